// Impacts, and small islands in motion: friction and rebound, rocking, rows of balls, tops, turntables, short slides.
#include "law/motion.h"
#include "law/reference.h"

namespace brickfall::law {
namespace {

// A ball of 0.1 m, without gravity, onto a plane at 4 m/s down and 6 m/s along: the friction impulse is mu (1 + e) J, or what
// makes it roll.
TEST(Law, Row18eFrictionInImpacts) {
  for (double dt : kMotionSteps) {
    Sweep along("speed along", 2, "%"), spin("spin", 2, "%"), up("speed up", 2, "%");
    for (double friction : {0.05, 0.1, 0.3, 0.6, 2.0})
      for (double e : {0.0, 0.001, 0.3, 0.5, 0.8}) {
        World world = emptySpace();
        ShapeDef floor = boxOf({20, 0.5, 20}, 1000, friction), ball = sphereOf(0.1, 1000, friction);
        floor.material.restitution = ball.material.restitution = e;
        add(world, bodyOf(floor, {0, -0.5, 0}, BodyType::fixed));
        BodyDef def = bodyOf(ball, {0, 0.3, 0});
        def.linearVelocity = {6, -4, 0};
        BodyId body = add(world, def);
        run(world, 0.25, dt);
        BodyState s = *world.state(body);
        const double slowed = std::min(friction * (1 + e) * 4, 6 * 2.0 / 7);
        std::string which = "mu " + text(friction, 2) + ", e " + text(e, 3);
        along.add(dt, 100 * (s.linearVelocity.x / (6 - slowed) - 1), which);
        spin.add(dt, 100 * (-s.angularVelocity.z * 0.1 / (slowed / 0.4) - 1), which);
        up.add(dt, 100 * (s.linearVelocity.y - e * 4) / 4, which);
      }
  }
}

// The same onto a heavy plate that carries blocks: an island of 6 bodies and one of 92. What friction has taken a moment after.
TEST(Law, Row18eFrictionInImpactsOfLargerIslands) {
  for (double dt : kMotionSteps)
    for (int blocks : {4, 90}) {
      Sweep taken("onto a plate that carries " + std::to_string(blocks) + " blocks: impulse along", 2, "%");
      for (double friction : {0.1, 0.2})
        for (double e : {0.0, 0.5}) {
          World world = worldOnFloor(1);
          ShapeDef slab = boxOf({1.5, 0.2, 1.5}, 8000, friction), ball = sphereOf(0.1, 500, friction);
          slab.material.restitution = ball.material.restitution = e;
          add(world, bodyOf(slab, {0, 0.2, 0}));
          for (int i = 0; i < blocks; i++)
            add(world, bodyOf(boxOf({.03, .03, .03}, 1900), {-.6 + .1 * (i % 15), .43, .3 + .1 * (i / 15)}));
          run(world, 0.3, dt);
          BodyDef def = bodyOf(ball, {-0.8, 0.7, 0});
          def.linearVelocity = {6, -4, 0};
          BodyId body = add(world, def);
          const double met = std::sqrt(16 + 2 * kG * 0.2), when = (met - 4) / kG;
          double time = 0;
          for (; world.state(body)->linearVelocity.y < -0.5; time += dt) {
            ASSERT_LT(time, 1) << "it must land";
            stepSound(world, dt);
          }
          run(world, 2 * dt, dt);
          const double right = friction * (1 + e) * met + (e > 0 ? 0 : friction * kG * (time + 2 * dt - when));
          taken.add(dt, 100 * ((6 - world.state(body)->linearVelocity.x) / right - 1),
                    "mu " + text(friction, 1) + ", e " + text(e, 1), 5);
        }
    }
}

// A ball dropped on a plate that carries blocks: how high it comes, in heights of the drop, after the first and the third bounce.
TEST(Law, Row18qReboundInLargerIslands) {
  for (double dt : kMotionSteps)
    for (int blocks : atFullLength() ? std::vector{4, 90} : std::vector{90}) {
      Sweep first("onto a plate that carries " + std::to_string(blocks) + " blocks: height after a bounce", 1,
                  "% of the drop"),
          third("after three", 3, "% of the drop");
      for (double e : {0.3, 0.5, 0.9, 1.0})
        for (double drop : atFullLength() ? std::vector{0.3, 0.5, 0.6, 0.8} : std::vector{0.3, 0.6}) {
          World world = worldOnFloor(1);
          ShapeDef slab = boxOf({1.5, 0.2, 1.5}, 8000, 0.6), ball = sphereOf(0.05, 1000, 0.6);
          slab.material.restitution = ball.material.restitution = e;
          add(world, bodyOf(slab, {0, 0.2, 0}));
          for (int i = 0; i < blocks; i++)
            add(world, bodyOf(boxOf({.03, .03, .03}, 1900), {-.6 + .1 * (i % 15), .43, .3 + .1 * (i / 15)}));
          run(world, 0.3, dt);
          BodyId body = add(world, bodyOf(ball, {0, 0.45 + drop, 0}));
          double height = 0, before = 0;
          int bounces = 0;
          for (double time = 0; time < 4 && bounces < (e > 0.8 ? 3 : 1); time += dt) {
            stepSound(world, dt);
            const double speed = world.state(body)->linearVelocity.y;
            if (speed > 0 && before <= 0) height = 0;
            height = std::max(height, world.state(body)->position.y - 0.45);
            if (speed <= 0 && before > 0) {
              bounces++;
              Sweep* told = bounces == 1 ? &first : bounces == 3 && e > 0.8 ? &third : nullptr;
              if (told)
                told->add(dt, 100 * (height / drop - std::pow(e, 2 * bounces)),
                          "e " + text(e, 1) + ", drop " + text(drop, 1));
            }
            before = speed;
          }
          EXPECT_GE(bounces, e > 0.8 ? 3 : 1) << e << " from " << drop;
        }
    }
}

// Restitution that goes to nothing does what none does: a ball into a wall, bricks that moved by more than 50 mm.
TEST(Law, Row18fTheSmallestRestitutionChangesTheLeast) {
  for (double speed : atFullLength() ? std::vector{10.0, 20.0} : std::vector{20.0}) {
    auto moved = [&](double e) {
      WallOf w;
      w.courses = w.bricks = 20;
      w.restitution = w.groundRestitution = e;
      w.friction = 0.6;
      BuiltWall wall = buildWall(w);
      shoot(wall, 0.08, 7800, {wall.middle, 0.65, 0.3}, {0, 0, -speed}, e);
      run(wall.world, 1.0, 1.0 / 60);
      return movedOver(wall, 0.05);
    };
    const int none = moved(0);
    ASSERT_GE(none, 4) << "the ball must make a hole";
    for (double e : {0.001, 0.1, 0.3})
      reached({"bricks moved at " + text(speed, 0) + " m/s, e " + text(e, 3), 1.0 / 60, double(moved(e)), double(none),
               0.3 * none + 1, ""});
  }
}

// Largest tilt after the first and the fifth impact of a rocking block, in critical angles (Housner: energy about the new edge).
TEST(Law, Row18gRockingGoesOnForLong) {
  struct Block {
    double width, height, from;
  };
  for (const Block& b : {Block{0.12, 1, 0.5}, Block{0.12, 1, 0.3}, Block{0.2, 0.6, 0.5}, Block{0.4, 1, 0.5}}) {
    const double critical = std::atan2(b.width, b.height), kept = 1 - 1.5 * std::sin(critical) * std::sin(critical);
    auto exact = [&](int impacts) {
      double energy = std::cos(critical * (1 - b.from)) - std::cos(critical);
      for (int i = 0; i < impacts; i++) energy *= kept * kept;
      return (critical - std::acos(energy + std::cos(critical))) / critical;
    };
    for (double dt : kMotionSteps) {
      World world = worldOnFloor(2);
      BodyDef def = bodyOf(boxOf({b.width / 2, b.height / 2, 0.3}, 1000, 2), {});
      def.rotation = quatFromRotationVector({0, 0, -b.from * critical});
      Vec3 centre = rotate(def.rotation, Vec3{-b.width / 2, b.height / 2, 0});
      def.position = {b.width / 2 + centre.x, centre.y, 0};
      BodyId block = add(world, def);
      std::vector<double> peaks;
      double most = 0;
      bool right = true;
      for (int i = 0; i < 20 / dt && peaks.size() < 6; i++) {
        stepSound(world, dt);
        Quat q = world.state(block)->rotation;
        double tilt = -2 * std::atan2(q.z, q.w);
        if ((tilt > 0) != right) {
          peaks.push_back(most / critical);
          most = 0;
          right = !right;
        }
        most = std::max(most, std::fabs(tilt));
      }
      ASSERT_EQ(peaks.size(), 6u);
      std::string name = text(b.width, 2) + " x " + text(b.height, 1) + " m from " + text(b.from, 1) + ": amplitude ";
      reached({name + "1", dt, peaks[1], exact(1), 0.03 * exact(1), ""});
      reached({name + "5", dt, peaks[5], exact(5), 0.1 * exact(5), "", 0.105 * exact(5)});
    }
  }
}

// Balls in a row with gaps: what comes in goes out at the other end, however slow, and of more than five, too. At 1/60, 1/120 and 1/240 s the first hit falls on
// the end of a step; in the others it doesn't.
TEST(Law, Row18hBallsInARow) {
  struct Row {
    int balls;
    double gap, speed;  // m, m/s
  };
  for (double dt : {1.0 / 36, 1.0 / 60, 1.0 / 72, 1.0 / 120, 1.0 / 144, 1.0 / 200, 1.0 / 240, 1.0 / 480})
    for (const auto& [count, gap, speed] :
         {Row{5, 0.002, 3}, Row{5, 0.010, 3}, Row{12, 0.002, 3}, Row{5, 0.002, 0.3}}) {
      World world = emptySpace();
      std::vector<BodyId> balls;
      for (int i = 0; i < count; i++) {
        ShapeDef ball = sphereOf(0.05, 7800, 0);
        ball.material.restitution = 1;
        BodyDef def = bodyOf(ball, {i * (0.1 + gap), 0, 0});
        if (i == 0) def.position.x = -0.3, def.linearVelocity = {speed, 0, 0};
        balls.push_back(add(world, def));
      }
      const double energy = world.energy().kinetic;
      run(world, 3 / speed, dt);
      std::string name =
          std::to_string(count) + " balls, gaps of " + text(gap * 1e3, 0) + " mm, " + text(speed, 1) + " m/s, e 1: ";
      reached({name + "energy kept", dt, world.energy().kinetic / energy, 1, 0.005, ""});
      reached(
          {name + "speed of the last", dt, world.state(balls.back())->linearVelocity.x, speed, 0.01 * speed, "m/s"});
    }
}

// A 32-gon rolls: at each knock w keeps (k2 + R2 cos b) / (k2 + R2), between knocks it is a pendulum about a corner.
TEST(Law, Row18iARollingPolygonKnocks) {
  const double radius = 0.5, angle = kPi / 16;
  for (double dt : kMotionSteps) {
    World world = worldOnFloor(1);
    ShapeDef gon;
    gon.type = ShapeType::hull;
    gon.material.friction = 1;
    for (int i = 0; i < 32; i++)
      for (double z : {-0.1, 0.1})
        gon.vertices.push_back({radius * std::cos(i * angle), radius * std::sin(i * angle), z});
    BodyDef def = bodyOf(gon, {0, radius * std::cos(angle / 2), 0});
    def.rotation = quatFromRotationVector({0, 0, angle / 2});
    const double start = 3;  // rad/s, when a face lies on the ground and the next corner begins to carry
    def.angularVelocity = {0, 0, -start};
    def.linearVelocity = {start * radius * std::cos(angle / 2), 0, 0};
    BodyId body = add(world, def);
    MassProperties mass = *world.massProperties(body);
    const double k2 = mass.inertia.row[2].z / mass.mass, about = k2 + radius * radius;
    const double flat = radius * std::cos(angle / 2);  // m, from the centre to the face that leaves the ground
    double w = start * (k2 + flat * flat) / about, phi = -angle / 2;
    for (double t = 0; t < 2; t += 1e-5) {
      w += kG * radius * std::sin(phi) / about * 1e-5;
      phi += w * 1e-5;
      if (phi >= angle / 2) {
        phi -= angle;
        w *= (k2 + radius * radius * std::cos(angle)) / about;
      }
    }
    run(world, 2, dt);
    reached({"spin after 2 s", dt, -world.state(body)->angularVelocity.z, w, 0.05 * w, "rad/s"});
  }
}

// A top on its tip, against the rigid body that turns about that point.
TEST(Law, Row18jTopsPrecess) {
  for (double spin : {150.0, 300.0})
    for (double dt : kMotionSteps) {
      World world = worldOnFloor(1);
      ShapeDef cone;
      cone.type = ShapeType::hull;
      cone.material.friction = 1;
      cone.vertices.push_back({0, 0, 0});
      for (int i = 0; i < 16; i++)
        cone.vertices.push_back({0.05 * std::cos(i * kPi / 8), 0.08, 0.05 * std::sin(i * kPi / 8)});
      BodyDef def = bodyOf(cone, {});
      def.rotation = quatFromRotationVector({0, 0, 0.3});
      BodyId body = add(world, def);
      MassProperties mass = *world.massProperties(body);
      const double arm = mass.centre.y;
      Quat q = def.rotation;
      Vec3 momentum = rotate(q, Vec3{0, spin * mass.inertia.row[1].y, 0});
      ASSERT_TRUE(world.setAngularVelocity(body, rotate(q, Vec3{0, spin, 0})).ok());
      Mat3 aboutTip = mass.inertia;
      aboutTip.row[0].x += mass.mass * arm * arm;
      aboutTip.row[2].z += mass.mass * arm * arm;
      const double h = 2e-5;
      for (double t = 0; t < 0.5; t += h) {  // midpoint rule
        auto rates = [&](Quat at, Vec3 l) { return rotate(at, inverse(aboutTip) * rotate(conjugate(at), l)); };
        auto torque = [&](Quat at) { return cross(rotate(at, Vec3{0, arm, 0}), Vec3{0, -mass.mass * kG, 0}); };
        Quat half = normalized(quatFromRotationVector(rates(q, momentum) * (h / 2)) * q);
        Vec3 middle = momentum + torque(q) * (h / 2);
        q = normalized(quatFromRotationVector(rates(half, middle) * h) * q);
        momentum += torque(half) * h;
      }
      run(world, 0.5, dt);
      Vec3 axis = rotate(world.state(body)->rotation, Vec3{0, 1, 0}), exact = rotate(q, Vec3{0, 1, 0});
      double off = std::acos(std::min(1.0, dot(axis, exact))) * 180 / kPi;
      atMost("top of " + text(spin, 0) + " rad/s: axis off after 0.5 s", dt, off, 10, "degrees", 20);
      EXPECT_GT(axis.y, 0.7) << "it stands";
    }
}

// What lies on a turntable within its friction goes round with it.
TEST(Law, Row18kARiderOnATurntableStays) {
  for (double share : {0.5, 0.8, 0.95})
    for (double dt : stepsOfLongCase()) {
      World world = makeWorld();
      const double friction = 0.5, radius = 1, turn = std::sqrt(share * friction * kG / radius);
      BodyDef table = bodyOf(boxOf({3, 0.1, 3}, 1000, friction), {0, -0.1, 0}, BodyType::kinematic);
      table.angularVelocity = {0, turn, 0};
      add(world, table);
      BodyDef rider = bodyOf(boxOf({0.05, 0.05, 0.05}, 1000, friction), {radius, 0.05, 0});
      rider.linearVelocity = {0, 0, -turn * radius};
      rider.angularVelocity = {0, turn, 0};
      BodyId body = add(world, rider);
      run(world, 10, dt);
      Vec3 at = world.state(body)->position;
      reached({"rider at " + text(share, 2) + " of the friction limit: radius after 10 s", dt, std::hypot(at.x, at.z),
               1, 0.01, "m"});
    }
}

// v^2 / (2 mu g), however short.
TEST(Law, Row18lShortSlides) {
  for (double dt : kMotionSteps) {
    Sweep way("slides of 0.01 to 1 m/s: way", 2, "%");
    for (double speed : {0.01, 0.02, 0.05, 0.1, 0.3, 1.0}) {
      World world = worldOnFloor(0.3);
      BodyId body = add(world, bodyOf(boxOf({0.1, 0.1, 0.1}, 1000, 0.3), {0, 0.1, 0}));
      run(world, 0.5, dt);
      double from = world.state(body)->position.x;
      ASSERT_TRUE(world.setLinearVelocity(body, {speed, 0, 0}).ok());
      run(world, 1, dt);
      double right = speed * speed / (2 * 0.3 * kG);
      way.add(dt, 100 * ((world.state(body)->position.x - from) / right - 1), text(speed, 2) + " m/s");
    }
  }
}

// A cube of up to 2.5 t on a column of blocks of 250 g, off its axis: it stands if it is within the column's width, and comes
// down if it is not.
TEST(Law, Row18nAGreatLoadOnLightBlocks) {
  struct Case {
    int blocks;
    double block, load, off;  // kg, kg, m
    bool stands = true;
  };
  const double height = 0.05, half = 0.05, cube = 0.25;
  for (const Case& c : {Case{20, 0.25, 1000, 0.01}, Case{20, 0.25, 1000, 0.02}, Case{20, 0.25, 2500, 0.01},
                        Case{5, 0.1, 1000, 0.02}, Case{30, 0.25, 1000, 0.01}, Case{40, 0.25, 1000, 0.01},
                        Case{20, 0.25, 100, 0.005}, Case{20, 0.25, 1000, 0.06, false}})
    for (double dt : kMotionSteps) {
      World world = worldOnFloor(0.6);
      for (int i = 0; i < c.blocks; i++)
        add(world, bodyOf(boxOf({half, height / 2, half}, c.block / (4 * half * half * height), 0.6),
                          {0, height * (i + 0.5), 0}));
      const double right = c.blocks * height + cube;
      BodyId top =
          add(world, bodyOf(boxOf({cube, cube, cube}, c.load / (8 * cube * cube * cube), 0.6), {c.off, right, 0}));
      run(world, 3, dt);
      const double sunk = right - world.state(top)->position.y;
      std::string name = text(c.load, 0) + " kg on " + std::to_string(c.blocks) + " blocks of " + text(c.block, 2) +
                         " kg, " + text(c.off * 1e3, 0) + " mm off: ";
      if (c.stands)
        atMost(name + "sunk", dt, sunk * 1e3, 5, "mm");
      else
        EXPECT_GT(sunk, 0.5) << name << 1 / dt;
    }
}

// Two plates that lean on each other: by symmetry the force between their top edges is level, so they stand until their feet
// slip, however steep their faces are.
TEST(Law, Row18pEdgeOnEdge) {
  const double length = 0.4, thick = 0.02, wide = 0.2;
  for (double friction : {0.3, 0.5}) {
    const double limit = std::atan(2 * (friction + 0.5 * thick / length));
    for (double beyond : {-15.0, -6.0, -1.5, 1.5})
      for (double dt : kMotionSteps) {
        const double lean = limit + beyond * kPi / 180;
        World world = worldOnFloor(friction);
        BodyId plates[2];
        for (int side : {-1, 1}) {  // the inner face goes from the foot to the ridge above the origin
          Vec3 centre{0.5 * length * std::sin(lean) + 0.5 * thick * std::cos(lean),
                      0.5 * length * std::cos(lean) + 0.5 * thick * std::sin(lean), 0};
          BodyDef plate =
              bodyOf(boxOf({thick / 2, length / 2, wide / 2}, 1000, friction), {side * centre.x, centre.y, centre.z});
          plate.rotation = turn({0, 0, 1}, side * lean * 180 / kPi);
          plates[side > 0] = add(world, plate);
        }
        double ridge = world.state(plates[0])->position.y;
        run(world, 1.5, dt);
        double sunk = ridge - world.state(plates[0])->position.y;
        std::string name = "plates, friction " + text(friction, 1) + ", " + text(std::fabs(beyond), 1) + " degrees ";
        if (beyond < 0)
          atMost(name + "steeper than they need: sunk", dt, sunk * 1e3, 1, "mm");
        else
          EXPECT_GT(sunk, 0.05) << name << "flatter: they slip, " << 1 / dt;
      }
  }
}

// Dominoes of 48 mm, 20 mm apart, the first of them tapped.
TEST(Law, Row18mDominoesAllFall) {
  for (double dt : kMotionSteps) {
    World world = worldOnFloor(0.5);
    std::vector<BodyId> dominoes;
    for (int i = 0; i < 20; i++)
      dominoes.push_back(add(world, bodyOf(boxOf({0.00375, 0.024, 0.0125}, 1000, 0.3), {i * 0.020, 0.024, 0})));
    run(world, 0.5, dt);
    ASSERT_TRUE(
        world.applyImpulseAtPoint(dominoes[0], {0.15 * world.state(dominoes[0])->mass, 0, 0}, {0, 0.044, 0}).ok());
    run(world, 3, dt);
    int fell = 0;
    for (BodyId body : dominoes) fell += world.state(body)->position.y < 0.020;
    reached({"dominoes that fell", dt, double(fell), 20, 0, ""});
  }
}

}  // namespace
}  // namespace brickfall::law
