// Bodies that press on each other and slide together go as a whole by the mean of their old and new velocities.
#include <gtest/gtest.h>

#include <cmath>

#include "support/test_island.h"

namespace brickfall {
namespace {

using test::kBrick;
using test::kG;
using test::TestIsland;

constexpr float kSlippery = 0.2f;

// Three bricks that have come to rest on the ground, then slide.
struct Stack : TestIsland {
  // The bricks first: the points of a contact ride with the first of its bodies.
  explicit Stack(double dt) : TestIsland(dt) {
    for (int i = 0; i < 3; i++) bricks.push_back(brick({0, (2 * i + 1) * kBrick.y, 0}));
    floor = ground();
    touch(bricks[0], floor, kSlippery);
    for (std::size_t i = 1; i < 3; i++) touch(bricks[i - 1], bricks[i]);
    run(60);
    EXPECT_TRUE(island().resting());
    island().unsettle();
  }
  void push(double speed) {
    for (BodyIndex body : bricks) at(body).linearVelocity = {speed, 0, 0};
  }
  // m, by which its way differs from that of implicit Euler.
  Vec3 corrected(BodyIndex body) const { return context.solved[body].d - context.solved[body].velocity * context.dt; }
  std::vector<BodyIndex> bricks;
  BodyIndex floor;
};

TEST(GroupSlide, AStackStopsWhereItMust) {
  for (double dt : {1.0 / 60, 1.0 / 240}) {
    Stack lab(dt);
    const double from = lab.at(lab.bricks[1]).position.x;
    lab.push(2);
    for (int step = 0; step < int(2 / dt); step++) lab.step();
    EXPECT_TRUE(lab.island().resting()) << dt;
    const double way = 2 * 2 / (2 * double(kSlippery) * kG);
    EXPECT_NEAR(lab.at(lab.bricks[1]).position.x - from, way, 0.5 * double(kSlippery) * kG * dt * dt + 2e-4)
        << "its last step is that of implicit Euler; without the others' correction " << dt << " m would be missing";
  }
}

TEST(GroupSlide, AllAreMovedAlike) {
  Stack lab(1.0 / 60);
  lab.push(2);
  lab.at(lab.bricks[2]).angularVelocity = {0, 0, 0.3};  // the uppermost begins to tilt
  lab.step();
  lab.step();
  const Vec3 by = lab.corrected(lab.bricks[0]);
  EXPECT_NEAR(by.x, 0.5 * double(kSlippery) * kG / 3600, 0.2 * double(kSlippery) * kG / 3600);
  EXPECT_NEAR(by.y, 0, 1e-8);
  for (BodyIndex body : lab.bricks) EXPECT_NEAR(length(lab.corrected(body) - by), 0, 1e-9);
}

TEST(GroupSlide, WhatSticksIsNotCorrected) {
  Stack lab(1.0 / 60);
  lab.push(0.5 * double(kSlippery) * kG / 60);  // less than friction takes in one step
  lab.step();
  for (BodyIndex body : lab.bricks) EXPECT_EQ(lab.corrected(body), Vec3{});
}

TEST(GroupSlide, WhatLandsIsNotCorrected) {
  TestIsland lab;
  const BodyIndex ground = lab.ground();
  auto bricks = lab.pile(ground, 3, 1e-4, {}, kSlippery);
  for (BodyIndex body : bricks) lab.at(body).linearVelocity = {1, -1, 0};
  lab.step();
  for (BodyIndex body : bricks)
    EXPECT_NEAR(length(lab.context.solved[body].d - lab.context.solved[body].velocity * (1.0 / 60)), 0, 1e-12);
  EXPECT_GT(lab.context.solved[bricks[0]].velocity.y, -0.9) << "it was stopped";
}

// A brick half a millimetre before another that stands: moved on by what is missing, it would be in it.
TEST(GroupSlide, NothingIsMovedIntoItsNeighbour) {
  for (bool near : {true, false}) {
    Stack lab(1.0 / 60);
    const double speed = 0.6, slows = double(kSlippery) * kG / 60;
    // Where the solve leaves it 20 um short of the neighbour, and the mean of velocities would not.
    const double ends = (speed - slows) / 60, gap = ends + (near ? 2e-5 : 0.5 * slows / 60 + 2e-5);
    const BodyIndex other = lab.brick({2 * kBrick.x + gap, kBrick.y, 0});
    lab.touch(lab.floor, other, 0.6f);
    lab.touch(lab.bricks[0], other, 0.6f);
    lab.push(speed);
    lab.prepare();
    lab.solve();
    lab.store();
    if (near)
      EXPECT_EQ(lab.corrected(lab.bricks[0]), Vec3{});
    else
      EXPECT_GT(lab.corrected(lab.bricks[0]).x, 0.3 * slows / 60);
  }
}

}  // namespace
}  // namespace brickfall
