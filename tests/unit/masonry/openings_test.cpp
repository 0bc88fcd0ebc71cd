// Doors and windows: the hole is clear, cut pieces are not slivers, lintels carry what is above.
#include "unit/masonry/wall_checks.h"

namespace brickfall {
namespace {

WallDef wallWith(Bond bond, double joint, std::vector<Opening> openings) {
  WallDef wall;
  wall.bond = bond;
  wall.courses = 24;
  wall.bricksPerCourse = 14;
  wall.headJoint = joint;
  wall.openings = std::move(openings);
  return wall;
}

Opening window(double from, double sill, double width = 0.6, double height = 0.5) {
  Opening opening;
  opening.from = from;
  opening.sill = sill;
  opening.width = width;
  opening.height = height;
  return opening;
}

TEST(Openings, AreClearAndTheRestIsCarriedInEveryBond) {
  for (Bond bond : {Bond::running, Bond::english, Bond::flemish})
    for (double joint : {0.0, 0.01})
      for (int step = 0; step < 22; step++) {  // the reveal wanders across a brick
        double from = 0.5 + 0.01 * step;
        WallDef wall = wallWith(bond, joint, {window(from, 0.39), window(from + 1.4, 0, 0.7, 0.91)});
        std::vector<BrickPlacement> bricks = lay(wall, 1);
        expectNoOverlap(bricks);
        expectCarried(bricks);
        int lintels = 0;
        for (const BrickPlacement& brick : bricks) {
          lintels += brick.lintel;
          if (brick.lintel) continue;
          bool windowRow = brick.centre.y > 0.39 && brick.centre.y < 0.89;
          bool doorRow = brick.centre.y < 0.91;
          Vec3 l = lowerOf(brick), u = upperOf(brick);
          double inWindow = windowRow ? shared(l.x, u.x, from, from + 0.6) : 0;
          double inDoor = doorRow ? shared(l.x, u.x, from + 1.4, from + 2.1) : 0;
          EXPECT_LT(inWindow, 1e-9) << brick.name;
          EXPECT_LT(inDoor, 1e-9) << brick.name;
          EXPECT_LE(brick.size.x, 0.215 + 1e-9) << brick.name;
          EXPECT_GE(brick.size.x, 0.046) << brick.name << " at " << from;
        }
        EXPECT_EQ(lintels, 2);
      }
}

TEST(Openings, LintelBearsOnBothSides) {
  WallDef wall = wallWith(Bond::running, 0, {window(1, 0.39)});
  wall.openings[0].lintelBearing = 0.2;
  wall.openings[0].lintelHeight = 0.13;
  for (const BrickPlacement& brick : lay(wall)) {
    if (!brick.lintel) continue;
    EXPECT_NEAR(lowerOf(brick).x, 0.8, 1e-12);
    EXPECT_NEAR(upperOf(brick).x, 1.8, 1e-12);
    EXPECT_NEAR(brick.size.y, 0.13, 1e-12);  // two courses
    EXPECT_NEAR(lowerOf(brick).y, 14 * 0.065, 1e-12);
  }
}

TEST(Openings, NoLintelAtTheTopOfTheWallOrIfNotWanted) {
  WallDef top = wallWith(Bond::running, 0, {window(1, 1, 0.6, 5)});
  for (const BrickPlacement& brick : lay(top)) EXPECT_FALSE(brick.lintel);
  WallDef none = wallWith(Bond::running, 0, {window(1, 0.39)});
  none.openings[0].lintelHeight = 0;
  for (const BrickPlacement& brick : lay(none)) EXPECT_FALSE(brick.lintel);
}

TEST(Openings, SillAndHeadMoveToTheNearestBedJoint) {
  WallDef wall = wallWith(Bond::running, 0, {window(1, 0.38, 0.6, 0.54)});  // 5.85 courses and 14.15 courses
  int inside = 0;
  for (const BrickPlacement& brick : lay(wall))
    inside += !brick.lintel && brick.centre.x > 1 && brick.centre.x < 1.6 && brick.course >= 6 && brick.course < 14;
  EXPECT_EQ(inside, 0);
  bool below = false;
  for (const BrickPlacement& brick : lay(wall))
    below |= brick.course == 5 && brick.centre.x > 1 && brick.centre.x < 1.6;
  EXPECT_TRUE(below);
}

TEST(Openings, AWallAlreadyJointedAtTheRevealIsNotCut) {
  WallDef wall = wallWith(Bond::stack, 0, {window(2 * 0.215, 0.39, 3 * 0.215, 0.52)});
  wall.openings[0].lintelBearing = 0.215;
  for (const BrickPlacement& brick : lay(wall)) EXPECT_FALSE(brick.cut) << brick.name;
}

}  // namespace
}  // namespace brickfall
