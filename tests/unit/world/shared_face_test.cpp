// The face in which two bodies lie on each other, against areas that are known.
#include <cmath>

#include "math/random.h"
#include "support/world_helpers.h"

namespace brickfall {
namespace {

using namespace test;

Vec3 areaOf(const std::vector<Vec3>& corners) {
  Vec3 twice;
  for (std::size_t i = 2; i < corners.size(); i++) twice += cross(corners[i - 1] - corners[0], corners[i] - corners[0]);
  return twice * 0.5;
}

// Area as seen from the second, and whether it is seen the right way round and the same from the other side.
double sharedArea(const World& world, BodyId a, BodyId b, double gap = 1e-3) {
  const std::vector<Vec3> one = *world.sharedFace(a, b, gap), other = *world.sharedFace(b, a, gap);
  EXPECT_EQ(one.empty(), other.empty());
  if (one.empty() || other.empty()) return 0;
  EXPECT_LE(one.size(), 16u);
  const Vec3 area = areaOf(one), back = areaOf(other);
  EXPECT_NEAR(length(area + back), 0, 1e-9 * length(area));
  return length(area);
}

struct TwoBoxes {
  World world = makeWorld();
  BodyId a, b;
  TwoBoxes(Vec3 halfA, Vec3 halfB, Vec3 at, Quat turn = {}) {
    a = add(world, bodyOf(boxOf(halfA), {0, 5, 0}));
    BodyDef second = bodyOf(boxOf(halfB), Vec3{0, 5, 0} + at);
    second.rotation = turn;
    b = add(world, second);
  }
  double area(double gap = 1e-3) const { return sharedArea(world, a, b, gap); }
};

TEST(SharedFace, OfBoxesThatAreShifted) {
  const Vec3 half{0.5, 0.25, 0.3};
  EXPECT_NEAR(TwoBoxes(half, half, {0, 0.5, 0}).area(), 1 * 0.6, 1e-12);
  EXPECT_NEAR(TwoBoxes(half, half, {0.3, 0.5, -0.2}).area(), 0.7 * 0.4, 1e-12);
  EXPECT_NEAR(TwoBoxes(half, half, {1, 0.1, 0.1}).area(), 0.4 * 0.5, 1e-12);
  EXPECT_NEAR(TwoBoxes(half, {0.1, 0.1, 0.1}, {0, -0.35, 0}).area(), 0.04, 1e-12);
  const TwoBoxes above(half, half, {0, 0.5008, 0});
  const std::vector<Vec3> face = *above.world.sharedFace(above.a, above.b);
  ASSERT_EQ(face.size(), 4u);
  EXPECT_GT(areaOf(face).y, 0);  // from A to B
  for (Vec3 corner : face) EXPECT_NEAR(corner.y, 5.2504, 1e-12);
}

TEST(SharedFace, OfATurnedBox) {
  const Vec3 half{0.5, 0.25, 0.5};
  const TwoBoxes octagon(half, half, {0, 0.5, 0}, quatFromAxisAngle({0, 1, 0}, 0.78539816339744828));
  EXPECT_NEAR(octagon.area(), 2 * (std::sqrt(2.0) - 1), 1e-9);
  EXPECT_EQ(octagon.world.sharedFace(octagon.a, octagon.b)->size(), 8u);
  // End for end, and the whole pair turned anyhow: nothing changes.
  Random random(5);
  for (int k = 0; k < 20; k++) {
    World world = makeWorld();
    const Quat turn = normalized(Quat{random.between(-1, 1), random.between(-1, 1), random.between(-1, 1), 0.3});
    BodyDef a = bodyOf(boxOf(half), {}), b = bodyOf(boxOf(half), rotate(turn, Vec3{0.3, 0.5, 0.4}));
    a.rotation = turn;
    b.rotation = turn * quatFromAxisAngle({0, 1, 0}, 3.14159265358979312);
    const BodyId one = add(world, a), other = add(world, b);
    EXPECT_NEAR(sharedArea(world, one, other), 0.7 * 0.6, 1e-9);
  }
}

TEST(SharedFace, OfStonesOfAnArch) {
  World world = makeWorld();
  ShapeDef wedge;
  wedge.type = ShapeType::hull;
  const double half = 3.14159265358979312 / 40;
  for (double radius : {0.9, 1.1})
    for (double side : {-1.0, 1.0})
      for (double front : {-0.15, 0.15})
        wedge.vertices.push_back({side * radius * std::sin(half), radius * std::cos(half), front});
  std::vector<BodyId> stones;
  for (int k = 0; k < 4; k++) {
    BodyDef stone = bodyOf(wedge, {});
    stone.rotation = quatFromAxisAngle({0, 0, 1}, -2 * half * k);
    stones.push_back(add(world, stone));
  }
  for (int k = 0; k < 3; k++) EXPECT_NEAR(sharedArea(world, stones[k], stones[k + 1]), 0.2 * 0.3, 1e-6);
  EXPECT_EQ(sharedArea(world, stones[0], stones[2]), 0);
}

TEST(SharedFace, OfABodyOnAPlane) {
  World world = makeWorld();
  const BodyId ground = addGround(world), box = add(world, bodyOf(boxOf({0.5, 0.25, 0.3}), {3, 0.25, 4}));
  EXPECT_NEAR(sharedArea(world, ground, box), 0.6, 1e-12);
  EXPECT_GT(areaOf(*world.sharedFace(ground, box)).y, 0);
  const BodyId tilted = [&] {
    BodyDef def = bodyOf(boxOf({0.5, 0.25, 0.3}), {0, 0.3, 0});
    def.rotation = quatFromAxisAngle({0, 0, 1}, 0.01);
    return add(world, def);
  }();
  EXPECT_EQ(sharedArea(world, ground, tilted, 1), 0);
}

TEST(SharedFace, OfCompoundsIsTheLargest) {
  World world = makeWorld();
  BodyDef table = bodyOf(boxOf({0.1, 0.5, 0.1}), {});
  table.shapes.push_back(boxOf({0.3, 0.5, 0.2}));
  table.shapes[1].local.position = {2, 0, 0};
  const BodyId legs = add(world, table), slab = add(world, bodyOf(boxOf({3, 0.1, 3}), {1, 0.6, 0}));
  EXPECT_NEAR(sharedArea(world, legs, slab), 0.6 * 0.4, 1e-12);
}

TEST(SharedFace, IsEmptyWhereNothingLiesOnAFace) {
  const Vec3 half{0.5, 0.25, 0.3};
  EXPECT_EQ(TwoBoxes(half, half, {0, 0.502, 0}).area(), 0);  // 2 mm apart
  EXPECT_GT(TwoBoxes(half, half, {0, 0.502, 0}).area(0.003), 0);
  EXPECT_EQ(TwoBoxes(half, half, {0, 0.3, 0}).area(), 0);    // into each other
  EXPECT_EQ(TwoBoxes(half, half, {1, 0.5, 0}).area(), 0);    // edge on edge
  EXPECT_EQ(TwoBoxes(half, half, {1, 0.5, 0.6}).area(), 0);  // corner on corner
  EXPECT_EQ(TwoBoxes(half, half, {0, 0.5, 0}, quatFromAxisAngle({1, 0, 0}, 0.01)).area(0.1), 0);
  const TwoBoxes onEdge(half, half, {0, 0.25 + std::sqrt(0.5 * 0.5 + 0.25 * 0.25), 0},
                        quatFromAxisAngle({0, 0, 1}, std::atan2(0.5, 0.25)));
  EXPECT_EQ(onEdge.area(), 0);
  World world = makeWorld();
  const BodyId ball = add(world, bodyOf(sphereOf(0.5), {0, 0.5, 0})), ground = addGround(world);
  EXPECT_EQ(sharedArea(world, ball, ground), 0);
}

// Two cylinders of 40 sides as hulls: more corners than an outline has.
TEST(SharedFace, OfManyCornersKeepsThoseThatCount) {
  World world = makeWorld();
  ShapeDef drum;
  drum.type = ShapeType::hull;
  for (int k = 0; k < 24; k++)
    for (double y : {-0.5, 0.5})
      drum.vertices.push_back({std::cos(k * 0.26179938779914944), y, std::sin(k * 0.26179938779914944)});
  const BodyId a = add(world, bodyOf(drum, {0, 0.5, 0})), b = add(world, bodyOf(drum, {0, 1.5, 0}));
  const std::vector<Vec3> face = *world.sharedFace(a, b);
  EXPECT_EQ(face.size(), 16u);
  EXPECT_NEAR(length(areaOf(face)), 3.1058, 0.08);
}

TEST(SharedFace, RefusesWhatItCannotRead) {
  TwoBoxes two({0.5, 0.5, 0.5}, {0.5, 0.5, 0.5}, {0, 1, 0});
  for (double gap : {-1.0, std::nan(""), 1e30})
    EXPECT_EQ(two.world.sharedFace(two.a, two.b, gap).error().code, ErrorCode::invalidArgument);
  EXPECT_EQ(two.world.sharedFace(two.a, two.a).error().code, ErrorCode::invalidArgument);
  EXPECT_EQ(two.world.sharedFace(two.a, {}).error().code, ErrorCode::staleId);
  EXPECT_TRUE(two.world.destroyBody(two.b).ok());
  EXPECT_EQ(two.world.sharedFace(two.b, two.a).error().code, ErrorCode::staleId);
}

}  // namespace
}  // namespace brickfall
