// Mass, centre and inertia against sums over small cells, and against each other.
#include "geometry/mass_properties.h"

#include <gtest/gtest.h>

#include "geometry/queries.h"
#include "shape_samples.h"

namespace brickfall {
namespace {

constexpr double kPi = 3.14159265358979323846;

void expectSame(const MassProperties& a, const MassProperties& b, double relative, double size) {
  EXPECT_NEAR(a.mass, b.mass, relative * b.mass);
  EXPECT_LE(length(a.centre - b.centre), relative * size);
  for (int i = 0; i < 3; i++) {
    for (int j = 0; j < 3; j++) {
      EXPECT_NEAR(a.inertia.row[i][j], b.inertia.row[i][j], relative * b.mass * size * size) << i << " " << j;
    }
  }
}

// Cells whose middle is in the shape, each with its own inertia about its middle.
MassProperties sumOfCells(const Shape& shape, double density, int cells) {
  Aabb box = bounds(shape, {});
  Vec3 cell = (box.upper - box.lower) * (1.0 / cells);
  std::vector<MassProperties> parts;
  Shape brick;
  brick.halfExtents = cell * 0.5;
  for (int x = 0; x < cells; x++) {
    for (int y = 0; y < cells; y++) {
      for (int z = 0; z < cells; z++) {
        Vec3 middle = box.lower + scaled(cell, Vec3{x + 0.5, y + 0.5, z + 0.5});
        if (closestPoint(shape, middle) == middle) {
          parts.push_back(transformed(shapeMass(brick, density), {middle, {}}));
        }
      }
    }
  }
  return combined(parts);
}

TEST(MassProperties, AgreeWithSumsOverCells) {
  test::ShapeSamples samples(1);
  for (ShapeType type :
       {ShapeType::box, ShapeType::sphere, ShapeType::capsule, ShapeType::hull, ShapeType::cylinder, ShapeType::cone}) {
    for (int round = 0; round < 4; round++) {
      Shape shape = samples.make(type);
      MassProperties exact = shapeMass(shape, 1900);
      SCOPED_TRACE("type " + std::to_string(int(type)) + " round " + std::to_string(round));
      expectSame(exact, sumOfCells(shape, 1900, 60), type == ShapeType::box ? 1e-9 : 0.01,
                 outerRadius(shape, exact.centre));
    }
  }
}

TEST(MassProperties, TextbookValues) {
  Shape sphere;
  sphere.type = ShapeType::sphere;
  sphere.radius = 0.08;
  MassProperties steel = shapeMass(sphere, 7800);
  EXPECT_NEAR(steel.mass, 7800 * 4 / 3.0 * kPi * 0.08 * 0.08 * 0.08, 1e-12);
  EXPECT_NEAR(steel.inertia.row[1].y, 0.4 * steel.mass * 0.0064, 1e-14);
  Shape brick;
  brick.halfExtents = {0.12, 0.0355, 0.0575};
  MassProperties clay = shapeMass(brick, 1900);
  EXPECT_NEAR(clay.mass, 1900 * 0.24 * 0.071 * 0.115, 1e-12);
  EXPECT_NEAR(clay.inertia.row[0].x, clay.mass / 12 * (0.071 * 0.071 + 0.115 * 0.115), 1e-14);
  Shape plane;
  plane.type = ShapeType::plane;
  EXPECT_EQ(shapeMass(plane, 1900).mass, 0);
}

TEST(MassProperties, HullOfABoxIsTheBox) {
  test::ShapeSamples samples(2);
  for (int round = 0; round < 200; round++) {
    Shape box = samples.make(ShapeType::box);
    Transform pose = test::randomPose(samples.random(), 2);
    std::vector<Vec3> corners = test::outlineOf(box).corners;
    for (Vec3& c : corners) c = transformPoint(pose, c);
    Shape hull = samples.makeHull(corners);
    expectSame(shapeMass(hull, 700), transformed(shapeMass(box, 700), pose), 1e-12, 1);
    EXPECT_LE(length(hull.hull->centroid - pose.position), 1e-14);
  }
}

// A hull cut in two, each half built as its own hull, weighs what the whole does.
TEST(MassProperties, HalvesMakeAWhole) {
  test::ShapeSamples samples(3);
  for (int round = 0; round < 200; round++) {
    std::vector<Vec3> points = test::randomPoints(samples.random(), 20, {1, 0.6, 0.4}, true);
    Shape whole = samples.makeHull(points);
    std::vector<Vec3> left, right;
    double cut = samples.random().between(-0.3, 0.3);
    for (Vec3 v : whole.hull->vertices) (v.x < cut ? left : right).push_back(v);
    for (std::size_t e = 0; e < whole.hull->edges.size(); e += 2) {
      Vec3 a = whole.hull->vertices[whole.hull->edges[e].origin];
      Vec3 b = whole.hull->vertices[whole.hull->edges[e + 1].origin];
      if ((a.x < cut) == (b.x < cut)) continue;
      Vec3 p = a + (b - a) * ((cut - a.x) / (b.x - a.x));
      left.push_back(p), right.push_back(p);
    }
    MassProperties halves[2] = {shapeMass(samples.makeHull(left), 5), shapeMass(samples.makeHull(right), 5)};
    expectSame(combined(halves), shapeMass(whole, 5), 1e-6, 1);
  }
}

TEST(MassProperties, TransformsUndoThemselves) {
  test::ShapeSamples samples(4);
  for (int round = 0; round < 200; round++) {
    MassProperties m = shapeMass(samples.make(ShapeType::hull), 1000);
    Transform pose = test::randomPose(samples.random(), 3);
    expectSame(transformed(transformed(m, pose), inverse(pose)), m, 1e-13, 1);
  }
}

TEST(MassProperties, NothingWeighsNothing) {
  EXPECT_EQ(combined({}).mass, 0);
  MassProperties none[2];
  EXPECT_EQ(combined(none).mass, 0);
  EXPECT_EQ(combined(none).centre, Vec3{});
}

}  // namespace
}  // namespace brickfall
