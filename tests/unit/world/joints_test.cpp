// Joints through the API: what is refused and why, what can be read and changed, sleep and waking, bodies that go.
#include <algorithm>
#include <limits>
#include <map>
#include <random>

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

// Any order of calls: the joints that there are, of which bodies and of which type, are those of a simple model.
class JointModel {
 public:
  explicit JointModel(unsigned seed) : random_(seed) {
    addGround(world_);
    for (int i = 0; i < 7; i++)
      add(world_, bodyOf(boxOf({0.1, 0.1, 0.1}), {0.4 * i, 1.5, 0}, i == 0 ? BodyType::fixed : BodyType::dynamic));
  }
  void play(int calls) {
    for (int i = 0; i < calls && !testing::Test::HasFailure(); i++) {
      call(int(random_() % 9));
      compare();
    }
  }
  int made = 0, refused = 0, broken = 0, ended = 0;

 private:
  struct Tie {
    BodyId a, b;
    JointType type;
  };
  double share() { return double(random_() % 1000) / 1000; }
  BodyId anyBody() {
    const std::vector<BodyId> all = world_.bodies();
    return all[random_() % all.size()];
  }
  JointId anyJoint() { return std::next(model_.begin(), std::ptrdiff_t(random_() % model_.size()))->first; }
  void call(int which) {
    if (which < 3) {
      make();
    } else if (which == 3) {
      change();
    } else if (which == 4 && random_() % 4 == 0) {
      end(anyBody());
    } else if (which == 5 && !model_.empty()) {
      const JointId id = anyJoint();
      EXPECT_TRUE(world_.destroyJoint(id).ok());
      EXPECT_FALSE(world_.destroyJoint(id).ok()) << "twice";
      model_.erase(id);
    } else if (which == 6) {
      World copy = makeWorld();
      ASSERT_TRUE(copy.restore(world_.snapshot()).ok());
      for (World* w : {&copy, &world_}) ASSERT_TRUE(w->step(kDt).ok());
      EXPECT_EQ(copy.stateHash(), world_.stateHash());
      takeBreaks();
    } else {
      ASSERT_TRUE(world_.step(which == 7 ? 1.0 / 240 : kDt).ok());
      takeBreaks();
    }
  }
  void make() {
    JointDef def;
    def.type = JointType(random_() % kJointTypeCount);
    def.bodyA = anyBody(), def.bodyB = anyBody();
    const Vec3 a = world_.state(def.bodyA)->position, b = world_.state(def.bodyB)->position;
    def.anchor = a + (b - a) * share();
    if (random_() % 2 == 0) def.anchorB = b;
    def.axis = {share(), share(), 0.5};
    def.collide = random_() % 3 == 0;
    if (random_() % 2 == 0) def.limit = JointDef::Limit{-share(), share()};
    if (random_() % 3 == 0) def.motor = JointDef::Motor{share(), 50 * share()};
    if (random_() % 3 == 0) def.breakForce = 1 + 200 * share();
    const Result<JointId> id = world_.createJoint(def);
    (id ? made : refused)++;
    if (id) model_[*id] = {def.bodyA, def.bodyB, def.type};
  }
  void change() {
    if (model_.empty()) return;
    const JointId id = anyJoint();
    const JointType type = model_[id].type;
    const bool hinge = type == JointType::revolute || type == JointType::prismatic;
    const bool line = type == JointType::distance || type == JointType::rope || type == JointType::spring;
    EXPECT_EQ(world_.setMotor(id, JointDef::Motor{share(), share()}).ok(), hinge);
    EXPECT_EQ(world_.setLimit(id, JointDef::Limit{-share(), share()}).ok(), hinge || type == JointType::spherical);
    EXPECT_EQ(world_.setLength(id, 0.3 + share()).ok(), line);
    EXPECT_EQ(world_.setTarget(id, {share(), 1, share()}).ok(), type == JointType::drag);
    EXPECT_TRUE(world_.setBreaking(id, 1 + 1e4 * share(), 1 + 1e4 * share()).ok());
  }
  void end(BodyId body) {
    if (world_.bodies().size() < 5) return;
    ASSERT_TRUE(world_.destroyBody(body).ok());
    ended += int(std::erase_if(model_, [&](const auto& tie) { return tie.second.a == body || tie.second.b == body; }));
  }
  void takeBreaks() {
    for (const BreakEvent& event : world_.events().breaks) broken += int(model_.erase(event.joint));
  }
  void compare() {
    std::vector<JointId> ids;
    for (const auto& [id, tie] : model_) {
      ids.push_back(id);
      const Result<JointState> state = world_.state(id);
      ASSERT_TRUE(state.ok()) << id.index;
      EXPECT_TRUE(state->bodyA == tie.a && state->bodyB == tie.b && state->type == tie.type);
      EXPECT_TRUE(isFinite(state->force) && isFinite(state->torque));
      const std::vector<JointId> own = world_.joints(tie.b);
      EXPECT_TRUE(std::find(own.begin(), own.end(), id) != own.end());
      EXPECT_TRUE(world_.definition(id).ok());
    }
    std::vector<JointId> there = world_.joints();
    std::sort(there.begin(), there.end());
    EXPECT_EQ(there, ids);
    expectSound(world_);
  }

  std::mt19937 random_;
  World world_ = makeWorld();
  std::map<JointId, Tie> model_;
};

TEST(Joints, CallsInAnyOrderLeaveWhatAModelSays) {
  int made = 0, refused = 0, broken = 0, ended = 0;
  for (unsigned seed = 1; seed <= 20; seed++) {
    SCOPED_TRACE(seed);
    JointModel model(seed);
    model.play(80);
    made += model.made, refused += model.refused, broken += model.broken, ended += model.ended;
    if (HasFailure()) return;
  }
  EXPECT_GT(made, 200);
  EXPECT_GT(refused, 20);
  EXPECT_GT(broken, 20);
  EXPECT_GT(ended, 20);
}

}  // namespace
}  // namespace brickfall::test
