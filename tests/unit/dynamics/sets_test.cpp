// Slots of bodies, shapes, contacts; combination rules; sorted pairs.
#include <gtest/gtest.h>

#include "dynamics/contact_set.h"
#include "dynamics/shape_set.h"
#include "dynamics/ties.h"

namespace brickfall {
namespace {

TEST(BodySet, KeepsSlotsAndReusesThemWithNewGenerations) {
  BodySet bodies;
  BodyIndex a = bodies.create(), b = bodies.create(), c = bodies.create();
  EXPECT_EQ(bodies.count(), 3);
  EXPECT_EQ(bodies.inOrder(), (std::vector<BodyIndex>{a, b, c}));
  std::uint16_t before = bodies.data[b].generation;
  bodies.destroy(b);
  EXPECT_FALSE(bodies.alive(b));
  EXPECT_TRUE(bodies.alive(c));
  EXPECT_FALSE(bodies.alive(99));
  EXPECT_EQ(bodies.count(), 2);
  BodyIndex d = bodies.create();
  EXPECT_EQ(d, b) << "the free slot is used again";
  EXPECT_NE(bodies.data[d].generation, before);
  EXPECT_EQ(bodies.inOrder(), (std::vector<BodyIndex>{a, c, d})) << "in order of creation, not of slots";
}

TEST(BodySet, AReusedSlotForgetsEverything) {
  BodySet bodies;
  BodyIndex a = bodies.create();
  bodies.data[a].gravityScale = 7;
  bodies.data[a].force = {1, 2, 3};
  bodies.data[a].quarantined = true;
  bodies.motion[a].linearVelocity = {1, 0, 0};
  bodies.mass[a].mass = 5;
  bodies.shapes[a].push_back(3);
  bodies.destroy(a);
  ASSERT_EQ(bodies.create(), a);
  EXPECT_EQ(bodies.data[a].gravityScale, 1);
  EXPECT_EQ(bodies.data[a].force, (Vec3{}));
  EXPECT_FALSE(bodies.data[a].quarantined);
  EXPECT_EQ(bodies.motion[a].linearVelocity, (Vec3{}));
  EXPECT_EQ(bodies.mass[a].mass, 0);
  EXPECT_TRUE(bodies.shapes[a].empty());
}

TEST(BodySet, GenerationsNeverBecomeZero) {
  BodySet bodies;
  BodyIndex a = bodies.create();
  for (int i = 0; i < 70000; i++) {
    bodies.destroy(a);
    a = bodies.create();
    ASSERT_NE(bodies.data[a].generation, 0) << i;
  }
}

TEST(BodySet, EnergyAndInertiaFollowTheOrientation) {
  BodySet bodies;
  BodyIndex a = bodies.create();
  bodies.mass[a].mass = 2;
  bodies.mass[a].inertia = diagonal(Vec3{1, 2, 3});
  bodies.mass[a].invInertia = inverse(bodies.mass[a].inertia);
  bodies.setRotation(a, quatFromAxisAngle({0, 0, 1}, 3.14159265358979323846 / 2));  // body x is world y
  bodies.motion[a].linearVelocity = {3, 0, 0};
  bodies.motion[a].angularVelocity = {0, 4, 0};
  EXPECT_NEAR(bodies.kineticEnergy(a), 0.5 * 2 * 9 + 0.5 * 1 * 16, 1e-12);
  EXPECT_NEAR(bodies.worldInertia(a).row[1].y, 1, 1e-12);
  EXPECT_NEAR(bodies.worldInvInertia(a).row[0].x, 0.5, 1e-12);
}

TEST(ContactSet, KeepsPairsSortedAndKnownOnesAsTheyAre) {
  ContactSet set;
  auto pair = [](ShapeIndex a, ShapeIndex b) { return CandidatePair{a, b, a, b, kNoIndex}; };
  set.insert({pair(1, 5), pair(2, 3)});
  set.pairs[0].contact = set.create();
  set.insert({pair(0, 9), pair(1, 5), pair(1, 6), pair(7, 8)});
  ASSERT_EQ(set.pairs.size(), 5u);
  for (std::size_t i = 1; i < set.pairs.size(); i++) EXPECT_TRUE(set.pairs[i - 1] < set.pairs[i]);
  EXPECT_EQ(set.pairs[1].shapeB, 5u);
  EXPECT_EQ(set.pairs[1].contact, 0u) << "a known pair lost its contact";
  set.insert({});
  EXPECT_EQ(set.pairs.size(), 5u);
}

TEST(ContactSet, ReusesSlotsFresh) {
  ContactSet set;
  ContactIndex a = set.create();
  set.contacts[a].count = 3;
  set.contacts[a].points.multiplierN[1] = 7;
  set.changed = false;
  set.destroy(a);
  EXPECT_TRUE(set.changed);
  ASSERT_EQ(set.create(), a);
  EXPECT_EQ(set.contacts[a].count, 0);
  EXPECT_EQ(set.contacts[a].points.multiplierN[1], 0);
  EXPECT_TRUE(set.contacts[a].born);
}

TEST(Ties, SleepWakeAndGoWithTheirBodies) {
  auto pair = [](ShapeIndex a, ShapeIndex b) { return CandidatePair{a, b, a, b, kNoIndex, 0}; };
  Ties ties;
  ties.contacts.insert({pair(0, 1), pair(1, 2), pair(3, 4)});
  for (CandidatePair& p : ties.contacts.pairs)
    if (p.shapeA != 1) p.contact = ties.contacts.create();
  auto namesOf = [&](bool asleep) {
    std::vector<BodyIndex> out;
    auto take = [&](const Link& link) {
      EXPECT_EQ(link.kind, LinkKind::contact);
      out.push_back(link.bodyA);
    };
    if (asleep)
      ties.eachAsleep(take);
    else
      ties.eachAwake(take);
    return out;
  };
  using Bodies = std::vector<BodyIndex>;
  EXPECT_EQ(namesOf(false), (Bodies{0, 3})) << "a pair without points ties nothing";
  EXPECT_FALSE(ties.anyAsleep());
  ties.sleepWhere([](BodyIndex a, BodyIndex b) { return a == 3 && b == 4; });
  EXPECT_TRUE(ties.anyAsleep());
  EXPECT_EQ(namesOf(false), (Bodies{0}));
  EXPECT_EQ(namesOf(true), (Bodies{3}));
  ties.islandsAreBuilt();
  EXPECT_FALSE(ties.changed());
  ties.dropOf(4);
  EXPECT_EQ(namesOf(true), Bodies{}) << "asleep or not";
  EXPECT_TRUE(ties.changed());
  ties.sleepWhere([](BodyIndex, BodyIndex) { return true; });
  ties.wakeWhere([](BodyIndex a, BodyIndex) { return a == 0; });
  EXPECT_EQ(namesOf(false), (Bodies{0}));
  EXPECT_TRUE(ties.anyAsleep()) << "the pair without points";
  EXPECT_TRUE(ties.mayCollide(0, 1)) << "a contact forbids nothing";
}

TEST(Mixing, EveryRuleIsSymmetricAndTheLaterWins) {
  const CombineRule rules[] = {CombineRule::geometricMean, CombineRule::average, CombineRule::minimum,
                               CombineRule::multiply, CombineRule::maximum};
  const double expected[] = {0.4, 0.5, 0.2, 0.16, 0.8};
  Material a, b;
  a.friction = a.restitution = 0.2;
  b.friction = b.restitution = 0.8;
  for (int i = 0; i < 5; i++)
    for (int j = 0; j < 5; j++) {
      a.frictionRule = a.restitutionRule = rules[i];
      b.frictionRule = b.restitutionRule = rules[j];
      EXPECT_NEAR(mixFriction(a, b), expected[std::max(i, j)], 1e-12);
      EXPECT_EQ(mixFriction(a, b), mixFriction(b, a));
      EXPECT_NEAR(mixRestitution(a, b), expected[std::max(i, j)], 1e-12);
      EXPECT_EQ(mixRestitution(a, b), mixRestitution(b, a));
    }
}

}  // namespace
}  // namespace brickfall
