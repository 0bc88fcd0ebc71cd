// Walls that can't be built: each mistake is named by its field, with what was found and what was expected.
#include <functional>
#include <limits>

#include "unit/masonry/wall_checks.h"

namespace brickfall {
namespace {

struct BadWall {
  const char* field;
  const char* part;  // of the message
  std::function<void(WallDef&)> spoil;
};

Opening opening(double from, double width, double sill = 0.2, double height = 0.2) {
  Opening o;
  o.from = from;
  o.width = width;
  o.sill = sill;
  o.height = height;
  return o;
}

const double kNan = std::numeric_limits<double>::quiet_NaN();
const double kInfinity = std::numeric_limits<double>::infinity();

const BadWall kBadWalls[] = {
    {"courses", "found 0, expected 1 .. 10000", [](WallDef& w) { w.courses = 0; }},
    {"courses", "found -3", [](WallDef& w) { w.courses = -3; }},
    {"bricksPerCourse", "found 10001", [](WallDef& w) { w.bricksPerCourse = 10001; }},
    {"brick.size.x", "found nan", [](WallDef& w) { w.brick.size.x = kNan; }},
    {"brick.size.y", "found 0, expected 0.001 .. 100 m", [](WallDef& w) { w.brick.size.y = 0; }},
    {"brick.size.z", "found inf", [](WallDef& w) { w.brick.size.z = kInfinity; }},
    {"headJoint", "found -0.01", [](WallDef& w) { w.headJoint = -0.01; }},
    {"bedJoint", "found nan", [](WallDef& w) { w.bedJoint = kNan; }},
    {"position.x", "found 1e+09", [](WallDef& w) { w.position.x = 1e9; }},
    {"yawDegrees", "found inf", [](WallDef& w) { w.yawDegrees = kInfinity; }},
    {"disorder", "found 1, expected 0 .. 0.01 m", [](WallDef& w) { w.disorder = 1; }},
    {"bondShift", "cut bricks of 0.00215 and 0.21285 m", [](WallDef& w) { w.bondShift = 0.01; }},
    {"brick.size", "need length >= 2 widths",
     [](WallDef& w) {
       w.bond = Bond::english;
       w.brick.size.z = 0.15;
     }},
    {"bricksPerCourse", "expected at least 2",
     [](WallDef& w) {
       w.bond = Bond::flemish;
       w.bricksPerCourse = 1;
     }},
    {"courses", "has 100005000 bricks, expected at most 1000000",
     [](WallDef& w) { w.courses = w.bricksPerCourse = 10000; }},
    {"openings[0].width", "found 0", [](WallDef& w) { w.openings = {opening(0.5, 0)}; }},
    {"openings[0].from", "found nan", [](WallDef& w) { w.openings = {opening(kNan, 0.5)}; }},
    {"openings[0].width", "ends at 2.5 m, expected inside the wall's length of 2.15 m",
     [](WallDef& w) { w.openings = {opening(1.5, 1)}; }},
    {"openings[0].lintelBearing", "the lintel reaches from -0.05",
     [](WallDef& w) { w.openings = {opening(0.1, 0.5)}; }},
    {"openings[0].sill", "above the wall", [](WallDef& w) { w.openings = {opening(0.5, 0.5, 3)}; }},
    {"openings[0].height", "takes no whole course", [](WallDef& w) { w.openings = {opening(0.5, 0.5, 0.2, 0.02)}; }},
    {"openings[1].from", "meets opening 0",
     [](WallDef& w) {
       w.openings = {opening(0.5, 0.5), opening(0.8, 0.5)};
     }},
    {"openings[0].width", "expected at most 120: 1.6",
     [](WallDef& w) {
       w.radius = 1;
       w.openings = {opening(0, 2.5)};
     }},
    {"openings[1].from", "meets opening 0",  // across the seam
     [](WallDef& w) {
       w.radius = 1;
       w.openings = {opening(5.6, 0.3), opening(0, 0.3)};
     }},
    {"openings[1].from", "meets opening 0",  // the lintels meet
     [](WallDef& w) {
       w.openings = {opening(0.3, 0.4), opening(0.8, 0.4)};
     }},
};

TEST(CheckWall, NamesTheFieldWhatWasFoundAndWhatWasExpected) {
  for (const BadWall& bad : kBadWalls) {
    WallDef wall;
    bad.spoil(wall);
    std::vector<WallProblem> problems = checkWall(wall);
    ASSERT_FALSE(problems.empty()) << bad.field << " " << bad.part;
    EXPECT_EQ(problems[0].field, bad.field);
    EXPECT_NE(problems[0].message.find(bad.part), std::string::npos) << problems[0].message << "\nwanted " << bad.part;
    auto bricks = layBricks(wall, 1);
    ASSERT_FALSE(bricks.ok());
    EXPECT_EQ(bricks.error().code, ErrorCode::invalidArgument);
    EXPECT_NE(bricks.error().message.find(bad.field), std::string::npos);
  }
}

TEST(CheckWall, ReportsAllMistakes) {
  WallDef wall;
  wall.courses = 0;
  wall.headJoint = kNan;
  wall.disorder = -1;
  EXPECT_EQ(checkWall(wall).size(), 3u);
}

TEST(CheckWall, AcceptsEverySmallWall) {
  for (int bond = 0; bond < 5; bond++)
    for (int courses = 1; courses <= 3; courses++) {
      WallDef wall;
      wall.bond = Bond(bond);
      wall.courses = courses;
      wall.bricksPerCourse = 2;
      EXPECT_TRUE(checkWall(wall).empty());
    }
}

}  // namespace
}  // namespace brickfall
