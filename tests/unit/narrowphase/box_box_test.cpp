// Box against box: the cases a wall is made of.
#include <gtest/gtest.h>

#include <set>

#include "narrowphase/collide.h"

namespace brickfall {
namespace {

Shape box(double x, double y, double z) {
  Shape s;
  s.type = ShapeType::box;
  s.halfExtents = {x, y, z};
  return s;
}
const Shape kBrick = box(0.1075, 0.0325, 0.05125);

TEST(BoxBox, BrickOnBrickGivesTheCornersOfTheOverlap) {
  Manifold m;
  collide(kBrick, kBrick, {{0.1075, 0.065, 0}, {}}, 0.01, m);
  ASSERT_EQ(m.count, 4);
  EXPECT_EQ(m.normal, (Vec3{0, 1, 0}));
  std::set<std::uint32_t> names;
  for (const ManifoldPoint& p : m.points) {
    EXPECT_NEAR(p.onA.x, p.onA.x > 0.05 ? 0.1075 : 0.0, 1e-12);
    EXPECT_NEAR(std::fabs(p.onA.z), 0.05125, 1e-12);
    EXPECT_NEAR(p.onA.y, 0.0325, 1e-12);
    EXPECT_NEAR(p.separation, 0, 1e-12);
    names.insert(p.feature);
  }
  EXPECT_EQ(names.size(), 4u);
}

TEST(BoxBox, HeadJointTouchesSideways) {
  for (double gap : {-1e-9, 0.0, 1e-9}) {
    Manifold m;
    collide(kBrick, kBrick, {{0.215 + gap, 0, 0}, {}}, 0.01, m);
    ASSERT_EQ(m.count, 4);
    EXPECT_EQ(m.normal, (Vec3{1, 0, 0}));
  }
}

TEST(BoxBox, DiagonalNeighboursThatShareALineDoNotTouch) {
  for (double dx : {-1e-6, -1e-9, 0.0, 1e-9, 1e-6})
    for (double dy : {-1e-6, -1e-9, 0.0, 1e-9, 1e-6}) {
      Manifold m;
      collide(kBrick, kBrick, {{0.215 + dx, 0.065 + dy, 0}, {}}, 0.01, m);
      EXPECT_EQ(m.count, 0) << dx << " " << dy;
    }
}

}  // namespace
}  // namespace brickfall
