// The ledger books what happens on the right cause: worlds so small that each can be worked out by hand.
#include "ledger/sums.h"

#include "support/world_helpers.h"

namespace brickfall::test {
namespace {

World ledgerWorld(WorldDef def = {}) {
  World world = makeWorld(def);
  world.trace({false, false, true});
  return world;
}
StepLedger stepOf(World& world, double dt = kDt, int substeps = 1) {
  StepReport report = stepSound(world, dt, substeps);
  EXPECT_TRUE(report.ledger);
  return report.ledger.value_or(StepLedger{});
}

TEST(Ledger, fallIsGravityAndNothingElse) {
  World world = ledgerWorld();
  BodyDef d = bodyOf(boxOf({.1, .2, .3}), {3, 5, -2});
  d.linearVelocity = {1, 2, 3};
  d.angularVelocity = {2, -1, 4};
  const double mass = world.state(add(world, d))->mass;
  for (int i = 0; i < 30; i++) {
    StepLedger l = stepOf(world);
    expectNear(l.gravity.linear, {0, -kG * mass * kDt, 0}, 1e-12 * mass);
    expectNear(l.after.linear - l.before.linear, l.gravity.linear, 1e-12 * mass);
    expectNear(l.after.angular - l.before.angular, l.gravity.angular, 1e-10 * mass);
    EXPECT_LT(length(l.supports.linear) + length(l.forces.linear) + length(l.damping.linear), 1e-300);
    EXPECT_LT(length(l.contacts.linear), 1e-12 * mass);
    EXPECT_NEAR(energyOf(l.after), energyOf(l.before), 1e-9 * energyOf(l.before));
  }
}

TEST(Ledger, whatStandsIsHeldByTheGround) {
  World world = ledgerWorld();
  addGround(world);
  const double mass = world.state(addBox(world, {.1, .1, .1}, {2, .1, 1}))->mass;
  StepLedger l;
  for (int i = 0; i < 20; i++) l = stepOf(world);
  expectNear(l.supports.linear, {0, kG * mass * kDt, 0}, 1e-3 * kG * mass * kDt, "held");
  expectNear(l.supports.angular, cross(Vec3{2, .1, 1}, Vec3{0, kG * mass * kDt, 0}), 3e-3 * kG * mass * kDt,
             "about the origin");
  EXPECT_EQ(l.supports.energy, 0);
}

TEST(Ledger, forcesImpulsesAndLaunchesAreNamed) {
  WorldDef def;
  def.gravity = {};
  World world = ledgerWorld(def);
  BodyId box = addBox(world, {.1, .1, .1}, {1, 0, 0});
  stepOf(world);
  ASSERT_TRUE(world.applyForce(box, {0, 6, 0}).ok());
  StepLedger l = stepOf(world, kDt, 3);
  expectNear(l.forces.linear, {0, 6 * kDt, 0}, 1e-12);
  expectNear(l.forces.angular, {0, 0, 6 * kDt}, 1e-12);
  EXPECT_NEAR(l.forces.energy, l.after.kinetic,
              0.4 * l.after.kinetic);  // implicit steps: F d is more than what arrives
  EXPECT_EQ(length(l.outside.linear), 0);

  ASSERT_TRUE(world.applyImpulse(box, {0, 0, 5}).ok());
  const double before = world.energy().kinetic;
  const BodyId late = addBox(world, {.1, .1, .1}, {9, 0, 0}, {2, 0, 0});
  const double mass = world.state(late)->mass;
  l = stepOf(world);
  expectNear(l.outside.linear, {2 * mass, 0, 5}, 1e-12 * mass);
  EXPECT_GT(l.outside.energy, 0.5 * mass * 4);
  EXPECT_NEAR(l.before.kinetic, before + 0.5 * mass * 4, 1e-9);
  ASSERT_TRUE(world.destroyBody(late).ok());
  l = stepOf(world);
  expectNear(l.outside.linear, {-2 * mass, 0, 0}, 1e-12 * mass);
}

TEST(Ledger, dampingAndDragTakeEnergy) {
  for (bool drag : {false, true}) {
    WorldDef def;
    def.gravity = {};
    World world = ledgerWorld(def);
    BodyDef d = bodyOf(sphereOf(.1), {});
    d.linearVelocity = {10, 0, 0};
    (drag ? d.dragArea : d.linearDamping) = 0.5;
    add(world, d);
    StepLedger l = stepOf(world);
    EXPECT_LT(l.damping.linear.x, 0);
    EXPECT_LT(l.damping.energy, 0);
    expectNear(l.after.linear - l.before.linear, l.damping.linear, 1e-9 * l.before.linear.x);
  }
}

TEST(Ledger, aKinematicBodyDoesWork) {
  World world = ledgerWorld();
  BodyDef lift = bodyOf(boxOf({1, .1, 1}), {}, BodyType::kinematic);
  lift.linearVelocity = {0, 0.5, 0};
  add(world, lift);
  BodyDef d = bodyOf(boxOf({.1, .1, .1}), {0, .2, 0});
  d.linearVelocity = {0, 0.5, 0};
  const double mass = world.state(add(world, d))->mass;
  double work = 0, rise = 0;
  for (int i = 0; i < 60; i++) {
    StepLedger l = stepOf(world);
    work += l.supports.energy;
    rise += energyOf(l.after) - energyOf(l.before);
  }
  EXPECT_NEAR(work, mass * kG * 0.5, 0.01 * mass * kG * 0.5);
  EXPECT_NEAR(rise, work, 0.01 * work);
}

TEST(Ledger, impactsAndReboundsTakeWhatTheyShould) {
  for (double e : {0.0, 0.6}) {
    World world = ledgerWorld();
    ShapeDef plane = planeOf(), ball = sphereOf(.1);
    plane.material.restitution = ball.material.restitution = e;
    add(world, bodyOf(plane, {}, BodyType::fixed));
    const double mass = world.state(add(world, bodyOf(ball, {0, 1, 0})))->mass;
    double lost = 0, total = 0;
    for (int i = 0; i < 40; i++) {
      StepLedger l = stepOf(world);
      lost += l.contacts.energy + l.solve.energy + l.impacts.energy + l.rebound.energy + l.balance.energy +
              l.stopped.energy;
      total += energyOf(l.after) - energyOf(l.before);
    }
    const double fall = mass * kG * 0.9;
    EXPECT_NEAR(total, -(1 - e * e) * fall, 0.05 * fall) << "e " << e;
    EXPECT_NEAR(lost, total, 1e-9 * fall);
  }
}

TEST(Ledger, aQuarantinedBodyIsBooked) {
  World world = ledgerWorld();
  BodyId box = addBox(world, {.1, .1, .1}, {0, 5, 0}, {3, 0, 0});
  const Vec3 momentum = world.linearMomentum();
  ASSERT_TRUE(world.applyForce(box, {1e12, 0, 0}).ok());
  Result<StepReport> report = world.step(kDt);
  ASSERT_TRUE(report.ok());
  ASSERT_EQ(report->quarantined.size(), 1u);
  expectNear(report->ledger->quarantine.linear, -momentum, 1e-12);
  EXPECT_EQ(length(report->ledger->after.linear), 0);
}

// Bodies of all kinds thrown together, with calls of every kind between: every step's sum is what the causes add up to.
TEST(Ledger, causesAddUpToTheChange) {
  World world = ledgerWorld();
  const Played played = play(randomInputs(5, 0), world);
  ASSERT_EQ(played.refused, 0);
  lab::LabRandom random(5);
  Sums sums;
  for (int i = 0; i < 200; i++) {
    const BodyId body = played.bodies[1 + std::size_t(random.unit() * 20)];
    if (i % 5 == 0) {
      ASSERT_TRUE(world.applyForceAtPoint(body, {random.unit() * 200, 300, 0}, {0, 1, 0}).ok());
    }
    if (i % 7 == 0) {
      ASSERT_TRUE(world.applyImpulse(body, {0, 20 * random.unit(), 5}).ok());
    }
    StepLedger l = stepOf(world, kDt, 1 + i % 2);
    sums.add(world, l);
  }
  EXPECT_LT(sums.worstGap.linear, 1e-9);
  EXPECT_LT(sums.worstGap.angular, 1e-9);
  EXPECT_LT(sums.worstGap.energy, 1e-9);
  EXPECT_GT(length(sums.total.supports.linear), 0);
  EXPECT_LT(sums.total.contacts.energy, 0);
}

// A force drives a ball at rest, as its bounds say, through a thin plate: it stops short of it, and so turns less about the
// world's origin than its momentum says. The force acts on it for as long as it moves. Both are the obstacle's doing, not rounding.
TEST(Ledger, whatStopsAtAnObstacleIsBookedOnIt) {
  WorldDef def;
  def.gravity = {};
  World world = ledgerWorld(def);
  BodyDef d = bodyOf(sphereOf(0.05), {});
  d.linearVelocity = {0, 0, 5};
  BodyId ball = add(world, d);
  add(world, bodyOf(boxOf({0.005, 2, 2}), {0.4, 0, 0}, BodyType::fixed));
  const double mass = world.state(ball)->mass;
  ASSERT_TRUE(world.applyForce(ball, {mass * 60 / kDt, 0, 0}).ok());
  StepLedger l = stepOf(world);
  const BodyState end = *world.state(ball);
  EXPECT_LT(end.position.x, 0.395);
  EXPECT_GT(length(l.obstacles.angular), 0.1);
  EXPECT_LT(length(l.integrate.angular), 1e-9);
  // Of the step, until it was stopped with its core in the plate; from there it is shifted out of it.
  const double share = end.linearVelocity.x / 60, moved = end.position.x / (0.5 * 60 * kDt);
  EXPECT_GT(share, moved);
  EXPECT_LT(share, moved + 0.05 / (0.5 * 60 * kDt)) << "shifted by more than its radius";
  expectNear(end.linearVelocity, {60 * share, 0, 5}, 1e-9, "velocity");
  expectNear(l.obstacles.linear, {-mass * 60 * (1 - share), 0, 0}, 1e-9, "of the force");
}

}  // namespace
}  // namespace brickfall::test
