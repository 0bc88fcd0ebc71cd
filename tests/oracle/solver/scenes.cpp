#include "scenes.h"

#include <cmath>

#include "support/world_helpers.h"

namespace brickfall::oracle {

namespace {

World awake(Vec3 gravity = {0, -9.81, 0}) {
  WorldDef def;
  def.enableSleep = false;
  def.gravity = gravity;
  return test::makeWorld(def);
}

// A wedge of a ring around the z axis, between two angles, corners about the middle of the ring there.
BodyDef wedge(double from, double to, double inner, double outer, double depth, BodyType type) {
  double middle = (from + to) / 2, mean = (inner + outer) / 2;
  BodyDef d;
  d.type = type;
  d.position = {mean * std::cos(middle), mean * std::sin(middle), 0};
  ShapeDef s = test::boxOf({}, 2000, 0.6);
  s.type = ShapeType::hull;
  for (double radius : {inner, outer})
    for (double angle : {from, to})
      for (double z : {-depth / 2, depth / 2})
        s.vertices.push_back(Vec3{radius * std::cos(angle), radius * std::sin(angle), z} - d.position);
  d.shapes = {s};
  return d;
}

ShapeDef litter(Litter kind, Random& random) {
  double size = random.between(0.1, 0.3), density = random.between(800, 3200);
  if (kind == Litter::mixed) kind = Litter(random.below(4));
  if (kind == Litter::spheres) return test::sphereOf(size, density);
  if (kind == Litter::capsules) return test::capsuleOf(0.5 * size, random.between(0.2, 0.8) * size, density);
  Vec3 half{size * random.between(0.5, 1), size * random.between(0.5, 1), size * random.between(0.5, 1)};
  ShapeDef s = test::boxOf(half, density);
  if (kind == Litter::boxes) return s;
  s.type = ShapeType::hull;
  s.vertices = test::randomPoints(random, 12, half, true);
  return s;
}

}  // namespace

Trial fromLab(const std::string& name, const lab::Options& options) {
  return {std::move(lab::make(name, options).world), options.dt};
}

Trial walls(int courses, int bricks, double gap, int seed, double dt) {
  lab::Options o;
  o.gap = gap;
  o.seed = seed;
  lab::Builder b("wall", o);
  b.open();
  b.addWall(courses, bricks);
  return {std::move(b.take(0).world), dt};
}

Trial pyramid(int base) {
  lab::Builder b("pyramid", {});
  b.open();
  for (int row = 0; row < base; row++)
    for (int i = 0; i < base - row; i++) b.box({.25, .25, .25}, {0.5 * (i + 0.5 * row), 0.25 + 0.5 * row, 0}, 1900);
  return {std::move(b.take(0).world)};
}

Trial arch(int voussoirs, double degrees, double thickness) {
  World world = awake();
  double inner = 1 - thickness / 2, outer = 1 + thickness / 2, depth = 0.4;
  double from = (180 - degrees) / 2 * test::kPi / 180, step = degrees * test::kPi / 180 / voussoirs;
  test::add(world, wedge(from - 0.3, from, inner - 0.2, outer + 0.2, depth, BodyType::fixed));
  for (int i = 0; i < voussoirs; i++)
    test::add(world, wedge(from + i * step, from + (i + 1) * step, inner, outer, depth, BodyType::dynamic));
  double to = from + voussoirs * step;
  test::add(world, wedge(to, to + 0.3, inner - 0.2, outer + 0.2, depth, BodyType::fixed));
  return {std::move(world)};
}

Trial pile(Litter kind, int count, std::uint64_t seed) {
  World world = awake();
  test::addGround(world);
  for (double side : {-1.0, 1.0}) {
    test::add(world, test::bodyOf(test::boxOf({0.2, 1, 2}), {side * 1.2, 1, 0}, BodyType::fixed));
    test::add(world, test::bodyOf(test::boxOf({2, 1, 0.2}), {0, 1, side * 1.2}, BodyType::fixed));
  }
  Random random(seed);
  for (int i = 0; i < count; i++) {
    ShapeDef shape = litter(kind, random);
    double x = 0.5 * (i % 3 - 1), z = 0.5 * (i / 3 % 3 - 1), y = 0.4 + 0.6 * (i / 9);
    BodyDef d = test::bodyOf(shape, Vec3{x, y, z} + test::randomVector(random, 0.05));
    d.rotation = test::randomRotation(random);
    d.angularVelocity = test::randomVector(random, 3);
    test::add(world, d);
  }
  return {std::move(world)};
}

Trial incline(double degrees, double friction, bool tiltGravity) {
  double angle = degrees * test::kPi / 180;
  Vec3 down{std::sin(angle) * 9.81, -std::cos(angle) * 9.81, 0};
  World world = tiltGravity ? awake(down) : awake();
  Quat slope = tiltGravity ? Quat{} : test::turn({0, 0, 1}, -degrees);
  BodyDef ground =
      test::bodyOf(test::boxOf({5, 0.5, 5}, 1000, friction), rotate(slope, Vec3{0, -0.5, 0}), BodyType::fixed);
  ground.rotation = slope;
  test::add(world, ground);
  BodyDef box = test::bodyOf(test::boxOf({0.25, 0.1, 0.25}, 1000, friction), rotate(slope, Vec3{0, 0.1, 0}));
  box.rotation = slope;
  test::add(world, box);
  return {std::move(world)};
}

Trial pushed(double share, double friction) {
  World world = awake();
  test::addGround(world, friction);
  for (int i = 0; i < 6; i++) {
    BodyDef box = test::bodyOf(test::boxOf({0.2, 0.1, 0.3}, 500.0 * (1 + i), friction), {0, 0.1, 1.0 * i});
    box.rotation = test::turn({0, 1, 0}, 15.0 * i);
    test::add(world, box);
  }
  auto push = [share, friction](World& w) {  // ids of a world are not those of its copy
    for (BodyId box : w.bodies()) {
      if (w.state(box)->type != BodyType::dynamic) continue;
      double weight = w.massProperties(box)->mass * 9.81;
      Vec3 foot = w.state(box)->position - Vec3{0, 0.1, 0};
      EXPECT_TRUE(w.applyForceAtPoint(box, {share * friction * weight, 0, 0}, foot).ok());
    }
  };
  return {std::move(world), 1.0 / 60, push};
}

Trial column(double ratio, bool heavyAbove) {
  World world = awake();
  test::addGround(world);
  for (int i = 0; i < 10; i++) {
    bool heavy = heavyAbove ? i == 9 : i == 0;
    test::add(world, test::bodyOf(test::boxOf({0.5, 0.5, 0.5}, heavy ? 1000 * ratio : 1000), {0, 0.5 + i, 0}));
  }
  return {std::move(world)};
}

}  // namespace brickfall::oracle
