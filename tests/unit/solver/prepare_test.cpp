// The start of a step: bodies in the solve's units, and the two return maps that make of what a point remembers the force that
// it has at zero motion (docs/step.md, "What a point remembers").
#include "solver/prepare.h"

#include <gtest/gtest.h>

#include <cmath>

#include "support/test_island.h"

namespace brickfall {
namespace {

using test::kBrick;
using test::kBrickMass;
using test::kCap;
using test::kG;
using test::OnGround;
using test::TestIsland;

// What a step leaves of a plastic offset (m): nine tenths, and less where 0.1 mm/s is more.
double offsetKept(double offset, double dt) { return std::min(0.0, std::max(0.9 * offset, offset + 1e-4 * dt)); }

TEST(Prepare, BodiesInUnitsOfTheStep) {
  for (double dt : {1.0 / 60, 1.0 / 240}) {
    TestIsland lab(dt);
    BodyIndex plate = lab.block({1, 0.1, 1}, {5, -0.1, 0}, BodyType::kinematic);
    Quat quarter = quatFromAxisAngle({0, 1, 0}, 1.5707963267948966);
    BodyIndex first = lab.brick({5, kBrick.y, 0}), second = lab.brick({5, 3 * kBrick.y, 0}, 5, kBrick, quarter);
    lab.touch(plate, first);
    lab.touch(first, second);
    lab.at(plate).linearVelocity = {0, 0, 0.5};
    lab.at(plate).angularVelocity = {0, 0.25, 0};
    lab.at(second).linearVelocity = {2, 0, 0};
    lab.at(second).angularVelocity = {0, 3, 0};
    lab.bodies.data[first].force = {27, 0, 0};
    lab.prepare();
    const Island& island = lab.island();
    const SolveMass &a = island.masses[0], &b = island.masses[1];
    EXPECT_FLOAT_EQ(a.mass, float(kBrickMass / (dt * dt)));
    EXPECT_FLOAT_EQ(a.dFree.x, float(10 * dt * dt)) << "27 N on 2.7 kg";
    EXPECT_FLOAT_EQ(a.dFree.y, float(-kG * dt * dt));
    EXPECT_FLOAT_EQ(b.dFree.x, float(2 * dt));
    EXPECT_FLOAT_EQ(b.thFree.y, float(3 * dt));
    EXPECT_FLOAT_EQ(b.position.y - a.position.y, float(2 * kBrick.y));
    double along = 5.0 / 3 * (kBrick.y * kBrick.y + kBrick.z * kBrick.z) / (dt * dt);  // about its long side
    EXPECT_NEAR(double(b.inertia[5]), along, 1e-5 * along) << "which lies along z";
    EXPECT_LT(double(b.inertia[5]), 0.4 * double(b.inertia[0]));
    ASSERT_EQ(island.motion.size(), 3u);
    EXPECT_FLOAT_EQ(island.motion[2].d.z, float(0.5 * dt)) << "the partner goes its way";
    EXPECT_FLOAT_EQ(island.motion[2].th.y, float(0.25 * dt));
  }
}

TEST(Prepare, TheCommonWayOfAFloatingIslandIsLeftOut) {
  TestIsland lab;
  BodyIndex light = lab.brick({}), heavy = lab.brick({0, 2 * kBrick.y, 0}, 10 * kBrickMass);
  lab.touch(light, heavy);
  lab.at(light).linearVelocity = {40, 0, 0.011};
  lab.at(heavy).linearVelocity = {40, 0, 0};
  lab.prepare();
  const Island& island = lab.island();
  double h = lab.context.dt;
  EXPECT_NEAR(island.rigid.move.x, 40 * h, 1e-15);
  EXPECT_NEAR(island.rigid.move.y, -kG * h * h, 1e-15);
  EXPECT_NEAR(island.rigid.move.z, 0.001 * h, 1e-15);
  EXPECT_NEAR(double(island.masses[0].dFree.z), 0.01 * h, 1e-10);
  EXPECT_NEAR(double(island.masses[1].dFree.z), -0.001 * h, 1e-11);
}

TEST(Prepare, APointBornSlowlyRests) {
  OnGround slow({0, -0.299, 0}, 1e-3);
  slow.prepare();
  EXPECT_EQ(slow.phase(), PointPhase::resting);
  EXPECT_NEAR(slow.stiffness(), 1000, 1e-3);
  const FaceRecord& r = slow.record();
  for (int i = 0; i < 4; i++) {
    EXPECT_NEAR(double(slow.island().rows.contacts.starts[0].approach[i]), -0.299, 1e-6);
    EXPECT_EQ(r.k[i], slow.points(slow.face).stiffness[i]);
    EXPECT_NEAR(double(r.trialN[i]), -1000 * slow.unit(slow.face) * 1e-3, 1) << "all of an open gap has to close";
    EXPECT_EQ(r.limit[i], 0);
  }
  EXPECT_EQ(r.newPoints, 15u);
  OnGround calm;
  calm.prepare();
  EXPECT_NEAR(calm.stiffness(), 10000, 1e-2) << "one calm body: ten times";
}

TEST(Prepare, APointBornFastIsAnImpactOfThirtyUnits) {
  OnGround fast({0, -0.301, 0});
  fast.prepare();
  EXPECT_EQ(fast.phase(), PointPhase::impact);
  EXPECT_NEAR(fast.stiffness(), 30, 1e-4);
}

TEST(Prepare, NoImpactIsSofterThanTheBodiesAreThick) {
  // At k units it stops after v h / (1 + k): on the ground, which has no thickness, at most half the brick's inner radius.
  for (double v : {20.0, 60.0, 300.0, 1e4}) {
    OnGround lab({0, -v, 0});
    lab.prepare();
    double needed = v * lab.context.dt / (0.5 * kBrick.y);
    EXPECT_NEAR(lab.stiffness(), std::clamp(needed, 30.0, 1000.0), 1e-3 * needed) << v;
    EXPECT_EQ(lab.phase(), needed < 990 ? PointPhase::impact : PointPhase::resting) << v << ": as stiff as what rests";
  }
  TestIsland two;
  BodyIndex thin = two.brick({}, 1, {0.1, 0.01, 0.1}), thick = two.brick({0, 0.05, 0}, 1, {0.1, 0.04, 0.1});
  ContactIndex face = two.touch(thin, thick);
  two.at(thick).linearVelocity = {0, -90, 0};
  two.prepare();
  EXPECT_NEAR(double(two.points(face).stiffness[0]) / two.unit(face), 90.0 / 60 / 0.025, 1e-2);
}

TEST(Prepare, OverlapAtBirthIsPlasticAndReleasedByATenthAStep) {
  OnGround lab({0, -0.1, 0});
  for (float& gap : lab.points(lab.face).gap) gap = -1e-3f;
  for (int step = 1; step <= 20; step++) {
    lab.prepare();
    double kept = std::pow(0.9, step) * 1e-3;
    EXPECT_NEAR(double(lab.points(lab.face).offset[0]), -kept, 1e-8);
    EXPECT_NEAR(double(lab.record().trialN[2]), 0.5 * 1000 * lab.unit(lab.face) * (1e-3 - kept), 0.1)
        << "half of the rest of the gap is corrected";
  }
  for (float& gap : lab.points(lab.face).gap) gap = -1e-5f;  // parted since: what is left is all plastic
  lab.prepare();
  EXPECT_NEAR(double(lab.points(lab.face).offset[0]), offsetKept(-1e-5, 1.0 / 60), 1e-10);
  for (float& gap : lab.points(lab.face).gap) gap = 1e-5f;
  lab.prepare();
  EXPECT_EQ(lab.points(lab.face).offset[0], 0);
}

// By tenths alone it would go on for a second, and what lies on it would not rest.
TEST(Prepare, TheLastOfAnOffsetGoesByATenthOfAMillimetreASecond) {
  OnGround lab({0, -0.1, 0});
  const double part = 1e-4 / 60;
  lab.remember(PointPhase::resting, 1000 * lab.unit(lab.face), -1e-3, -5.5 * part, 1);
  for (int step = 1; step <= 6; step++) {
    lab.prepare();
    EXPECT_NEAR(double(lab.points(lab.face).offset[0]), std::min(0.0, (step - 5.5) * part), 1e-12);
  }
  EXPECT_EQ(lab.points(lab.face).offset[0], 0) << "to the last bit";
}

TEST(Prepare, TheEndOfAnImpactGoesOnWithItsForceUpToFiveWeights) {
  for (double force : {10.0, 100.0, 1000.0})  // N a point, of 132 N
    for (double gap : {-1e-3, -2e-4}) {
      OnGround lab({0, -0.2, 0});
      double k = 1000 * lab.unit(lab.face);
      lab.remember(PointPhase::impact, 30 * lab.unit(lab.face), gap, 0, force);
      lab.points(lab.face).force1[1] = lab.points(lab.face).multiplier1[1] = 5;
      lab.prepare();
      double left = std::min(force, kCap), share = left / force;
      const PointMemory& m = lab.points(lab.face);
      EXPECT_EQ(lab.phase(), PointPhase::resting);
      EXPECT_NEAR(lab.stiffness(), 1000, 1e-3);
      EXPECT_NEAR(double(m.forceN[1]), left, 1e-3);
      EXPECT_NEAR(double(m.multiplierN[1]), left, 1e-3);
      EXPECT_NEAR(double(m.force1[1]), 5 * share, 1e-5) << "friction goes down with it";
      EXPECT_NEAR(double(m.multiplier1[1]), 5 * share, 1e-5);
      // Chosen so that k (offset - gap) is the force; a tenth of it released in the same step.
      double offset = 0.9 * std::min(0.0, gap + left / k);
      EXPECT_NEAR(double(m.offset[1]), offset, 1e-9);
      EXPECT_NEAR(double(lab.record().trialN[1]), 0.5 * left + 0.5 * k * (offset - gap), 0.05);
      EXPECT_NEAR(double(lab.record().limit[1]), 0.6 * left, 1e-3);
    }
}

TEST(Prepare, AnImpactGoesOnWhileItCarriesNothing) {
  OnGround open({0, -0.2, 0});
  open.remember(PointPhase::impact, 30 * open.unit(open.face), 1e-3, 0, 0);
  open.prepare();
  EXPECT_EQ(open.phase(), PointPhase::impact);
  EXPECT_NEAR(open.stiffness(), 30, 1e-4);
}

TEST(Prepare, AnImpactThatStillClosesIsFirmAfterItsFirstStep) {
  OnGround closes({0, -0.31, 0});
  closes.remember(PointPhase::impact, 30 * closes.unit(closes.face), -1e-3, 0, 1000);
  closes.prepare();
  EXPECT_EQ(closes.phase(), PointPhase::resting);
  EXPECT_NEAR(closes.stiffness(), 1000, 1e-2);
  EXPECT_EQ(closes.points(closes.face).forceN[0], 1000);
}

TEST(Prepare, ASlidingPointGetsTheAnchorAtWhichItsSpringCarriesItsForce) {
  OnGround lab({1, 0, 0.5});
  for (int step = 0; step < 3; step++) lab.step();
  const PointMemory before = lab.points(lab.face);
  ASSERT_EQ(before.stickingMask, 0u) << "slides";
  ASSERT_GT(before.forceN[0], 1);
  lab.prepare();
  const PointMemory& m = lab.points(lab.face);
  const ContactGeometry& g = lab.contacts.geometry[lab.face];
  const FaceRecord& r = lab.record();
  Vec3 t1 = toDouble(r.t1), t2 = cross(toDouble(r.n), t1);
  for (int i = 0; i < 4; i++) {
    double size = std::hypot(double(m.force1[i]), double(m.force2[i]));
    // One step back limits it: 0.6 of the normal force that the point had then.
    EXPECT_NEAR(double(r.trial1[i]), double(before.force1[i]), 1e-5 * size);
    EXPECT_NEAR(double(r.trial2[i]), double(before.force2[i]), 1e-5 * size);
    EXPECT_NEAR(double(m.drift1[i]), -double(before.force1[i]) / double(m.stiffness[i]),
                1e-5 * size / double(m.stiffness[i]));
    Vec3 apart = lab.at(lab.body).position + lab.at(lab.body).orientation * g.anchorB[i] - g.anchorA[i];
    EXPECT_NEAR(dot(t1, apart), double(m.drift1[i]), 1e-9) << "the anchor lies where the drift says";
    EXPECT_NEAR(dot(t2, apart), double(m.drift2[i]), 1e-9);
  }
}

TEST(Prepare, AnAnchorThatSticksIsKeptUpToThreeHundredthsOfTheInnerRadius) {
  for (float drift : {0.97e-3f, 0.98e-3f}) {
    OnGround lab;
    lab.remember(PointPhase::resting, 1e4 * lab.unit(lab.face), 0, 0, 5);
    const ContactGeometry& g = lab.contacts.geometry[lab.face];
    Vec3 anchor = g.anchorA[2], way = cross(g.normal, g.tangent1) * double(drift);
    lab.points(lab.face).drift2[2] = drift;
    lab.at(lab.body).position += way;
    lab.prepare();
    bool kept = drift < 0.975e-3f;
    EXPECT_EQ(lab.points(lab.face).drift2[2], kept ? drift : 0);
    EXPECT_NEAR(length(g.anchorA[2] - anchor - (kept ? Vec3{} : way)), 0, 1e-9);
    EXPECT_FLOAT_EQ(lab.record().trial2[2], kept ? -0.5f * drift * lab.points(lab.face).stiffness[2] : 0.0f);
  }
}

TEST(Prepare, ShorterStepsMakeAPointStiffAtOnce) {
  OnGround lab({0, -0.1, 0}, 0, 1.0 / 120);
  double old = 250 * lab.unit(lab.face), k = 1000 * lab.unit(lab.face);  // 1000 u of steps twice as long
  lab.remember(PointPhase::resting, old, -20 / old, 0, 20);
  lab.prepare();
  EXPECT_NEAR(lab.stiffness(), 1000, 1e-3);
  EXPECT_EQ(lab.phase(), PointPhase::resting);
  EXPECT_NEAR(double(lab.points(lab.face).offset[0]), offsetKept(-20 / old + 20 / k, 1.0 / 120), 1e-9)
      << "it carries on with 20 N";
  OnGround idle({0, -0.1, 0}, 0, 1.0 / 120);
  idle.remember(PointPhase::resting, old, 1e-4, 0, 0);
  idle.prepare();
  EXPECT_NEAR(idle.stiffness(), 250, 1e-3) << "not before it carries something";
}

TEST(Prepare, LongerStepsMakeAPointSofterAtOnce) {
  for (double gap : {-1e-6, -1e-3}) {  // less overlap than the softer point needs for its force, and more
    OnGround lab({0, -0.1, 0}, 0, 1.0 / 60);
    double old = 4000 * lab.unit(lab.face), k = 1000 * lab.unit(lab.face);
    lab.remember(PointPhase::resting, old, gap, std::min(0.0, gap + 20 / old), 20);
    lab.prepare();
    EXPECT_NEAR(lab.stiffness(), 1000, 1e-3);
    EXPECT_FLOAT_EQ(lab.points(lab.face).forceN[0], 20);
    EXPECT_NEAR(double(lab.points(lab.face).offset[0]), offsetKept(std::min(0.0, gap + 20 / k), 1.0 / 60), 1e-9)
        << "it carries on with 20 N as far as it overlaps";
  }
}

// In the last thousandth of a step the force of a blow is a thousand times what the step bears.
TEST(Prepare, APointMadeSofterHoldsNoMoreOfABlow) {
  OnGround lab({0, -0.1, 0}, 0, 1.0 / 60);
  const double k = 1000 * lab.unit(lab.face);
  lab.remember(PointPhase::resting, 1e6 * k, -5e-3, -5e-3, 1e5);
  for (float& held : lab.points(lab.face).multiplierN) held = 20;
  lab.prepare();
  EXPECT_NEAR(lab.stiffness(), 1000, 1e-3);
  EXPECT_NEAR(double(lab.points(lab.face).offset[0]), offsetKept(-5e-3 + 100 / k, 1.0 / 60), 1e-9)
      << "100 N of the softer point are the energy of 1e5 N";
}

TEST(Prepare, UnusedLanesDoNothing) {
  TestIsland lab;
  BodyIndex under = lab.ground();
  BodyIndex body = lab.brick({0, 0.06 * std::sqrt(0.5) * 2, 0}, 1, {0.06, 0.06, 0.06},
                             quatFromAxisAngle({1, 0, 0}, 0.7853981633974483));
  ContactIndex edge = lab.touch(under, body);  // on an edge
  ASSERT_EQ(lab.contact(edge).count, 2);
  lab.points(edge).forceN[0] = lab.points(edge).multiplierN[0] = 3;
  lab.prepare();
  const FaceRecord& r = lab.record();
  EXPECT_EQ(r.newPoints, 2u);
  EXPECT_FLOAT_EQ(r.limit[0], 0.6f * 3);
  for (int i : {2, 3})
    EXPECT_TRUE(r.k[i] == 0 && r.trialN[i] == 0 && r.trial1[i] == 0 && r.trial2[i] == 0 && r.limit[i] == 0 &&
                r.leastN[i] == 0);
}

}  // namespace
}  // namespace brickfall
