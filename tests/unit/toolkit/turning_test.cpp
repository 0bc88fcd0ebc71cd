// Boxes that turn: against closed answers, against the boxes sampled in time, and against the sweep without turning.
#include <gtest/gtest.h>

#include <limits>
#include <numbers>

#include "obb_cases.h"
#include "pair_families.h"
#include "slow_boxes.h"

namespace brickfall {
namespace {

using test::Family;
using test::SlowBox;

Obb boxAt(Vec3 centre, Vec3 half) { return {centre, {}, half}; }

// A rod of half length 2 turns about z towards a small box beside it: contact when its flank reaches the box's corner.
TEST(Turning, RodMeetsAPost) {
  ObbMotion m;
  m.a = boxAt({0, 0, 0}, {2, 0.1, 0.5});
  m.b = boxAt({0, 1.5, 0}, {0.1, 0.1, 0.5});
  m.spinA = {0, 0, 1};
  // The flank's line is at 0.1 from the centre, turned by t; the corner (0.1, 1.4) is at distance x cos + ... of it.
  auto result = firstContactTurning(m, 3.0, 1e-9);
  ASSERT_TRUE(result);
  ASSERT_EQ(result->hit, ObbHit::contact);
  double expected = std::numbers::pi / 2 - std::atan2(0.1, 1.4) - std::asin(0.1 / std::hypot(0.1, 1.4));
  EXPECT_NEAR(result->time, expected, 1e-8);
  EXPECT_LE(result->time, expected);
  EXPECT_LE(result->gap, 1e-9);
  ASSERT_TRUE(result->confirmed);
  EXPECT_GE(result->latest, expected);
  EXPECT_LT(result->latest - result->time, 1e-7);
  // An edge of the post, level with the rod: a segment along z.
  EXPECT_EQ(result->contact.count, 2);
  EXPECT_NEAR(std::fabs(result->contact.points[0].position.z), 0.5, 1e-6);
  EXPECT_NEAR(result->contact.points[0].position.x, 0.1, 1e-6);
  EXPECT_NEAR(result->contact.points[0].position.y, 1.4, 1e-6);
}

TEST(Turning, SpinningPastWithoutTouching) {
  ObbMotion m;
  m.a = boxAt({0, 0, 0}, {1, 0.1, 0.1});
  m.b = boxAt({0, 1.3, 0}, {0.1, 0.1, 0.1});  // beyond the reach of the rod's corners, 1.01
  m.spinA = {0, 0, 5};
  auto result = firstContactTurning(m, 2.0, 1e-6);
  ASSERT_TRUE(result);
  EXPECT_EQ(result->hit, ObbHit::none);
}

TEST(Turning, OverlapAtTheStart) {
  ObbMotion m;
  m.spinB = {1, 2, 3};
  auto result = firstContactTurning(m, 1.0, 1e-6);
  ASSERT_TRUE(result);
  EXPECT_EQ(result->hit, ObbHit::overlapping);
  EXPECT_EQ(result->time, 0);
}

TEST(Turning, AgainstSamplesInTime) {
  Random random(77);
  int hits = 0, misses = 0, confirmed = 0, undecided = 0, most = 0;
  for (int k = 0; k < 400; k++) {
    test::FamilyPair pair = test::randomPair(random, k % 2 ? Family::generic : Family::thin);
    ObbMotion m = pair.motion;
    m.spinA = test::randomVector(random, 6), m.spinB = test::randomVector(random, 6);
    if (overlaps(m.a, m.b)) continue;
    const double size = length(m.a.halfExtents) + length(m.b.halfExtents), tolerance = 1e-6 * size, until = 1;
    auto result = firstContactTurning(m, until, tolerance);
    ASSERT_TRUE(result) << result.error().message;
    if (result->hit == ObbHit::undecided) {
      undecided++;
      continue;
    }
    most = std::max(most, result->steps);
    auto at = [&](double t) {
      return test::slowGap(SlowBox(advanced(m.a, m.velocityA, m.spinA, t)),
                           SlowBox(advanced(m.b, m.velocityB, m.spinB, t)));
    };
    // Never touching before.
    double end = result->hit == ObbHit::contact ? result->time : until;
    for (int s = 0; s <= 300; s++) EXPECT_GT(at(end * s / 300 * (1 - 1e-12)), 0) << "pair " << k << " at " << s;
    if (result->hit == ObbHit::none) {
      misses++;
      continue;
    }
    hits++;
    EXPECT_NEAR(at(result->time), result->gap, 1e-9 * size);
    EXPECT_LE(result->gap, tolerance);
    if (result->confirmed) {
      confirmed++;
      EXPECT_LE(at(result->latest), 1e-9 * size);
      EXPECT_GT(result->latest, result->time);
    }
    ASSERT_GT(result->contact.count, 0);
    EXPECT_NEAR(length(result->contact.normal), 1, 1e-9);
  }
  std::printf("  turning: %d hits (%d confirmed), %d misses, %d undecided, at most %d steps\n", hits, confirmed, misses,
              undecided, most);
  EXPECT_GE(hits, 50);
  EXPECT_GE(misses, 20);
  EXPECT_GE(confirmed, hits * 9 / 10);
  EXPECT_EQ(undecided, 0);
}

TEST(Turning, WithoutSpinAsTheSweep) {
  Random random(78);
  int hits = 0;
  for (int k = 0; k < 300; k++) {
    ObbMotion m = test::randomPair(random, Family(k % int(Family::sizeRatio))).motion;
    if (overlaps(m.a, m.b)) continue;
    const double size = length(m.a.halfExtents) + length(m.b.halfExtents);
    auto swept = firstContact(m, 1.0);
    auto turning = firstContactTurning(m, 1.0, 1e-9 * size);
    ASSERT_TRUE(swept);
    ASSERT_TRUE(turning);
    if (swept->hit == ObbHit::contact) {
      ASSERT_EQ(turning->hit, ObbHit::contact) << "pair " << k;
      // How far they may still be apart along the path depends on how squarely they meet.
      Vec3 w = m.velocityB - m.velocityA;
      double closing = -dot(swept->contact.normal, w);
      // Of boxes that hardly move against each other, rounding of the gap is a long time.
      EXPECT_LE(turning->time, swept->time + 1e-12 + (closing < 1e-6 * size ? 1e-9 * size / closing : 0));
      if (closing > 0.1 * length(w)) {
        EXPECT_NEAR(turning->time, swept->time, 1e-7 * size / closing);
      }
      hits++;
    } else if (turning->hit == ObbHit::contact) {
      EXPECT_FALSE(turning->confirmed) << "pair " << k;
    }
  }
  EXPECT_GE(hits, 60);
}

TEST(Turning, SinglePrecisionIsComputedInDouble) {
  Random random(79);
  int hits = 0;
  for (int k = 0; k < 100; k++) {
    ObbMotion m = test::randomPair(random, Family::generic).motion;
    m.spinB = test::randomVector(random, 3);
    auto exact = firstContactTurning(m, 1.0, 1e-4);
    auto single = firstContactTurning(test::as<float>(m), 1.0f, 1e-4f);
    ASSERT_TRUE(exact);
    ASSERT_TRUE(single) << single.error().message;
    if (exact->hit != ObbHit::contact || !exact->confirmed) continue;
    EXPECT_EQ(single->hit, ObbHit::contact);
    EXPECT_NEAR(double(single->time), exact->time, 1e-2);
    hits++;
  }
  EXPECT_GE(hits, 10);
}

}  // namespace
}  // namespace brickfall
