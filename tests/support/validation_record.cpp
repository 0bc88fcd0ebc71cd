#include "support/validation_record.h"

#include <gtest/gtest.h>

#include <cstdlib>
#include <fstream>
#include <nlohmann/json.hpp>
#include <set>

namespace brickfall::test {

namespace {

std::string fileOfThisTest() {
  std::string name = "outside";
  if (const testing::TestInfo* test = testing::UnitTest::GetInstance()->current_test_info())
    name = std::string(test->test_suite_name()) + "." + test->name();
  for (char& c : name)
    if (c == '/') c = '_';
  return std::string(std::getenv("BRICKFALL_VALIDATION_DIR")) + "/" + name + ".jsonl";
}

void append(const nlohmann::json& line) {
  static std::set<std::string> begun;  // files that this process began; what an earlier run left is replaced
  std::string name = fileOfThisTest();
  std::ofstream file(name, begun.insert(name).second ? std::ios::trunc : std::ios::app);
  file << line.dump() << '\n';
  file.flush();
  EXPECT_TRUE(file.good()) << "cannot write " << name;
}

nlohmann::json toJson(const std::vector<ValidationSeries>& all) {
  nlohmann::json out = nlohmann::json::array();
  for (const ValidationSeries& s : all) out.push_back({{"name", s.name}, {"x", s.x}, {"y", s.y}});
  return out;
}

}  // namespace

bool recordsValidation() {
  const char* folder = std::getenv("BRICKFALL_VALIDATION_DIR");
  return folder && *folder;
}

void record(const ValidationRow& row) {
  if (!recordsValidation()) return;
  append({{"kind", "row"},
          {"section", row.section},
          {"case", row.name},
          {"dt", row.dt},
          {"expected", row.expected},
          {"found", row.found},
          {"tolerance", row.tolerance},
          {"atMost", row.atMost},
          {"unit", row.unit},
          {"pass", row.pass},
          {"cases", row.cases},
          {"note", row.note}});
}

void record(const ValidationCurve& curve) {
  if (!recordsValidation()) return;
  append({{"kind", "curve"},
          {"section", curve.section},
          {"title", curve.title},
          {"xAxis", curve.xAxis},
          {"yAxis", curve.yAxis},
          {"found", toJson(curve.found)},
          {"exact", toJson(curve.exact)},
          {"note", curve.note}});
}

}  // namespace brickfall::test
