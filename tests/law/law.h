// Each law states what it should give, what it gave and the tolerance: printed, kept for the validation page, and checked.
#pragma once
#include <cctype>
#include <cstdio>
#include <map>
#include <string>

#include "support/lab_measure.h"
#include "support/validation_record.h"
#include "support/world_helpers.h"

namespace brickfall::law {

using namespace brickfall::test;

constexpr double kSteps[] = {1.0 / 30, 1.0 / 60, 1.0 / 120, 1.0 / 240};

inline World worldOnFloor(double friction) {
  World world = makeWorld();
  add(world, bodyOf(boxOf({50, 0.5, 20}, 1000, friction), {0, -0.5, 0}, BodyType::fixed));
  return world;
}

// "15a" of a test named Row15a...: the row of laws and of the validation page that a figure belongs to.
inline std::string section() {
  std::string name = testing::UnitTest::GetInstance()->current_test_info()->name();
  if (name.rfind("Row", 0) != 0) return "hits";
  std::size_t end = 3;
  while (end < name.size() && std::isdigit(static_cast<unsigned char>(name[end]))) end++;
  if (end < name.size() && name[end] >= 'a' && name[end] <= 'z') end++;
  return name.substr(3, end - 3);
}
inline std::string at(double dt) { return dt > 0 ? " at 1/" + std::to_string(std::lround(1 / dt)) + " s" : ""; }
inline std::string text(double value, int digits) {
  char out[32];
  std::snprintf(out, sizeof out, "%.*f", digits, value);
  return out;
}

struct Check {
  std::string name;
  double dt = 0;  // s; 0: not one time step
  double found = 0, expected = 0, tolerance = 0;
  std::string unit;
  double bound = 0;  // where the engine is known to be further off than the law allows: no worse than this
};

inline void reached(const Check& c) {
  std::printf("    %-52s %12.6g, expected %.6g +- %.3g %s\n", (c.name + at(c.dt)).c_str(), c.found, c.expected,
              c.tolerance, c.unit.c_str());
  record({.section = section(),
          .name = c.name,
          .dt = c.dt,
          .expected = c.expected,
          .found = c.found,
          .tolerance = c.tolerance,
          .unit = c.unit,
          .pass = std::fabs(c.found - c.expected) <= c.tolerance});
  EXPECT_NEAR(c.found, c.expected, std::max(c.tolerance, c.bound)) << c.name << at(c.dt) << ", " << c.unit;
}
inline void atMost(const std::string& name, double dt, double found, double limit, const char* unit, double bound = 0) {
  std::printf("    %-52s %12.6g, at most %.6g %s\n", (name + at(dt)).c_str(), found, limit, unit);
  record({.section = section(),
          .name = name,
          .dt = dt,
          .expected = limit,
          .found = found,
          .atMost = true,
          .unit = unit,
          .pass = found <= limit});
  EXPECT_LE(found, std::max(limit, bound)) << name << at(dt) << ", " << unit;
}

// The same law in many worlds: the worst case for each time step, and which it was. Reports when it goes out of scope.
class Sweep {
 public:
  Sweep(std::string name, double tolerance, std::string unit) : name_(name), tolerance_(tolerance), unit_(unit) {}
  Sweep(const Sweep&) = delete;
  // `bound`: what the engine is held to in this case, if it is known to miss the law's tolerance.
  void add(double dt, double error, const std::string& which, double bound = 0) {
    EXPECT_LE(std::fabs(error), std::max(bound, tolerance_)) << name_ << ", " << unit_ << ": " << which;
    Worst& w = worst_[-std::lround(1 / dt)];
    w.dt = dt;
    w.cases++;
    if (w.cases > 1 && !(std::fabs(error) > w.error)) return;
    w.error = std::fabs(error);
    w.which = which;
  }
  ~Sweep() {
    for (const auto& [key, w] : worst_) {
      std::printf("    %-52s %12.6g, at most %.6g %s; worst of %d: %s\n", (name_ + at(w.dt)).c_str(), w.error,
                  tolerance_, unit_.c_str(), w.cases, w.which.c_str());
      record({.section = section(),
              .name = name_,
              .dt = w.dt,
              .expected = tolerance_,
              .found = w.error,
              .atMost = true,
              .unit = unit_,
              .pass = w.error <= tolerance_,
              .cases = w.cases,
              .note = w.which});
    }
  }

 private:
  struct Worst {
    double dt = 0, error = 0;
    int cases = 0;
    std::string which;
  };
  std::string name_;
  double tolerance_;
  std::string unit_;
  std::map<long, Worst> worst_;
};

// A curve of the page; points closer in x than `every` are left out.
class Trace {
 public:
  explicit Trace(std::string name, double every = 0) : series_{std::move(name), {}, {}}, every_(every) {}
  void add(double x, double y) {
    if (!series_.x.empty() && x - series_.x.back() < every_ * (1 - 1e-9)) return;
    series_.x.push_back(x);
    series_.y.push_back(y);
  }
  const ValidationSeries& series() const { return series_; }

 private:
  ValidationSeries series_;
  double every_;
};
// y(x) on an even grid.
template <class F> ValidationSeries exactCurve(std::string name, double from, double to, F y, int points = 200) {
  ValidationSeries s{std::move(name), {}, {}};
  for (int i = 0; i <= points; i++) {
    s.x.push_back(from + (to - from) * i / points);
    s.y.push_back(y(s.x.back()));
  }
  return s;
}

}  // namespace brickfall::law
