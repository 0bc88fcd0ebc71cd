// Mortar through the API: what is refused and why, what can be read, events, what is carried, sleep, bodies that go.
#include <limits>

#include "support/world_helpers.h"

namespace brickfall::test {
namespace {

// A brick under a fixed one.
struct Hung {
  World world = makeWorld();
  BodyId above = add(world, bodyOf(boxOf({0.1, 0.05, 0.05}), {0, 1, 0}, BodyType::fixed));
  BodyId below = add(world, bodyOf(boxOf({0.1, 0.05, 0.05}), {0, 0.9, 0}));
  MortarDef def() const {
    MortarDef d;
    d.bodyA = above;
    d.bodyB = below;
    d.outline = {{-0.1, 0.95, -0.05}, {0.1, 0.95, -0.05}, {0.1, 0.95, 0.05}, {-0.1, 0.95, 0.05}};
    return d;
  }
  void step(int steps) {
    for (int i = 0; i < steps; i++) ASSERT_TRUE(world.step(kDt).ok());
  }
};

TEST(Mortar, BadDefinitionsAreRefusedByName) {
  Hung hung;
  const double nan = std::numeric_limits<double>::quiet_NaN();
  auto refuse = [&](const std::string& names, auto change) {
    MortarDef def = hung.def();
    change(def);
    Result<MortarId> made = hung.world.createMortar(def);
    ASSERT_FALSE(made.ok()) << names;
    EXPECT_NE(made.error().message.find(names), std::string::npos) << made.error().message;
    EXPECT_TRUE(hung.world.mortars().empty());
  };
  refuse("bodyB", [](MortarDef& d) { d.bodyB = d.bodyA; });
  refuse("bodyA: body: the id is null", [](MortarDef& d) { d.bodyA = {}; });
  refuse("outline: found 2 corners", [](MortarDef& d) { d.outline.resize(2); });
  refuse("outline[1].y", [&](MortarDef& d) { d.outline[1].y = nan; });
  refuse("outline[0].x", [](MortarDef& d) { d.outline[0].x = 1e300; });
  refuse("outline: found a face of 0", [](MortarDef& d) { d.outline.assign(4, Vec3{}); });
  refuse("off the plane", [](MortarDef& d) { d.outline[2].y += 0.05; });
  refuse("dented in", [](MortarDef& d) { d.outline.insert(d.outline.begin() + 1, Vec3{0, 0.95, 0.03}); });
  refuse("strength.tension", [](MortarDef& d) { d.strength.tension = 0; });
  refuse("strength.cohesion", [](MortarDef& d) { d.strength.cohesion = -1; });
  refuse("strength.friction", [&](MortarDef& d) { d.strength.friction = nan; });
  refuse("strength.tensionEnergy", [](MortarDef& d) { d.strength.tensionEnergy = 0; });
  refuse("strength.shearEnergy", [](MortarDef& d) { d.strength.shearEnergy = 0; });
  refuse("strength.compression", [](MortarDef& d) { d.strength.compression = 0; });
  refuse("strength.stiffness", [](MortarDef& d) { d.strength.stiffness = 1e20; });
  refuse("more than tension x friction", [](MortarDef& d) { d.strength.cohesion = 0.5 * d.strength.tension; });
  const BodyId other = add(hung.world, bodyOf(boxOf({0.1, 0.1, 0.1}), {3, 2, 0}, BodyType::fixed));
  refuse("dynamic", [&](MortarDef& d) { d.bodyB = other; });
  expectSound(hung.world);
}

TEST(Mortar, WhatHoldsCanBeRead) {
  Hung hung;
  MortarDef def = hung.def();
  def.userData = 7;
  const MortarId joint = *hung.world.createMortar(def);
  hung.step(60);
  const MortarState s = *hung.world.state(joint);
  const double weight = hung.world.state(hung.below)->mass * kG;
  EXPECT_NEAR(s.force.y, weight, 1e-3 * weight) << "on B";
  EXPECT_NEAR(s.area, 0.02, 1e-12);
  expectNear(s.normal, {0, -1, 0}, 1e-9, "normal");
  expectNear(s.centre, {0, 0.95, 0}, 1e-6, "centre");
  EXPECT_NEAR(s.tension, weight / s.area, 0.01 * weight / s.area);
  EXPECT_NEAR(s.utilisation, s.tension / def.strength.tension, 1e-6);
  EXPECT_EQ(s.damage, 0);
  EXPECT_EQ(s.mode, MortarMode::none);
  EXPECT_FALSE(s.awake) << "what hangs still sleeps";
  EXPECT_EQ(s.userData, 7u);
  EXPECT_EQ(hung.world.mortars(hung.below), std::vector<MortarId>{joint});
  EXPECT_EQ(hung.world.carried(), std::vector<BodyId>{hung.below});
  expectSound(hung.world);
}

TEST(Mortar, ABrokenJointIsToldAndStaysKnown) {
  Hung hung;
  const MortarId joint = *hung.world.createMortar(hung.def());
  int cracked = 0, broken = 0;
  for (double force = 0; broken == 0 && force < 2e4; force += 100) {
    ASSERT_TRUE(hung.world.applyForce(hung.below, {0, -force, 0}).ok());
    hung.step(1);
    for (const MortarEvent& e : hung.world.events().mortar) {
      EXPECT_EQ(e.mortar, joint);
      EXPECT_EQ(e.mode, MortarMode::tension);
      (e.broken ? broken : cracked)++;
    }
  }
  EXPECT_EQ(cracked, 1);
  EXPECT_EQ(broken, 1);
  ASSERT_TRUE(hung.world.isValid(joint));
  EXPECT_TRUE(hung.world.state(joint)->broken);
  EXPECT_EQ(hung.world.state(joint)->damage, 1);
  EXPECT_NEAR(hung.world.state(joint)->tensionWork, 18 * 0.02, 0.03 * 18 * 0.02);
  hung.step(10);
  EXPECT_TRUE(hung.world.carried().empty());
  EXPECT_LT(hung.world.state(hung.below)->position.y, 0.85);
  expectSound(hung.world);
}

TEST(Mortar, WhatItGluedCollidesOnceItIsGone) {
  World world = makeWorld();
  addGround(world);
  const BodyId below = add(world, bodyOf(boxOf({0.1, 0.05, 0.05}), {0, 0.05, 0}));
  const BodyId above = add(world, bodyOf(boxOf({0.1, 0.05, 0.05}), {0, 0.15, 0}));
  MortarDef def;
  def.bodyA = below;
  def.bodyB = above;
  def.outline = {{-0.1, 0.1, 0.05}, {0.1, 0.1, 0.05}, {0.1, 0.1, -0.05}, {-0.1, 0.1, -0.05}};
  const MortarId joint = *world.createMortar(def);
  for (int i = 0; i < 120; i++) ASSERT_TRUE(world.step(kDt).ok());
  EXPECT_FALSE(world.state(above)->awake);
  int between = 0;
  auto count = [&] {
    between = 0;
    world.forEachContact([&](const ContactView& c) { between += c.bodyA == below && c.bodyB == above; });
    return between;
  };
  EXPECT_EQ(count(), 0);
  ASSERT_TRUE(world.destroyMortar(joint).ok());
  EXPECT_FALSE(world.isValid(joint));
  EXPECT_TRUE(world.state(above)->awake);
  for (int i = 0; i < 60; i++) ASSERT_TRUE(world.step(kDt).ok());
  EXPECT_EQ(count(), 1);
  EXPECT_NEAR(world.state(above)->position.y, 0.15, 1e-4);
  expectSound(world);
}

TEST(Mortar, EndsWithItsBodies) {
  Hung hung;
  const MortarId joint = *hung.world.createMortar(hung.def());
  hung.step(2);
  EXPECT_TRUE(hung.world.destroyBody(hung.above).ok());
  EXPECT_FALSE(hung.world.isValid(joint));
  EXPECT_FALSE(hung.world.destroyMortar(joint).ok());
  hung.step(20);
  EXPECT_LT(hung.world.state(hung.below)->position.y, 0.85);
  expectSound(hung.world);
}

}  // namespace
}  // namespace brickfall::test
