// Mortar between bricks: how many joints, on which outlines, and bricks that meet in the middle of their joints.
#include <chrono>
#include <map>
#include <set>

#include "unit/masonry/wall_checks.h"

namespace brickfall {
namespace {

WallDef laidIn(Bond bond, int courses, int bricks, double head = 0.01, double bed = 0.01) {
  WallDef wall;
  wall.bond = bond;
  wall.courses = courses;
  wall.bricksPerCourse = bricks;
  wall.headJoint = head;
  wall.bedJoint = bed;
  return wall;
}

MortarLayout mortarOf(const WallDef& wall) {
  const std::vector<BrickPlacement> bricks = lay(wall);
  return layMortar(std::vector<MortaredBricks>{{bricks, jointWidths(wall)}});
}

Vec3 areaVector(const std::vector<Vec3>& outline) {
  Vec3 twice;
  for (std::size_t i = 2; i < outline.size(); i++) twice += cross(outline[i - 1] - outline[0], outline[i] - outline[0]);
  return twice * 0.5;
}

int countOf(const MortarLayout& layout, bool bed) {
  return int(std::count_if(layout.joints.begin(), layout.joints.end(),
                           [&](const MortarJoint& joint) { return joint.bed == bed; }));
}

double areaOf(const MortarLayout& layout, bool bed) {
  double area = 0;
  for (const MortarJoint& joint : layout.joints)
    if (joint.bed == bed) area += length(areaVector(joint.outline));
  return area;
}

// What any layout satisfies: sorted, anticlockwise as seen from b, in the middle of the gap, each pair once; grown bricks apart.
void expectSound(const std::vector<BrickPlacement>& bricks, const MortarLayout& layout) {
  std::pair<std::size_t, std::size_t> last{0, 0};
  for (const MortarJoint& joint : layout.joints) {
    const auto pair = std::pair(joint.a, joint.b);
    EXPECT_LT(joint.a, joint.b);
    EXPECT_LT(last, pair);
    last = pair;
    const Vec3 normal = normalized(areaVector(joint.outline));
    EXPECT_GT(dot(normal, bricks[joint.b].centre - bricks[joint.a].centre), 0);
    EXPECT_EQ(joint.bed, std::fabs(normal.y) > 0.99);
    for (Vec3 corner : joint.outline)
      EXPECT_NEAR(dot(corner - joint.outline[0], normal), 0, 1e-12) << "not in one plane";
  }
  std::vector<BrickPlacement> grown = bricks;
  ASSERT_EQ(layout.grown.size(), bricks.size());
  for (std::size_t k = 0; k < grown.size(); k++) {
    grown[k].centre = layout.grown[k].centre;
    grown[k].size = layout.grown[k].size;
    for (int i = 0; i < 3; i++) EXPECT_GE(grown[k].size[i], bricks[k].size[i]);
  }
  expectNoOverlap(grown);
}

TEST(Mortar, JoinsARunningWallByCount) {
  const WallDef wall = laidIn(Bond::running, 10, 10);
  const std::vector<BrickPlacement> bricks = lay(wall);
  const MortarLayout layout = mortarOf(wall);
  EXPECT_EQ(countOf(layout, false), 5 * 9 + 5 * 10);
  EXPECT_EQ(countOf(layout, true), 9 * 20);
  expectSound(bricks, layout);
  // The bricks' own faces: half a brick less half a joint, and a head face.
  for (const MortarJoint& joint : layout.joints) {
    EXPECT_NEAR(joint.thickness, 0.01, 1e-12);
    EXPECT_NEAR(length(areaVector(joint.outline)), joint.bed ? 0.1025 * 0.1025 : 0.065 * 0.1025, 1e-12);
    EXPECT_EQ(joint.outline.size(), 4u);
  }
  // Bricks and mortar fill the wall, and nothing sticks out of it.
  double volume = 0;
  for (const GrownBrick& brick : layout.grown) volume += brick.size.x * brick.size.y * brick.size.z;
  EXPECT_NEAR(volume, wallLength(wall) * (10 * 0.075 - 0.01) * 0.1025, 1e-12);
}

TEST(Mortar, NeedsNoThickness) {
  const MortarLayout layout = mortarOf(laidIn(Bond::running, 10, 10, 0, 0));
  EXPECT_EQ(countOf(layout, false), 5 * 9 + 5 * 10);
  EXPECT_EQ(countOf(layout, true), 9 * 20);
  EXPECT_NEAR(areaOf(layout, true), 9 * 10 * 0.215 * 0.1025, 1e-12);
  for (const GrownBrick& brick : layout.grown) EXPECT_NEAR(brick.size.y, 0.065, 1e-15);
}

TEST(Mortar, IsTheSameInAnyPlaceAndOrder) {
  WallDef wall = laidIn(Bond::running, 6, 8);
  const MortarLayout straight = mortarOf(wall);
  wall.yawDegrees = 37;
  wall.position = {1200, -30, 555};
  wall.shuffle = true;
  const std::vector<BrickPlacement> bricks = lay(wall), unturned = lay(laidIn(Bond::running, 6, 8));
  const MortarLayout turned = mortarOf(wall);
  std::map<std::set<std::string>, double> areas;
  for (const MortarJoint& joint : straight.joints)
    areas[{unturned[joint.a].name, unturned[joint.b].name}] = length(areaVector(joint.outline));
  ASSERT_EQ(areas.size(), turned.joints.size());
  for (const MortarJoint& joint : turned.joints) {
    const double area = areas[{bricks[joint.a].name, bricks[joint.b].name}];
    EXPECT_NEAR(length(areaVector(joint.outline)), area, 1e-10);
    EXPECT_GT(dot(areaVector(joint.outline), bricks[joint.b].centre - bricks[joint.a].centre), 0);
  }
}

TEST(Mortar, ReachesEveryBrickOfEveryBond) {
  for (Bond bond : {Bond::running, Bond::header, Bond::english, Bond::flemish, Bond::stack})
    for (bool halfBats : {true, false}) {
      WallDef wall = laidIn(bond, 6, 6);
      wall.halfBats = halfBats;
      const std::vector<BrickPlacement> bricks = lay(wall);
      const MortarLayout layout = mortarOf(wall);
      expectSound(bricks, layout);
      std::vector<std::size_t> root(bricks.size());
      for (std::size_t k = 0; k < root.size(); k++) root[k] = k;
      const auto find = [&](std::size_t k) {
        while (root[k] != k) k = root[k];
        return k;
      };
      for (const MortarJoint& joint : layout.joints) root[find(joint.a)] = find(joint.b);
      for (std::size_t k = 0; k < root.size(); k++)
        EXPECT_EQ(find(k), find(0)) << bricks[k].name << " of bond " << int(bond);
      // All that lies on each other is joined.
      double beds = 0;
      for (const BrickPlacement& a : bricks)
        for (const BrickPlacement& b : bricks)
          if (b.course == a.course + 1)
            beds += std::max(0.0, shared(lowerOf(a).x, upperOf(a).x, lowerOf(b).x, upperOf(b).x)) *
                    std::max(0.0, shared(lowerOf(a).z, upperOf(a).z, lowerOf(b).z, upperOf(b).z));
      EXPECT_NEAR(areaOf(layout, true), beds, 1e-9) << int(bond);
    }
}

TEST(Mortar, FillsTheJointBetweenTheLeavesOfAThickWall) {
  const WallDef wall = laidIn(Bond::english, 1, 4);
  const MortarLayout layout = mortarOf(wall);
  // Two leaves of four stretchers: two rows of three head joints, and each brick to the one behind it.
  EXPECT_EQ(countOf(layout, false), 2 * 3 + 4);
  for (const GrownBrick& brick : layout.grown) EXPECT_NEAR(brick.size.z, 0.1025 + 0.005, 1e-12);
  // A brick more than twice as long as wide leaves a cavity, which stays open.
  WallDef cavity = laidIn(Bond::english, 1, 4);
  cavity.brick.size = {0.3, 0.065, 0.1};
  EXPECT_EQ(countOf(mortarOf(cavity), false), 2 * 3);
}

TEST(Mortar, GoesAroundAnOpeningAndItsLintel) {
  WallDef wall = laidIn(Bond::running, 10, 8);
  wall.openings.push_back({0.6, 0, 0.7, 0.5, 0.15, 0.065});
  const std::vector<BrickPlacement> bricks = lay(wall);
  const MortarLayout layout = mortarOf(wall);
  expectSound(bricks, layout);
  std::size_t lintel = 0;
  while (!bricks[lintel].lintel) lintel++;
  int below = 0, above = 0, beside = 0;
  for (const MortarJoint& joint : layout.joints) {
    if (joint.a != lintel && joint.b != lintel) continue;
    const Vec3 other = bricks[joint.a == lintel ? joint.b : joint.a].centre;
    if (!joint.bed)
      beside++;
    else
      (other.y < bricks[lintel].centre.y ? below : above)++;
  }
  EXPECT_EQ(beside, 2);
  EXPECT_GE(below, 2);  // its bearings
  EXPECT_GE(above, 4);
  // Nothing spans the opening: what is left of it below the lintel's bed is free on both sides.
  for (const MortarJoint& joint : layout.joints)
    for (Vec3 corner : joint.outline)
      EXPECT_FALSE(corner.x > 0.601 && corner.x < 1.299 && corner.y < lowerOf(bricks[lintel]).y - 0.006);
}

// The bent lintel of a round wall: a brick over two of its pieces has one bed on it.
TEST(Mortar, GoesAroundABentLintel) {
  WallDef wall = laidIn(Bond::running, 8, 8);
  wall.radius = 0.8;
  wall.openings.push_back({0, 0, 0.6, 0.3, 0.15, 0.065});
  const std::vector<BrickPlacement> bricks = lay(wall);
  const MortarLayout layout = mortarOf(wall);
  std::size_t lintel = 0;
  while (!bricks[lintel].lintel) lintel++;
  ASSERT_GT(bricks[lintel].bend, 1);
  double below = 0, above = 0;
  int ends = 0;
  std::set<std::pair<std::size_t, std::size_t>> joined;
  for (const MortarJoint& joint : layout.joints) {
    EXPECT_TRUE(joined.insert({joint.a, joint.b}).second);
    EXPECT_GT(dot(areaVector(joint.outline), bricks[joint.b].centre - bricks[joint.a].centre), 0);
    if (joint.a != lintel && joint.b != lintel) continue;
    ends += !joint.bed;
    if (joint.bed) (joint.b == lintel ? below : above) += length(areaVector(joint.outline));
  }
  EXPECT_EQ(ends, 2);
  // Its bearings, and its upper face but for the head joints there, which are a seventh of a round wall.
  EXPECT_NEAR(below, 2 * 0.15 * 0.1025, 0.2 * 2 * 0.15 * 0.1025);
  EXPECT_NEAR(above, 0.82 * bricks[lintel].size.x * 0.1025, 0.06 * bricks[lintel].size.x * 0.1025);
  EXPECT_NEAR(layout.grown[lintel].size.y, 0.065 + 0.01, 1e-12);
  EXPECT_EQ(layout.grown[lintel].size.x, bricks[lintel].size.x);
}

// The corner of two walls that interlock, as the scene `house` has them.
TEST(Mortar, JoinsWallsThatInterlock) {
  WallDef front = laidIn(Bond::running, 6, 4), side = front;
  front.halfBats = side.halfBats = false;
  front.position = {0, 0, 0};
  side.name = "side";
  side.yawDegrees = 90;
  side.position = {4 * 0.225 + 0.1025 / 2, 0, 0.1025 / 2};
  const std::vector<BrickPlacement> a = lay(front), b = lay(side);
  const MortarLayout layout = layMortar(std::vector<MortaredBricks>{{a, jointWidths(front)}, {b, jointWidths(side)}});
  int heads = 0, beds = 0;
  double area = 0;
  for (const MortarJoint& joint : layout.joints)
    if (joint.a < a.size() && joint.b >= a.size()) {
      (joint.bed ? beds : heads)++;
      area += joint.bed ? length(areaVector(joint.outline)) : 0;
      if (!joint.bed) {
        EXPECT_NEAR(length(areaVector(joint.outline)), 0.1025 * 0.065, 1e-9);
      }
    }
  EXPECT_EQ(heads, 6);  // a brick's end against the other's side, in each course
  EXPECT_EQ(beds, 5);   // and the corner brick on the corner brick below
  EXPECT_NEAR(area, 5 * 0.1025 * 0.1025, 1e-9);
}

TEST(Mortar, StopsWhereBricksAreApart) {
  WallDef wall = laidIn(Bond::stack, 1, 2);
  std::vector<BrickPlacement> bricks = lay(wall);
  const JointWidths widths = jointWidths(wall);
  const auto joined = [&](Vec3 shift, double yaw) {
    std::vector<BrickPlacement> moved = bricks;
    moved[1].centre += shift;
    moved[1].rotation = quatFromAxisAngle({0, 1, 0}, yaw);
    return layMortar(std::vector<MortaredBricks>{{moved, widths}}).joints.size() == 1;
  };
  EXPECT_TRUE(joined({}, 0));
  EXPECT_TRUE(joined({-0.004, 0, 0}, 0));
  EXPECT_TRUE(joined({0, 0.03, 0.05}, 0));
  EXPECT_TRUE(joined({0.0049, 0, 0}, 0));     // a gap of 14.9 mm
  EXPECT_FALSE(joined({0.0051, 0, 0}, 0));    // and of 15.1
  EXPECT_FALSE(joined({-0.011, 0, 0}, 0));    // into each other
  EXPECT_FALSE(joined({0, 0, 0.103}, 0));     // past each other
  EXPECT_FALSE(joined({0, 0, 0.10249}, 0));   // by a hair
  EXPECT_FALSE(joined({}, 0.01));             // askew
  EXPECT_TRUE(joined({}, 3.14159265358979));  // end for end
}

// Turned bricks on each other share a polygon of more than four corners.
TEST(Mortar, TakesTheOverlapOfTurnedFaces) {
  WallDef wall = laidIn(Bond::stack, 2, 1);
  std::vector<BrickPlacement> bricks = lay(wall);
  bricks[1].rotation = quatFromAxisAngle({0, 1, 0}, 1.5707963267948966);
  MortarLayout layout = layMortar(std::vector<MortaredBricks>{{bricks, jointWidths(wall)}});
  ASSERT_EQ(layout.joints.size(), 1u);
  EXPECT_NEAR(areaVector(layout.joints[0].outline).y, 0.1025 * 0.1025, 1e-9);
  // Two squares of side s, turned by 45 degrees: an octagon of 8 (sqrt2 - 1) (s / 2)^2.
  wall.brick.size = {0.1, 0.065, 0.1};
  bricks = lay(wall);
  bricks[1].rotation = quatFromAxisAngle({0, 1, 0}, 0.78539816339744828);
  layout = layMortar(std::vector<MortaredBricks>{{bricks, jointWidths(wall)}});
  ASSERT_EQ(layout.joints.size(), 1u);
  EXPECT_EQ(layout.joints[0].outline.size(), 8u);
  EXPECT_NEAR(areaVector(layout.joints[0].outline).y, 8 * (std::sqrt(2.0) - 1) * 0.0025, 1e-12);
}

// Bricks as they are laid and the slabs that are drawn with them fill the wall, and none lies in another.
TEST(Mortar, IsDrawnOnceByOneOfTwoBricks) {
  WallDef wall = laidIn(Bond::running, 6, 5);
  wall.yawDegrees = 0;
  std::vector<BrickPlacement> bricks = lay(wall);
  const MortarLayout layout = mortarOf(wall);
  double volume = 0;
  std::vector<BrickPlacement> all = bricks;
  for (std::size_t k = 0; k < bricks.size(); k++)
    for (const MortarSlab& slab : layout.slabs[k]) {
      BrickPlacement piece;
      piece.name = bricks[k].name + " mortar";
      piece.centre = layout.grown[k].centre + slab.centre;
      piece.size = slab.size;
      all.push_back(piece);
    }
  for (const BrickPlacement& piece : all) volume += piece.size.x * piece.size.y * piece.size.z;
  EXPECT_NEAR(volume, wallLength(wall) * (6 * 0.075 - 0.01) * 0.1025, 1e-9);
  expectNoOverlap(all);
  EXPECT_EQ(layout.slabs[0].size(), 2u);  // above, and to its right
  EXPECT_EQ(layout.slabs.back().size(), 0u);
  for (const auto& slabs : mortarOf(laidIn(Bond::running, 3, 3, 0, 0)).slabs) EXPECT_TRUE(slabs.empty());
}

TEST(Mortar, OfNothingIsNothing) {
  EXPECT_TRUE(layMortar({}).joints.empty());
  EXPECT_TRUE(layMortar(std::vector<MortaredBricks>{{{}, {0.01, 0.01}}}).grown.empty());
}

// As many visits as bricks, wherever the wall runs: no pair of all pairs.
TEST(Mortar, OfTenThousandBricksIsQuick) {
  for (double yaw : {0.0, 90.0}) {
    WallDef wall = laidIn(Bond::running, 5, 2000);
    wall.yawDegrees = yaw;
    const std::vector<BrickPlacement> bricks = lay(wall);
    const auto start = std::chrono::steady_clock::now();
    const MortarLayout layout = layMortar(std::vector<MortaredBricks>{{bricks, jointWidths(wall)}});
    const std::chrono::duration<double> took = std::chrono::steady_clock::now() - start;
    EXPECT_EQ(countOf(layout, true), 4 * 4000);
    EXPECT_LT(took.count(), 1.0);
  }
}

}  // namespace
}  // namespace brickfall
