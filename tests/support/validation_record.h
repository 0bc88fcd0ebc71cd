// What a test measured, kept for the validation page: with BRICKFALL_VALIDATION_DIR set, each row and curve becomes one
// line of JSON in <folder>/<suite>.<test>.jsonl, from which tools/validation-page makes docs/validation.md. A test that
// runs again replaces its file. Without the variable nothing is written.
#pragma once
#include <string>
#include <vector>

namespace brickfall::test {

struct ValidationRow {
  std::string section;   // number of the law ("7", "15a"), or a heading of its own ("oracle")
  std::string name;      // the case
  double dt = 0;         // s; 0: not one time step
  double expected = 0;   // or the limit, if atMost
  double found = 0;      // the worst of `cases`
  double tolerance = 0;  // |found - expected| allowed
  bool atMost = false;   // found <= expected is asked, not nearness
  std::string unit;      // SI or as written ("mm", "%"); empty: a pure number
  bool pass = true;      // the law holds (not: the test passed)
  int cases = 1;         // how many the row stands for
  std::string note;      // which was the worst; why it is off
};

struct ValidationSeries {
  std::string name;
  std::vector<double> x, y;
};
struct ValidationCurve {
  std::string section, title;
  std::string xAxis, yAxis;             // with units: "time, s"
  std::vector<ValidationSeries> found;  // drawn as lines
  std::vector<ValidationSeries> exact;  // drawn dashed
  std::string note;
};

bool recordsValidation();
void record(const ValidationRow& row);
void record(const ValidationCurve& curve);

}  // namespace brickfall::test
