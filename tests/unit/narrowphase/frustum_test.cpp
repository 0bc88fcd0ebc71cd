// Contacts of cylinders and cones: what every manifold owes, and those whose points a ruler can tell.
#include <gtest/gtest.h>

#include <algorithm>

#include "brickfall/geometry/mesh_tree.h"
#include "contact_checks.h"
#include "geometry/touch_axis.h"
#include "narrowphase/mesh_collide.h"

namespace brickfall {
namespace {

using namespace test;

constexpr double kHalfPi = 1.57079632679489661923;

Shape drumShape(double radius, double halfHeight) {
  Shape s = capsuleShape(radius, halfHeight);
  s.type = ShapeType::cylinder;
  return s;
}
Shape coneShape(double radius, double topRadius, double halfHeight) {
  Shape s = drumShape(radius, halfHeight);
  s.type = ShapeType::cone;
  s.topRadius = topRadius;
  return s;
}
Shape anyTurned(Random& random) {
  double radius = random.between(0.03, 0.3), half = random.between(0.03, 0.3);
  if (random.below(2)) return drumShape(radius, half);
  return coneShape(radius, random.below(2) ? 0 : random.between(0.01, 0.3), half);
}
const Quat kLying = quatFromAxisAngle({1, 0, 0}, kHalfPi);  // axis along z

Manifold manifoldOf(const Shape& a, const Shape& b, const Transform& pose, double margin = 0.01) {
  Manifold m;
  collide(a, b, pose, margin, m);
  return m;
}

TEST(FrustumContact, AgainstEverythingByTheAxisOfTouch) {
  Random random(1);
  constexpr double kMargin = 0.02;
  int faces = 0, lines = 0, points = 0;
  for (int i = 0; i < 6000; i++) {
    Hull hull = randomHull(random, 9);
    double size = random.between(0.03, 0.2), half = random.between(0.05, 0.3);
    Shape b = anyTurned(random), a = i % 6 == 0   ? planeShape()
                                     : i % 6 == 1 ? sphereShape(size)
                                     : i % 6 == 2 ? capsuleShape(size, half)
                                     : i % 6 == 3 ? boxShape(randomHalfExtents(random))
                                     : i % 6 == 4 ? hullShape(hull)
                                                  : anyTurned(random);
    Transform pose{randomDirection(random) * random.between(0.1, 0.6), randomRotation(random)};
    if (i % 4 == 0) pose.rotation = i % 8 == 0 ? Quat{} : kLying;  // flush
    Manifold m = manifoldOf(a, b, pose, kMargin);
    ASSERT_EQ(faultOf(m, a, b, pose, kMargin, 0.02), "") << i;
    Manifold other = swapped(a, b, pose, kMargin);
    ASSERT_EQ(m.count > 0, other.count > 0) << i;
    if (m.count == 0) continue;
    if (deepest(m) > -0.01) {
      ASSERT_NEAR(deepest(m), deepest(other), 0.003) << i;
    }
    (m.count > 2 ? faces : m.count == 2 ? lines : points)++;
    if (a.type == ShapeType::plane) continue;
    std::optional<TouchAxis> axis = findTouchAxis(a, b, pose, kMargin);
    ASSERT_TRUE(axis) << i;
    ASSERT_NEAR(deepest(m), axis->separation, 0.003) << i;
  }
  EXPECT_GT(faces, 100);
  EXPECT_GT(lines, 100);
  EXPECT_GT(points, 500);
}

TEST(FrustumContact, CapOnAFaceStandsOnItsRim) {
  for (const Shape& table : {planeShape(), boxShape({1, 0.5, 1}), drumShape(0.4, 0.5)}) {
    const double top = table.type == ShapeType::plane ? 0 : 0.5;
    for (double turn : {0.0, 0.3, 2.0}) {
      Transform pose{{0, top + 0.2 - 1e-5, 0}, quatFromAxisAngle({0, 1, 0}, turn)};
      Manifold m = manifoldOf(table, drumShape(0.3, 0.2), pose);
      ASSERT_EQ(m.count, 4);
      EXPECT_EQ(m.normal, (Vec3{0, 1, 0}));
      EXPECT_FALSE(m.rolls);
      EXPECT_TRUE(m.partial);
      for (int k = 0; k < 4; k++) {
        EXPECT_NEAR(m.points[k].separation, -1e-5, 1e-12);
        EXPECT_NEAR(std::hypot(m.points[k].onB.x, m.points[k].onB.z), 0.3, 1e-12);
      }
    }
  }
}

// The loaded points stay, and the deepest comes to them.
TEST(FrustumContact, CapKeepsThePointsThatCarry) {
  Transform pose{{0, 0.2 - 1e-5, 0}, quatFromAxisAngle({0, 0, 1}, 1e-6)};
  Manifold first = manifoldOf(planeShape(), drumShape(0.3, 0.2), pose), next;
  LoadedPoints loaded;
  loaded.add(first.points[0].feature), loaded.add(first.points[1].feature);
  collide(planeShape(), drumShape(0.3, 0.2), {pose.position, quatFromAxisAngle({1, 0, 0}, 1e-6)}, 0.01, next, loaded);
  int kept = 0;
  double low = 1;
  for (int k = 0; k < next.count; k++)
    kept += loaded.has(next.points[k].feature), low = std::min(low, next.points[k].separation);
  EXPECT_EQ(kept, 2);
  EXPECT_NEAR(low, -1e-5 - 0.3e-6, 1e-11);
}

TEST(FrustumContact, LyingItTouchesAlongALine) {
  for (const Shape& floor : {planeShape(), boxShape({1, 0.5, 1})})
    for (double yaw : {0.0, 0.7}) {
      const double top = floor.type == ShapeType::plane ? 0 : 0.5;
      Transform pose{{0.1, top + 0.3 - 1e-5, 0.2}, quatFromAxisAngle({0, 1, 0}, yaw) * kLying};
      Manifold m = manifoldOf(floor, drumShape(0.3, 0.25), pose);
      ASSERT_EQ(m.count, 2);
      EXPECT_TRUE(m.rolls);
      EXPECT_NEAR(length(m.normal - Vec3{0, 1, 0}), 0, 1e-12);
      EXPECT_NEAR(length(m.points[0].onB - m.points[1].onB), 0.5, 1e-9);
      EXPECT_NEAR((m.points[0].onB + m.points[1].onB).x, 0.2, 1e-9);
      for (int k = 0; k < 2; k++) EXPECT_NEAR(m.points[k].separation, -1e-5, 1e-11);
    }
}

TEST(FrustumContact, CoinOnItsRimTouchesAtTheLowestPoint) {
  const double tilt = 0.6, radius = 0.2, half = 0.01, height = radius * std::sin(tilt) + half * std::cos(tilt);
  Manifold m = manifoldOf(boxShape({1, 0.5, 1}), drumShape(radius, half),
                          {{0, 0.5 + height, 0}, quatFromAxisAngle({0, 0, 1}, tilt)});
  ASSERT_GE(m.count, 1);
  EXPECT_TRUE(m.rolls);
  EXPECT_NEAR(deepest(m), 0, 1e-12);
  const ManifoldPoint& low =
      *std::min_element(m.points, m.points + m.count, [](auto& p, auto& q) { return p.separation < q.separation; });
  EXPECT_NEAR(low.onB.x, half * std::sin(tilt) - radius * std::cos(tilt), 1e-9);
  EXPECT_NEAR(low.onB.z, 0, 1e-9);
}

TEST(FrustumContact, PipesSideBySideAndAcross) {
  Shape pipe = drumShape(0.1, 0.5), thin = drumShape(0.05, 0.5);
  Manifold beside = manifoldOf(pipe, thin, {{0.15 - 1e-5, 0.2, 0}, {}});
  ASSERT_EQ(beside.count, 2);
  EXPECT_NEAR(length(beside.normal - Vec3{1, 0, 0}), 0, 1e-9);
  EXPECT_NEAR(std::fabs(beside.points[0].onA.y - beside.points[1].onA.y), 0.8, 1e-9);
  Manifold across = manifoldOf(pipe, thin, {{0.15 - 1e-5, 0.2, 0.1}, kLying});
  ASSERT_EQ(across.count, 1);
  EXPECT_NEAR(length(across.normal - Vec3{1, 0, 0}), 0, 1e-6);
  EXPECT_NEAR(across.points[0].separation, -1e-5, 1e-9);
  EXPECT_NEAR(length(across.points[0].onA - Vec3{0.1, 0.2, 0}), 0, 1e-6);
}

// A flat mesh is the plane to what lies, stands or rolls on it, wherever its edges run.
TEST(FrustumContact, FlatMeshIsAPlane) {
  std::vector<Vec3> corners;
  std::vector<std::uint32_t> indices;
  for (std::uint32_t i = 0; i < 25; i++) corners.push_back({double(i / 5) * 0.5 - 1, 0, double(i % 5) * 0.5 - 1});
  for (std::uint32_t i = 0; i < 4; i++)
    for (std::uint32_t k = 0; k < 4; k++)
      for (std::uint32_t v : {i * 5 + k, i * 5 + k + 1, i * 5 + k + 5, i * 5 + k + 5, i * 5 + k + 1, i * 5 + k + 6})
        indices.push_back(v);
  const MeshTree tree = MeshTree::build(TriangleMesh::create(corners, indices).value());
  Shape mesh;
  mesh.type = ShapeType::mesh, mesh.mesh = &tree;
  MeshScratch scratch;
  Random random(2);
  for (int round = 0; round < 600; round++) {
    Shape shape = drumShape(random.between(0.05, 0.2), random.between(0.05, 0.2));
    const bool lies = round % 2;
    const double up = (lies ? shape.radius : shape.halfHeight) - 1e-5;
    Transform pose{{random.between(-0.4, 0.4), up, random.between(-0.4, 0.4)},
                   quatFromAxisAngle({0, 1, 0}, random.between(0, 3)) * (lies ? kLying : Quat{})};
    MeshManifolds found;
    collideMesh(mesh, shape, pose, 0.01, scratch, found);
    ASSERT_EQ(found.count, 1) << round;
    const Manifold &m = found.list[0], flat = manifoldOf(planeShape(), shape, pose);
    ASSERT_EQ(m.count, flat.count) << round;
    ASSERT_EQ(m.rolls, lies) << round;
    ASSERT_LT(length(m.normal - Vec3{0, 1, 0}), 1e-9) << round;
    for (int k = 0; k < m.count; k++) {
      ASSERT_NEAR(m.points[k].separation, -1e-5, 1e-9) << round;
      double nearest = 1;
      for (int j = 0; j < flat.count; j++) nearest = std::min(nearest, length(flat.points[j].onB - m.points[k].onB));
      ASSERT_LT(lies ? nearest
                     : std::fabs(std::hypot(m.points[k].onB.x - pose.position.x, m.points[k].onB.z - pose.position.z) -
                                 shape.radius),
                1e-3)
          << round;
    }
  }
}

}  // namespace
}  // namespace brickfall
