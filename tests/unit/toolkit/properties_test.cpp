// What must not depend on how a pair is looked at: which box comes first, from where, in what unit. And what must be an error.
#include <gtest/gtest.h>

#include <array>
#include <limits>
#include <vector>

#include "obb_cases.h"
#include "pair_families.h"

namespace brickfall {
namespace {

using test::Family;
using test::nameOf;

constexpr int kFamilies = int(Family::count);
constexpr int kPairs = 200;  // of each family

// Row of the same axis when A and B change places.
int swappedRow(int row) {
  if (row < 0) return row;
  if (row < 6) return (row + 3) % 6;
  return 6 + 3 * ((row - 6) % 3) + (row - 6) / 3;
}

double size(const ObbMotion& m) { return length(m.a.halfExtents) + length(m.b.halfExtents); }

ObbMotion moved(const ObbMotion& m, const Transform& pose, double scale) {
  ObbMotion out = m;
  for (Obb* box : {&out.a, &out.b}) {
    box->centre = transformPoint(pose, box->centre * scale);
    box->halfExtents *= scale;
    for (Vec3& axis : box->axes.row) axis = rotate(pose.rotation, axis);
  }
  out.velocityA = rotate(pose.rotation, m.velocityA * scale);
  out.velocityB = rotate(pose.rotation, m.velocityB * scale);
  return out;
}

template <class F> void forPairs(std::uint64_t seed, F&& look) {
  for (int f = 0; f < kFamilies; f++) {
    Random random(seed + std::uint64_t(f));
    for (int k = 0; k < kPairs; k++) {
      SCOPED_TRACE(std::string(nameOf(Family(f))) + " " + std::to_string(k));
      look(test::randomPair(random, Family(f)).motion, random);
      if (testing::Test::HasFailure()) return;
    }
  }
}

TEST(ObbProperties, SwappingTheBoxes) {
  int hits = 0, overlapping = 0;
  forPairs(100, [&](const ObbMotion& m, Random&) {
    const double tol = 3e-8 * size(m) + 1e-15 * length(m.a.centre);
    ObbGapsT<double> gaps = rowGaps(m.a, m.b), swapped = rowGaps(m.b, m.a);
    for (int row = 0; row < kObbRows; row++) {
      int other = swappedRow(row);
      bool both = (gaps.used >> row & 1) && (swapped.used >> other & 1);
      if (length(obbRowAxis(m.a, m.b, row)) > 1e-7) {
        EXPECT_TRUE(both);
      }
      if (!both) continue;
      EXPECT_NEAR(gaps.gap[std::size_t(row)], swapped.gap[std::size_t(other)], tol);
    }
    EXPECT_NEAR(distance(m.a, m.b).distance, distance(m.b, m.a).distance, tol);
    if (auto least = leastPenetration(m.a, m.b)) {
      overlapping++;
      auto back = leastPenetration(m.b, m.a);
      EXPECT_TRUE(back || least->depth <= tol);
      EXPECT_NEAR(least->depth, back ? back->depth : 0, tol);
    }
    ObbMotion reversed = m;
    std::swap(reversed.a, reversed.b);
    std::swap(reversed.velocityA, reversed.velocityB);
    auto there = firstContact(m, 1.5), back = firstContact(reversed, 1.5);
    ASSERT_TRUE(there && back);
    if (there->hit != back->hit) {  // touching to rounding; those that part at once may then be said to miss
      bool early = there->time * length(m.velocityB) <= 30 * tol && back->time * length(m.velocityB) <= 30 * tol;
      bool miss = there->hit == ObbHit::none || back->hit == ObbHit::none;
      EXPECT_TRUE(early);
      if (miss) {
        EXPECT_LE(distance(m.a, m.b).distance, tol);
      }
      return;
    }
    if (there->hit != ObbHit::contact) return;
    hits++;
    double speed = length(m.velocityB - m.velocityA);
    EXPECT_LE(std::fabs(there->time - back->time) * speed, 30 * tol);
    // Where nearly parallel edges cross, rounding moves the point by epsilon over their angle.
    bool square = length(obbRowAxis(m.a, m.b, there->row)) > 1e-5;
    if (square && there->row == swappedRow(back->row) && there->tied == (1 << there->row) && there->contact.unique) {
      EXPECT_LT(length(there->contact.normal + back->contact.normal), 1e-9);
      EXPECT_LT(length(there->contact.point - back->contact.point), 1e-5 * size(m));
      EXPECT_LT(length(there->contact.onA - back->contact.onB), 1e-5 * size(m));
    }
  });
  EXPECT_GE(hits, 400);
  EXPECT_GE(overlapping, 400);
}

TEST(ObbProperties, MovingBothRigidly) {
  int hits = 0;
  forPairs(200, [&](const ObbMotion& m, Random& random) {
    Transform pose = test::randomPose(random, 3 * size(m));
    ObbMotion there = moved(m, pose, 1);
    const double tol = 1e-7 * size(m) + 1e-14 * length(there.a.centre) + 1e-14 * length(m.a.centre);
    EXPECT_NEAR(distance(m.a, m.b).distance, distance(there.a, there.b).distance, tol);
    auto depth = leastPenetration(m.a, m.b), depthThere = leastPenetration(there.a, there.b);
    if (depth && depthThere) {
      EXPECT_NEAR(depth->depth, depthThere->depth, tol);
    }
    if (depth.has_value() != depthThere.has_value()) {
      EXPECT_LE(depth ? depth->depth : depthThere->depth, tol);
    }
    auto hit = firstContact(m, 1.5), hitThere = firstContact(there, 1.5);
    ASSERT_TRUE(hit && hitThere);
    if (hit->hit != hitThere->hit || hit->hit != ObbHit::contact) return;
    hits++;
    EXPECT_LE(std::fabs(hit->time - hitThere->time) * length(m.velocityB), 10 * tol);
    // Where nearly parallel edges cross, rounding moves the point by epsilon over their angle.
    bool square = length(obbRowAxis(m.a, m.b, hit->row)) > 1e-5;
    if (square && hit->row == hitThere->row && hit->contact.unique && hitThere->contact.unique) {
      EXPECT_LT(length(transformPoint(pose, hit->contact.point) - hitThere->contact.point), 1e-4 * size(m));
      EXPECT_LT(length(hit->contact.onA - hitThere->contact.onA), 1e-4 * size(m));
    }
  });
  EXPECT_GE(hits, 400);
}

// By a power of two nothing is rounded differently: every number scales to the bit.
TEST(ObbProperties, ScalingByPowersOfTwoIsExact) {
  forPairs(300, [&](const ObbMotion& m, Random& random) {
    const double scale = random.below(2) ? 0x1p-20 : 0x1p+30;
    ObbMotion big = moved(m, {}, scale);
    EXPECT_EQ(firstSeparatingRow(m.a, m.b), firstSeparatingRow(big.a, big.b));
    ObbGapsT<double> gaps = rowGaps(m.a, m.b), scaled = rowGaps(big.a, big.b);
    EXPECT_EQ(gaps.used, scaled.used);
    EXPECT_EQ(gaps.separating, scaled.separating);
    for (std::size_t row = 0; row < kObbRows; row++) EXPECT_EQ(gaps.gap[row] * scale, scaled.gap[row]);
    EXPECT_EQ(distance(m.a, m.b).distance * scale, distance(big.a, big.b).distance);
    auto hit = firstContact(m, 1.5), hitBig = firstContact(big, 1.5);
    ASSERT_TRUE(hit && hitBig);
    EXPECT_EQ(hit->hit, hitBig->hit);
    EXPECT_EQ(hit->time, hitBig->time);
    EXPECT_EQ(hit->row, hitBig->row);
    EXPECT_EQ(hit->contact.count, hitBig->contact.count);
    EXPECT_EQ(hit->contact.point * scale, hitBig->contact.point);
  });
}

TEST(ObbProperties, ScalingByOthers) {
  forPairs(400, [&](const ObbMotion& m, Random& random) {
    const double scale = test::family_detail::powerOfTen(random, -6, 6);
    ObbMotion other = moved(m, {}, scale);
    const double tol = 1e-7 * size(m) + 1e-14 * length(m.a.centre);
    EXPECT_NEAR(distance(m.a, m.b).distance, distance(other.a, other.b).distance / scale, tol);
    auto hit = firstContact(m, 1.5), hitOther = firstContact(other, 1.5);
    ASSERT_TRUE(hit && hitOther);
    if (hit->hit == ObbHit::contact && hitOther->hit == ObbHit::contact) {
      EXPECT_LE(std::fabs(hit->time - hitOther->time) * length(m.velocityB), tol);
    }
  });
}

TEST(ObbProperties, FourAtATimeAsOneAtATime) {
  std::vector<ObbF> a, b;
  int apart = 0;
  forPairs(500, [&](const ObbMotion& m, Random&) {
    a.push_back(test::as<float>(m.a));
    b.push_back(test::as<float>(m.b));
  });
  for (std::size_t count : {a.size(), a.size() - 1, a.size() - 2, a.size() - 3, std::size_t(3), std::size_t(0)}) {
    std::vector<std::uint8_t> out(a.size(), 9);
    overlaps(a, std::span<const ObbF>(b).first(count), out);
    for (std::size_t k = 0; k < count; k++) {
      ASSERT_EQ(out[k], overlaps(a[k], b[k])) << "pair " << k;
      apart += out[k] == 0;
    }
    for (std::size_t k = count; k < out.size(); k++) ASSERT_EQ(out[k], 9);
  }
  EXPECT_GE(apart, 1000);
}

TEST(ObbProperties, EarlyExitAsAllRows) {
  forPairs(600, [&](const ObbMotion& m, Random&) {
    for (bool single : {false, true}) {
      int first =
          single ? firstSeparatingRow(test::as<float>(m.a), test::as<float>(m.b)) : firstSeparatingRow(m.a, m.b);
      unsigned all =
          single ? rowGaps(test::as<float>(m.a), test::as<float>(m.b)).separating : rowGaps(m.a, m.b).separating;
      EXPECT_EQ(first, all ? __builtin_ctz(all) : -1);
    }
  });
}

TEST(ObbErrors, InvalidBoxesAreErrorValues) {
  const Obb good;
  auto expectBad = [&](Obb bad, const char* field) {
    for (bool second : {false, true}) {
      const Obb &a = second ? good : bad, &b = second ? bad : good;
      auto pair = examine(a, b);
      ASSERT_FALSE(pair);
      EXPECT_EQ(pair.error().code, ErrorCode::invalidArgument);
      EXPECT_NE(pair.error().message.find(std::string(second ? "b." : "a.") + field), std::string::npos)
          << pair.error().message;
      ObbMotion m{a, b, {}, {1, 0, 0}, {}, {}};
      EXPECT_FALSE(firstContact(m, 1.0));
      EXPECT_FALSE(firstContactTurning(m, 1.0, 1e-3));
      // The unchecked ones give some answer and come back.
      (void)overlaps(a, b), (void)rowGaps(a, b), (void)leastPenetration(a, b), (void)distance(a, b);
      for (int row = -1; row <= kObbRows; row++) (void)contactSet(a, b, row, 1), (void)tablePoint(a, b, row, -1);
    }
  };
  const double bad[] = {std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::infinity(),
                        -std::numeric_limits<double>::infinity()};
  for (double value : bad) {
    for (int k = 0; k < 3; k++) {
      Obb box;
      box.centre[k] = value;
      expectBad(box, "centre");
      box = {};
      box.halfExtents[k] = value;
      expectBad(box, "halfExtents");
      box = {};
      box.axes.row[k][(k + 1) % 3] = value;
      expectBad(box, "axes");
    }
  }
  Obb box;
  box.halfExtents.y = -0.1;
  expectBad(box, "halfExtents");
  box = {};
  box.axes.row[2] = {0, 0, -1};
  expectBad(box, "axes: found left-handed");
  box = {};
  box.axes.row[1] = {0, 1.1, 0};
  expectBad(box, "axes");
  box = {};
  box.axes.row[1] = normalized(Vec3{0.1, 1, 0});
  expectBad(box, "axes");
  box = {};
  box.axes = diagonal(Vec3{});
  expectBad(box, "axes");
  box = {};
  box.halfExtents = {0, 0, 0};  // a point is a box
  EXPECT_TRUE(examine(box, Obb{}));
}

TEST(ObbErrors, BadNumbersAreErrorValues) {
  ObbMotion m;
  m.b.centre = {5, 0, 0}, m.velocityB = {-1, 0, 0};
  const double nan = std::numeric_limits<double>::quiet_NaN(), infinite = std::numeric_limits<double>::infinity();
  EXPECT_TRUE(firstContact(m, infinite));
  for (double time : {nan, -1.0}) {
    EXPECT_FALSE(firstContact(m, time));
    EXPECT_FALSE(firstContactTurning(m, time, 1e-3));
  }
  EXPECT_FALSE(firstContactTurning(m, infinite, 1e-3));
  for (double tolerance : {nan, 0.0, -1.0, 1e-300, infinite}) EXPECT_FALSE(firstContactTurning(m, 1.0, tolerance));
  EXPECT_FALSE(firstContact(m, 1.0, {nan, 0}));
  EXPECT_FALSE(firstContact(m, 1.0, {0, -1}));
  ObbMotion bad = m;
  bad.velocityB.y = nan;
  EXPECT_FALSE(firstContact(bad, 1.0));
  bad = m;
  bad.spinA.z = infinite;
  EXPECT_FALSE(firstContactTurning(bad, 1.0, 1e-3));
}

// Boxes without thickness: points, segments, rectangles.
TEST(ObbErrors, BoxesWithoutThicknessAreAnswered) {
  Random random(12);
  int hits = 0, apart = 0;
  for (int k = 0; k < 2000; k++) {
    ObbMotion m = test::randomPair(random, Family(k % 3)).motion;
    for (int i = 0; i < 3; i++) {
      if (random.below(2)) m.a.halfExtents[i] = 0;
      if (random.below(2)) m.b.halfExtents[i] = 0;
    }
    if (size(m) == 0) continue;
    const double tol = 1e-7 * size(m);
    test::SlowBox a(m.a), b(m.b);
    EXPECT_NEAR(distance(m.a, m.b).distance, test::slowDistance(a, b), tol);
    apart += test::slowDistance(a, b) > 0;
    auto impact = firstContact(m, 1.5);
    ASSERT_TRUE(impact);
    if (impact->hit != ObbHit::contact) continue;
    Obb later = m.b;
    later.centre += m.velocityB * impact->time;
    EXPECT_LE(test::slowDistance(a, test::SlowBox(later)), tol);
    hits++;
  }
  EXPECT_GE(hits, 100);
  EXPECT_GE(apart, 500);
}

}  // namespace
}  // namespace brickfall
