// Joints of whatever moved in a large island in which anything was fast were as soft as in an impact, also those that bore a
// house: while `tower` shook, its floors sank by up to 0.27 m and came up again, and a wall of 40 courses by 26 mm.
#include <gtest/gtest.h>

#include "support/lab_scenes.h"

namespace brickfall {
namespace {

TEST(Regression, StoreysSinkLikeRubber) {
  lab::Scene s = lab::make("w40", {});
  ShapeDef sphere;
  sphere.type = ShapeType::sphere;
  sphere.radius = 0.05;
  BodyDef ball;  // what is fast
  ball.position = s.start.back() + Vec3{-1, 0.0325 + 0.05, 0};
  ball.linearVelocity = {1, 0, 0};
  ball.shapes.push_back(sphere);
  BodyId fast = s.world.createBody(ball).value();
  for (int i = 0; i < 20; i++) ASSERT_TRUE(s.world.step(1.0 / 60).ok());
  ASSERT_GT(s.world.state(fast)->linearVelocity.x, 0.5);
  for (BodyId brick : s.boxes) ASSERT_TRUE(s.world.setLinearVelocity(brick, {0.1, 0, 0}).ok());
  double sunk = 0;
  for (int i = 0; i < 12; i++) {
    ASSERT_TRUE(s.world.step(1.0 / 60).ok());
    for (std::size_t k = 0; k < s.boxes.size(); k++)
      sunk = std::max(sunk, s.start[k].y - s.world.state(s.boxes[k])->position.y);
  }
  EXPECT_GT(sunk, 5e-4) << "it was shaken";
  EXPECT_LT(sunk, 8e-3);
}

}  // namespace
}  // namespace brickfall
