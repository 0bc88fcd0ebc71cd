// Prisms of many sides that roll on flat ground were thrown up, by as much as 1.8 m: the corner that came down took over the anchors
// of the one that the prism stood on, 20 mm away, and the prism sank in at that end until it was found anew.
#include "support/world_helpers.h"

namespace brickfall {
namespace {

using namespace test;

ShapeDef prism(int sides, double radius, double halfLength) {
  ShapeDef shape;
  shape.type = ShapeType::hull;
  shape.material.density = 1000;
  shape.material.friction = 0.8;
  for (int i = 0; i < sides; i++)
    for (double z : {-halfLength, halfLength}) {
      double angle = 2 * kPi * (i + 0.5) / sides;
      shape.vertices.push_back({radius * std::sin(angle), -radius * std::cos(angle), z});
    }
  return shape;
}

TEST(Regression, PolygonRollsIntoTheAir) {
  const double radius = 0.05, speed = 0.3;
  for (int sides : {16, 24, 32})
    for (double rate : {120, 240, 480}) {
      World world = awakeWorld();
      add(world, bodyOf(boxOf({50, 0.5, 50}, 1000, 0.8), {0, -0.5, 0}, BodyType::fixed));
      const double height = radius * std::cos(kPi / sides);
      BodyDef def = bodyOf(prism(sides, radius, 0.2), {0, height, 0});
      def.linearVelocity = {speed, 0, 0};
      def.angularVelocity = {0, 0, -speed / height};
      BodyId body = add(world, def);
      auto energy = [&] { return world.energy().kinetic + world.energy().potential; };
      const double start = energy();
      double highest = 0, most = start;
      for (int i = 0; i < int(0.8 * rate); i++) {
        ASSERT_TRUE(world.step(1 / rate).ok());
        highest = std::max(highest, world.state(body)->position.y);
        most = std::max(most, energy());
      }
      EXPECT_GT(world.state(body)->position.x, 0.1) << "it rolls";
      EXPECT_LT(highest, radius + 2e-4) << sides << " sides, 1/" << rate << " s";
      EXPECT_LT(most, start + 0.01) << sides << " sides, 1/" << rate << " s";
    }
}

}  // namespace
}  // namespace brickfall
