// The bonds: who lies where, flush ends, no overlaps, everything carried; disorder, yaw and order of creation.
#include <set>

#include "unit/masonry/wall_checks.h"

namespace brickfall {
namespace {

WallDef wallOf(Bond bond, int courses, int bricks) {
  WallDef wall;
  wall.bond = bond;
  wall.courses = courses;
  wall.bricksPerCourse = bricks;
  return wall;
}

TEST(RunningBond, IsTheHalfBatWallOfTheReport) {
  std::vector<BrickPlacement> bricks = lay(wallOf(Bond::running, 10, 10));
  ASSERT_EQ(bricks.size(), 105u);
  const double L = 0.215, H = 0.065;
  std::size_t next = 0;
  for (int course = 0; course < 10; course++) {
    int count = course % 2 == 0 ? 10 : 11;
    for (int i = 0; i < count; i++) {
      const BrickPlacement& brick = bricks[next++];
      bool half = count == 11 && (i == 0 || i == 10);
      double x = count == 10 ? L * (i + 0.5) : i == 0 ? L * 0.25 : i == 10 ? L * 9.75 : L * i;
      EXPECT_NEAR(brick.centre.x, x, 1e-14) << brick.name;
      EXPECT_NEAR(brick.centre.y, H * (course + 0.5), 1e-14) << brick.name;
      EXPECT_EQ(brick.centre.z, 0);
      EXPECT_NEAR(brick.size.x, half ? L / 2 : L, 1e-14);
      EXPECT_EQ(brick.cut, half);
      EXPECT_EQ(brick.course, course);
    }
  }
  EXPECT_EQ(bricks[0].name, "wall/0/0");
  EXPECT_EQ(bricks[20].name, "wall/1/10");
}

TEST(RunningBond, NeighboursOfALongWallTouchToRounding) {
  WallDef wall = wallOf(Bond::running, 4, 1000);
  std::vector<BrickPlacement> bricks = lay(wall);
  for (std::size_t i = 1; i < bricks.size(); i++) {
    if (bricks[i].course != bricks[i - 1].course) continue;
    EXPECT_NEAR(upperOf(bricks[i - 1]).x, lowerOf(bricks[i]).x, 1e-12) << bricks[i].name;
  }
}

TEST(RunningBond, ThirdBondOfWholeBricksIsToothed) {
  WallDef wall = wallOf(Bond::running, 10, 10);
  wall.bondShift = 1.0 / 3;
  wall.halfBats = false;
  std::vector<BrickPlacement> bricks = lay(wall);
  ASSERT_EQ(bricks.size(), 100u);
  for (const BrickPlacement& brick : bricks) EXPECT_FALSE(brick.cut);
  EXPECT_NEAR(lowerOf(bricks[10]).x, 0.215 / 3, 1e-14);
  EXPECT_NEAR(upperOf(bricks[19]).x, 10 * 0.215 + 0.215 / 3, 1e-12);
  expectNoOverlap(bricks);
  expectCarried(bricks);
}

TEST(RunningBond, JointsAreGaps) {
  WallDef wall = wallOf(Bond::running, 3, 5);
  wall.headJoint = 0.01;
  wall.bedJoint = 0.012;
  std::vector<BrickPlacement> bricks = lay(wall);
  EXPECT_NEAR(wallLength(wall), 5 * 0.225 - 0.01, 1e-15);
  EXPECT_NEAR(lowerOf(bricks[1]).x - upperOf(bricks[0]).x, 0.01, 1e-15);
  EXPECT_NEAR(bricks[5].size.x, 0.1025, 1e-15);  // half a brick less half a joint
  EXPECT_NEAR(lowerOf(bricks[5]).y - upperOf(bricks[0]).y, 0.012, 1e-15);
  EXPECT_NEAR(upperOf(bricks[10]).x, wallLength(wall), 1e-12);
}

struct BondCase {
  Bond bond;
  bool halfBats;
  double headJoint;
};

class EveryBond : public testing::TestWithParam<BondCase> {};

TEST_P(EveryBond, IsWithinItsEndsApartAndCarried) {
  for (int length = 2; length <= 9; length++) {
    WallDef wall = wallOf(GetParam().bond, 4, length);
    wall.halfBats = GetParam().halfBats;
    wall.headJoint = GetParam().headJoint;
    std::vector<BrickPlacement> bricks = lay(wall);
    EXPECT_EQ(std::int64_t(bricks.size()), brickCount(wall));
    expectNoOverlap(bricks);
    bool tippingEnds = wall.bond == Bond::stack || !wall.halfBats;  // toothed ends need a return wall
    if (!tippingEnds) expectCarried(bricks);
    std::set<std::string> names;
    for (const BrickPlacement& brick : bricks) {
      EXPECT_TRUE(names.insert(brick.name).second) << brick.name;
      EXPECT_LE(std::fabs(brick.centre.z) + 0.5 * brick.size.z, 0.5 * wallThickness(wall) + 1e-15);
      EXPECT_LE(brick.size.x, 0.215 + 1e-15);
      EXPECT_GE(lowerOf(brick).x, -1e-15);
      if (wall.halfBats) {
        EXPECT_LE(upperOf(brick).x, wallLength(wall) + 1e-12) << brick.name;
      }
    }
  }
}

class ClosedBond : public EveryBond {};

TEST_P(ClosedBond, HasFlushEnds) {
  WallDef wall = wallOf(GetParam().bond, 4, 7);
  wall.headJoint = GetParam().headJoint;
  std::vector<double> from(4, 1e9), to(4, -1e9);
  for (const BrickPlacement& brick : lay(wall)) {
    from[brick.course] = std::min(from[brick.course], lowerOf(brick).x);
    to[brick.course] = std::max(to[brick.course], upperOf(brick).x);
  }
  // Headers of UK bricks without joints leave 5 mm between them, and half of that at either end.
  double tolerance = wall.headJoint == 0 && wall.bond != Bond::header ? 0.00251 : 1e-12;
  for (int course = 0; course < 4; course++) {
    EXPECT_NEAR(from[course], 0, tolerance);
    EXPECT_NEAR(to[course], wallLength(wall), tolerance);
  }
}

constexpr BondCase kClosed[] = {{Bond::running, true, 0},    {Bond::header, true, 0},     {Bond::header, true, 0.01},
                                {Bond::english, true, 0},    {Bond::english, true, 0.01}, {Bond::flemish, true, 0},
                                {Bond::flemish, true, 0.01}, {Bond::stack, true, 0}};
constexpr BondCase kToothed[] = {
    {Bond::running, false, 0.01}, {Bond::header, false, 0}, {Bond::english, false, 0.01}, {Bond::flemish, false, 0.01}};
INSTANTIATE_TEST_SUITE_P(Closed, EveryBond, testing::ValuesIn(kClosed));
INSTANTIATE_TEST_SUITE_P(Toothed, EveryBond, testing::ValuesIn(kToothed));
INSTANTIATE_TEST_SUITE_P(Closed, ClosedBond, testing::ValuesIn(kClosed));

TEST(FlemishBond, HeadersAreCentredOnTheStretchersBelow) {
  WallDef wall = wallOf(Bond::flemish, 2, 7);
  wall.headJoint = 0.01;
  std::vector<BrickPlacement> bricks = lay(wall);
  int centred = 0;
  for (const BrickPlacement& header : bricks) {
    if (header.course != 1 || header.size.z < 0.2 || header.cut || lowerOf(header).x < 0.01) continue;
    for (const BrickPlacement& below : bricks)
      centred += below.course == 0 && below.size.x > 0.2 && std::fabs(below.centre.x - header.centre.x) < 1e-12;
  }
  EXPECT_EQ(centred, 2 * 3 + 2 * 0);  // three inner headers, each over two leaves
}

// The headers at the right end of 2, 3, 5, 6, ... bricks stood above each other, bonded to nothing.
TEST(FlemishBond, NoJointIsAboveAnotherAtAnyLength) {
  for (bool halfBats : {true, false})
    for (int length = 2; length <= 30; length++) {
      WallDef wall = wallOf(Bond::flemish, 2, length);
      wall.headJoint = 0.01;
      wall.halfBats = halfBats;
      std::set<double> ends[2];  // m, right ends of bricks within the wall
      double last[2] = {0, 0};
      const std::vector<BrickPlacement> bricks = lay(wall);
      for (const BrickPlacement& brick : bricks) last[brick.course] = std::max(last[brick.course], upperOf(brick).x);
      for (const BrickPlacement& brick : bricks)
        if (upperOf(brick).x < last[brick.course] - 1e-9) ends[brick.course].insert(upperOf(brick).x);
      EXPECT_NEAR(last[0], wallLength(wall), 1e-12) << length;
      double nearest = 1e9;
      for (double below : ends[0])
        for (double above : ends[1]) nearest = std::min(nearest, std::fabs(above - below));
      EXPECT_GE(ends[1].size(), std::size_t(2)) << length;
      EXPECT_GT(nearest, 0.04) << length << " bricks";  // a quarter brick
      // Both ends are alike.
      for (const std::set<double>& course : ends)
        for (double end : course) {
          const double mirrored =
              (&course == ends ? wallLength(wall) : last[1] + (halfBats ? 0 : 0.05625)) - end - 0.01;
          EXPECT_LT(std::fabs(*std::min_element(course.begin(), course.end(),
                                                [&](double a, double b) {
                                                  return std::fabs(a - mirrored) < std::fabs(b - mirrored);
                                                }) -
                              mirrored),
                    1e-9)
              << length;
        }
    }
}

TEST(EnglishBond, StretchersAndHeadersTakeTurns) {
  std::vector<BrickPlacement> bricks = lay(wallOf(Bond::english, 4, 5));
  for (const BrickPlacement& brick : bricks) EXPECT_EQ(brick.size.z > 0.2, brick.course % 2 == 1) << brick.name;
}

TEST(Disorder, StaysWithinItsBoundsAndRepeatsWithTheSeed) {
  WallDef wall = wallOf(Bond::running, 10, 10);
  std::vector<BrickPlacement> true_ = lay(wall);
  wall.disorder = 1e-4;
  std::vector<BrickPlacement> bricks = lay(wall, 7), again = lay(wall, 7), other = lay(wall, 8);
  double lowest = 1, highest = 0;
  int different = 0;
  for (std::size_t i = 0; i < bricks.size(); i++) {
    Vec3 moved = bricks[i].centre - true_[i].centre;
    double lift = moved.y - bricks[i].course * wall.disorder;
    lowest = std::min(lowest, lift);
    highest = std::max(highest, lift);
    EXPECT_LE(std::fabs(moved.x), 0.5 * wall.disorder + 1e-12);
    EXPECT_LE(std::fabs(moved.z), 0.5 * wall.disorder + 1e-12);
    EXPECT_LE(length(rotationVector(bricks[i].rotation)), 5 * wall.disorder + 1e-12);
    EXPECT_EQ(bricks[i].rotation.x, 0);
    EXPECT_EQ(bricks[i].centre, again[i].centre);
    different += bricks[i].centre != other[i].centre;
  }
  EXPECT_GE(lowest, -1e-12);  // no brick is pushed into the course below
  EXPECT_LE(highest, wall.disorder + 1e-12);
  EXPECT_GT(highest - lowest, 0.8 * wall.disorder);
  EXPECT_GT(different, 100);
}

TEST(Shuffle, ChangesTheOrderAndNothingElse) {
  WallDef wall = wallOf(Bond::running, 10, 10);
  wall.disorder = 5e-5;
  std::vector<BrickPlacement> plain = lay(wall, 3);
  wall.shuffle = true;
  std::vector<BrickPlacement> shuffled = lay(wall, 3);
  ASSERT_EQ(plain.size(), shuffled.size());
  int moved = 0;
  for (std::size_t i = 0; i < plain.size(); i++) {
    moved += plain[i].name != shuffled[i].name;
    auto found =
        std::find_if(shuffled.begin(), shuffled.end(), [&](auto& brick) { return brick.name == plain[i].name; });
    ASSERT_NE(found, shuffled.end());
    EXPECT_EQ(found->centre, plain[i].centre);
  }
  EXPECT_GT(moved, 90);
}

TEST(Yaw, TurnsTheWallAboutItsLeftEnd) {
  WallDef wall = wallOf(Bond::running, 2, 3);
  wall.position = {1, 2, 3};
  wall.yawDegrees = 90;
  std::vector<BrickPlacement> bricks = lay(wall);
  EXPECT_NEAR(bricks[2].centre.x, 1, 1e-14);  // along +x before, along -z now
  EXPECT_NEAR(bricks[2].centre.y, 2.0325, 1e-14);
  EXPECT_NEAR(bricks[2].centre.z, 3 - 2.5 * 0.215, 1e-14);
  Vec3 along = rotate(bricks[2].rotation, Vec3{1, 0, 0});
  EXPECT_NEAR(along.z, -1, 1e-14);
}

TEST(Yaw, KeepsNeighboursTouching) {
  WallDef wall = wallOf(Bond::running, 1, 100);
  wall.yawDegrees = 37;
  std::vector<BrickPlacement> bricks = lay(wall);
  for (std::size_t i = 1; i < bricks.size(); i++)
    EXPECT_NEAR(length(bricks[i].centre - bricks[i - 1].centre), 0.215, 1e-12);
}

}  // namespace
}  // namespace brickfall
