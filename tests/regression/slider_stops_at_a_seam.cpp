// A box that slid over flush bricks was stopped, or thrown up, by the side of the next one, and a ball that rolled over them lost its speed:
// the side of a brick that lies ahead is nearer than its top.
#include "law/motion.h"

namespace brickfall {
namespace {

using namespace law;

void pave(World& world, double length) {
  for (int i = 0; i < int(8 / length); i++)
    add(world, bodyOf(boxOf({length / 2, 0.03, 0.5}, 1900), {-4 + length * (i + 0.5), 0.03, 0}));
}

TEST(Regression, SliderStopsAtASeam) {
  for (double dt : kMotionSteps)
    for (double speed : {2.0, 3.0, 5.0}) {
      World world = awakeWorld();
      addGround(world, 0.6);
      pave(world, 0.2);
      run(world, 0.3, dt);
      BodyDef box = bodyOf(boxOf({0.1, 0.1, 0.1}, 1900, 0.3), {-3.5, 0.16, 0.013});
      box.shapes[0].material.frictionRule = CombineRule::minimum;
      box.linearVelocity = {speed, 0, 0};
      BodyId body = add(world, box);
      run(world, 3, dt);
      const double way = world.state(body)->position.x + 3.5, right = speed * speed / (2 * 0.3 * kG);
      EXPECT_NEAR(way / right, 1, 9 * dt) << speed << " m/s, 1/" << 1 / dt << " s";
    }
}

TEST(Regression, WhatRollsLosesItsSpeedOverSeams) {
  for (double dt : kMotionSteps)
    for (bool capsule : {false, true}) {
      World world = awakeWorld();
      addGround(world, 0.6);
      pave(world, 0.2);
      run(world, 0.3, dt);
      BodyDef ball = bodyOf(capsule ? capsuleOf(0.1, 0.2) : sphereOf(0.1, 1000), {-3.5, 0.16, 0.013});
      if (capsule) ball.rotation = turn({1, 0, 0}, 90);
      ball.linearVelocity = {2, 0, 0};
      ball.angularVelocity = {0, 0, -20};
      BodyId body = add(world, ball);
      run(world, 2.5, dt);
      EXPECT_NEAR(world.state(body)->linearVelocity.x / 2, 1, 9 * dt)
          << "capsule " << capsule << ", 1/" << 1 / dt << " s";
    }
}

}  // namespace
}  // namespace brickfall
