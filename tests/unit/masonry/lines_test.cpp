// Walls that are not straight: no brick lies in another, each is carried, and their corners are bonded.
#include <algorithm>
#include <cmath>

#include "unit/masonry/wall_checks.h"

namespace brickfall {
namespace {

constexpr Bond kBonds[] = {Bond::running, Bond::header, Bond::english, Bond::flemish, Bond::stack};

// In plan: how far the rectangles of two bricks are apart along the best of their axes; less than 0: they overlap.
double apartInPlan(const BrickPlacement& a, const BrickPlacement& b) {
  double most = -1e9;
  for (const BrickPlacement* one : {&a, &b})
    for (Vec3 axis : {rotate(one->rotation, Vec3{1, 0, 0}), rotate(one->rotation, Vec3{0, 0, 1})}) {
      double reach = 0;
      for (const BrickPlacement* brick : {&a, &b})
        reach += 0.5 * (brick->size.x * std::fabs(dot(axis, rotate(brick->rotation, Vec3{1, 0, 0}))) +
                        brick->size.z * std::fabs(dot(axis, rotate(brick->rotation, Vec3{0, 0, 1}))));
      most = std::max(most, std::fabs(dot(b.centre - a.centre, axis)) - reach);
    }
  return most;
}

struct WallReport {
  double deepest = 0;  // m, that a brick lies in another
  int loose = 0;       // bricks above the first course that lie on nothing
};

WallReport reportOn(const std::vector<BrickPlacement>& bricks) {
  WallReport out;
  for (const BrickPlacement& a : bricks) {
    bool carried = a.centre.y < a.size.y;
    for (const BrickPlacement& b : bricks) {
      if (&a == &b || a.bend > 0 || b.bend > 0) continue;  // a lintel that is bent is no rectangle
      const double rise = std::fabs(a.centre.y - b.centre.y) - 0.5 * (a.size.y + b.size.y);
      const double apart = rise < 0.05 ? apartInPlan(a, b) : 1;
      if (rise < -1e-6) out.deepest = std::max(out.deepest, std::min(-apart, -rise));
      carried = carried || (rise < 0.02 && b.centre.y < a.centre.y && apart < -0.01);
    }
    out.loose += !carried;
  }
  return out;
}

std::vector<BrickPlacement> laid(const WallDef& wall) {
  const Result<std::vector<BrickPlacement>> bricks = layBricks(wall, 1);
  EXPECT_TRUE(bricks.ok()) << (bricks.ok() ? "" : bricks.error().message);
  if (bricks && wall.openings.empty()) {
    EXPECT_EQ(brickCount(wall), std::int64_t(bricks->size()));
  }
  return bricks ? *bricks : std::vector<BrickPlacement>{};
}

WallDef wallIn(Bond bond) {
  WallDef wall;
  wall.bond = bond;
  wall.courses = 4;
  wall.headJoint = 0.01;
  return wall;
}

TEST(CurvedWalls, PathsAreBondedAtTheirCornersInEveryBond) {
  for (Bond bond : kBonds) {
    WallDef wall = wallIn(bond);
    wall.path = {{0, 0, 0}, {2, 0, 0}, {2, 0, -1.5}, {0, 0, -1.5}};
    wall.closed = true;
    const std::vector<BrickPlacement> bricks = laid(wall);
    const WallReport report = reportOn(bricks);
    EXPECT_LT(report.deepest, 1e-9) << int(bond);
    EXPECT_EQ(report.loose, 0) << int(bond);
    // The outer corner is one wall's in even courses, the other's in odd ones.
    const double out = 0.5 * wallThickness(wall) - 0.02;
    int owners[2] = {-1, -1};
    for (const BrickPlacement& brick : bricks) {
      if (brick.course > 1) continue;
      const Vec3 p = rotate(conjugate(brick.rotation), Vec3{2 + out, brick.centre.y, out} - brick.centre);
      if (std::fabs(p.x) < 0.5 * brick.size.x && std::fabs(p.z) < 0.5 * brick.size.z)
        owners[brick.course] = std::fabs(brick.rotation.y) > 0.5;
    }
    EXPECT_GE(owners[0], 0) << int(bond);
    EXPECT_GE(owners[1], 0) << int(bond);
    EXPECT_NE(owners[0], owners[1]) << int(bond);
  }
  WallDef bay = wallIn(Bond::running);
  bay.path = {{0, 0, 0}, {1, 0, 0}, {1.7, 0, -0.7}, {1.7, 0, -1.7}};
  EXPECT_LT(reportOn(laid(bay)).deepest, 1e-6);
}

TEST(CurvedWalls, RingsAndArcsHaveNoBrickInAnother) {
  for (Bond bond : kBonds) {
    WallDef wall = wallIn(bond);
    wall.radius = 1.1;
    EXPECT_LT(reportOn(laid(wall)).deepest, 1e-9) << int(bond);
    EXPECT_EQ(reportOn(laid(wall)).loose, 0) << int(bond);
    wall.arcDegrees = 130;
    EXPECT_LT(reportOn(laid(wall)).deepest, 1e-9) << int(bond);
    wall.arcDegrees = 360;
    wall.openings.push_back({0.12, 0, 0.4, 0.13, 0.1, 0.065});
    EXPECT_LT(reportOn(laid(wall)).deepest, 1e-9) << int(bond);
  }
}

// rad: how far a brick's corner is from a lintel's middle, seen from the middle of the ring at the origin; the nearest.
double nearestCorner(const BrickPlacement& brick, const BrickPlacement& lintel) {
  double nearest = 9;
  for (double along : {-0.5, 0.5})
    for (double through : {-0.5, 0.5}) {
      const Vec3 corner = brick.centre + rotate(brick.rotation, Vec3{along * brick.size.x, 0, through * brick.size.z});
      const Vec3 seen = rotate(conjugate(lintel.rotation), corner);
      nearest = std::min(nearest, std::fabs(std::atan2(seen.x, seen.z)));
    }
  return nearest;
}

// A wide door, at the seam as well: its lintel lies in the ring and in no brick, and is carried on both sides of the door.
TEST(CurvedWalls, LintelsOfRoundWallsAreBent) {
  for (Bond bond : kBonds)
    for (double from : {0.0, 0.4, 6.0}) {
      WallDef wall = wallIn(bond);
      wall.radius = 1.1;
      wall.courses = 8;
      wall.openings.push_back({from, 0, 1.2, 0.26, 0.15, 0.065});
      const std::vector<BrickPlacement> bricks = laid(wall);
      const auto lintel = std::find_if(bricks.begin(), bricks.end(), [](const BrickPlacement& b) { return b.lintel; });
      ASSERT_NE(lintel, bricks.end());
      EXPECT_NEAR(lintel->size.x / lintel->bend, 1.1, 1e-9);
      for (const ShapeDef& shape : shapesOf(*lintel))
        for (Vec3 corner : shape.vertices) {
          const Vec3 at = lintel->centre + rotate(lintel->rotation, corner);
          EXPECT_NEAR(std::fabs(std::sqrt(at.x * at.x + at.z * at.z) - 1.1), 0.5 * wallThickness(wall), 1e-9);
        }
      int under = 0;
      for (const BrickPlacement& brick : bricks) {
        const double beyond = nearestCorner(brick, *lintel) - 0.5 * lintel->bend;
        if (brick.course == lintel->course && !brick.lintel) {
          EXPECT_GT(beyond, -1e-9) << brick.name;
        }
        under += brick.course == lintel->course - 1 && beyond < -0.05;
      }
      EXPECT_GE(under, 2) << int(bond) << " " << from;
    }
}

TEST(CurvedWalls, PiersAndGablesBelongToTheWall) {
  for (Bond bond : kBonds) {
    for (double depth : {1.5, 2.0, 2.5}) {
      WallDef wall = wallIn(bond);
      wall.bricksPerCourse = bond == Bond::header ? 14 : 7;
      wall.piers = {{0, 1.5, depth, 2}, {0.5 * wallLength(wall), 2, depth, 0}};
      const WallReport report = reportOn(laid(wall));
      EXPECT_LT(report.deepest, 1e-9) << int(bond) << " " << depth;
      EXPECT_EQ(report.loose, 0) << int(bond) << " " << depth;
    }
    WallDef gable = wallIn(bond);
    gable.gableDegrees = 30;
    const std::vector<BrickPlacement> bricks = laid(gable);
    const double middle = 0.5 * wallLength(gable), slope = std::tan(30 * 3.14159265358979 / 180);
    int above = 0;
    for (const BrickPlacement& brick : bricks) {
      const double rise = brick.centre.y + 0.5 * brick.size.y - 4 * 0.065;
      const double out = std::fabs(brick.centre.x - middle) + 0.5 * brick.size.x;
      if (brick.course < 4) continue;
      above++;
      EXPECT_LE(rise, (middle - out) * slope + 1e-9) << brick.name;
    }
    EXPECT_GT(above, 20) << int(bond);
    EXPECT_LT(reportOn(bricks).deepest, 1e-9);
  }
}

// On a path, at a corner's side and at a free end; on rings and arcs, small and large.
TEST(CurvedWalls, PiersStandInPathsAndRings) {
  for (Bond bond : kBonds)
    for (double depth : {1.5, 2.5})
      for (int kind = 0; kind < 5; kind++) {
        WallDef wall = wallIn(bond);
        if (kind < 2) wall.path = {{0, 0, 0}, {3, 0, 0}, {3, 0, -2.5}};
        if (kind == 1) wall.path.push_back({0, 0, -2.5});
        wall.closed = kind == 1;
        if (kind >= 2) wall.radius = kind == 2 ? 0.9 : 2.5;
        if (kind == 4) wall.arcDegrees = 120;
        const double length = wallLength(wall);
        wall.piers = {{0, 1.5, depth, 2}, {0.5 * length, 2, depth, 0}};
        if (kind < 2) wall.piers = {{kind == 0 ? 0 : 0.3, 1.5, depth, 2}, {3.9, 2, depth, 0}};
        for (const WallProblem& problem : checkWall(wall))
          ADD_FAILURE() << kind << " " << problem.field << " " << problem.message;
        const WallReport report = reportOn(laid(wall));
        EXPECT_LT(report.deepest, 1e-9) << int(bond) << " " << depth << " " << kind;
        EXPECT_EQ(report.loose, 0) << int(bond) << " " << depth << " " << kind;
      }
}

TEST(CurvedWalls, MortarJoinsCornersRingsPiersAndGables) {
  WallDef wall = wallIn(Bond::running);
  wall.bedJoint = 0.01;
  for (int kind = 0; kind < 4; kind++) {
    WallDef one = wall;
    if (kind == 0) one.radius = 1.2;
    if (kind == 1) one.path = {{0, 0, 0}, {1.5, 0, 0}, {1.5, 0, -1}};
    if (kind == 2) one.piers = {{1, 1.5, 1.5, 1}};
    if (kind == 3) one.gableDegrees = 35;
    const std::vector<BrickPlacement> bricks = laid(one);
    const std::vector<MortaredBricks> all{{bricks, jointWidths(one)}};
    const MortarLayout layout = layMortar(all);
    // One piece: each brick can be reached from the first by joints, and heads are joined as well as beds.
    std::vector<std::size_t> root(bricks.size());
    for (std::size_t k = 0; k < root.size(); k++) root[k] = k;
    const auto find = [&](std::size_t k) {
      while (root[k] != k) k = root[k];
      return k;
    };
    std::size_t heads = 0, pieces = 0;
    for (const MortarJoint& joint : layout.joints) {
      heads += !joint.bed;
      root[find(joint.a)] = find(joint.b);
    }
    for (std::size_t k = 0; k < root.size(); k++) pieces += root[k] == k;
    EXPECT_EQ(pieces, 1u) << kind;
    EXPECT_GT(heads, bricks.size() / 2) << kind;
    EXPECT_TRUE(kind != 0 || heads == bricks.size()) << heads << " of " << bricks.size();
  }
}

TEST(CurvedWalls, MistakesNameTheirField) {
  const auto fieldOf = [](const WallDef& wall) {
    const std::vector<WallProblem> problems = checkWall(wall);
    return problems.empty() ? std::string() : problems[0].field;
  };
  WallDef wall = wallIn(Bond::running);
  wall.path = {{0, 0, 0}, {1, 0, 0}, {2, 0, -0.1}};
  EXPECT_EQ(fieldOf(wall), "path") << "a corner of 6 degrees";
  wall.path = {{0, 0, 0}, {0, 0, 0}};
  EXPECT_EQ(fieldOf(wall), "path");
  wall.path = {{0, 0, 0}, {1, 0, 0}};
  wall.closed = true;
  EXPECT_EQ(fieldOf(wall), "path");
  wall = wallIn(Bond::running);
  wall.radius = 0.1;
  EXPECT_EQ(fieldOf(wall), "radius");
  wall = wallIn(Bond::running);
  wall.piers = {{9, 1.5, 1.5, 0}};
  EXPECT_EQ(fieldOf(wall), "piers[0].at");
  wall.piers = {{1, 1.5, 1.5, 0}};
  wall.openings = {{0.9, 0, 0.5, 0.1, 0.15, 0}};
  EXPECT_EQ(fieldOf(wall), "piers[0].at");
  wall = wallIn(Bond::running);
  wall.path = {{0, 0, 0}, {1, 0, 0}, {1, 0, -1}};
  wall.piers = {{0.5, 5, 1.5, 0}};
  EXPECT_EQ(fieldOf(wall), "piers[0].at") << "no room before the corner";
  wall.piers.clear();
  wall.openings = {{0.7, 0, 0.6, 0.1, 0.15, 0}};
  EXPECT_EQ(fieldOf(wall), "openings[0].width") << "across a corner";
}

}  // namespace
}  // namespace brickfall
