// A trial of an island's step: whatever it changed is put back, to the bit.
#include "solver/island_trial.h"

#include <cstring>

#include "support/test_island.h"

namespace brickfall {
namespace {

using namespace test;

template <class T> bool sameBits(const T& a, const T& b) { return std::memcmp(&a, &b, sizeof(T)) == 0; }

struct SamePoints {
  const PointMemory& other;
  const char* base;
  bool same = true;
  template <class T> void operator()(T& field, PointQuantity = {}) {
    const char* at = reinterpret_cast<const char*>(&field);
    same = same && std::memcmp(at, reinterpret_cast<const char*>(&other) + (at - base), sizeof(T)) == 0;
  }
};
bool samePoints(const PointMemory& a, const PointMemory& b) {
  SamePoints visitor{b, reinterpret_cast<const char*>(&a)};
  eachField(a, visitor);
  return visitor.same;
}

// Three bricks on each other, the uppermost sliding, and one that comes down on it.
struct SlidingBrick : TestIsland {
  SlidingBrick() {
    BodyIndex floor = ground();
    std::vector<BodyIndex> bricks = pile(floor, 3);
    BodyIndex falling = brick({0.05, 7 * kBrick.y + 2e-3, 0});
    ContactIndex top = touch(bricks[2], falling);
    contact(top).restitution = 0.5f;
    at(bricks[2]).linearVelocity = {1, 0, 0};
    at(falling).linearVelocity = {0.1, -1, 0};
    run(2);
  }
};

TEST(IslandTrial, PutsBackAllThatAPartOfTheStepChanged) {
  for (IslandPart part : {IslandPart::between, IslandPart::toImpact}) {
    SlidingBrick lab;
    Island& island = lab.island();
    const std::vector<BodyMotion> motions = lab.bodies.motion;
    const std::vector<Contact> contacts = lab.contacts.contacts;
    const std::vector<ContactGeometry> geometry = lab.contacts.geometry;
    const std::size_t struck = lab.contacts.struck.size();
    const double dt = island.dt;
    const IslandEnding ending = island.ending;
    std::vector<double> losses;
    for (BodyIndex body : lab.awake) losses.push_back(lab.bodies.data[body].impactLoss = 1e-3);

    IslandTrial trial(island, lab.ties(), lab.bodies);
    stepIsland(island, part, 0.3 * lab.context.dt, lab.ties(), lab.bodies, lab.context, lab.context.statistics);
    for (BodyIndex body : lab.awake) lab.bodies.data[body].impactLoss = 2e-3;
    lab.move();
    ASSERT_FALSE(samePoints(contacts[0].points, lab.contacts.contacts[0].points));
    trial.restore();

    EXPECT_EQ(island.dt, dt);
    EXPECT_EQ(island.ending, ending);
    EXPECT_EQ(island.part, IslandPart::last);
    EXPECT_EQ(island.facts.energy, findFacts(island, lab.context).energy) << "of its state now, not of the last step";
    for (std::size_t i = 0; i < lab.awake.size(); i++) {
      EXPECT_TRUE(sameBits(lab.bodies.motion[lab.awake[i]], motions[lab.awake[i]])) << i;
      EXPECT_EQ(lab.bodies.data[lab.awake[i]].impactLoss, losses[i]) << i;
    }
    for (std::size_t c = 0; c < contacts.size(); c++) {
      EXPECT_TRUE(samePoints(lab.contacts.contacts[c].points, contacts[c].points)) << c;
      EXPECT_EQ(lab.contacts.contacts[c].touching, contacts[c].touching) << c;
      EXPECT_EQ(lab.contacts.contacts[c].struck, contacts[c].struck) << c;
      EXPECT_TRUE(sameBits(lab.contacts.geometry[c], geometry[c])) << c;
    }
    EXPECT_EQ(lab.contacts.struck.size(), struck);
  }
}

// What comes next must not depend on whether something was tried before it.
TEST(IslandTrial, TheStepAfterItIsTheStepWithoutIt) {
  SlidingBrick tried, plain;
  IslandTrial trial(tried.island(), tried.ties(), tried.bodies);
  stepIsland(tried.island(), IslandPart::toImpact, tried.context.dt, tried.ties(), tried.bodies, tried.context,
             tried.context.statistics);
  trial.restore();
  tried.step();
  plain.step();
  for (BodyIndex body : plain.awake)
    EXPECT_TRUE(sameBits(tried.bodies.motion[body], plain.bodies.motion[body])) << body;
}

}  // namespace
}  // namespace brickfall
