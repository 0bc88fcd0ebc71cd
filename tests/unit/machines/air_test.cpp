// Blasts and wind: shares, shelter, and nothing from nothing.
#include "brickfall/machines.h"
#include "support/world_helpers.h"

namespace brickfall {
namespace {

using namespace test;

// A box far from the centre takes its solid angle: nearly its area over 4 pi r^2.
TEST(Blast, ABodyTakesTheShareOfItsSolidAngle) {
  World world = emptySpace();
  const BodyId box = addBox(world, {0.1, 0.2, 0.3}, {10, 0, 0}), ball = add(world, bodyOf(sphereOf(0.3), {0, 5, 0}));
  const Result<BlastReport> report = applyBlast(world, {.centre = {}, .impulse = 1000, .radius = 11});
  ASSERT_TRUE(report.ok());
  EXPECT_EQ(report->bodies, 2);
  const BodyState b = *world.state(box), s = *world.state(ball);
  const double areaShare = 0.4 * 0.6 / (4 * kPi * 9.9 * 9.9), cap = (1 - std::sqrt(1 - 0.09 / 25)) / 2;
  EXPECT_NEAR(b.linearVelocity.x * b.mass, 1000 * areaShare, 1000 * areaShare * 0.002);
  EXPECT_NEAR(s.linearVelocity.y * s.mass, 1000 * cap, 1000 * cap * 0.01);
  EXPECT_NEAR(b.linearVelocity.y, 0, 1e-12);
  EXPECT_NEAR(length(b.angularVelocity), 0, 1e-9);
}

// Seen from the centre a ball of radius r at a distance d fills (1 - cos) / 2 of all directions, sin = r / d, and goes
// straight away from it with sin^2 / 4.
TEST(Blast, ABallTakesTheShareOfItsSolidAngle) {
  for (double distance : {0.5, 1.0, 3.0}) {
    World world = emptySpace();
    const BodyId ball = world.createBody(ballBody(0.3, {}, {distance, 0, 0})).value();
    const Result<BlastReport> report = applyBlast(world, {.centre = {}, .impulse = 100, .radius = 10});
    ASSERT_TRUE(report.ok());
    const double sine = 0.3 / distance, cosine = std::sqrt(1 - sine * sine);
    EXPECT_NEAR(report->impulse / (50 * (1 - cosine)), 1, 0.01) << distance;
    const BodyState s = *world.state(ball);
    EXPECT_NEAR(s.linearVelocity.x * s.mass / (25 * sine * sine), 1, 0.01) << distance;
    EXPECT_NEAR(length(s.angularVelocity), 0, 1e-9);
  }
}

// All around the centre: as much as there is, and no momentum in sum.
TEST(Blast, AClosedShellTakesAllOfIt) {
  World world = emptySpace();
  for (int axis = 0; axis < 3; axis++)
    for (double side : {-1.0, 1.0}) {
      Vec3 half{1, 1, 1}, at;
      half[axis] = 0.05;
      at[axis] = side * 1.05;
      addBox(world, half, at);
    }
  const Result<BlastReport> report = applyBlast(world, {.centre = {0.3, 0.2, -0.4}, .impulse = 50, .radius = 10});
  EXPECT_NEAR(report->impulse, 50, 1e-6);
  EXPECT_LT(length(world.linearMomentum()), 50 * 0.02) << "faces are pushed at their middles";
}

TEST(Blast, HiddenBodiesFeelItOnlyWithoutOcclusion) {
  for (bool occlusion : {true, false}) {
    World world = emptySpace();
    add(world, bodyOf(boxOf({0.1, 2, 2}), {1, 0, 0}, BodyType::fixed));
    const BodyId hidden = addBox(world, {0.2, 0.2, 0.2}, {2, 0, 0});
    const BodyId half = addBox(world, {0.2, 0.2, 0.2}, {2, 4.2, 0});  // the edge's shadow goes through it
    const Result<BlastReport> report =
        applyBlast(world, {.centre = {}, .impulse = 100, .radius = 9, .occlusion = occlusion});
    EXPECT_EQ(report->bodies, occlusion ? 1 : 2);
    EXPECT_EQ(world.state(hidden)->linearVelocity.x > 0, !occlusion);
    if (occlusion) {
      EXPECT_GT(world.state(half)->linearVelocity.y, 0);
      EXPECT_LT(world.state(half)->angularVelocity.z, 0) << "pushed up at its near face, its underside is hidden";
    }
    EXPECT_EQ(applyBlast(world, {.centre = {}, .impulse = 100, .radius = 1.5, .occlusion = false})->bodies, 0);
  }
  World world = emptySpace();
  EXPECT_FALSE(applyBlast(world, {.centre = {NAN, 0, 0}, .impulse = 1, .radius = 1}).ok());
  EXPECT_FALSE(applyBlast(world, {.centre = {}, .impulse = -1, .radius = 1}).ok());
  EXPECT_FALSE(applyBlast(world, {.centre = {}, .impulse = 1, .radius = INFINITY}).ok());
}

TEST(Wind, PushesAPlateAsItsCoefficientSays) {
  World world = emptySpace();
  const BodyId plate = addBox(world, {0.5, 0.5, 0.01}, {});
  ASSERT_TRUE(applyWind(world, {.velocity = {0, 0, 10}}, 0, 1e-5).ok());
  ASSERT_TRUE(world.step(1e-5).ok());
  const BodyState s = *world.state(plate);
  const double force = 1.3 * 0.5 * 1.204 * 100 * 1;
  EXPECT_NEAR(s.linearVelocity.z * s.mass / 1e-5, force, force * 0.001);
  EXPECT_NEAR(length(s.angularVelocity), 0, 1e-12);
}

// The pressure on a face goes with the square of the cosine. A ball so bears half of what a disc would, a cylinder across
// the wind two thirds of what a plate would. No shape stands in its own wind.
TEST(Wind, PushesWhatIsRound) {
  auto share = [](ShapeType type, Quat turned, double area) {
    World world = emptySpace();
    ShapeDef shape;
    shape.type = type;
    shape.radius = 0.3;
    shape.halfHeight = 0.5;
    BodyDef def;
    def.shapes = {shape};
    def.rotation = turned;
    ShapeDef sensor;
    sensor.halfExtents = {3, 3, 3};
    sensor.sensor = true;
    def.shapes.push_back(sensor);
    const BodyId body = world.createBody(def).value();
    EXPECT_TRUE(applyWind(world, {.velocity = {0, 0, 10}}, 0, 1e-5).ok());
    EXPECT_TRUE(world.step(1e-5).ok());
    const BodyState s = *world.state(body);
    return s.linearVelocity.z * s.mass / 1e-5 / (1.3 * 0.5 * 1.204 * 100 * area);
  };
  const double disc = kPi * 0.09;
  EXPECT_NEAR(share(ShapeType::sphere, {}, disc), 0.5, 0.01);
  EXPECT_NEAR(share(ShapeType::cylinder, {}, 0.6), 2.0 / 3, 0.01);
  EXPECT_NEAR(share(ShapeType::cylinder, quatFromAxisAngle({1, 0, 0}, kPi / 2), disc), 1, 0.01);
  EXPECT_NEAR(share(ShapeType::capsule, {}, 0.6 + disc * 0.75), 2.0 / 3, 0.015);
}

// The lightest leaf in a storm at the longest step ends with the wind, never beyond it, nor does it spin up.
TEST(Wind, NothingOutrunsIt) {
  for (double dt : {0.1, 1.0 / 60}) {
    World world = emptySpace();
    BodyDef leaf = bodyOf(boxOf({0.1, 0.1, 0.001}, 10), {});
    leaf.rotation = quatFromAxisAngle({1, 0, 0}, 0.4);
    const BodyId body = add(world, leaf);
    const double mass = world.state(body)->mass;
    for (int k = 0; k < 600; k++) {
      ASSERT_TRUE(applyWind(world, {.velocity = {0, 0, 40}}, 0, dt).ok());
      ASSERT_TRUE(world.step(dt).ok());
      const BodyState s = *world.state(body);
      const Vec3 relative = s.linearVelocity - Vec3{0, 0, 40};
      EXPECT_LE(0.5 * mass * lengthSquared(relative), 0.5 * mass * 1600 * 1.0001)
          << "in the wind's frame it only loses";
    }
    EXPECT_NEAR(world.state(body)->linearVelocity.z, 40, 4);
  }
}

TEST(Wind, WhatStandsBehindAnotherFeelsNothingAndStillAirIsNothing) {
  World world = emptySpace();
  add(world, bodyOf(boxOf({1, 1, 0.1}), {0, 0, -5}, BodyType::fixed));
  const BodyId front = addBox(world, {0.5, 0.5, 0.1}, {0, 0, 0}),
               touching = addBox(world, {0.5, 0.5, 0.1}, {0, 0, 0.2});
  ASSERT_TRUE(applyWind(world, {.velocity = {0, 0, 20}}, 0, 1e-5).ok());
  ASSERT_TRUE(world.step(1e-5).ok());
  EXPECT_EQ(world.state(front)->linearVelocity.z, 0);
  EXPECT_GT(world.state(touching)->linearVelocity.z, 0) << "drawn at its back";
  ASSERT_TRUE(applyWind(world, {.velocity = {0, 0, 20}, .from = 5}, 0, 1e-5).ok());
  World still = emptySpace();
  addBox(still, {1, 1, 1}, {});
  ASSERT_TRUE(applyWind(still, {.velocity = {0, 0, 20}, .from = 5}, 0, 0.01).ok());
  ASSERT_TRUE(still.step(0.01).ok());
  EXPECT_EQ(still.energy().kinetic, 0);
  EXPECT_FALSE(applyWind(still, {.velocity = {NAN, 0, 20}}, 0, 0.01).ok());
}

}  // namespace
}  // namespace brickfall
