// One body becomes several: what leans on it is held all the while, because the contacts of the pieces go on with what those
// of the body remembered.
#include <algorithm>

#include "support/world_helpers.h"

namespace brickfall {
namespace {

using namespace test;

constexpr Vec3 kHalf{0.12, 0.0325, 0.06};  // m, of a brick

// Bricks on each other, at rest; from below.
std::vector<BodyId> column(World& world, int bricks = 12, int substeps = 1) {
  addGround(world);
  std::vector<BodyId> out;
  for (int i = 0; i < bricks; i++) out.push_back(add(world, bodyOf(boxOf(kHalf, 1800), {0, kHalf.y * (2 * i + 1), 0})));
  for (int i = 0; i < 90; i++) stepSound(world, kDt, substeps);
  return out;
}

// The left and the right half of a brick where it is, moving as it does.
std::vector<BodyDef> halvesOf(const World& world, BodyId body) {
  BodyState s = *world.state(body);
  std::vector<BodyDef> out;
  for (double side : {-1.0, 1.0}) {
    Vec3 offset = rotate(s.rotation, Vec3{side * kHalf.x / 2, 0, 0});
    BodyDef d = bodyOf(boxOf({kHalf.x / 2, kHalf.y, kHalf.z}, 1800), s.position + offset);
    d.rotation = s.rotation;
    d.linearVelocity = s.linearVelocity + cross(s.angularVelocity, offset);
    d.angularVelocity = s.angularVelocity;
    out.push_back(d);
  }
  return out;
}

std::vector<BodyId> replace(World& world, BodyId body) {
  Result<std::vector<BodyId>> pieces = world.replaceBody(body, halvesOf(world, body));
  EXPECT_TRUE(pieces.ok()) << pieces.error().message;
  expectSound(world);
  return pieces.ok() ? *pieces : std::vector<BodyId>{};
}

void destroyAndCreate(World& world, BodyId body) {
  std::vector<BodyDef> halves = halvesOf(world, body);
  ASSERT_TRUE(world.destroyBody(body).ok());
  for (const BodyDef& half : halves) add(world, half);
}

// m: how far any of them is ever above or below its place during a second.
double farthest(World& world, const std::vector<BodyId>& bodies, int substeps = 1) {
  std::vector<double> before;
  for (BodyId body : bodies) before.push_back(world.state(body)->position.y);
  double most = 0;
  for (int i = 0; i < 60; i++) {
    stepSound(world, kDt, substeps);
    for (std::size_t k = 0; k < bodies.size(); k++)
      most = std::max(most, std::fabs(before[k] - world.state(bodies[k])->position.y));
  }
  return most;
}

std::vector<BodyId> above(const std::vector<BodyId>& bricks, std::size_t one) {
  return {bricks.begin() + std::ptrdiff_t(one) + 1, bricks.end()};
}

TEST(Replace, AColumnStandsOnTheHalvesOfABrick) {
  for (int substeps : {1, 4}) {
    World world = awakeWorld();
    std::vector<BodyId> bricks = column(world, 12, substeps);
    replace(world, bricks[2]);
    EXPECT_LT(farthest(world, above(bricks, 2), substeps), 5e-6) << "substeps " << substeps;
  }
}

// Stretchers in third bond (in half bond the end bricks of every second course lie at their very tipping point): the body has contacts
// with two bricks below and two above.
TEST(Replace, AWallStandsOnTheHalvesOfABrick) {
  auto wall = [](World& world) {
    addGround(world);
    std::vector<BodyId> out;
    for (int course = 0; course < 10; course++)
      for (int i = 0; i < 5; i++)
        out.push_back(add(world, bodyOf(boxOf(kHalf, 1800),
                                        {2 * kHalf.x * (i + (course % 2) / 3.0), kHalf.y * (2 * course + 1), 0})));
    for (int i = 0; i < 90; i++) stepSound(world);
    return out;
  };
  World world = awakeWorld(), other = awakeWorld();
  std::vector<BodyId> bricks = wall(world), same = wall(other);
  replace(world, bricks[7]);  // in the second course
  destroyAndCreate(other, same[7]);
  std::vector<BodyId> upper(bricks.begin() + 10, bricks.end()), upperSame(same.begin() + 10, same.end());
  double replaced = farthest(world, upper), anew = farthest(other, upperSame);
  EXPECT_LT(replaced, 1e-4);
  EXPECT_GT(anew, replaced);
  RecordProperty("sunk_um", std::to_string(replaced * 1e6));
  RecordProperty("sunk_anew_um", std::to_string(anew * 1e6));
}

TEST(Replace, ForcesGoOnAsTheyWere) {
  World world = awakeWorld();
  std::vector<BodyId> bricks = column(world);
  auto forceOn = [&](BodyId upper) {
    double sum = 0;
    world.forEachContact([&](const ContactView& c) {
      for (int i = 0; i < c.pointCount; i++)
        sum += (c.bodyB == upper ? 1 : c.bodyA == upper ? -1 : 0) * c.points[i].normalForce * c.normalWorld.y;
    });
    return sum;
  };
  double weight = world.state(bricks[3])->mass * kG;
  EXPECT_NEAR(forceOn(bricks[3]), weight, 0.05 * weight);
  replace(world, bricks[2]);  // before any step: the memory was handed on
  EXPECT_NEAR(forceOn(bricks[3]), weight, 0.05 * weight);
}

TEST(Replace, KeepsMassAndMomentum) {
  World world = emptySpace();
  BodyDef d = bodyOf(boxOf(kHalf, 1800), {1, 2, 3});
  d.rotation = normalized(Quat{0.1, 0.2, 0.3, 0.9});
  d.linearVelocity = {3, -1, 2};
  d.angularVelocity = {0, 4, 0};
  BodyId body = add(world, d);
  double mass = world.state(body)->mass;
  Vec3 linear = world.linearMomentum(), angular = world.angularMomentum();
  std::vector<BodyId> pieces = replace(world, body);
  ASSERT_EQ(pieces.size(), 2u);
  EXPECT_NEAR(world.state(pieces[0])->mass + world.state(pieces[1])->mass, mass, 1e-12 * mass);
  EXPECT_LT(length(world.linearMomentum() - linear), 1e-12 * length(linear));
  EXPECT_LT(length(world.angularMomentum() - angular), 1e-12 * length(angular));
}

// The pieces go on together, as the body would have.
TEST(Replace, ForcesOfTheComingStepGoToThePieces) {
  World world = emptySpace(), whole = emptySpace();
  BodyDef d = bodyOf(boxOf(kHalf, 1800), {1, 2, 3});
  d.rotation = normalized(Quat{0.1, 0.2, 0.3, 0.9});
  BodyId body = add(world, d), same = add(whole, d);
  for (auto [w, b] : {std::pair{&world, body}, {&whole, same}}) {
    ASSERT_TRUE(w->applyForceAtPoint(b, {3, -2, 1}, {1.05, 2.02, 3}).ok());
    ASSERT_TRUE(w->applyTorque(b, {0.01, 0.02, -0.03}).ok());
  }
  // A third and two thirds of it.
  std::vector<BodyDef> pieces;
  for (double share : {1 / 3.0, -2 / 3.0}) {
    Vec3 half{std::fabs(share) * kHalf.x, kHalf.y, kHalf.z};
    pieces.push_back(
        bodyOf(boxOf(half, 1800), d.position + rotate(d.rotation, Vec3{kHalf.x * (share > 0 ? -2 : 1) / 3, 0, 0})));
    pieces.back().rotation = d.rotation;
  }
  Result<std::vector<BodyId>> made = world.replaceBody(body, pieces);
  ASSERT_TRUE(made.ok());
  stepSound(world);
  stepSound(whole);
  ASSERT_GT(length(whole.linearMomentum()), 0.05);
  expectNear(world.linearMomentum(), whole.linearMomentum(), 1e-9);
  expectNear(world.angularMomentum(), whole.angularMomentum(), 1e-6);
  for (BodyId piece : *made)
    expectNear(world.state(piece)->angularVelocity, whole.state(same)->angularVelocity, 2e-3, "none turns by itself");
  const Vec3 after = world.linearMomentum();
  stepSound(world);
  expectNear(world.linearMomentum(), after, 1e-9, "for one step");
}

TEST(Replace, AFixedPieceTakesNoForce) {
  World world = emptySpace();
  BodyId body = addBox(world, {0.1, 0.1, 0.1}, {});
  ASSERT_TRUE(world.applyForce(body, {60, 0, 0}).ok());
  std::vector<BodyDef> pieces{bodyOf(boxOf({0.1, 0.05, 0.1}), {0, -0.05, 0}, BodyType::fixed),
                              bodyOf(boxOf({0.1, 0.04, 0.1}), {0, 0.2, 0})};
  ASSERT_TRUE(world.replaceBody(body, pieces).ok());
  stepSound(world);
  expectNear(world.linearMomentum(), {1, 0, 0}, 1e-9);
}

TEST(Replace, ASnapshotRightAfterwardsGoesOnBitForBit) {
  World world = awakeWorld(), copy = makeWorld();
  std::vector<BodyId> bricks = column(world);
  replace(world, bricks[4]);
  ASSERT_TRUE(copy.restore(world.snapshot()).ok());
  for (int i = 0; i < 60; i++) {
    stepSound(world);
    stepSound(copy);
    ASSERT_EQ(world.stateHash(), copy.stateHash()) << "step " << i;
  }
}

TEST(Replace, WhileAsleepItWakesWhatTouchesIt) {
  World world = makeWorld();
  std::vector<BodyId> bricks = column(world);
  for (BodyId brick : bricks) ASSERT_FALSE(world.state(brick)->awake);
  std::vector<BodyId> pieces = replace(world, bricks[2]);
  for (BodyId piece : pieces) EXPECT_TRUE(world.state(piece)->awake);
  for (BodyId brick : above(bricks, 2)) EXPECT_TRUE(world.state(brick)->awake);
  EXPECT_LT(farthest(world, above(bricks, 2)), 1e-4);
  EXPECT_EQ(std::count(world.events().woke.begin(), world.events().woke.end(), bricks[3]), 0);  // once, long ago
}

TEST(Replace, TouchingPairsOfTheBodyEndAndThoseOfThePiecesBegin) {
  World world = awakeWorld();
  std::vector<BodyId> bricks = column(world, 4);
  std::vector<BodyId> pieces = replace(world, bricks[1]);
  stepSound(world);
  auto names = [](const std::vector<ContactEvent>& list, BodyId body) {
    return std::count_if(list.begin(), list.end(),
                         [&](const ContactEvent& e) { return e.bodyA == body || e.bodyB == body; });
  };
  EXPECT_EQ(names(world.events().end, bricks[1]), 2);
  EXPECT_EQ(world.events().end.size(), 2u);
  for (BodyId piece : pieces) EXPECT_GE(names(world.events().begin, piece), 2);
  EXPECT_EQ(names(world.events().begin, bricks[3]), 0);
}

TEST(Replace, OldIdsAreStaleAndNewOnesAreTold) {
  World world = awakeWorld();
  std::vector<BodyId> bricks = column(world, 3);
  ShapeId shape = world.shapes(bricks[1])[0];
  std::vector<BodyId> pieces = replace(world, bricks[1]);
  EXPECT_FALSE(world.isValid(bricks[1]));
  EXPECT_EQ(world.shape(shape).error().code, ErrorCode::staleId);
  EXPECT_EQ(world.replaceBody(bricks[1], {}).error().code, ErrorCode::staleId);
  ASSERT_EQ(pieces.size(), 2u);
  EXPECT_LT(world.state(pieces[0])->position.x, world.state(pieces[1])->position.x) << "in the order given";
  EXPECT_EQ(world.bodies().size(), 5u);
}

TEST(Replace, AnyBadPieceAndNothingChanges) {
  WorldDef def;
  def.maxBodies = 4;
  World world = makeWorld(def);
  std::vector<BodyId> bricks = column(world, 3);
  std::vector<std::byte> before = world.snapshot();
  auto fails = [&](const std::vector<BodyDef>& pieces, ErrorCode code, const std::string& begin) {
    Result<std::vector<BodyId>> result = world.replaceBody(bricks[1], pieces);
    ASSERT_FALSE(result.ok());
    EXPECT_EQ(result.error().code, code);
    EXPECT_EQ(result.error().message.rfind(begin, 0), 0u) << result.error().message;
    EXPECT_EQ(world.snapshot(), before);
  };
  std::vector<BodyDef> halves = halvesOf(world, bricks[1]);
  fails(halves, ErrorCode::limitExceeded, "replaceBody: ");
  fails({}, ErrorCode::invalidArgument, "pieces: ");
  World roomy = awakeWorld();
  bricks = column(roomy, 3);
  before = roomy.snapshot();
  std::swap(world, roomy);
  halves[1].shapes[0].halfExtents.x = -1;
  fails(halves, ErrorCode::invalidArgument, "pieces[1].shapes[0].halfExtents.x: ");
}

// A ball that lies in a notch of two bricks, and one brick of fixed ground that becomes two: the other kinds of contacts.
TEST(Replace, WhatLiesOnAFixedBodyStaysOnItsPieces) {
  World world = awakeWorld();
  BodyDef slab = bodyOf(boxOf(kHalf), {0, -kHalf.y, 0}, BodyType::fixed);
  BodyId ground = add(world, slab);
  BodyId box = addBox(world, {0.03, 0.03, 0.03}, {0.05, 0.03, 0});
  BodyId ball = add(world, bodyOf(sphereOf(0.02), {-0.06, 0.02, 0}));
  for (int i = 0; i < 90; i++) stepSound(world);
  std::vector<BodyDef> halves;
  for (double side : {-1.0, 1.0}) {
    halves.push_back(
        bodyOf(boxOf({kHalf.x / 2, kHalf.y, kHalf.z}), {side * kHalf.x / 2, -kHalf.y, 0}, BodyType::fixed));
  }
  ASSERT_TRUE(world.replaceBody(ground, halves).ok());
  expectSound(world);
  EXPECT_LT(farthest(world, {box, ball}), 1e-5);
}

}  // namespace
}  // namespace brickfall
