// What shapes will meet: against where they really first touch, found by small steps.
#include "world/look_ahead.h"

#include <gtest/gtest.h>

#include <cmath>

#include "geometry/queries.h"
#include "math/random.h"
#include "narrowphase/collide.h"
#include "support/random_geometry.h"
#include "unit/world/shape_data.h"

namespace brickfall {
namespace {

using namespace test;

constexpr double kStep = 1.0 / 60, kMargin = 0.005, kReach = 5;

struct Looked {
  AheadFound found = AheadFound::asNow;
  Manifold before, after;
};
Looked ahead(const ShapeData& a, const ShapeData& b, const RelativeMotion& motion) {
  Looked out;
  collide(a.geometry, b.geometry, inverse(a.inCentreFrame) * motion.pose * b.inCentreFrame, kReach, out.before);
  out.after = out.before;
  out.found = lookAhead(a, b, motion, kStep, {kReach, kMargin}, out.after).found;
  return out;
}

TEST(LookAhead, BallThatFliesPastAnEdgeMeetsNothing) {
  const ShapeData block = boxShape({0.1, 0.3, 0.1});
  for (double speed : {2.0, 10.0, 60.0})
    for (double clearance : {0.006, 0.02})
      for (double spin : {0.0, 30.0}) {
        const double along = 0.3 + 0.4 * speed * kStep;  // m, it is beside the edge within the step
        RelativeMotion motion{{{0.2 + clearance, along, 0}, {}}, {0, -speed, 0}, {}, {0, 0, spin}};
        Looked found = ahead(block, ballShape(0.1), motion);
        EXPECT_EQ(found.before.count, 1);
        EXPECT_EQ(found.found, AheadFound::passes) << speed << " m/s, " << clearance << " m beside it, spin " << spin;
      }
  RelativeMotion both{{{0.206, 0.2, 0}, {}}, {0, -30, 0}, {}, {}};
  EXPECT_EQ(ahead(ballShape(0.1), ballShape(0.1), both).found, AheadFound::passes);
}

// The plane that keeps a ball from a box is met when they touch, and stands as the box's surface does there.
TEST(LookAhead, BallMeetsWhatItReallyTouches) {
  Random random(7);
  const ShapeData block = boxShape({0.3, 0.2, 0.25}), sphere = ballShape(0.08);
  int hits = 0, turned = 0;
  for (int k = 0; k < 400; k++) {
    RelativeMotion motion;
    motion.pose.position = {random.between(-0.7, 0.7), random.between(0.3, 0.6), random.between(-0.7, 0.7)};
    Vec3 aim{random.between(-0.3, 0.3), random.between(-0.2, 0.2), random.between(-0.25, 0.25)};
    motion.velocity = normalized(aim - motion.pose.position) * random.between(5, 50);
    motion.spinB = {random.between(-20, 20), random.between(-20, 20), random.between(-20, 20)};
    const double least = 1e-3;
    double when = 0;  // s, of the first touch
    Manifold now;
    auto apart = [&](double time) {
      collide(block.geometry, sphere.geometry, {motion.pose.position + motion.velocity * time, {}}, kReach, now);
      return now.points[0].separation;
    };
    if (apart(0) < least) continue;
    while (when < kStep && apart(when) > 0) when += kStep / 4000;
    if (when >= kStep || apart(std::min(kStep, when + 5e-3 / length(motion.velocity))) > -least)
      continue;  // it only grazes
    apart(when);
    Looked found = ahead(block, sphere, motion);
    ASSERT_EQ(found.after.count, 1) << k;
    ASSERT_NE(found.found, AheadFound::passes) << k;
    hits++;
    turned += dot(found.before.normal, now.normal) < 0.95;
    const ManifoldPoint& p = found.after.points[0];
    EXPECT_GT(dot(found.after.normal, now.normal), 0.9999) << k;
    EXPECT_NEAR(p.separation, -dot(now.normal, motion.velocity) * when, 2e-3) << k << ": closed when it is there";
    EXPECT_NEAR(length(p.onB - (motion.pose.position - found.after.normal * 0.08)), 0, 1e-9)
        << "on the ball, where it is now";
    EXPECT_NEAR(length(p.onB - p.onA - found.after.normal * p.separation), 0, 1e-12);
  }
  EXPECT_GT(hits, 60);
  EXPECT_GT(turned, 15) << "of them the nearest point at the start says something else";
}

TEST(LookAhead, BoxSlidesOverASeam) {
  const ShapeData tile = boxShape({0.1, 0.03, 0.1}), slider = boxShape({0.05, 0.05, 0.05});
  for (double sunk : {0.0, 2e-5, 5e-4}) {
    RelativeMotion motion{{{-0.17, 0.08 - sunk, 0}, {}}, {3, 0, 0}, {}, {}};  // 20 mm before the tile's edge
    Looked found = ahead(tile, slider, motion);
    EXPECT_TRUE(sunk == 0 || found.before.count > 0) << "the side of the tile is nearest";
    EXPECT_TRUE(sunk == 0 || found.found == AheadFound::passes) << sunk;
  }
  for (double step : {0.005, 0.02}) {  // m, the tile stands higher by so much
    RelativeMotion motion{{{-0.17, 0.08 - step, 0}, {}}, {3, 0, 0}, {}, {}};
    Looked found = ahead(tile, slider, motion);
    EXPECT_EQ(found.found, AheadFound::asNow) << step;
    EXPECT_LT(found.after.normal.x, -0.9) << "it hits the side";
  }
}

// What a ball or a capsule meets is the same from either side, in frames of their own, off their bodies' centres, with spins.
TEST(LookAhead, IsTheSameSeenFromEitherBody) {
  Random random(11);
  int meets = 0, passes = 0;
  for (int k = 0; k < 600; k++) {
    ShapeData block = boxShape({0.3, 0.2, 0.25}), round = k % 2 == 0 ? ballShape(0.08) : capsuleShape(0.06, 0.1);
    block.inCentreFrame = {{random.between(-0.1, 0.1), random.between(-0.1, 0.1), 0.05}, randomRotation(random)};
    if (k % 3 == 0) round.inCentreFrame = {{0, random.between(-0.05, 0.05), 0.02}, randomRotation(random)};
    const Vec3 from = randomDirection(random) * random.between(0.5, 0.9);
    RelativeMotion motion;
    motion.pose = {from, randomRotation(random)};
    motion.velocity = normalized(randomDirection(random) * 0.4 - from) * random.between(10, 60);
    motion.spinA = randomDirection(random) * random.between(0, 8);
    motion.spinB = randomDirection(random) * random.between(0, 8);
    // The same two, B first: all in its frame.
    const Quat back = conjugate(motion.pose.rotation);
    const RelativeMotion other{inverse(motion.pose), rotate(back, -motion.velocity), rotate(back, motion.spinB),
                               rotate(back, motion.spinA)};
    const Looked one = ahead(block, round, motion), two = ahead(round, block, other);
    ASSERT_EQ(one.found, two.found) << k;
    meets += one.found == AheadFound::meets;
    passes += one.found == AheadFound::passes;
    if (one.found != AheadFound::meets) continue;
    ASSERT_EQ(one.after.count, two.after.count) << k;
    // Both normals and places in the frame of the block's body.
    const Quat toA = motion.pose.rotation * round.inCentreFrame.rotation;
    const Vec3 normal = rotate(block.inCentreFrame.rotation, one.after.normal);
    EXPECT_GT(dot(normal, rotate(toA, -two.after.normal)), 1 - 1e-4) << k;
    EXPECT_NEAR(one.after.points[0].separation, two.after.points[0].separation, 5e-4) << k;
    const Vec3 onRound = transformPoint(block.inCentreFrame, one.after.points[0].onB);
    const Vec3 same = transformPoint(motion.pose * round.inCentreFrame, two.after.points[0].onA);
    EXPECT_LT(length(onRound - same), 5e-3) << k << ", on the round body, where it is now";
  }
  EXPECT_GT(meets, 100);
  EXPECT_GT(passes, 20);
}

// Thin plates that meet face on have passed each other by the time that an edge would tell: they are no edges.
TEST(LookAhead, PlatesThatMeetFaceOnHit) {
  for (double half : {2e-4, 1e-3, 5e-3}) {
    RelativeMotion motion{{{0.01, 2 * half + 0.01, 0}, {}}, {0, -5, 0}, {}, {}};
    EXPECT_EQ(ahead(boxShape({0.1, half, 0.1}), boxShape({0.1, half, 0.1}), motion).found, AheadFound::asNow) << half;
  }
}

TEST(LookAhead, WhatHardlyMovesStaysAsItIs) {
  for (double speed : {0.0, 0.05}) {
    RelativeMotion motion{{{0.15, 0.4, 0}, {}}, {0, -speed, 0}, {}, {}};
    EXPECT_EQ(ahead(boxShape({0.1, 0.3, 0.1}), ballShape(0.1), motion).found, AheadFound::asNow);
  }
}

}  // namespace
}  // namespace brickfall
