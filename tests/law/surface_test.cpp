// Rows 21a and 21b: surfaces that run, and resistance to rolling.
#include "law/law.h"

namespace brickfall::law {
namespace {

BodyDef beltOf(double friction, Vec3 velocity, BodyType type = BodyType::fixed) {
  BodyDef belt = bodyOf(boxOf({50, 0.1, 2}, 1000, friction), {0, -0.1, 0}, type);
  belt.surfaceVelocity = velocity;
  return belt;
}

// A box is put on a belt. It slides for v / (mu g) and goes with the belt from then on, so it is late by v^2 / (2 mu g).
TEST(Law, Row21aABeltTakesABoxAlong) {
  constexpr double kFriction = 0.5;
  for (double dt : kSteps)
    for (double v : {0.3, 1.0}) {
      const bool kinematic = v == 1;
      World world = makeWorld();
      world.trace({.ledger = true});
      const BodyId box = add(world, bodyOf(boxOf({0.1, 0.05, 0.05}, 1900, kFriction), {0, 0.05, 0}));
      add(world, beltOf(kFriction, {v, 0, 0}, kinematic ? BodyType::kinematic : BodyType::fixed));
      double given = 0, gained = 0, off = 0, t = 0;
      for (long n = std::lround(2 / dt); n > 0; n--) {
        const Result<StepReport> report = world.step(dt);
        ASSERT_TRUE(report.ok());
        t += dt;
        const StepLedger& l = *report->ledger;
        given += l.supports.energy;
        gained = std::max(gained, l.contacts.energy + l.contacts.elastic);
        if (t > v / (kFriction * kG) + 2 * dt)
          off = std::max(off, length(world.state(box)->linearVelocity - Vec3{v, 0, 0}));
      }
      const BodyState s = *world.state(box);
      const double slide = v / (kFriction * kG);
      reached({"belt at " + text(v, 1) + " m/s: time of the slide", dt, 2 * (t - s.position.x / v), slide, 0.01 * slide,
               "s"});
      atMost("belt at " + text(v, 1) + " m/s: speed off, once it goes along", dt, off, 1e-4 * v, "m/s");
      atMost("belt at " + text(v, 1) + " m/s: energy that contacts give", dt, gained, 1e-6, "J");
      const double work = s.mass * v * v;  // half of it becomes heat
      reached({"belt at " + text(v, 1) + " m/s: work of the belt", dt, given, work,
               work * (v * dt / (slide * v) + 0.01), "J"});
      EXPECT_TRUE(s.awake);
      EXPECT_TRUE(world.validate().empty());
    }
  for (double dt : kSteps) {
    World world = makeWorld();
    add(world, beltOf(kFriction, {2, 0, 0}));
    const BodyId ball = add(world, bodyOf(sphereOf(0.1, 1900, kFriction), {0, 0.1, 0}));
    run(world, 3, dt);
    reached({"belt at 2 m/s: ball rolls at 2/7 of it", dt, world.state(ball)->linearVelocity.x, 4.0 / 7, 1e-3, "m/s"});
  }
}

// Blocked, a box stays awake while the belt runs under it, and sleeps when it stops. The belt is turned: its surface
// runs in its own axes.
TEST(Law, Row21aWhatLiesOnARunningBeltDoesNotSleep) {
  World world = makeWorld();
  BodyDef belt = beltOf(0.5, {1, 0, 0});
  belt.rotation = turn({0, 1, 0}, 90);  // its x is the world's -z
  const BodyId running = add(world, belt);
  add(world, bodyOf(boxOf({1, 1, 0.1}), {0, 1, -1}, BodyType::fixed));
  const BodyId box = add(world, bodyOf(boxOf({0.1, 0.05, 0.05}, 1900, 0.5), {0, 0.05, 0}));
  for (int i = 0; i < 300; i++) {
    stepSound(world);
    ASSERT_TRUE(world.state(box)->awake);
  }
  EXPECT_NEAR(world.state(box)->position.z, -0.85, 1e-4);
  EXPECT_LT(length(world.state(box)->linearVelocity), 1e-6);
  ASSERT_TRUE(world.setSurfaceVelocity(running, {}).ok());
  run(world, 1.5);
  EXPECT_FALSE(world.state(box)->awake);
  ASSERT_TRUE(world.setSurfaceVelocity(running, {-1, 0, 0}).ok());
  EXPECT_TRUE(world.state(box)->awake);
  run(world, 0.5);
  EXPECT_NEAR(world.state(box)->linearVelocity.z, 1, 1e-5);
}

// A stack and a heap on a belt come to its speed, too, and a drop on it gains no more than the belt does work.
TEST(Law, Row21aStacksGoWithABelt) {
  for (double dt : kSteps) {
    World world = makeWorld();
    world.trace({.ledger = true});
    add(world, beltOf(0.5, {1, 0, 0}));
    std::vector<BodyId> all;
    for (int i = 0; i < 30; i++)
      all.push_back(
          add(world, bodyOf(boxOf({0.1, 0.05, 0.05}, 1900, 0.5), {0.25 * (i % 6), 0.06 + 0.13 * (i / 6), 0})));
    double off = 0, made = 0;
    for (long n = std::lround(3 / dt); n > 0; n--) {
      const Result<StepReport> report = world.step(dt);
      ASSERT_TRUE(report.ok());
      made = std::max(made, report->ledger->contacts.energy + report->ledger->contacts.elastic);
    }
    for (BodyId body : all) off = std::max(off, length(world.state(body)->linearVelocity - Vec3{1, 0, 0}));
    atMost("five layers of boxes on a belt at 1 m/s: speed off", dt, off, 2e-3, "m/s");
    atMost("five layers of boxes on a belt at 1 m/s: energy that contacts give", dt, made, 1e-3, "J");
  }
}

struct Roller {
  const char* name;
  ShapeType type;
};

BodyDef rollerOf(ShapeType type, double c) {
  ShapeDef shape = sphereOf(0.1, 1900);
  shape.type = type;
  shape.halfHeight = 0.1;
  shape.material.rollingResistance = c;
  BodyDef roller = bodyOf(shape, {0, 0.1, 0});
  if (type != ShapeType::sphere) roller.rotation = turn({1, 0, 0}, 90);
  return roller;
}

// Rolling against a torque of c N r: v^2 k / (2 c g) with k = 1 + I / (m r^2), 7/5 of a ball.
TEST(Law, Row21bWhatRollsComesToRest) {
  for (const Roller& roller : {Roller{"ball", ShapeType::sphere}, Roller{"drum", ShapeType::cylinder}})
    for (double dt : {1.0 / 30, 1.0 / 60, 1.0 / 480}) {
      const double c = 0.05, v = 1;
      World world = makeWorld();
      addGround(world);
      BodyDef def = rollerOf(roller.type, c);
      def.linearVelocity = {v, 0, 0};
      def.angularVelocity = {0, 0, -10 * v};
      const BodyId body = add(world, def);
      const MassProperties m = *world.massProperties(body);
      const double k =
          1 + (roller.type == ShapeType::sphere ? m.inertia.row[0].x : m.inertia.row[1].y) / (m.mass * 0.01);
      double last = world.energy().kinetic, gained = 0;
      for (long n = std::lround(4.5 / dt); n > 0; n--) {
        ASSERT_TRUE(world.step(dt).ok());
        gained = std::max(gained, world.energy().kinetic - last);
        last = world.energy().kinetic;
      }
      const double way = k * v * v / (2 * c * kG);
      reached({std::string(roller.name) + " at 1 m/s, c .05: way", dt, world.state(body)->position.x, way, 2e-3 * way,
               "m"});
      atMost(std::string(roller.name) + ": energy gained in a step", dt, gained, 1e-12, "J");
      EXPECT_FALSE(world.state(body)->awake);
      EXPECT_TRUE(world.validate().empty());
    }
}

// Over bricks that lie loose, in an island of many bodies, of which each is left a fiftieth of its weight.
TEST(Law, Row21bABallComesToRestOnLooseBricks) {
  for (double dt : {1.0 / 60, 1.0 / 240}) {
    const double c = 0.02;
    World world = makeWorld();
    addGround(world);
    for (int i = 0; i < 25; i++) add(world, bodyOf(boxOf({0.1075, 0.0325, 0.2}, 1900), {0.215 * i - 0.1, 0.0325, 0}));
    BodyDef def = rollerOf(ShapeType::sphere, c);
    def.position.y = 0.165;
    def.linearVelocity = {0.7, 0, 0};
    def.angularVelocity = {0, 0, -7};
    const BodyId ball = add(world, def);
    for (long n = std::lround(6 / dt); n > 0; n--) ASSERT_TRUE(world.step(dt).ok());
    const double way = 0.7 * 0.49 / (c * kG);
    reached({"ball over loose bricks, c .02: way", dt, world.state(ball)->position.x, way, 0.08 * way, "m"});
  }
}

// On a slope of tangent t a ball stands up to t = c, and rolls with 5/7 (t - c) cos g beyond.
TEST(Law, Row21bABallStandsOnASlopeUpToItsResistance) {
  for (double dt : {1.0 / 30, 1.0 / 60, 1.0 / 480})
    for (double share : {0.97, 1.03, 2.0}) {
      const double c = 0.05, tangent = share * c, cosine = 1 / std::sqrt(1 + tangent * tangent);
      WorldDef def;
      def.gravity = Vec3{tangent, -1, 0} * (kG * cosine);
      World world = makeWorld(def);
      addGround(world);
      const BodyId ball = add(world, rollerOf(ShapeType::sphere, c));
      run(world, 4, dt);
      const double way = share > 1 ? 8 * kG * cosine * (tangent - c) * 5 / 7 : 0;
      reached({"slope of " + text(share, 2) + " c: way in 4 s", dt, world.state(ball)->position.x, way,
               0.01 * way + 1e-4, "m"});
      EXPECT_EQ(world.state(ball)->awake, share > 1);
    }
}

// Nothing is won in a heap of balls that resist rolling, and it lies still on a slope that loose balls run down.
TEST(Law, Row21bAHeapOfBallsStandsByItsResistance) {
  for (double c : {0.0, 0.3}) {
    World world = makeWorld();
    addGround(world);
    std::vector<BodyId> all;
    for (int i = 0; i < 14; i++) {  // a pyramid of 3 x 3, 2 x 2 and 1
      const int layer = i < 9 ? 0 : i < 13 ? 1 : 2, side = 3 - layer, k = i - (layer == 0 ? 0 : layer == 1 ? 9 : 13);
      const double first = -0.1 * (side - 1);
      all.push_back(add(world, rollerOf(ShapeType::sphere, c)));
      ASSERT_TRUE(
          world.setTransform(all.back(), {first + 0.2 * (k % side), 0.1 + 0.1415 * layer, first + 0.2 * (k / side)}, {})
              .ok());
    }
    const auto all_ = [&] { return world.energy().kinetic + world.energy().potential; };
    double last = all_(), gained = 0;
    for (int n = 0; n < 240; n++) {
      ASSERT_TRUE(world.step(kDt).ok());
      gained = std::max(gained, all_() - last);
      last = all_();
    }
    if (c > 0) atMost("pyramid of 14 balls, c " + text(c, 1) + ": energy gained in a step", kDt, gained, 1e-5, "J");
    const double top = world.state(all.back())->position.y;
    reached({"pyramid of 14 balls, c " + text(c, 1) + ": stands (1 = yes)", kDt, top > 0.37 ? 1.0 : 0.0,
             c > 0 ? 1.0 : 0.0, 0, ""});
  }
}

}  // namespace
}  // namespace brickfall::law
