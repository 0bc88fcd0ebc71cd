// What has landed overlaps, and lets go of a tenth of that in each step. It did so in each part of a step, too. Parts of a millisecond,
// for a hit elsewhere, pushed a column that had just landed up by five times its weight x the step. The last check took that back.
#include "support/world_helpers.h"

namespace brickfall {
namespace {

using namespace test;

constexpr int kBoxes = 20;

struct Pushed {
  double back = 0;  // weights x step: what the last check took back, in a step in which a ball hits a brick 50 m away
  int parts = 0;
};

// Boxes fall 50 mm onto each other. After so many steps the column has landed.
Pushed pushedAfter(int steps) {
  World world = makeWorld();
  add(world, bodyOf(boxOf({100, 0.5, 100}), {0, -0.5, 0}, BodyType::fixed));
  for (int i = 0; i < kBoxes; i++) add(world, bodyOf(boxOf({0.2, 0.2, 0.2}, 1900), {0, 0.25 + 0.45 * i, 0}));
  const Vec3 brick{50, 0.0325, 0};
  add(world, bodyOf(boxOf({0.1075, 0.0325, 0.05125}, 1900), brick));
  for (int i = 0; i < steps; i++) (void)world.step(kDt);
  constexpr double kSpeed = 100, kRadius = 0.06;
  BodyDef ball = bodyOf(sphereOf(kRadius, 78000), brick - Vec3{0, 0, 0.05125 + kRadius + 0.9 * kSpeed * kDt});
  ball.linearVelocity = {0, 0, kSpeed};
  add(world, ball);
  world.trace({.ledger = true});
  const Result<StepReport> report = world.step(kDt);
  constexpr double kMass = kBoxes * 0.4 * 0.4 * 0.4 * 1900;
  return {length(report->ledger->balance.linear) / (kMass * 9.81 * kDt), report->parts};
}

TEST(Regression, LandedColumnIsPushedUpInShortParts) {
  for (int steps : {28, 31, 34}) {
    SCOPED_TRACE(std::to_string(steps) + " steps");
    const Pushed pushed = pushedAfter(steps);
    EXPECT_GT(pushed.parts, 2);
    EXPECT_LT(pushed.back, 0.1);
  }
}

}  // namespace
}  // namespace brickfall
