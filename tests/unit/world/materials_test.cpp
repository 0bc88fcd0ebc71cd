// Friction and restitution of two materials by their rules; who collides with whom.
#include "support/world_helpers.h"

namespace brickfall {
namespace {

using namespace test;

// Deceleration of a box of `own` that slides on ground of `other`, over g: the friction that acted.
double frictionActing(Material own, Material other) {
  World world = makeWorld();
  ShapeDef plane = planeOf();
  plane.material = other;
  add(world, bodyOf(plane, {}, BodyType::fixed));
  BodyDef d = bodyOf(boxOf({0.25, 0.1, 0.25}), {0, 0.1, 0});
  own.density = 1000;
  d.shapes[0].material = own;
  d.linearVelocity = {5, 0, 0};
  BodyId box = add(world, d);
  run(world, 0.1);
  double before = world.state(box)->linearVelocity.x;
  run(world, 0.2);
  return (before - world.state(box)->linearVelocity.x) / 0.2 / kG;
}

Material frictionOf(double friction, CombineRule rule) {
  Material m;
  m.friction = friction;
  m.frictionRule = rule;
  return m;
}

TEST(Materials, FrictionCombinesByRule) {
  struct Case {
    CombineRule rule;
    double expected;
  };
  for (Case c : {Case{CombineRule::geometricMean, std::sqrt(0.2 * 0.8)},
                 {CombineRule::average, 0.5},
                 {CombineRule::minimum, 0.2},
                 {CombineRule::multiply, 0.16},
                 {CombineRule::maximum, 0.8}}) {
    EXPECT_NEAR(frictionActing(frictionOf(0.2, c.rule), frictionOf(0.8, c.rule)), c.expected, 0.01) << int(c.rule);
    EXPECT_NEAR(frictionActing(frictionOf(0.8, c.rule), frictionOf(0.2, c.rule)), c.expected, 0.01) << int(c.rule);
  }
}

TEST(Materials, TheLaterRuleWins) {
  EXPECT_NEAR(frictionActing(frictionOf(0.2, CombineRule::geometricMean), frictionOf(0.8, CombineRule::maximum)), 0.8,
              0.01);
  EXPECT_NEAR(frictionActing(frictionOf(0.2, CombineRule::minimum), frictionOf(0.8, CombineRule::average)), 0.2, 0.01);
}

TEST(Materials, NoFrictionSlidesForEver) {
  EXPECT_NEAR(frictionActing(frictionOf(0, CombineRule::geometricMean), frictionOf(0.8, CombineRule::geometricMean)), 0,
              1e-6);
}

double apexOf(double own, double other, CombineRule rule) {
  World world = makeWorld();
  ShapeDef plane = planeOf(), ball = sphereOf(0.25);
  plane.material.restitution = other;
  ball.material.restitution = own;
  plane.material.restitutionRule = ball.material.restitutionRule = rule;
  add(world, bodyOf(plane, {}, BodyType::fixed));
  BodyId body = add(world, bodyOf(ball, {0, 1.25, 0}));
  double apex = 0;
  bool bounced = false;
  for (int i = 0; i < 80; i++) {
    stepSound(world);
    BodyState s = *world.state(body);
    bounced = bounced || s.linearVelocity.y > 0.5;
    if (bounced) apex = std::max(apex, s.position.y - 0.25);
  }
  return apex;
}

TEST(Materials, RestitutionCombinesByRule) {
  EXPECT_NEAR(apexOf(0.4, 0.9, CombineRule::maximum), 0.81, 0.01);
  EXPECT_NEAR(apexOf(0.4, 0.9, CombineRule::minimum), 0.16, 0.01);
  EXPECT_NEAR(apexOf(0.4, 0.9, CombineRule::multiply), 0.36 * 0.36, 0.01);
  EXPECT_NEAR(apexOf(0.4, 0.9, CombineRule::average), 0.65 * 0.65, 0.01);
  EXPECT_NEAR(apexOf(0.4, 0.9, CombineRule::geometricMean), 0.36, 0.01);
}

bool collide(CollisionFilter a, CollisionFilter b) {
  World world = makeWorld();
  ShapeDef floor = boxOf({1, 0.1, 1}), ball = sphereOf(0.1);
  floor.filter = a;
  ball.filter = b;
  add(world, bodyOf(floor, {}, BodyType::fixed));
  BodyId body = add(world, bodyOf(ball, {0, 0.25, 0}));
  run(world, 0.7);
  return world.state(body)->position.y > 0;
}

TEST(Filters, CategoryMaskAndGroup) {
  EXPECT_TRUE(collide({}, {}));
  EXPECT_TRUE(collide({1, 2, 0}, {2, 1, 0}));
  EXPECT_FALSE(collide({1, 2, 0}, {2, 4, 0})) << "one side is not enough";
  EXPECT_FALSE(collide({1, 4, 0}, {2, 1, 0}));
  EXPECT_FALSE(collide({1, 0, 0}, {}));
  EXPECT_TRUE(collide({1, 0, 7}, {1, 0, 7})) << "a positive group always collides with itself";
  EXPECT_FALSE(collide({1, 0xffffffffu, -7}, {1, 0xffffffffu, -7}));
  EXPECT_TRUE(collide({1, 0xffffffffu, -7}, {1, 0xffffffffu, -8})) << "other groups: the masks decide";
  EXPECT_TRUE(collide({0x80000000u, 0x80000000u, 0}, {0x80000000u, 0x80000000u, 0}));
}

TEST(Filters, ShapesOfOneBodyNeverCollide) {
  World world = emptySpace();
  BodyDef d;
  d.shapes = {boxOf({0.2, 0.2, 0.2}), boxOf({0.2, 0.2, 0.2})};
  d.shapes[1].local.position = {0.1, 0, 0};
  BodyId body = add(world, d);
  run(world, 0.5);
  EXPECT_EQ(world.state(body)->linearVelocity, (Vec3{}));
  int contacts = 0;
  world.forEachContact([&](const ContactView&) { contacts++; });
  EXPECT_EQ(contacts, 0);
}

}  // namespace
}  // namespace brickfall
