// Each law states what it should give, what it gave and the tolerance: printed, and kept in the test report.
#pragma once
#include <cctype>
#include <cstdio>

#include "support/lab_measure.h"
#include "support/validation_record.h"
#include "support/world_helpers.h"

namespace brickfall::law {

using namespace brickfall::test;

// "15a" of a test named Row15a...: the row of the validation page that a figure belongs to.
inline std::string section() {
  std::string name = testing::UnitTest::GetInstance()->current_test_info()->name();
  if (name.rfind("Row", 0) != 0) return "more";
  std::size_t end = 3;
  while (end < name.size() && std::isdigit(static_cast<unsigned char>(name[end]))) end++;
  if (end < name.size() && (name[end] == 'a' || name[end] == 'b')) end++;
  return name.substr(3, end - 3);
}
inline void reached(const std::string& what, double found, double expected, double tolerance, const char* unit) {
  std::printf("    %-44s %12.6g, expected %.6g +- %.3g %s\n", what.c_str(), found, expected, tolerance, unit);
  record({.section = section(),
          .name = what,
          .expected = expected,
          .found = found,
          .tolerance = tolerance,
          .unit = unit,
          .pass = std::fabs(found - expected) <= tolerance});
  EXPECT_NEAR(found, expected, tolerance) << what << ", " << unit;
}
inline void atMost(const std::string& what, double found, double limit, const char* unit) {
  std::printf("    %-44s %12.6g, at most %.6g %s\n", what.c_str(), found, limit, unit);
  record({.section = section(),
          .name = what,
          .expected = limit,
          .found = found,
          .atMost = true,
          .unit = unit,
          .pass = found <= limit});
  EXPECT_LE(found, limit) << what << ", " << unit;
}
inline std::string at(double dt) { return " at 1/" + std::to_string(std::lround(1 / dt)) + " s"; }

// A box on an inclined plane: either a fixed box is tilted, or gravity is and the ground stays level.
struct Incline {
  World world;
  BodyId box;
  Vec3 start, down;  // unit, along the slope

  Incline(double degrees, double friction, bool tiltGravity, Vec3 half = {0.25, 0.1, 0.25}, double yawDegrees = 0)
      : world(makeWorld(definition(degrees, tiltGravity))) {
    double angle = tiltGravity ? 0 : degrees;
    Quat slope = turn({0, 0, 1}, -angle);  // down along +x
    Quat yaw = turn({0, 1, 0}, yawDegrees);
    BodyDef plane = bodyOf(boxOf({30, 0.5, 30}, 1000, friction), rotate(slope, Vec3{0, -0.5, 0}), BodyType::fixed);
    plane.rotation = slope;
    add(world, plane);
    BodyDef d = bodyOf(boxOf(half, 1000, friction), rotate(slope, Vec3{0, half.y, 0}));
    d.rotation = slope * yaw;
    box = add(world, d);
    start = d.position;
    down = rotate(slope, Vec3{1, 0, 0});
  }
  double slid() const { return dot(world.state(box)->position - start, down); }
  double moved() const { return length(world.state(box)->position - start); }

 private:
  static WorldDef definition(double degrees, bool tiltGravity) {
    WorldDef def;
    def.enableSleep = false;
    double angle = degrees * kPi / 180;
    if (tiltGravity) def.gravity = {kG * std::sin(angle), -kG * std::cos(angle), 0};
    return def;
  }
};

}  // namespace brickfall::law
