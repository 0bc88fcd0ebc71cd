// Mortar through the API: what is refused and why, what can be read, events, what is carried, sleep, bodies that go.
#include <algorithm>
#include <limits>
#include <map>
#include <random>

#include "brickfall/fall.h"
#include "support/mortared_wall.h"
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
  refuse("strength.crushingEnergy", [](MortarDef& d) { d.strength.crushingEnergy = 0; });
  refuse("strength.crushingEnergy", [&](MortarDef& d) { d.strength.crushingEnergy = nan; });
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
  EXPECT_NEAR(s.area, 0.02, 1e-9);
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

// A wall of 500 bricks flies apart in space: over a thousand joints break in one step. They are told in the order in which they
// were made, whatever the threads, the step does not stall, and a snapshot between two such steps goes on as the world.
TEST(Mortar, AThousandJointsBreakInOneStep) {
  auto burst = [](int threads) {
    WorldDef def;
    def.threads = threads;
    MortaredWall wall = mortaredWall(25, 20, 0, def);
    EXPECT_TRUE(wall.world.destroyBody(wall.ground).ok());
    for (BodyId brick : wall.bricks) {
      const Vec3 from = wall.world.state(brick)->position - Vec3{2, 1, 0};
      EXPECT_TRUE(wall.world.setLinearVelocity(brick, from * 30.0).ok());
    }
    return wall;
  };
  MortaredWall wall = burst(1), other = burst(4);
  const Energy before = wall.world.energy();
  Result<StepReport> report = wall.world.step(kDt);
  ASSERT_TRUE(report.ok() && other.world.step(kDt).ok());
  std::vector<std::uint32_t> broken;
  for (const MortarEvent& e : wall.world.events().mortar)
    if (e.broken) broken.push_back(e.mortar.index);
  EXPECT_GT(broken.size(), 1000u);
  EXPECT_TRUE(std::is_sorted(broken.begin(), broken.end()));
  EXPECT_LT(report->solveVisits, 500 * double(wall.joints.size()));
  const Energy after = wall.world.energy();
  EXPECT_LT(after.kinetic + after.potential, before.kinetic + before.potential);
  World copy = makeWorld();
  ASSERT_TRUE(copy.restore(wall.world.snapshot()).ok());
  for (int i = 0; i < 3; i++) {
    for (World* w : {&wall.world, &other.world, &copy}) ASSERT_TRUE(w->step(kDt).ok());
    EXPECT_EQ(wall.world.stateHash(), other.world.stateHash()) << "threads, step " << i;
    EXPECT_EQ(wall.world.stateHash(), copy.stateHash()) << "snapshot, step " << i;
  }
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

// Glues the horizontal face of that middle and half extents.
MortarId glueAcross(World& world, BodyId lower, BodyId upper, Vec3 centre, double x, double z, double strength = 1) {
  MortarDef d;
  d.bodyA = lower;
  d.bodyB = upper;
  d.outline = {centre + Vec3{-x, 0, z}, centre + Vec3{x, 0, z}, centre + Vec3{x, 0, -z}, centre + Vec3{-x, 0, -z}};
  d.strength.tension *= strength;
  d.strength.cohesion *= strength;
  d.strength.tensionEnergy *= strength;
  d.strength.shearEnergy *= strength;
  return *world.createMortar(d);
}

// A beam under a ceiling, on two faces alike; the left one is weak. A block hangs under its middle.
struct HungBeam {
  World world = makeWorld();
  BodyId ceiling = add(world, bodyOf(boxOf({1, 0.1, 0.1}), {0, 2.1, 0}, BodyType::fixed));
  BodyId beam = add(world, bodyOf(boxOf({0.3, 0.05, 0.05}), {0, 1.95, 0}));
  BodyId block = add(world, bodyOf(boxOf({0.05, 0.05, 0.05}), {0, 1.85, 0}));
  MortarId left = glueAcross(world, beam, ceiling, {-0.25, 2, 0}, 0.05, 0.05, 0.024);
  MortarId right = glueAcross(world, beam, ceiling, {0.25, 2, 0}, 0.05, 0.05, 5);
  MortarId under = glueAcross(world, block, beam, {0, 1.9, 0}, 0.05, 0.05);
  double weight() const { return (world.state(beam)->mass + world.state(block)->mass) * kG; }
  void step(int steps) {
    for (int i = 0; i < steps; i++) ASSERT_TRUE(world.step(kDt).ok());
  }
  // Pulls at the body until the joint has broken; s.
  void tear(BodyId body, Vec3 point, MortarId joint, double by) {
    for (double force = 0; !world.state(joint)->broken && force < 1e5; force += by) {
      ASSERT_TRUE(world.applyForceAtPoint(body, {0, -force, 0}, point).ok());
      step(1);
    }
    ASSERT_TRUE(world.state(joint)->broken);
  }
};

TEST(Mortar, TellsWhoTookTheLoadOver) {
  HungBeam hung;
  const double weight = hung.weight();
  EXPECT_FALSE(hung.world.past(hung.left).ok()) << "it has not cracked";
  hung.step(30);
  EXPECT_NEAR(length(hung.world.state(hung.right)->force), 0.5 * weight, 0.01 * weight);
  // Eight times the weight opens the left face for good: the right one has all of it, at its arm. (Twice the weight, more
  // than the left face bears, cracks it by a fifth: the right one bends too little.)
  ASSERT_TRUE(hung.world.setGravity({0, -8 * kG, 0}).ok());
  while (!hung.world.state(hung.left)->broken && hung.world.time() < 2) hung.step(1);
  ASSERT_TRUE(hung.world.state(hung.left)->broken);
  const double broke = hung.world.time();
  hung.step(30);
  const MortarPast past = *hung.world.past(hung.left);
  EXPECT_EQ(past.mortar, hung.left);
  EXPECT_EQ(past.breakTime, broke);
  EXPECT_LE(past.crackTime, broke);
  EXPECT_EQ(past.mode, MortarMode::tension);
  EXPECT_GT(past.tensionShare, 0.9);
  EXPECT_LE(past.tensionShare + past.shearShare, 1 + 1e-9);
  EXPECT_TRUE(past.settled);
  EXPECT_NEAR(past.force.y, -0.5 * weight, 0.01 * weight) << "on the ceiling";
  ASSERT_FALSE(past.takers.empty());  // the block under it is jerked, and may come second
  EXPECT_EQ(past.takers[0].mortar, hung.right);
  EXPECT_NEAR(past.takers[0].before, 0.5 * weight, 0.01 * weight);
  EXPECT_NEAR(past.takers[0].after, 8 * weight, 0.05 * weight);
  const FallStory story = *hung.world.whyFell(hung.beam);
  EXPECT_TRUE(story.carried);
  ASSERT_EQ(story.opened.size(), 1u);
  expectSound(hung.world);
}

TEST(Mortar, WhatFellAsOneFellForOneReason) {
  HungBeam hung;
  hung.step(30);
  EXPECT_FALSE(hung.world.whyFell(hung.block)->first) << "nothing broke";
  hung.tear(hung.beam, {-0.25, 1.95, 0}, hung.left, 100);
  hung.tear(hung.beam, {0.25, 1.95, 0}, hung.right, 1000);
  ASSERT_FALSE(hung.world.state(hung.under)->broken);
  hung.step(20);
  const FallStory story = *hung.world.whyFell(hung.block);
  EXPECT_FALSE(story.carried);
  ASSERT_TRUE(story.first);
  EXPECT_EQ(story.first->mortar, hung.left);
  EXPECT_FALSE(story.own);
  EXPECT_TRUE(story.opened.empty());
  EXPECT_TRUE(hung.world.whyFell(hung.beam)->own);
  EXPECT_FALSE(hung.world.whyFell({}).ok());
  EXPECT_TRUE(hung.world.destroyBody(hung.ceiling).ok());
  EXPECT_FALSE(hung.world.whyFell(hung.block)->first) << "the joints ended with it";
  expectSound(hung.world);
}

TEST(Mortar, TheBlameGoesDownToWhatBrokeBefore) {
  // Fixed 0, under it 1, under it 2 and 3. First 0-1 broke, then 1-2; 3 still hangs on 2. 4-5 broke first of all, elsewhere.
  const std::vector<bool> moves{false, true, true, true, true, false};
  const double up = 5;
  std::vector<FallJoint> joints{{0, 1, 2, up}, {1, 2, 3, up}, {2, 3}, {5, 4, 1, up}};
  const FallFinder finder(joints, moves);
  for (std::uint32_t body : {1u, 2u, 3u}) EXPECT_EQ(finder.first(body), 0u) << body;
  EXPECT_EQ(finder.first(4), 3u);
  EXPECT_FALSE(finder.first(0)) << "fixed";
  EXPECT_FALSE(finder.first(99));
  joints[0].breakTime = 4;  // 1-2 broke before: 2 fell by that alone
  EXPECT_EQ(FallFinder(joints, moves).first(3), 1u);
  joints[0].lift = -up;  // 1 lay on 0 upside down: 0 did not hold it up
  joints[0].breakTime = 2;
  EXPECT_EQ(FallFinder(joints, moves).first(2), 1u);
}

TEST(Mortar, GoesOnWithThePieceThatHasItsFace) {
  World world = makeWorld();
  const BodyId ceiling = add(world, bodyOf(boxOf({1, 0.1, 0.1}), {0, 2.1, 0}, BodyType::fixed));
  const BodyId beam = add(world, bodyOf(boxOf({0.3, 0.05, 0.05}), {0, 1.95, 0}));
  const BodyId block = add(world, bodyOf(boxOf({0.05, 0.05, 0.05}), {0, 1.85, 0}));
  const MortarId left = glueAcross(world, beam, ceiling, {-0.2, 2, 0}, 0.1, 0.05);
  const MortarId right = glueAcross(world, beam, ceiling, {0.2, 2, 0}, 0.1, 0.05);
  const MortarId under = glueAcross(world, block, beam, {0, 1.9, 0}, 0.05, 0.05);
  for (int i = 0; i < 60; i++) ASSERT_TRUE(world.step(kDt).ok());
  const Vec3 force = world.state(left)->force;
  // Cut in its middle, through the face of the block.
  std::vector<BodyDef> halves{bodyOf(boxOf({0.15, 0.05, 0.05}), {-0.15, 1.95, 0}),
                              bodyOf(boxOf({0.15, 0.05, 0.05}), {0.15, 1.95, 0})};
  const std::vector<BodyId> pieces = *world.replaceBody(beam, halves);
  EXPECT_EQ(world.state(left)->bodyA, pieces[0]);
  EXPECT_EQ(world.state(right)->bodyA, pieces[1]);
  EXPECT_FALSE(world.isValid(under));
  expectSound(world);
  const std::vector<std::byte> bytes = world.snapshot();
  World copy = makeWorld();
  ASSERT_TRUE(copy.restore(bytes).ok());
  for (World* w : {&world, &copy}) {
    ASSERT_TRUE(w->step(kDt).ok());
    ASSERT_EQ(w->events().mortar.size(), 1u) << "also after a snapshot between the call and the step";
    EXPECT_TRUE(w->events().mortar[0].dropped);
    EXPECT_EQ(w->events().mortar[0].bodyA.index, block.index);
  }
  for (int i = 0; i < 30; i++) ASSERT_TRUE(world.step(kDt).ok());
  EXPECT_NEAR(world.state(pieces[0])->position.y, 1.95, 1e-4) << "holds on";
  EXPECT_LT(world.state(block)->position.y, 1.8) << "fell";
  EXPECT_NEAR(length(world.state(left)->force), world.state(pieces[0])->mass * kG, 0.01 * length(force));
  expectSound(world);
}

// Any order of calls: the joints that there are, and of which bodies, are those of a simple model.
class MortarModel {
 public:
  explicit MortarModel(unsigned seed) : random_(seed), wall_(mortaredWall(3, 3, 4)) {
    for (MortarId id : wall_.joints) add(id);
  }
  void play(int calls) {
    for (int i = 0; i < calls && !testing::Test::HasFailure(); i++) {
      call(int(random_() % 8));
      compare();
    }
  }
  int dropped = 0, kept = 0, broken = 0;

 private:
  World& world() { return wall_.world; }
  BodyId anyBody() {
    const std::vector<BodyId> all = world().bodies();
    return all[random_() % all.size()];
  }
  void add(MortarId id) { model_[id] = {world().state(id)->bodyA, world().state(id)->bodyB}; }
  void call(int which) {
    if (which == 0) {
      MortarDef def;
      def.bodyA = anyBody();
      def.bodyB = anyBody();
      if (Result<std::vector<Vec3>> face = world().sharedFace(def.bodyA, def.bodyB)) def.outline = *face;
      if (Result<MortarId> made = world().createMortar(def)) add(*made);
    } else if (which == 1 && !model_.empty()) {
      const MortarId id = std::next(model_.begin(), std::ptrdiff_t(random_() % model_.size()))->first;
      EXPECT_TRUE(world().destroyMortar(id).ok());
      EXPECT_FALSE(world().destroyMortar(id).ok()) << "twice";
      model_.erase(id);
    } else if (which == 2 && random_() % 3 == 0) {
      end(anyBody());
    } else if (which == 3) {
      cut(anyBody());
    } else if (which == 4) {
      World copy = makeWorld();
      ASSERT_TRUE(copy.restore(world().snapshot()).ok());
      for (World* w : {&copy, &world()}) ASSERT_TRUE(w->step(kDt).ok());
      EXPECT_EQ(copy.stateHash(), world().stateHash());
    } else {
      ASSERT_TRUE(world().step(which == 5 ? 1.0 / 240 : kDt).ok());
      for (const MortarEvent& event : world().events().mortar) broken += event.broken;
    }
  }
  void end(BodyId body) {
    ASSERT_TRUE(world().destroyBody(body).ok());
    std::erase_if(model_, [&](const auto& joint) { return joint.second.first == body || joint.second.second == body; });
  }
  // In two, across its longest axis.
  void cut(BodyId body) {
    const BodyState state = *world().state(body);
    const ShapeDef shape = *world().shape(world().shapes(body)[0]);
    if (shape.type != ShapeType::box || shape.halfExtents.x < 0.03) return;
    std::vector<BodyDef> halves;
    for (double side : {-0.5, 0.5}) {
      BodyDef def = bodyOf(shape, state.position + rotate(state.rotation, Vec3{side * shape.halfExtents.x, 0, 0}));
      def.rotation = state.rotation;
      def.linearVelocity = state.linearVelocity;
      def.shapes[0].halfExtents.x *= 0.5;
      halves.push_back(def);
    }
    const Result<std::vector<BodyId>> pieces = world().replaceBody(body, halves);
    ASSERT_TRUE(pieces.ok());
    for (auto joint = model_.begin(); joint != model_.end();) {
      auto& [a, b] = joint->second;
      if (a != body && b != body) {
        ++joint;
        continue;
      }
      const Result<MortarState> now = world().state(joint->first);
      if (!now) {
        dropped++;
        joint = model_.erase(joint);
        continue;
      }
      BodyId& was = a == body ? a : b;
      was = a == body ? now->bodyA : now->bodyB;
      EXPECT_TRUE(was == (*pieces)[0] || was == (*pieces)[1]);
      kept++;
      ++joint;
    }
  }
  void compare() {
    std::vector<MortarId> ids;
    for (const auto& [id, bodies] : model_) {
      ids.push_back(id);
      const Result<MortarState> state = world().state(id);
      ASSERT_TRUE(state.ok()) << id.index;
      EXPECT_EQ(state->bodyA, bodies.first);
      EXPECT_EQ(state->bodyB, bodies.second);
      EXPECT_TRUE(world().isValid(bodies.first) && world().isValid(bodies.second));
    }
    std::vector<MortarId> there = world().mortars();
    std::sort(there.begin(), there.end());
    EXPECT_EQ(there, ids);
    for (BodyId body : world().bodies()) ASSERT_TRUE(world().whyFell(body).ok());
    expectSound(world());
  }

  std::mt19937 random_;
  MortaredWall wall_;
  std::map<MortarId, std::pair<BodyId, BodyId>> model_;
};

TEST(Mortar, CallsInAnyOrderLeaveWhatAModelSays) {
  int dropped = 0, kept = 0, broken = 0;
  for (unsigned seed = 1; seed <= 12; seed++) {
    SCOPED_TRACE(seed);
    MortarModel model(seed);
    model.play(60);
    dropped += model.dropped;
    kept += model.kept;
    broken += model.broken;
    if (HasFailure()) return;
  }
  EXPECT_GT(dropped, 5);
  EXPECT_GT(kept, 5);
  EXPECT_GT(broken, 5);
}

}  // namespace
}  // namespace brickfall::test
