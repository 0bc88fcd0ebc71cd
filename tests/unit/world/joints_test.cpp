// Joints through the API: what is refused and why, what can be read and changed, sleep and waking, bodies that go.
#include <limits>

#include "support/world_helpers.h"

namespace brickfall::test {
namespace {

struct Two {
  World world = makeWorld();
  BodyId a = add(world, bodyOf(boxOf({0.1, 0.1, 0.1}), {0, 2, 0}, BodyType::fixed));
  BodyId b = add(world, bodyOf(boxOf({0.1, 0.1, 0.1}), {0, 1, 0}));
  JointDef def(JointType type = JointType::spherical) const {
    JointDef d;
    d.type = type;
    d.bodyA = a;
    d.bodyB = b;
    d.anchor = {0, 2, 0};
    d.anchorB = Vec3{0, 1.1, 0};
    return d;
  }
};

void expectRefused(World& world, const JointDef& def, const std::string& names) {
  Result<JointId> joint = world.createJoint(def);
  ASSERT_FALSE(joint.ok()) << names;
  EXPECT_NE(joint.error().message.find(names), std::string::npos) << joint.error().message;
  EXPECT_TRUE(world.joints().empty());
}

TEST(Joints, BadDefinitionsAreRefusedByName) {
  Two two;
  const double nan = std::numeric_limits<double>::quiet_NaN();
  auto refuse = [&](JointType type, const std::string& names, auto change) {
    JointDef def = two.def(type);
    change(def);
    expectRefused(two.world, def, names);
  };
  refuse(JointType::fixed, "bodyB", [](JointDef& d) { d.bodyB = d.bodyA; });
  refuse(JointType::fixed, "bodyB: body: the id is null", [](JointDef& d) { d.bodyB = {}; });
  refuse(JointType::fixed, "anchor.x", [&](JointDef& d) { d.anchor.x = nan; });
  refuse(JointType::rope, "anchorB.y", [](JointDef& d) { d.anchorB->y = 1e300; });
  refuse(JointType::revolute, "axis", [](JointDef& d) { d.axis = {}; });
  refuse(JointType::revolute, "axis", [&](JointDef& d) { d.axis = {0, nan, 1}; });
  refuse(JointType::revolute, "limit", [](JointDef& d) { d.limit = JointDef::Limit{1, -1}; });
  refuse(JointType::revolute, "limit.upper", [](JointDef& d) { d.limit = JointDef::Limit{-1, 4}; });
  refuse(JointType::prismatic, "motor.strength", [](JointDef& d) { d.motor = JointDef::Motor{1, -1}; });
  refuse(JointType::spherical, "cone", [](JointDef& d) { d.cone = 4; });
  refuse(JointType::spring, "stiffness", [](JointDef& d) { d.stiffness = 1e15; });
  refuse(JointType::spring, "damping", [](JointDef& d) { d.damping = -1; });
  refuse(JointType::drag, "strength", [&](JointDef& d) { d.strength = nan; });
  refuse(JointType::distance, "length", [](JointDef& d) { d.anchorB = d.anchor; });
  refuse(JointType::rope, "length", [](JointDef& d) { d.length = 0; });
  refuse(JointType::fixed, "breakForce", [](JointDef& d) { d.breakForce = 0; });
  refuse(JointType::fixed, "breakTorque", [&](JointDef& d) { d.breakTorque = nan; });
  refuse(JointType(77), "type", [](JointDef&) {});
  const BodyId other = add(two.world, bodyOf(boxOf({0.1, 0.1, 0.1}), {3, 2, 0}, BodyType::fixed));
  refuse(JointType::fixed, "dynamic", [&](JointDef& d) { d.bodyB = other; });
  EXPECT_TRUE(two.world.destroyBody(two.b).ok());
  refuse(JointType::fixed, "was destroyed", [](JointDef&) {});
  expectSound(two.world);
}

TEST(Joints, WhatWasMadeCanBeReadAndChanged) {
  Two two;
  JointDef def = two.def(JointType::revolute);
  def.axis = {0, 0, 3};
  def.limit = JointDef::Limit{-1, 2};
  def.userData = 7;
  const JointId joint = *two.world.createJoint(def);
  const JointDef told = *two.world.definition(joint);
  expectNear(told.anchor, def.anchor, 1e-12, "anchor");
  expectNear(told.axis, {0, 0, 1}, 1e-12, "axis");
  EXPECT_EQ(told.limit->upper, 2);
  EXPECT_EQ(two.world.state(joint)->userData, 7u);
  EXPECT_EQ(two.world.joints(two.b), std::vector<JointId>{joint});
  EXPECT_TRUE(two.world.setMotor(joint, JointDef::Motor{3, 4}).ok());
  EXPECT_EQ(two.world.definition(joint)->motor->speed, 3);
  EXPECT_FALSE(two.world.setLength(joint, 1).ok()) << "a hinge has none";
  EXPECT_FALSE(two.world.setTarget(joint, {}).ok());
  EXPECT_FALSE(two.world.setLimit(joint, JointDef::Limit{1, 2}).ok());
  EXPECT_TRUE(two.world.destroyJoint(joint).ok());
  EXPECT_EQ(two.world.destroyJoint(joint).error().code, ErrorCode::staleId);
  const JointId next = *two.world.createJoint(def);
  EXPECT_EQ(next.index, joint.index);
  EXPECT_FALSE(two.world.isValid(joint)) << "the slot's next joint is another";
  expectSound(two.world);
}

TEST(Joints, SleepersWakeAndJointsEndWithTheirBodies) {
  Two two;
  const JointId upper = *two.world.createJoint(two.def());
  const BodyId c = add(two.world, bodyOf(boxOf({0.1, 0.1, 0.1}), {0, 0.5, 0}));
  JointDef def = two.def();
  def.bodyA = two.b;
  def.bodyB = c;
  def.anchor = {0, 0.75, 0};
  const JointId lower = *two.world.createJoint(def);
  run(two.world, 2);
  EXPECT_FALSE(two.world.state(lower)->awake);
  EXPECT_TRUE(two.world.applyImpulse(c, {0.1, 0, 0}).ok());
  EXPECT_TRUE(two.world.state(two.b)->awake);
  run(two.world, 0.1);
  EXPECT_TRUE(two.world.destroyBody(two.b).ok());
  EXPECT_FALSE(two.world.isValid(upper) || two.world.isValid(lower));
  run(two.world, 0.5);
  EXPECT_LT(two.world.state(c)->position.y, -0.5);
  EXPECT_TRUE(two.world.events().breaks.empty());
}

// A joint of two bodies that nothing moves any more is kept, and goes on when one becomes dynamic again.
TEST(Joints, BodiesMayChangeTheirType) {
  Two two;
  const JointId joint = *two.world.createJoint(two.def());
  run(two.world, 0.2);
  EXPECT_TRUE(two.world.setType(two.b, BodyType::fixed).ok());
  run(two.world, 0.2);
  EXPECT_TRUE(two.world.setType(two.b, BodyType::dynamic).ok());
  EXPECT_TRUE(two.world.setLinearVelocity(two.b, {1, 0, 0}).ok());
  run(two.world, 0.5);
  EXPECT_LT(two.world.state(joint)->error, 1e-3);
  EXPECT_NEAR(length(two.world.state(two.b)->centreOfMass - Vec3{0, 2, 0}), 1, 2e-3);
}

// The winch of a crane.
TEST(Joints, ARopeIsWoundUp) {
  Two two;
  const JointId rope = *two.world.createJoint(two.def(JointType::rope));
  for (int i = 0; i < 60; i++) {
    EXPECT_TRUE(two.world.setLength(rope, 0.9 - 0.005 * i).ok());
    stepSound(two.world);
  }
  run(two.world, 1);
  EXPECT_NEAR(two.world.state(rope)->position, 0.605, 1e-3);
}

TEST(Joints, DebugDrawShowsThemFromCentreToCentre) {
  Two two;
  JointDef def = two.def(JointType::rope);
  def.anchorB = Vec3{0.1, 1.1, 0};
  ASSERT_TRUE(two.world.createJoint(def).ok());
  std::vector<Vec3> ends;
  DebugDraw draw;
  draw.line = [&](Vec3 from, Vec3 to, std::uint32_t) {
    ends.push_back(from);
    ends.push_back(to);
  };
  two.world.draw(draw);
  ASSERT_EQ(ends.size(), 6u);
  expectNear(ends[0], {0, 2, 0}, 1e-12);
  expectNear(ends[2], {0, 2, 0}, 1e-12);
  expectNear(ends[3], {0.1, 1.1, 0}, 1e-12);
  expectNear(ends[5], {0, 1, 0}, 1e-12);
}

}  // namespace
}  // namespace brickfall::test
