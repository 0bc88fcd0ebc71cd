// A ball of 134 kg at 0.8 m/s into a wall of 20 courses in lime. Its top rocked by 26 mm at 1/60 s and by 42 at 1/240 s. The
// first part of the blow was as long as the wall takes to pass it on, and all that followed was made in whole steps, which
// damp how the wall bends and straightens.
#include "law/glued.h"

namespace brickfall {
namespace {

using namespace law;

// m, that the top goes back at most, mean of three balls beside each other.
double rocks(double dt) {
  constexpr int kCourses = 20, kBricks = 12;
  double sum = 0;
  for (int n = 0; n < 3; n++) {
    Glued g;
    g.strength = {.tension = 0.05e6, .cohesion = 0.1e6, .friction = 0.7, .tensionEnergy = 6, .shearEnergy = 40};
    g.strength.stiffness = 30e9;
    g.brick({1.3, -0.5, 0}, BodyType::fixed, {10, 1, 10});
    g.wall(kCourses, kBricks);
    g.glue(0, kBricks + 2);
    BodyDef ball = bodyOf(sphereOf(0.16, 7800), {1.25 + 0.02 * n, 0.72, 0.3});
    ball.linearVelocity = {0, 0, -0.8};
    add(g.world, ball);
    double back = 0;  // m
    for (int i = 0; i < int(std::lround(1 / dt)); i++) {
      g.step(dt);
      back = std::min(back, g.world.state(g.bodies.back())->position.z);
    }
    sum -= back / 3;
  }
  return sum;
}

TEST(Regression, HitWallRocksLessAtLongSteps) {
  const double fine = rocks(1.0 / 240);
  EXPECT_GT(rocks(1.0 / 60), fine / 1.4) << fine << " m in steps of 1/240 s";
}

}  // namespace
}  // namespace brickfall
