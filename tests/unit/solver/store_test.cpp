// The end of a solve: what contacts remember of it, and what bodies do.
#include "solver/store.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstring>

#include "math/random.h"
#include "solver/finish/motion.h"
#include "solver/free_motion.h"
#include "support/test_island.h"

namespace brickfall {
namespace {

using test::kBrick;
using test::kBrickWeight;
using test::kCap;
using test::kG;
using test::OnGround;
using test::TestIsland;

TEST(Store, ForcesAreThoseOfTheFinalMotion) {
  OnGround lab;
  lab.load(lab.face, kBrickWeight, 1e4 * lab.unit(lab.face));
  lab.prepare();
  double k = 1e4 * lab.unit(lab.face), down = 2.0 / k, along = 0.5 / k;  // 2 N and 0.5 N more for each point
  Vec3 t1 = lab.contacts.geometry[lab.face].tangent1;
  lab.motion().d = toFloat(t1 * along + Vec3{0, -down, 0});
  EXPECT_TRUE(lab.store());
  const PointMemory& m = lab.points(lab.face);
  for (int i = 0; i < 4; i++) {
    EXPECT_NEAR(double(m.forceN[i]), kBrickWeight / 4 + 2, 1e-4);
    EXPECT_NEAR(double(m.force1[i]), -0.5, 1e-5);
    EXPECT_NEAR(double(m.force2[i]), 0, 1e-5);
    EXPECT_EQ(m.multiplierN[i], m.forceN[i]) << "far from a sudden load";
    EXPECT_EQ(m.multiplier1[i], m.force1[i]);
  }
  EXPECT_EQ(m.stickingMask, 15u);
}

TEST(Store, MultiplierGrowsByNoMoreThanFiveWeightsBeyondTwiceWhatItWas) {
  for (double held : {0.0, 10.0, 200.0})
    for (double force : {0.5 * kCap, held + 0.99 * kCap, held + 1.01 * kCap, held + 9 * kCap}) {
      OnGround lab;
      double k = 1e4 * lab.unit(lab.face);
      lab.load(lab.face, 4 * held, k);
      lab.prepare();
      // half of the held force and half of the gap's: at zero motion the force is the held one
      lab.motion().d = {float(1 / k), -float((force - held) / k), 0};
      lab.store();
      const PointMemory& m = lab.points(lab.face);
      double cap = held + kCap;  // half of it was held in the solve: twice that, and 5 weights
      for (int i = 0; i < 4; i++) {
        EXPECT_NEAR(double(m.forceN[i]), force, 1e-4 * force) << "the force itself is kept";
        EXPECT_NEAR(double(m.multiplierN[i]), std::min(force, cap), 1e-4 * force) << held << " held, now " << force;
        if (held > 0) {
          double size = std::hypot(double(m.force1[i]), double(m.force2[i]));
          EXPECT_NEAR(size, 1, 1e-3);
          EXPECT_NEAR(std::hypot(double(m.multiplier1[i]), double(m.multiplier2[i])), std::min(1.0, cap / force) * size,
                      1e-3);
        }
      }
    }
}

TEST(Store, StickingIsLoadedAndWithinTheFriction) {
  OnGround lab;
  double k = 1e4 * lab.unit(lab.face);
  lab.load(lab.face, kBrickWeight, k);
  lab.prepare();
  double each = kBrickWeight / 4, limit = 0.6 * each;
  lab.motion().d = {float(2 * limit / k), 0, 0};  // slides
  lab.store();
  PointMemory m = lab.points(lab.face);
  EXPECT_EQ(m.stickingMask, 0u);
  for (int i = 0; i < 4; i++) {
    EXPECT_NEAR(std::hypot(double(m.force1[i]), double(m.force2[i])), limit, 1e-4);
    EXPECT_NEAR(double(m.slip1[i]), -double(m.force1[i]) / k, 1e-6 * limit / k) << "where the spring carries the force";
    EXPECT_NEAR(double(m.slip2[i]), -double(m.force2[i]) / k, 1e-6 * limit / k);
  }
  lab.motion().d = {float(0.99 * limit / k), 0, 0};
  lab.store();
  EXPECT_EQ(lab.points(lab.face).stickingMask, 15u);
  EXPECT_EQ(lab.points(lab.face).slip1[0], 0);
  lab.motion().d = {0, float(1.01 * each / k), 0};  // lifted off
  lab.store();
  EXPECT_EQ(lab.points(lab.face).stickingMask, 0u) << "what carries nothing sticks to nothing";
  EXPECT_EQ(lab.points(lab.face).slip1[0], 0);
}

TEST(Store, NoAnchorIsPlacedFurtherThanThreeHundredthsOfTheInnerRadius) {
  OnGround lab;
  double k = lab.unit(lab.face);  // as soft as that: 100 N are 10 mm
  lab.load(lab.face, 4 * 100, k);
  lab.prepare();
  for (int i = 0; i < 4; i++) lab.points(lab.face).stiffness[i] = lab.island().rows.contacts.records[0].k[i] = float(k);
  lab.motion().d = {0.1f, 0, 0.1f};
  lab.store();
  const PointMemory& m = lab.points(lab.face);
  for (int i = 0; i < 4; i++) {
    EXPECT_NEAR(std::hypot(double(m.slip1[i]), double(m.slip2[i])), 0.03 * kReferenceSize, 1e-8);
    EXPECT_NEAR(double(m.slip1[i]) * double(m.force2[i]) - double(m.slip2[i]) * double(m.force1[i]), 0, 1e-6)
        << "along the force";
  }
}

TEST(Store, TellsWhenAContactBeginsOrCeasesToCarry) {
  OnGround lab;
  lab.prepare();
  lab.contacts.touchingChanged = false;
  for (auto [y, touches, changes] :
       {std::tuple{1e-6f, false, false}, {-1e-6f, true, true}, {-2e-6f, true, false}, {1e-6f, false, true}}) {
    lab.motion().d = {0, y, 0};
    lab.store();
    EXPECT_EQ(lab.contact(lab.face).touching, touches) << y;
    EXPECT_EQ(lab.contacts.touchingChanged, changes) << y;
    lab.contacts.touchingChanged = false;
  }
}

TEST(Store, AtAFixedPointNotOneBitChanges) {
  TestIsland lab;
  lab.pile(lab.ground(), 4);
  int steps = 0;
  while (!lab.island().settled() && steps < 200) {
    lab.step();
    steps++;
  }
  ASSERT_TRUE(lab.island().settled());
  std::vector<Contact> before = lab.contacts.contacts;
  auto sameBits = [&] {
    return std::memcmp(before.data(), lab.contacts.contacts.data(), before.size() * sizeof(Contact)) == 0;
  };
  lab.island().unsettle();
  lab.prepare();
  lab.checkRest();
  EXPECT_FALSE(lab.store());
  EXPECT_TRUE(sameBits());
  EXPECT_TRUE(lab.island().settled());
  lab.island().unsettle();
  lab.prepare();
  lab.checkRest();
  PointMemory& m = lab.points(1);
  m.multiplierN[2] *= 1 + 1e-5f;
  EXPECT_TRUE(lab.store()) << "a hundred thousandth of one force";
  EXPECT_FALSE(lab.island().settled());
  EXPECT_TRUE(sameBits()) << "and it is put right";
}

// A point at the edge of sliding may change its last bits for ever.
TEST(Store, WhatChangesByRoundingStaysToTheBit) {
  TestIsland lab;
  lab.pile(lab.ground(), 4);
  for (int step = 0; step < 200 && !lab.island().settled(); step++) lab.step();
  ASSERT_TRUE(lab.island().settled());
  lab.island().unsettle();
  lab.prepare();
  lab.checkRest();
  PointMemory& m = lab.points(1);
  const float other = m.multiplierN[2] = std::nextafter(m.multiplierN[2], 1e9f);
  EXPECT_FALSE(lab.store());
  EXPECT_TRUE(lab.island().settled());
  EXPECT_EQ(m.multiplierN[2], other);
}

TEST(Store, MotionBecomesVelocityAndAngularMomentum) {
  OnGround lab({0.5, 0, 0});
  lab.prepare();
  double h = lab.context.dt;
  const SolveMass free = lab.island().masses[0];
  lab.motion().d = {1e-3f, -2e-6f, -3e-3f};  // it presses on the ground
  lab.motion().th = {2e-3f, 0, 1e-3f};
  lab.island().ending = IslandEnding::balanced;
  auto store = [&] {
    storeRows(lab.island(), lab.ties(), lab.context);
    lab.island().groups.find(lab.island(), lab.context);
    storeMotion(lab.island(), lab.context);
  };
  store();
  const SolvedMotion& s = lab.context.solved[lab.body];
  EXPECT_NEAR(length(s.d - Vec3{1e-3, -2e-6, -3e-3}), 0, 1e-9);
  EXPECT_NEAR(length(s.velocity - s.d * (1 / h)), 0, 1e-12);
  EXPECT_NEAR(length(s.angularMomentum - lab.bodies.worldInertia(lab.body) * Vec3{2e-3, 0, 1e-3} * (1 / h)), 0, 1e-8);
  EXPECT_TRUE(!s.flying && !s.freeTurn && !s.rest);
  // What has parted goes its own way, whatever the solve left of its weight.
  lab.motion().d = free.dFree + Vec3f{0, 4e-3f, 0};
  lab.motion().th = free.thFree + Vec3f{1e-4f, 0, 0};
  store();
  EXPECT_TRUE(s.freeTurn && s.flying);
  EXPECT_EQ(s.d, lab.context.free[lab.body].d) << "in double";
  EXPECT_EQ(s.angularMomentum, lab.context.free[lab.body].angularMomentum);
  lab.island().ending = IslandEnding::rested;
  lab.island().groups.find(lab.island(), lab.context);
  storeMotion(lab.island(), lab.context);
  EXPECT_TRUE(s.rest && s.d == Vec3{} && s.velocity == Vec3{} && s.angularMomentum == Vec3{} && !s.freeTurn);
}

TEST(Store, GapsAndDriftsGoOnByTheMotionThatWasMade) {
  Random random(51);
  for (int n = 0; n < 20; n++) {
    OnGround lab({0.5, 0, 0});
    lab.prepare();
    lab.island().ending = IslandEnding::balanced;
    PointMemory before = lab.points(lab.face);
    SolvedMotion& s = lab.context.solved[lab.body];
    auto some = [&](double size) { return random.between(-size, size); };
    s.d = {some(1e-3), some(1e-3), some(1e-3)};
    s.th = {some(1e-3), some(1e-3), some(1e-3)};
    advanceRows(lab.island(), lab.ties(), lab.context);
    const ContactGeometry& g = lab.contacts.geometry[lab.face];
    Vec3 t2 = cross(g.normal, g.tangent1);
    const PointMemory& m = lab.points(lab.face);
    for (int i = 0; i < 4; i++) {
      Vec3 arm = g.centre + g.tangent1 * double(m.s1[i]) + t2 * double(m.s2[i]) - lab.at(lab.body).position;
      Vec3 way = s.d + cross(s.th, arm);
      EXPECT_NEAR(double(m.gap[i] - before.gap[i]), dot(g.normal, way), 1e-9);
      EXPECT_NEAR(double(m.drift1[i] - before.drift1[i]), dot(g.tangent1, way), 1e-9);
      EXPECT_NEAR(double(m.drift2[i] - before.drift2[i]), dot(t2, way), 1e-9);
    }
  }
  OnGround rests;
  rests.load(rests.face, kBrickWeight, 1e4 * rests.unit(rests.face));
  rests.prepare();
  rests.checkRest();
  PointMemory before = rests.points(rests.face);
  advanceRows(rests.island(), rests.ties(), rests.context);
  EXPECT_EQ(std::memcmp(&before, &rests.points(rests.face), sizeof before), 0);
}

TEST(Store, ABodyWithoutContactsFliesItsParabola) {
  TestIsland lab;
  BodyIndex body = lab.brick({});
  lab.at(body).linearVelocity = {3, 4, 0};
  lab.at(body).angularVelocity = {0, 2, 0};
  lab.link();
  predictFreeMotion(lab.context, lab.bodies, body, lab.context.dt, false);
  storeFreeBody(body, lab.context.dt, lab.context);
  const SolvedMotion& s = lab.context.solved[body];
  double h = lab.context.dt;
  EXPECT_NEAR(length(s.d - Vec3{3 * h, 4 * h - 0.5 * kG * h * h, 0}), 0, 1e-15);
  EXPECT_NEAR(length(s.velocity - Vec3{3, 4 - kG * h, 0}), 0, 1e-14);
  EXPECT_NEAR(length(s.angularMomentum - lab.bodies.worldInertia(body) * Vec3{0, 2, 0}), 0, 1e-15);
  EXPECT_TRUE(s.freeTurn && s.flying && !s.rest);
}

}  // namespace
}  // namespace brickfall
