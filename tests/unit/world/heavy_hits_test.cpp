// A step in which something heavy hits is made in parts: how many, and that nothing else notices.
#include "support/world_helpers.h"

namespace brickfall {
namespace {

using namespace test;

constexpr Vec3 kBrick{0.1075, 0.0325, 0.05125};  // m, half: 0.1025 thick along z
constexpr double kBall = 0.15;                   // m

struct Hit {
  double density = 7800;  // of the ball: 110 kg, 39 bricks
  double speed = 15;      // m/s, along z
  double across = 0;      // m/s, along x
  Vec3 half = kBrick;
  BodyType struck = BodyType::dynamic;
  double ahead = 0.02;  // m, between the two
  double sideways = 0;  // m, of the ball
  Vec3 brickVelocity;
  int maxHitParts = 8, substeps = 1;
};

StepReport stepOf(const Hit& h) {
  WorldDef def;
  def.gravity = {};
  def.solver.maxHitParts = h.maxHitParts;
  World world = makeWorld(def);
  BodyDef brick = bodyOf(boxOf(h.half, 1900), {}, h.struck);
  brick.linearVelocity = h.brickVelocity;
  add(world, brick);
  BodyDef ball = bodyOf(sphereOf(kBall, h.density), {h.sideways, 0, -(h.half.z + h.ahead + kBall)});
  ball.linearVelocity = {h.across, 0, h.speed};
  add(world, ball);
  return *world.step(kDt, h.substeps);
}

TEST(HeavyHits, GoAThirdThroughWhatTheyHitInAPart) {
  EXPECT_EQ(stepOf({}).parts, 4)
      << "0.25 m, of them 0.23 after the flight: a seventh of the step, two, and what is left in halves";
  EXPECT_EQ(stepOf({.speed = 7}).parts, 2);
  EXPECT_EQ(stepOf({.speed = 3}).parts, 1) << "0.05 m, of them 0.03 after the flight";
  EXPECT_EQ(stepOf({.speed = 1.5, .ahead = 0.001}).parts, 1) << "0.025 m";
  EXPECT_EQ(stepOf({.ahead = 0.15}).parts, 6)
      << "the flight; a quarter of a part, a half, a whole one, and what is left in halves";
  EXPECT_EQ(stepOf({.half = {0.05125, 0.0325, 0.1075}}).parts, 3) << "along its length";
  EXPECT_EQ(stepOf({.speed = 10, .brickVelocity = {0, 0, 4}}).parts, 2) << "what counts is how fast they meet";
  EXPECT_EQ(stepOf({.speed = 10, .brickVelocity = {0, 0, -5}}).parts, 4);
}

TEST(HeavyHits, NeverTakeMoreThanTheSettingAllows) {
  EXPECT_EQ(stepOf({.speed = 100}).parts, 7) << "each is twice as long as the one before";
  EXPECT_EQ(stepOf({.speed = 100, .maxHitParts = 64}).parts, 7);
  EXPECT_EQ(stepOf({.maxHitParts = 3}).parts, 3);
  EXPECT_EQ(stepOf({.maxHitParts = 1}).parts, 1);
}

TEST(HeavyHits, AreOfWhatIsTenTimesAsHeavyAndGetsThere) {
  EXPECT_EQ(stepOf({.density = 1900}).parts, 1) << "26.9 kg, 9.4 bricks";
  EXPECT_EQ(stepOf({.density = 2200}).parts, 4) << "31.1 kg, 10.9 bricks";
  EXPECT_EQ(stepOf({.ahead = 0.4}).parts, 1) << "it does not get there in this step";
  EXPECT_EQ(stepOf({.speed = -15}).parts, 1) << "it goes away";
  EXPECT_EQ(stepOf({.brickVelocity = {0, 0, 15}}).parts, 1) << "it is carried along";
  EXPECT_EQ(stepOf({.struck = BodyType::fixed}).parts, 1) << "nothing goes through what is fixed";
}

// It is pushed out of its neighbours, which the ball meets after a few millimetres.
TEST(HeavyHits, AreOfMoreThanItsMassWhereMortarHolds) {
  auto partsOf = [](double density, bool mortared) {
    WorldDef def;
    def.gravity = {};
    World world = makeWorld(def);
    MortarDef mortar;
    mortar.bodyA = add(world, bodyOf(boxOf(kBrick, 1900), {}));
    mortar.bodyB = add(world, bodyOf(boxOf(kBrick, 1900), {0, 2 * kBrick.y, 0}, BodyType::fixed));
    mortar.outline = *world.sharedFace(mortar.bodyA, mortar.bodyB);
    if (mortared) (void)world.createMortar(mortar).value();
    BodyDef ball = bodyOf(sphereOf(kBall, density), {0, 0, -(kBrick.z + 0.02 + kBall)});
    ball.linearVelocity = {0, 0, 5};
    add(world, ball);
    return world.step(kDt)->parts;
  };
  EXPECT_EQ(partsOf(500, true), 8)
      << "7.1 kg, 2.6 bricks: the flight, then an eighth of 4.6 ms, and each a third longer than the last";
  EXPECT_EQ(partsOf(500, false), 1);
  EXPECT_EQ(partsOf(300, true), 8) << "4.2 kg, 1.6 bricks";
  EXPECT_EQ(partsOf(180, true), 1) << "2.5 kg, 0.9 bricks";
}

// Rubble beside its way and behind it would else have the whole world stepped in parts for seconds.
TEST(HeavyHits, AreNotOfWhatItPassesOrLeavesBehind) {
  const Hit past{.across = 15, .ahead = -0.25, .sideways = -0.45};
  EXPECT_EQ(stepOf(past).parts, 1) << "within the box around its way, 0.35 m from its middle";
  EXPECT_EQ(stepOf({.across = 15, .ahead = -0.1, .sideways = -0.28}).parts, 3) << "its corner is met";
  EXPECT_EQ(stepOf({.ahead = -0.41}).parts, 1) << "it has just gone through";
  EXPECT_EQ(stepOf({.ahead = -0.41, .brickVelocity = {0, 0, 40}}).parts, 4) << "but the brick comes after it, faster";
}

// A bar that comes sideways is widest far from its centre.
TEST(HeavyHits, AreThoseOfWhatIsLongAtItsEndsToo) {
  for (double ahead : {0.1, -0.01}) {
    WorldDef def;
    def.gravity = {};
    World world = makeWorld(def);
    add(world, bodyOf(boxOf(kBrick, 1900), {1.9, 0, ahead}));
    BodyDef bar = bodyOf(boxOf({2, 0.03, 0.03}, 7800), {0, 0.06, 0});
    bar.linearVelocity = {0, 0, 15};
    add(world, bar);
    EXPECT_EQ(world.step(kDt)->parts, ahead > 0 ? 4 : 5) << ahead;
  }
}

TEST(HeavyHits, AreThoseOfDrivenBodiesToo) {
  WorldDef def;
  def.gravity = {};
  World world = makeWorld(def);
  add(world, bodyOf(boxOf(kBrick, 1900), {}));
  BodyDef ram = bodyOf(boxOf({0.05, 0.05, 0.05}, 1), {0, 0, -0.2}, BodyType::kinematic);
  ram.linearVelocity = {0, 0, 15};
  add(world, ram);
  EXPECT_EQ(world.step(kDt)->parts, 6);
}

TEST(HeavyHits, EachSubstepIsPartedByItself) {
  EXPECT_EQ(stepOf({.substeps = 4}).parts, 2 + 1 + 1 + 1) << "the ball goes on with the brick before it";
  EXPECT_EQ(stepOf({.density = 1000, .substeps = 4}).parts, 4);
}

// Forces act for the whole step, kinematic bodies go their whole way, time and the count of steps know no parts.
TEST(HeavyHits, NothingElseNotices) {
  WorldDef def;
  def.gravity = {};
  World world = makeWorld(def);
  add(world, bodyOf(boxOf(kBrick, 1900), {}));
  BodyDef ball = bodyOf(sphereOf(kBall, 7800), {0, 0, -0.25});
  ball.linearVelocity = {0, 0, 15};
  add(world, ball);
  BodyId pushed = add(world, bodyOf(boxOf({0.1, 0.1, 0.1}, 1000), {5, 0, 0}));
  BodyDef cart = bodyOf(boxOf({0.1, 0.1, 0.1}), {-5, 0, 0}, BodyType::kinematic);
  cart.linearVelocity = {0, 1.5, 0};
  BodyId carted = add(world, cart);
  ASSERT_TRUE(world.applyForce(pushed, {480, 0, 0}).ok());
  StepReport report = *world.step(kDt);
  ASSERT_EQ(report.parts, 4);
  EXPECT_EQ(report.stepIndex, 1u);
  EXPECT_EQ(world.stepCount(), 1u);
  EXPECT_EQ(world.time(), kDt);
  EXPECT_NEAR(world.state(pushed)->linearVelocity.x, 1, 1e-12);
  EXPECT_NEAR(world.state(pushed)->linearAcceleration.x, 60, 1e-9) << "over the whole step";
  EXPECT_NEAR(world.state(carted)->position.y, 1.5 * kDt, 1e-12);
  EXPECT_EQ(world.events().moved.size(), 4u) << "each is told once";
  report = *world.step(kDt);
  EXPECT_NEAR(world.state(pushed)->linearVelocity.x, 1, 1e-12) << "the force is forgotten";
  EXPECT_EQ(world.time(), 2 * kDt);
}

// What rests while something else is hit rests on, in no part anew.
TEST(HeavyHits, LeaveWhatRestsAlone) {
  World world = awakeWorld();
  add(world, bodyOf(boxOf({50, 0.5, 50}, 1000), {0, -0.5, 0}, BodyType::fixed));
  std::vector<BodyId> column;
  for (int i = 0; i < 30; i++) column.push_back(add(world, bodyOf(boxOf(kBrick, 1900), {10, 0.0325 + i * 0.065, 0})));
  for (int i = 0; i < 60; i++) stepSound(world);
  std::vector<Vec3> before;
  for (BodyId body : column) before.push_back(world.state(body)->position);
  for (int i = 0; i < 8; i++) add(world, bodyOf(boxOf(kBrick, 1900), {0, 0.0325 + i * 0.065, 0}));
  BodyDef ball = bodyOf(sphereOf(kBall, 7800), {0, 0.25, -0.4});
  ball.linearVelocity = {0, 0, 15};
  add(world, ball);
  int parts = 0;
  for (int i = 0; i < 30; i++) {
    StepReport report = *world.step(kDt);
    EXPECT_TRUE(world.validate().empty());
    parts += report.parts;
  }
  EXPECT_GT(parts, 33) << "it must have been hit";
  for (std::size_t i = 0; i < column.size(); i++) {
    EXPECT_EQ(world.state(column[i])->position, before[i]);
    EXPECT_EQ(world.state(column[i])->linearVelocity, Vec3{});
  }
}

}  // namespace
}  // namespace brickfall
