// Laws of single bodies and small stacks: friction, toppling, rolling, bouncing, rocking, tumbling, drag.
#include "law/law.h"

namespace brickfall::law {
namespace {

const double kSteps[] = {1.0 / 60, 1.0 / 120, 1.0 / 240};

TEST(Law, Row1BlockOnAnInclineSticksUpToTheAngleOfFriction) {
  for (double friction : {0.5, 0.6, 0.75})
    for (double dt : {1.0 / 30, 1.0 / 60, 1.0 / 120, 1.0 / 240})
      for (bool tiltGravity : {false, true}) {
        double limit = std::atan(friction) * 180 / kPi;
        Incline below(limit - 0.2, friction, tiltGravity), above(limit + 0.2, friction, tiltGravity);
        run(below.world, 1, dt);
        double settled = below.slid();
        run(below.world, 5, dt);
        run(above.world, 2, dt);
        std::string name =
            "mu " + std::to_string(friction).substr(0, 4) + (tiltGravity ? " gravity" : " plane") + at(dt);
        atMost(name + ", creep in 5 s", std::fabs(below.slid() - settled) * 1e3, 0.1, "mm");
        double expected =
            0.5 * 4 * kG * (std::sin((limit + 0.2) * kPi / 180) - friction * std::cos((limit + 0.2) * kPi / 180));
        reached(name + ", slides in 2 s", above.slid(), expected, 0.25 * expected, "m");
      }
}

TEST(Law, Row1HoldsWhicheverWayTheBlockIsTurned) {
  for (double yaw : {0.0, 17.0, 37.0, 45.0}) {
    double limit = std::atan(0.6) * 180 / kPi;
    Incline below(limit - 0.2, 0.6, false, {0.25, 0.1, 0.25}, yaw),
        above(limit + 0.2, 0.6, false, {0.25, 0.1, 0.25}, yaw);
    run(below.world, 5);
    run(above.world, 2);
    atMost("yaw " + std::to_string(int(yaw)) + ", creep in 5 s", below.moved() * 1e3, 0.1, "mm");
    EXPECT_GT(above.slid(), 0.01);
  }
}

TEST(Law, Row2AccelerationDownAnIncline) {
  double expected = kG * (std::sin(kPi / 6) - 0.5 * std::cos(kPi / 6));
  for (double dt : kSteps)
    for (bool tiltGravity : {false, true}) {
      Incline i(30, 0.5, tiltGravity);
      run(i.world, 0.5, dt);
      double before = length(i.world.state(i.box)->linearVelocity);
      run(i.world, 2, dt);
      double a = (length(i.world.state(i.box)->linearVelocity) - before) / 2;
      reached(std::string(tiltGravity ? "gravity" : "plane") + at(dt), a, expected, 0.01 * expected, "m/s2");
    }
}

TEST(Law, Row3SlowlyTiltedBlockTopples) {
  for (double dt : kSteps) {
    WorldDef def;
    def.enableSleep = false;
    World world = makeWorld(def);
    addGround(world, 2);
    BodyId block = add(world, bodyOf(boxOf({0.125, 0.5, 0.125}, 1000, 2), {0, 0.5, 0}));
    run(world, 0.5, dt);
    double degrees = 13, rate = 0.25;                                                    // a second
    while (degrees < 15.5 && toMatrix(world.state(block)->rotation).row[1].y > 0.995) {  // 5.7 degrees from upright
      degrees += rate * dt;
      double angle = degrees * kPi / 180;
      ASSERT_TRUE(world.setGravity({kG * std::sin(angle), -kG * std::cos(angle), 0}).ok());
      stepSound(world, dt);
    }
    // It needs its time to fall: 14.036 degrees and what the tilt gained meanwhile.
    reached("topples" + at(dt), degrees, 14.036 + 0.25, 0.35, "degrees");
    EXPECT_GT(degrees, 14.0);
  }
}

// Gravity turned at once past the balance of 14.036 degrees: the block has to go over, however near it is.
TEST(Law, Row3BlockPastItsBalanceGoesOver) {
  for (double dt : kSteps)
    for (double degrees : {14.3, 14.6, 15.0, 16.0}) {
      World world = awakeWorld();
      addGround(world, 2);
      BodyId block = add(world, bodyOf(boxOf({0.125, 0.5, 0.125}, 1000, 2), {0, 0.5, 0}));
      run(world, 0.5, dt);
      double angle = degrees * kPi / 180;
      ASSERT_TRUE(world.setGravity({kG * std::sin(angle), -kG * std::cos(angle), 0}).ok());
      run(world, 3, dt);
      EXPECT_LT(toMatrix(world.state(block)->rotation).row[1].y, 0.5) << degrees << " degrees, dt " << dt;
    }
}

TEST(Law, Row4SlidesToRest) {
  for (double dt : kSteps) {
    World world = awakeWorld();
    addGround(world, 0.4);
    BodyDef d = bodyOf(boxOf({0.25, 0.1, 0.25}, 1000, 0.4), {0, 0.1, 0});
    d.linearVelocity = {5, 0, 0};
    BodyId box = add(world, d);
    double stopped = -1;
    for (int i = 0; i < 3 / dt; i++) {
      stepSound(world, dt);
      if (stopped < 0 && length(world.state(box)->linearVelocity) < 1e-2) stopped = world.time();
    }
    double way = 25 / (2 * 0.4 * kG), time = 5 / (0.4 * kG);
    // Implicit Euler brakes from the start of each step: v0 dt / 2 less.
    reached("way" + at(dt), world.state(box)->position.x, way - 2.5 * dt, 0.01 * way, "m");
    reached("time" + at(dt), stopped, time, 0.01 * time + 2 * dt, "s");
  }
}

TEST(Law, Row5SlidingBallBeginsToRoll) {
  for (double dt : kSteps) {
    World world = awakeWorld();
    addGround(world, 0.2);
    BodyDef d = bodyOf(sphereOf(0.1, 1000, 0.2), {0, 0.1, 0});
    d.linearVelocity = {2, 0, 0};
    BodyId ball = add(world, d);
    double rolls = -1, way = 0;
    for (int i = 0; i < 1 / dt; i++) {
      stepSound(world, dt);
      BodyState s = *world.state(ball);
      if (rolls < 0 && s.linearVelocity.x <= -s.angularVelocity.z * 0.1 * 1.001) {
        rolls = world.time();
        way = s.position.x;
      }
    }
    reached("speed" + at(dt), world.state(ball)->linearVelocity.x, 1.42857, 0.01 * 1.42857, "m/s");
    reached("time" + at(dt), rolls, 0.29125, 0.01 * 0.29125 + 1.01 * dt, "s");
    reached("way" + at(dt), way, 0.49928, 0.01 * 0.49928 + 1.5 * 2 * dt, "m");
  }
}

TEST(Law, Row5FastBallRollsOnUndisturbed) {
  World world = awakeWorld();
  addGround(world, 0.6);
  BodyDef d = bodyOf(sphereOf(0.05), {0, 0.05, 0});
  d.linearVelocity = {8, 0, 0};
  d.angularVelocity = {0, 0, -160};  // 2.7 rad a step
  BodyId ball = add(world, d);
  run(world, 2);
  reached("speed after 2 s", world.state(ball)->linearVelocity.x, 8, 0.08, "m/s");
}

TEST(Law, Row6BouncesToHeightsOfTheRestitutionSquared) {
  for (double dt : kSteps)
    for (double e : {0.3, 0.5, 0.8})
      for (bool sphere : {true, false}) {
        World world = awakeWorld();
        ShapeDef plane = planeOf(), shape = sphere ? sphereOf(0.25) : boxOf({0.25, 0.25, 0.25});
        plane.material.restitution = shape.material.restitution = e;
        add(world, bodyOf(plane, {}, BodyType::fixed));
        BodyId body = add(world, bodyOf(shape, {0, 1.25, 0}));
        std::vector<double> apexes;
        double previous = 0, highest = 0, sideways = 0;
        for (int i = 0; i < 4 / dt; i++) {
          stepSound(world, dt);
          BodyState s = *world.state(body);
          if (previous < 0 && s.linearVelocity.y > 0.3) {
            if (highest > 0 && !apexes.empty()) apexes.back() = highest;
            apexes.push_back(0);
            highest = 0;
          }
          // the exact apex of this flight
          if (!apexes.empty() && s.linearVelocity.y > 0)
            highest = std::max(highest, s.position.y - 0.25 + s.linearVelocity.y * s.linearVelocity.y / (2 * kG));
          previous = s.linearVelocity.y;
          sideways = std::max(sideways, std::hypot(s.position.x, s.position.z));
        }
        if (!apexes.empty() && apexes.back() == 0) apexes.back() = highest;
        std::string name = std::string(sphere ? "ball" : "box") + " e " + std::to_string(e).substr(0, 3);
        ASSERT_GE(apexes.size(), 1u) << name;
        reached(name + " first apex" + at(dt), apexes[0], e * e, 0.02 * e * e, "m");
        if (e > 0.6) {
          ASSERT_GE(apexes.size(), 2u) << name;
          reached(name + " second apex" + at(dt), apexes[1], e * e * e * e, 0.03 * e * e, "m");
        }
        atMost(name + " sideways" + at(dt), sideways * 1e3, 1, "mm");
      }
}

TEST(Law, Row7HousnerBlockRocks) {
  double expected = 0.34917;
  for (double dt : {1.0 / 120, 1.0 / 240, 1.0 / 480}) {
    World world = awakeWorld();
    addGround(world, 2);
    double angle = 0.5 * std::atan(0.25), hx = 0.125, hy = 0.5;
    BodyDef d = bodyOf(boxOf({hx, hy, hx}, 1000, 2), {});
    d.rotation = turn({0, 0, 1}, -angle * 180 / kPi);
    Vec3 corner = rotate(d.rotation, Vec3{hx, -hy, 0});
    d.position = -corner;
    BodyId block = add(world, d);
    double upright = -1, previous = angle;
    for (int i = 0; i < 1 / dt && upright < 0; i++) {
      stepSound(world, dt);
      double tilt = -rotationVector(world.state(block)->rotation).z;
      if (tilt <= 1e-4) upright = world.time() - dt * (1e-4 - tilt) / std::max(1e-9, previous - tilt);
      previous = tilt;
    }
    reached("quarter period" + at(dt), upright, expected, 0.02 * expected + 0.5 * dt, "s");
  }
}

TEST(Law, Row8DzhanibekovFlips) {
  for (double dt : {1.0 / 60, 1.0 / 240}) {
    World world = emptySpace();
    double volume = 0.3 * 0.2 * 0.1;
    BodyDef d = bodyOf(boxOf({0.15, 0.1, 0.05}, 1 / volume), {});
    d.angularVelocity = {0.1, 10, 0};
    BodyId box = add(world, d);
    Vec3 momentum = world.angularMomentum();
    double energy = world.energy().kinetic, drift = 0, energyDrift = 0, previous = 10;
    std::vector<double> flips;
    for (int i = 0; i < 60 / dt; i++) {
      stepSound(world, dt);
      drift = std::max(drift, length(world.angularMomentum() - momentum) / length(momentum));
      energyDrift = std::max(energyDrift, std::fabs(world.energy().kinetic - energy) / energy);
      BodyState s = *world.state(box);
      double spin = dot(s.angularVelocity, rotate(s.rotation, Vec3{0, 1, 0}));
      if ((previous > 0) != (spin > 0))
        flips.push_back(world.time() - dt * std::fabs(spin) / (std::fabs(spin) + std::fabs(previous)));
      previous = spin;
    }
    ASSERT_GE(flips.size(), 20u);
    reached("half period" + at(dt), (flips[10] - flips[0]) / 10, 2.4345, 0.01 * 2.4345, "s");
    atMost("angular momentum drift in 60 s" + at(dt), drift, 1e-9, "");
    atMost("energy drift in 60 s" + at(dt), energyDrift, 0.01, "");
  }
}

TEST(Law, Row10ColumnPressesOnTheGroundWithItsWeight) {
  for (double dt : kSteps)
    for (int n : {1, 5, 20}) {
      World world = awakeWorld();
      BodyId ground = addGround(world);
      double weight = 0;
      for (int i = 0; i < n; i++) {
        BodyId brick = add(world, bodyOf(boxOf({0.1075, 0.0325, 0.05125}, 1900), {0, 0.0325 + 0.065 * i, 0}));
        weight += world.state(brick)->mass * kG;
      }
      run(world, 1, dt);
      double force = 0;
      world.forEachContact([&](const ContactView& c) {
        if (c.bodyA != ground && c.bodyB != ground) return;
        for (int k = 0; k < c.pointCount; k++) force += c.points[k].normalForce;
      });
      reached(std::to_string(n) + " bricks" + at(dt), force, weight, 0.01 * weight, "N");
    }
}

TEST(Law, Row15ColumnUnderAThousandfoldWeight) {
  for (double dt : {1.0 / 60, 1.0 / 120}) {
    lab::Scene s = lab::make("col");
    run(s.world, 6, dt);
    double worst = 0;
    for (std::size_t i = 0; i + 1 < s.boxes.size(); i++)
      worst = std::max(worst, *s.world.penetration(s.world.shapes(s.boxes[i])[0], s.world.shapes(s.boxes[i + 1])[0]));
    atMost("penetration" + at(dt), worst * 1e3, 5, "mm");
    for (std::size_t i = 0; i < s.boxes.size(); i++) EXPECT_LT(lab::boxMove(s, i), 0.02) << i;
  }
}

TEST(Law, Row17TerminalVelocity) {
  for (double dt : {1.0 / 30, 1.0 / 60, 1.0 / 240}) {
    World world = makeWorld();
    BodyDef d = bodyOf(sphereOf(0.1, 600), {0, 1e5, 0});
    d.dragArea = 0.47 * kPi * 0.01;
    BodyId ball = add(world, d);
    run(world, 30, dt);
    double mass = world.state(ball)->mass, expected = std::sqrt(2 * mass * kG / (1.204 * d.dragArea));
    reached("terminal velocity" + at(dt), -world.state(ball)->linearVelocity.y, expected, 1e-3 * expected, "m/s");
  }
}

TEST(Law, Row17FallWithDragFollowsTheExactCurve) {
  for (double dt : {1.0 / 60, 1.0 / 240}) {
    World world = makeWorld();
    BodyDef d = bodyOf(sphereOf(0.1, 600), {0, 1e5, 0});
    d.dragArea = 2;
    BodyId ball = add(world, d);
    run(world, 0.5, dt);
    double mass = world.state(ball)->mass, terminal = std::sqrt(2 * mass * kG / (1.204 * 2));
    double expected = terminal * std::tanh(kG * 0.5 / terminal);
    reached("speed after 0.5 s" + at(dt), -world.state(ball)->linearVelocity.y, expected, 5e-3 * expected, "m/s");
  }
}

}  // namespace
}  // namespace brickfall::law
