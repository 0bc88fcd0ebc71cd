// Every kind of pair that the contact functions know, by families of random pairs, against the slow method of solid.h.
#include <gtest/gtest.h>

#include <cstdio>

#include "contact_audit.h"
#include "support/validation_record.h"

namespace brickfall::oracle {
namespace {

using test::ValidationRow;

#ifndef BRICKFALL_PAIRS
#define BRICKFALL_PAIRS 5000
#endif

const char* nameOf(ShapeType type) {
  constexpr const char* kNames[] = {"box", "sphere", "capsule", "hull", "plane"};
  return kNames[int(type)];
}

struct Kind {
  ShapeType first, second;
};
void PrintTo(const Kind& kind, std::ostream* out) { *out << nameOf(kind.first) << "-" << nameOf(kind.second); }

class Pairs : public testing::TestWithParam<Kind> {};

constexpr long kPairs = BRICKFALL_PAIRS;

// Each regime was really met.
void expectRegimes(const ContactAudit& audit, Kind kind, const std::vector<Family>& families) {
  for (Family family : families)
    EXPECT_GE(audit.seen(oracle::nameOf(family)), kPairs / long(families.size())) << oracle::nameOf(family);
  EXPECT_GT(audit.seen("overlapping"), kPairs / 3);
  EXPECT_GT(audit.seen("not overlapping"), kPairs / 3);
  EXPECT_GT(audit.seen("touching (1e-9 of the size)"), kPairs / 15);
  EXPECT_GT(audit.seen("within the margin"), kPairs / 4);
  auto flat = [](ShapeType t) { return t == ShapeType::box || t == ShapeType::hull; };
  if (kind.first == ShapeType::sphere || kind.second == ShapeType::sphere) return;
  EXPECT_GT(audit.seen("points: 1"), kPairs / 5);
  EXPECT_GT(audit.seen("points: 2"), kPairs / 20);
  if (!flat(kind.first) || !flat(kind.second)) return;
  EXPECT_GT(audit.seen("points: 3"), kPairs / 50);
  EXPECT_GT(audit.seen("points: 4"), kPairs / 10);
  EXPECT_GT(audit.seen("edge crossings"), kPairs / 12);
}

// What contacts that remember no more than which points carried cannot avoid is rare: other axes or points that are as good.
void expectRare(const ContactAudit& audit) {
  long motions = audit.seen("small motions"), few = motions / 100 + 5;
  EXPECT_LT(audit.seen("points jump with the normal kept"), few);
  EXPECT_LT(audit.seen("normal jumps"), 2 * few);
  EXPECT_LT(audit.seen("normal jumps while overlapping"), 2 * few);
  EXPECT_LT(audit.seen("contact lost by a small motion"), few);
  EXPECT_LT(audit.seen("contact one way round only"), few);
  EXPECT_LT(audit.seen("deep: less than the depth shown"), few);
  EXPECT_LT(audit.seen("capsule through a hull: point beside the face"), few);
  EXPECT_LT(audit.seen("within the margin, unseen"), 4 * few);
}

void keepRows(const ContactAudit& audit, const std::string& pair) {
  for (const auto& [what, f] : audit.findings()) {
    std::printf("%-50s asked %7ld, over the limit %ld, worst %.3g of the limit (up to %.3g)\n", what.c_str(), f.asked,
                f.over, f.worst, f.limit);
    ValidationRow row;
    row.section = "collision";
    row.name = pair + ": " + what;
    row.expected = 1;
    row.found = f.worst;
    row.atMost = true;
    row.unit = "of the limit";
    row.pass = f.over == 0;
    row.cases = int(f.asked);
    test::record(row);
  }
  for (const auto& [what, n] : audit.counts()) std::printf("  %-45s %ld\n", what.c_str(), n);
}

TEST_P(Pairs, AgainstTheSlowMethod) {
  auto [first, second] = GetParam();
  PairSource source(first, second, 100 + std::uint64_t(first) * 10 + std::uint64_t(second));
  std::vector<Family> families;
  for (int f = 0; f < kFamilies; f++)
    if (source.has(Family(f))) families.push_back(Family(f));
  ContactAudit audit;
  for (long n = 0; n < kPairs; n++) {
    Family family = families[std::size_t(n) % families.size()];
    audit.look(source.next(family), family, n);
  }
  EXPECT_GE(audit.findings().size(), 10u);
  for (const auto& [what, f] : audit.findings())
    EXPECT_EQ(f.over, 0) << what << ": of " << f.asked << ", worst " << f.worst << " times what is allowed, "
                         << f.example;
  expectRegimes(audit, GetParam(), families);
  expectRare(audit);
  if (kPairs >= 100000) keepRows(audit, std::string(nameOf(first)) + " and " + nameOf(second));
}

const Kind kKinds[] = {{ShapeType::plane, ShapeType::sphere},    {ShapeType::plane, ShapeType::capsule},
                       {ShapeType::plane, ShapeType::box},       {ShapeType::plane, ShapeType::hull},
                       {ShapeType::sphere, ShapeType::sphere},   {ShapeType::sphere, ShapeType::capsule},
                       {ShapeType::sphere, ShapeType::box},      {ShapeType::sphere, ShapeType::hull},
                       {ShapeType::capsule, ShapeType::capsule}, {ShapeType::capsule, ShapeType::box},
                       {ShapeType::capsule, ShapeType::hull},    {ShapeType::box, ShapeType::box},
                       {ShapeType::box, ShapeType::hull},        {ShapeType::hull, ShapeType::hull}};
INSTANTIATE_TEST_SUITE_P(Kinds, Pairs, testing::ValuesIn(kKinds), [](const testing::TestParamInfo<Kind>& kind) {
  return std::string(nameOf(kind.param.first)) + "_" + nameOf(kind.param.second);
});

}  // namespace
}  // namespace brickfall::oracle
