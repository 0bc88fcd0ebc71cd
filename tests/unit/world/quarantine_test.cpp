// Legal but absurd input must not end the simulation: what becomes non-finite is named, held, and harms nobody.
#include <algorithm>
#include <string>

#include "brickfall/notes.h"
#include "support/world_helpers.h"

namespace brickfall {
namespace {

using namespace test;

struct Outcome {
  std::vector<BodyId> named;
  bool names(BodyId body) const { return std::find(named.begin(), named.end(), body) != named.end(); }
};

Outcome runAny(
    World& world, int steps, double dt, const std::function<void()>& before = [] {}) {
  Outcome out;
  for (int i = 0; i < steps; i++) {
    before();
    Result<StepReport> report = world.step(dt);
    EXPECT_TRUE(report.ok());
    if (!report) break;
    out.named.insert(out.named.end(), report->quarantined.begin(), report->quarantined.end());
    expectSound(world);
    if (testing::Test::HasFailure()) break;
  }
  return out;
}

// A wall beside which something absurd happens.
struct Scene {
  World world = awakeWorld();
  std::vector<BodyId> wall;
  Scene() {
    addGround(world);
    for (int row = 0; row < 5; row++)
      for (int i = 0; i < 3; i++)
        wall.push_back(addBox(world, {0.1, 0.05, 0.06}, {0.2 * i + 0.1 * (row % 2), 0.05 + 0.1 * row, 0}));
  }
  void expectWallStands() {
    for (std::size_t i = 0; i < wall.size(); i++) {
      BodyState s = *world.state(wall[i]);
      EXPECT_FALSE(s.quarantined);
      double row = double(i / 3);
      expectNear(s.position, {0.2 * double(i % 3) + 0.1 * (int(row) % 2), 0.05 + 0.1 * row, 0}, 2e-3);
    }
  }
};

TEST(Quarantine, HugeForceOnATinyBodyIsNamedAndDoesNotSpread) {
  Scene s;
  BodyId tiny = add(s.world, bodyOf(boxOf({1e-3, 1e-3, 1e-3}), {5, 1, 0}));
  Outcome out = runAny(s.world, 60, kDt, [&] { (void)s.world.applyForce(tiny, {1e12, 1e12, 0}); });
  EXPECT_TRUE(out.names(tiny));
  EXPECT_EQ(out.named.size(), 1u);
  BodyState state = *s.world.state(tiny);
  EXPECT_TRUE(state.quarantined);
  EXPECT_TRUE(isFinite(state.position));
  EXPECT_EQ(state.linearVelocity, (Vec3{}));
  EXPECT_EQ(s.world.applyForce(tiny, {1, 0, 0}).error().code, ErrorCode::wrongState);
  EXPECT_EQ(s.world.setTransform(tiny, {}, {}).error().code, ErrorCode::wrongState);
  ASSERT_TRUE(s.world.destroyBody(tiny).ok());
  stepSound(s.world);
  s.expectWallStands();
}

TEST(Quarantine, HugeForceOnABodyThatTouchesOthers) {
  for (Vec3 direction : {Vec3{1, 0, 0}, Vec3{0, 1, 0}, Vec3{1, 1, 1}}) {
    Scene s;
    BodyId tiny = add(s.world, bodyOf(boxOf({0.05, 0.05, 0.05}), {5, 0.05, 0}));
    BodyId on = add(s.world, bodyOf(boxOf({0.05, 0.05, 0.05}), {5, 0.15, 0}));
    runAny(s.world, 30, kDt);
    Outcome out = runAny(s.world, 60, kDt, [&] { (void)s.world.applyForce(tiny, direction * 1e12); });
    EXPECT_TRUE(out.names(tiny));
    EXPECT_FALSE(out.names(on)) << "spread to its neighbour";
    EXPECT_TRUE(isFinite(s.world.state(on)->position));
    s.expectWallStands();
  }
}

TEST(Quarantine, HugeForceIntoTheGround) {
  Scene s;
  BodyId box = add(s.world, bodyOf(boxOf({0.05, 0.05, 0.05}), {5, 0.05, 0}));
  Outcome out = runAny(s.world, 60, kDt, [&] { (void)s.world.applyForce(box, {0, -1e12, 0}); });
  for (BodyId named : out.named) EXPECT_EQ(named, box);
  EXPECT_TRUE(isFinite(s.world.state(box)->position));
  s.expectWallStands();
}

TEST(Quarantine, HugeTorque) {
  Scene s;
  BodyId free = add(s.world, bodyOf(boxOf({1e-2, 2e-2, 3e-2}), {5, 5, 0}));
  BodyId onGround = add(s.world, bodyOf(boxOf({1e-2, 2e-2, 3e-2}), {7, 2e-2, 0}));
  Outcome out = runAny(s.world, 60, kDt, [&] {
    (void)s.world.applyTorque(free, {1e12, 1e12, -1e12});
    (void)s.world.applyTorque(onGround, {1e12, 1e12, -1e12});
  });
  for (BodyId named : out.named) EXPECT_TRUE(named == free || named == onGround);
  s.expectWallStands();
}

TEST(Quarantine, HugeImpulsesAndVelocities) {
  Scene s;
  BodyId a = add(s.world, bodyOf(boxOf({0.05, 0.05, 0.05}), {5, 0.05, 0}));
  BodyId b = add(s.world, bodyOf(boxOf({0.05, 0.05, 0.05}), {7, 3, 0}));
  BodyId c = add(s.world, bodyOf(boxOf({0.05, 0.02, 0.05}), {9, 3, 0}));
  Outcome out = runAny(s.world, 120, kDt, [&] {
    (void)s.world.applyImpulseAtPoint(a, {1e12, 1e12, 0}, {5, 1e7, 1e7});
    (void)s.world.setLinearVelocity(b, {1e5, -1e5, 1e5});
    (void)s.world.setAngularVelocity(b, {1e5, -1e5, 1e5});
    (void)s.world.applyAngularImpulse(c, {1e12, 1e12, 1e12});
  });
  EXPECT_TRUE(out.names(a));
  for (BodyId named : out.named) EXPECT_TRUE(named == a || named == b || named == c);
  s.expectWallStands();
}

TEST(Quarantine, AbsurdForceOnABrickOfTheWallSparesItsNeighbours) {
  Scene s;
  runAny(s.world, 30, kDt);
  BodyId victim = s.wall[7];
  Outcome out = runAny(s.world, 90, kDt, [&] { (void)s.world.applyForce(victim, {0, 0, 1e12}); });
  EXPECT_TRUE(out.names(victim));
  EXPECT_EQ(out.named.size(), 1u);
  for (BodyId body : s.wall) {
    BodyState state = *s.world.state(body);
    EXPECT_TRUE(isFinite(state.position));
    EXPECT_LT(length(state.position), 5) << "the others stay near";
  }
}

TEST(Quarantine, ExtremeMassRatiosAndSizesStayFinite) {
  World world = awakeWorld();
  addGround(world);
  add(world, bodyOf(boxOf({1e-3, 1e-3, 1e-3}, 1e-3), {0, 1e-3, 0}));
  add(world, bodyOf(boxOf({1, 1, 1}, 1e7), {0, 1.003, 0}));
  add(world, bodyOf(sphereOf(1e-4, 1e-3), {3, 0.1, 0}));
  add(world, bodyOf(boxOf({1000, 500, 1000}, 1e5), {5000, 510, 0}));
  add(world, bodyOf(boxOf({1e-3, 1e-3, 1e-3}, 1e-3), {5000, 0.5, 0}));
  Outcome out = runAny(world, 240, kDt);
  EXPECT_TRUE(out.named.empty());
}

TEST(Quarantine, HugeGravity) {
  WorldDef def;
  def.gravity = {0, -1e4, 0};
  def.enableSleep = false;
  World world = makeWorld(def);
  addGround(world);
  BodyDef d = bodyOf(boxOf({0.1, 0.1, 0.1}), {0, 0.1, 0});
  d.gravityScale = 1000;
  BodyId body = add(world, d);
  runAny(world, 120, kDt);
  EXPECT_TRUE(isFinite(world.state(body)->position));
}

// Told to who listens, and to nobody else.
std::vector<std::string> notesHeard;

TEST(Quarantine, IsNotedInTheLogAndSoAreTiesThatEnd) {
  World world = awakeWorld();
  const BodyId base = add(world, bodyOf(boxOf({0.1, 0.1, 0.1}), {0, 3, 0}, BodyType::fixed));
  const BodyId lost = add(world, bodyOf(boxOf({1e-3, 1e-3, 1e-3}), {5, 1, 0}));
  JointDef joint;
  joint.bodyA = base;
  joint.bodyB = addBox(world, {0.1, 0.1, 0.1}, {0, 2, 0});
  joint.anchor = {0, 2.5, 0};
  ASSERT_TRUE(world.createJoint(joint).ok());
  const NoteHandler before = setNoteHandler([](const Note& note) { notesHeard.push_back(note.text); });
  notesHeard.clear();
  runAny(world, 20, kDt, [&] { (void)world.applyForce(lost, {1e12, 1e12, 0}); });
  ASSERT_EQ(notesHeard.size(), 1u);
  EXPECT_NE(notesHeard[0].find("body " + std::to_string(lost.index) + " became non-finite"), std::string::npos);
  ASSERT_TRUE(world.destroyBody(lost).ok());  // alone: nothing to tell
  ASSERT_TRUE(world.destroyBody(base).ok());
  ASSERT_EQ(notesHeard.size(), 2u);
  EXPECT_NE(notesHeard[1].find("1 joints and 0 faces of mortar went with it"), std::string::npos);
  setNoteHandler(before);
  ASSERT_TRUE(world.destroyBody(joint.bodyB).ok());
  EXPECT_EQ(notesHeard.size(), 2u);
}

}  // namespace
}  // namespace brickfall
