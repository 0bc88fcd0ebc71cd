// The same bits from run to run, for any number of threads, and through a snapshot in the middle of a collapse.
#include "support/lab_scenes.h"
#include "support/mortared_wall.h"
#include "support/world_helpers.h"

namespace brickfall {
namespace {

using namespace test;

struct Case {
  const char* scene;
  double restitution, gap, seconds;
  bool sleep;
};
const Case kCases[] = {{"w10", 0, 0, 1, true},        {"w10", 0, 0.2e-3, 1, false}, {"drop", 0.3, 0, 1.2, true},
                       {"tumble", 0.5, 0, 3, true},   {"cor30", 0, 0, 1.5, true},   {"hit0", 0.3, 0, 0.3, false},
                       {"hole10", 0, 0, 0.25, false}, {"row", 1, 0, 0.3, false}};

lab::Scene sceneOf(const Case& c) {
  lab::Options o;
  o.restitution = c.restitution;
  o.gap = c.gap;
  o.seed = 4;
  o.sleep = c.sleep;
  return lab::make(c.scene, o);
}

std::vector<std::uint64_t> hashes(World& world, int steps) {
  std::vector<std::uint64_t> out;
  for (int i = 0; i < steps; i++) {
    EXPECT_TRUE(world.step(kDt).ok());
    out.push_back(world.stateHash());
  }
  return out;
}

TEST(Determinism, TwoRunsAgreeInEveryStep) {
  for (const Case& c : kCases) {
    lab::Scene a = sceneOf(c), b = sceneOf(c);
    int steps = int(c.seconds * 60);
    std::vector<std::uint64_t> first = hashes(a.world, steps);
    EXPECT_EQ(first, hashes(b.world, steps)) << c.scene;
    if (std::string(c.scene) != "w10") {
      EXPECT_NE(first.front(), first.back()) << "nothing happened in " << c.scene;
    }
  }
}

TEST(Determinism, AnyNumberOfThreadsGivesTheSameBits) {
  for (const Case& c : kCases) {
    std::vector<std::uint64_t> wanted;
    for (int threads : {1, 2, 3}) {
      lab::Scene s = sceneOf(c);
      WorldDef def;
      def.threads = threads;
      def.enableSleep = c.sleep;
      if (s.world.gravity() == Vec3{}) def.gravity = {};
      World world = makeWorld(def);
      // The same bodies in a world of that many threads.
      for (BodyId body : s.world.bodies()) {
        BodyState state = *s.world.state(body);
        BodyDef d;
        d.type = state.type;
        for (ShapeId shape : s.world.shapes(body)) d.shapes.push_back(*s.world.shape(shape));
        d.position = state.position;
        d.rotation = state.rotation;
        d.linearVelocity = state.linearVelocity;
        d.angularVelocity = state.angularVelocity;
        add(world, d);
      }
      std::vector<std::uint64_t> found = hashes(world, int(c.seconds * 60));
      if (threads == 1) wanted = found;
      EXPECT_EQ(found, wanted) << c.scene << " with " << threads << " threads";
    }
  }
}

// Another world takes over at every step.
TEST(Determinism, SnapshotAtEveryStepChangesNothing) {
  for (const Case& c : kCases) {
    int steps = int(c.seconds * 60);
    lab::Scene a = sceneOf(c), b = sceneOf(c);
    std::vector<std::uint64_t> wanted = hashes(a.world, steps);
    World even = makeWorld(), odd = makeWorld();
    ASSERT_TRUE(odd.restore(b.world.snapshot()).ok());
    for (int i = 0; i < steps; i++) {
      World &from = i % 2 == 0 ? odd : even, &to = i % 2 == 0 ? even : odd;
      ASSERT_TRUE(to.restore(from.snapshot()).ok());
      ASSERT_TRUE(to.step(kDt).ok());
      ASSERT_EQ(to.stateHash(), wanted[std::size_t(i)]) << c.scene << " step " << i;
    }
  }
}

// One that was kept does not grow old: from each of several moments the whole rest of the run is the same.
TEST(Determinism, RunsFromASnapshotAreTheSameToTheEnd) {
  for (const Case& c : kCases) {
    int steps = int(c.seconds * 60);
    lab::Scene a = sceneOf(c);
    std::vector<std::vector<std::byte>> kept;
    std::vector<std::uint64_t> wanted;
    for (int i = 0; i < steps; i++) {
      if (i % 5 == 0) kept.push_back(a.world.snapshot());
      ASSERT_TRUE(a.world.step(kDt).ok());
      wanted.push_back(a.world.stateHash());
    }
    for (std::size_t k : {std::size_t(0), kept.size() / 2, kept.size() - 1}) {
      World world = makeWorld();
      ASSERT_TRUE(world.restore(kept[k]).ok());
      std::vector<std::uint64_t> rest(wanted.begin() + std::ptrdiff_t(5 * k), wanted.end());
      EXPECT_EQ(hashes(world, int(rest.size())), rest) << c.scene << " from step " << 5 * k;
    }
  }
}

// All that a world tells of its mortar, bit for bit, without the world's number in its ids.
std::vector<double> toldOfMortar(const World& world) {
  std::vector<double> out;
  for (MortarId id : world.mortars()) {
    const MortarState state = *world.state(id);
    out.insert(out.end(), {double(id.index), state.force.x, state.force.y, state.force.z, state.utilisation,
                           state.damage, state.tensionWork, state.shearWork, state.crushingWork});
    const Result<MortarPast> past = world.past(id);
    if (!past) continue;
    out.insert(out.end(), {past->crackTime, past->openTime, past->breakTime, past->force.x, double(past->settled)});
    for (const LoadTaker& taker : past->takers)
      out.insert(out.end(), {double(taker.mortar.index), double(taker.bodyA.index), taker.before, taker.after});
  }
  return out;
}

TEST(Determinism, MortarBreaksAlikeOnAnyNumberOfThreadsAndThroughSnapshots) {
  constexpr int kMortarSteps = 40;
  MortaredWall one = mortaredWall(5, 5, 12);
  std::vector<std::uint64_t> wanted;
  std::vector<std::vector<double>> told;
  std::vector<std::vector<std::byte>> kept;
  for (int i = 0; i < kMortarSteps; i++) {
    kept.push_back(one.world.snapshot());
    ASSERT_TRUE(one.world.step(kDt).ok());
    wanted.push_back(one.world.stateHash());
    told.push_back(toldOfMortar(one.world));
  }
  int broken = 0;
  for (MortarId joint : one.joints) broken += one.world.state(joint)->broken;
  EXPECT_GT(broken, 5) << "the ball went through nothing";
  EXPECT_LT(broken, int(one.joints.size()));
  for (int threads : {2, 4, 8}) {
    WorldDef def;
    def.threads = threads;
    MortaredWall many = mortaredWall(5, 5, 12, def);
    EXPECT_EQ(hashes(many.world, kMortarSteps), wanted) << threads;
    EXPECT_EQ(toldOfMortar(many.world), told.back()) << threads;
  }
  // From each moment, a broken joint whose load is still going over included.
  for (std::size_t from = 0; from < kept.size(); from += 3) {
    World world = makeWorld();
    ASSERT_TRUE(world.restore(kept[from]).ok());
    EXPECT_EQ(world.snapshot(), kept[from]) << from;
    for (std::size_t i = from; i < wanted.size(); i++) {
      ASSERT_TRUE(world.step(kDt).ok());
      ASSERT_EQ(world.stateHash(), wanted[i]) << "from " << from << " step " << i;
      ASSERT_EQ(toldOfMortar(world), told[i]) << "from " << from << " step " << i;
    }
  }
}

// Chains, ropes and hinges in islands side by side, hit by heavy balls: some break.
World jointsThatBreak(int threads) {
  WorldDef def;
  def.threads = threads;
  World world = makeWorld(def);
  addGround(world);
  for (int row = 0; row < 6; row++) {
    const double z = 1.2 * row;
    BodyId last = add(world, bodyOf(boxOf({0.1, 0.1, 0.1}), {0, 3, z}, BodyType::fixed));
    for (int i = 0; i < 6 + row; i++) {
      const BodyId next = add(world, bodyOf(boxOf({0.1, 0.02, 0.2}), {0.22 * (i + 1), 3, z}));
      JointDef joint;
      joint.type = row % 3 == 0 ? JointType::revolute : row % 3 == 1 ? JointType::spherical : JointType::rope;
      joint.bodyA = last, joint.bodyB = next;
      joint.anchor = {0.22 * (i + 0.5), 3, z};
      joint.axis = {0, 0, 1};
      if (joint.type == JointType::rope) joint.anchor.x -= 0.1, joint.anchorB = joint.anchor + Vec3{0.2, 0, 0};
      joint.breakForce = 200 + 300 * i;
      EXPECT_TRUE(world.createJoint(joint).ok());
      last = next;
    }
    BodyDef ball = bodyOf(sphereOf(0.15, 7800), {0.6, 3.2, z});
    ball.linearVelocity = {0, -6, 0};
    add(world, ball);
  }
  return world;
}

TEST(Determinism, JointsBreakAlikeOnAnyNumberOfThreadsAndThroughSnapshots) {
  constexpr int kSteps = 38;
  World one = jointsThatBreak(1);
  const std::size_t had = one.joints().size();
  std::vector<std::vector<std::byte>> kept;
  std::vector<std::uint64_t> wanted;
  for (int i = 0; i < kSteps; i++) {
    kept.push_back(one.snapshot());
    ASSERT_TRUE(one.step(kDt).ok());
    wanted.push_back(one.stateHash());
  }
  EXPECT_LT(one.joints().size(), had - 3) << "none broke";
  EXPECT_GT(one.joints().size(), had / 4) << "hardly any is left";
  for (int threads : {2, 4, 8}) {
    World many = jointsThatBreak(threads);
    EXPECT_EQ(hashes(many, kSteps), wanted) << threads;
  }
  for (std::size_t from = 0; from < kept.size(); from += 13) {
    World world = makeWorld();
    ASSERT_TRUE(world.restore(kept[from]).ok());
    EXPECT_EQ(hashes(world, kSteps - int(from)),
              std::vector<std::uint64_t>(wanted.begin() + std::ptrdiff_t(from), wanted.end()))
        << from;
  }
}

TEST(Determinism, OtherWorldsInTheProcessDoNotMatter) {
  lab::Scene alone = sceneOf(kCases[2]);
  std::vector<std::uint64_t> wanted = hashes(alone.world, 40);
  lab::Scene a = sceneOf(kCases[2]), b = sceneOf(kCases[6]);
  for (int i = 0; i < 40; i++) {
    ASSERT_TRUE(b.world.step(1.0 / 120).ok());
    ASSERT_TRUE(a.world.step(kDt).ok());
    ASSERT_EQ(a.world.stateHash(), wanted[std::size_t(i)]);
  }
}

}  // namespace
}  // namespace brickfall
