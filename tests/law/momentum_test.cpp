// Row 11: free flight and collisions between free bodies keep linear and angular momentum.
#include "law/law.h"

namespace brickfall::law {
namespace {

struct Drift {
  double linear, angular;  // of the whole exchanged
};

// Throws bodies at each other in empty space; how far the sums drift against the momentum of one of them.
Drift crash(std::uint32_t seed, double dt, double speed, double restitution) {
  World world = emptySpace();
  lab::LabRandom random{int(seed)};
  double largest = 0;
  for (int i = 0; i < 12; i++) {
    ShapeDef shapes[] = {boxOf({.1, .15, .2}), sphereOf(.15), capsuleOf(.08, .15), hullOf(.2)};
    ShapeDef shape = shapes[i % 4];
    shape.material.restitution = restitution;
    Vec3 at{2 * random.unit() - 1, 2 * random.unit() - 1, 2 * random.unit() - 1};
    at = normalized(at) * (1 + random.unit());
    BodyDef d = bodyOf(shape, at);
    d.linearVelocity = normalized(-at) * speed;
    d.angularVelocity = {random.unit() - 0.5, random.unit() - 0.5, random.unit() - 0.5};
    BodyId body = add(world, d);
    largest = std::max(largest, world.state(body)->mass * speed);
  }
  Vec3 linear = world.linearMomentum(), angular = world.angularMomentum();
  double energy = world.energy().kinetic;
  Drift drift{0, 0};
  for (int i = 0; i < 1.5 / dt; i++) {
    stepSound(world, dt);
    drift.linear = std::max(drift.linear, length(world.linearMomentum() - linear) / largest);
    drift.angular = std::max(drift.angular, length(world.angularMomentum() - angular) / largest);
    EXPECT_LE(world.energy().kinetic, energy * 1.0001) << "seed " << seed;
  }
  return drift;
}

TEST(Law, Row11FreeFlightKeepsMomentum) {
  for (double dt : kSteps) {
    World world = emptySpace();
    BodyDef d = bodyOf(boxOf({0.1, 0.2, 0.3}), {1, 2, 3});
    d.shapes.push_back(boxOf({0.1, 0.1, 0.1}));
    d.shapes[1].local = {{0.3, 0.1, 0}, turn({1, 2, 3}, 40)};
    d.linearVelocity = {1, 2, 3};
    d.angularVelocity = {3, -2, 5};
    add(world, d);
    Vec3 linear = world.linearMomentum(), angular = world.angularMomentum();
    run(world, 10, dt);
    atMost("free flight, 10 s: linear momentum, drift", dt, length(world.linearMomentum() - linear) / length(linear),
           1e-12, "");
    atMost("free flight, 10 s: angular momentum, drift", dt,
           length(world.angularMomentum() - angular) / length(angular), 1e-10, "");
  }
}

TEST(Law, Row11CollisionsOfFreeBodiesKeepMomentum) {
  for (double dt : kSteps) {
    Drift worst{0, 0};
    for (std::uint32_t seed : {1, 2, 3, 4, 5})
      for (double e : {0.0, 0.5}) {
        Drift drift = crash(seed, dt, 1.5, e);
        worst = {std::max(worst.linear, drift.linear), std::max(worst.angular, drift.angular)};
      }
    atMost("crash of 12 bodies at 1.5 m/s: linear momentum, drift", dt, worst.linear, 3e-6, "");
    atMost("crash of 12 bodies at 1.5 m/s: angular momentum, drift", dt, worst.angular, dt > 0.03 ? 1e-2 : 3e-6, "");
  }
}

TEST(Law, Row11ElasticHeadOnCollisionSwapsVelocities) {
  for (double dt : kSteps) {
    World world = emptySpace();
    ShapeDef ball = sphereOf(0.1);
    ball.material.restitution = 1;
    BodyDef d = bodyOf(ball, {-1, 0, 0});
    d.linearVelocity = {3, 0, 0};
    BodyId a = add(world, d), b = add(world, bodyOf(ball, {0, 0, 0}));
    run(world, 1, dt);
    reached({"elastic head-on hit at 3 m/s: first ball", dt, world.state(a)->linearVelocity.x, 0, 0.01, "m/s"});
    reached({"elastic head-on hit at 3 m/s: second ball", dt, world.state(b)->linearVelocity.x, 3, 0.01, "m/s"});
  }
}

}  // namespace
}  // namespace brickfall::law
