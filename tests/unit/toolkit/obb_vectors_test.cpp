// Every quantity of the 203 vectors, in double, and in float where they allow it. Counts per family are printed.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>

#include "obb_cases.h"

namespace brickfall {
namespace {

using test::as;
using test::exactly;
using test::ObbCase;

bool holds(const std::vector<int>& rows, int row) { return std::find(rows.begin(), rows.end(), row) != rows.end(); }

// Failures so far: the running test has one part result for each (and none for what passed).
int partsSoFar() { return testing::UnitTest::GetInstance()->current_test_info()->result()->total_part_count(); }

struct Tally {
  int passed = 0, all = 0;
};
// One line per family; a family passes as a whole or the test says what did not.
class Families {
 public:
  explicit Families(const char* precision) : precision_(precision) {}
  void count(const ObbCase& c, bool passed) {
    families_[c.category].all++;
    families_[c.category].passed += passed;
  }
  void print() const {
    for (const auto& [name, tally] : families_) {
      std::printf("  %-8s %-26s %d/%d\n", precision_, name.c_str(), tally.passed, tally.all);
    }
  }

 private:
  const char* precision_;
  std::map<std::string, Tally> families_;
};

template <class T> class ObbVectors : public testing::Test {
 protected:
  static constexpr bool kDouble = std::is_same_v<T, double>;
  static constexpr double kRel = kDouble ? 1e-7 : 1e-4;
  static std::vector<ObbCase> cases() {
    std::vector<ObbCase> all = test::obbCases();
    std::erase_if(all, [](const ObbCase& c) { return !kDouble && !c.float32Ok; });
    return all;
  }
  static double tolerance(const ObbCase& c) { return c.tolerance(kRel); }
};
using Precisions = testing::Types<double, float>;
TYPED_TEST_SUITE(ObbVectors, Precisions);

template <class T> bool insideBoth(const ObbCase& c, Vec3 world, double time, double slack) {
  Obb b = c.motion.b;
  b.centre += c.motion.velocityB * time;
  Vec3 x = toLocal(c.motion.a, world), y = toLocal(b, world);
  for (int k = 0; k < 3; k++) {
    if (!(std::fabs(x[k]) <= c.motion.a.halfExtents[k] + slack)) return false;
    if (!(std::fabs(y[k]) <= b.halfExtents[k] + slack)) return false;
  }
  return true;
}

TYPED_TEST(ObbVectors, OneInstant) {
  using T = TypeParam;
  Families families(this->kDouble ? "double" : "float");
  for (const ObbCase& c : this->cases()) {
    SCOPED_TRACE("vector " + std::to_string(c.id) + " " + c.category);
    const double tol = this->tolerance(c);
    ObbT<T> a = as<T>(c.motion.a), b = as<T>(c.motion.b);
    Result<ObbPairT<T>> examined = examine(a, b);
    ASSERT_TRUE(examined) << examined.error().message;
    const ObbPairT<T>& pair = *examined;
    const int partsBefore = partsSoFar();
    EXPECT_EQ(pair.overlap, overlaps(a, b));
    EXPECT_EQ(pair.firstSeparating, firstSeparatingRow(a, b));
    if (!c.borderline) {
      EXPECT_EQ(pair.overlap, c.overlap);
    }
    EXPECT_NEAR(double(pair.closest.distance), c.distance.value_or(-1), tol);
    EXPECT_NEAR(length(exactly(pair.closest.onA) - exactly(pair.closest.onB)), *c.distance, tol);
    EXPECT_TRUE(insideBoth<T>(c, exactly(pair.closest.onA), 0, *c.distance + tol));
    if (c.separatingRow && !pair.overlap) {
      EXPECT_EQ(pair.firstSeparating, *c.separatingRow) << obbRowName(pair.firstSeparating);
      EXPECT_NEAR(double(pair.gaps.gap[std::size_t(pair.firstSeparating)]), *c.gap, tol);
      for (int row = 0; row < kObbRows; row++) {
        if (!(pair.gaps.used >> row & 1)) continue;  // nearer to parallel than this precision can use
        EXPECT_EQ(bool(pair.gaps.separating >> row & 1), holds(c.separatingRows, row)) << obbRowName(row);
      }
    }
    if (c.penetrationRow && pair.overlap) {
      ASSERT_TRUE(pair.penetration);
      EXPECT_TRUE(holds(c.penetrationRows, pair.penetration->row)) << obbRowName(pair.penetration->row);
      if (this->kDouble) {
        EXPECT_EQ(pair.penetration->row, *c.penetrationRow);
      }
      EXPECT_NEAR(double(pair.penetration->depth), *c.depth, tol);
      EXPECT_EQ(pair.penetration->signKnown, c.penetrationNormal.has_value());
      if (c.penetrationNormal && pair.penetration->row == *c.penetrationRow) {
        EXPECT_LT(length(exactly(pair.penetration->normal) - *c.penetrationNormal), 10 * this->kRel);
      }
    }
    families.count(c, partsSoFar() == partsBefore);
  }
  families.print();
}

// Each corner of one set has a near one in the other.
void expectSameCorners(const std::vector<Vec3>& found, const std::vector<Vec3>& expected, double tol) {
  auto nearest = [](Vec3 p, const std::vector<Vec3>& set) {
    double best = std::numeric_limits<double>::infinity();
    for (Vec3 q : set) best = std::min(best, length(p - q));
    return best;
  };
  for (Vec3 p : found) EXPECT_LT(nearest(p, expected), tol);
  for (Vec3 p : expected) EXPECT_LT(nearest(p, found), tol);
}

TYPED_TEST(ObbVectors, FirstContact) {
  using T = TypeParam;
  Families families(this->kDouble ? "double" : "float");
  int unique = 0, sets = 0, byTable = 0, misses = 0;
  for (const ObbCase& c : this->cases()) {
    SCOPED_TRACE("vector " + std::to_string(c.id) + " " + c.category);
    const double tol = this->tolerance(c), speed = length(c.motion.velocityB);
    const int partsBefore = partsSoFar();
    Result<ObbImpactT<T>> result = firstContact(as<T>(c.motion), T(c.maxTime));
    ASSERT_TRUE(result) << result.error().message;
    const ObbImpactT<T>& impact = *result;
    bool hit = impact.hit != ObbHit::none;
    if (!c.borderline) {
      EXPECT_EQ(hit, c.time.has_value());
    }
    Result<ObbImpactT<T>> unbounded = firstContact(as<T>(c.motion), std::numeric_limits<T>::infinity());
    ASSERT_TRUE(unbounded);
    if (!c.borderline) {
      EXPECT_EQ(unbounded->hit != ObbHit::none, c.timeUnbounded.has_value());
    }
    if (unbounded->hit != ObbHit::none && c.timeUnbounded) {
      EXPECT_LE(std::fabs(double(unbounded->time) - *c.timeUnbounded) * speed, tol);
    }
    if (!hit || !c.time) {
      misses++;
      families.count(c, partsSoFar() == partsBefore);
      continue;
    }
    EXPECT_LE(std::fabs(double(impact.time) - *c.time) * speed, tol);
    if (c.contactRow) {
      EXPECT_TRUE(holds(this->kDouble ? c.contactRows : c.contactRowsNear, impact.row) ||
                  (c.illConditioned && holds(c.contactRowsNear, impact.row)))
          << obbRowName(impact.row);
      const ObbContactSetT<T>& contact = impact.contact;
      ASSERT_GT(contact.count, 0);
      EXPECT_FALSE(contact.estimated);
      for (int k = 0; k < contact.count; k++) {
        EXPECT_TRUE(insideBoth<T>(c, exactly(contact.points[std::size_t(k)].position), *c.time, 1e-4 * c.size));
      }
      Vec3 point = exactly(contact.point);
      EXPECT_TRUE(insideBoth<T>(c, point, *c.time, 1e-4 * c.size));
      // x and y are the same point in the boxes' own coordinates, at the time of contact.
      Obb b = c.motion.b;
      b.centre += c.motion.velocityB * double(impact.time);
      EXPECT_LT(length(toWorld(c.motion.a, exactly(contact.onA)) - point), 10 * tol);
      EXPECT_LT(length(toWorld(b, exactly(contact.onB)) - point), 10 * tol);
      if (contact.row == *c.contactRow) {
        EXPECT_LT(length(exactly(contact.normal) - *c.contactNormal), 10 * this->kRel);
      }
      if (c.contactPoint && !c.illConditioned) {
        EXPECT_TRUE(contact.unique);
        EXPECT_LT(length(point - *c.contactPoint), 10 * tol);
        unique++;
        byTable += contact.byTable;
      }
      if (c.contactNotUnique) {
        EXPECT_FALSE(contact.unique);
        std::vector<Vec3> corners;
        for (int k = 0; k < contact.count; k++) {
          corners.push_back(exactly(contact.points[std::size_t(k)].position));
        }
        expectSameCorners(corners, c.contactHull, 10 * tol);
        EXPECT_FALSE(tablePoint(as<T>(c.motion.a), as<T>(b), impact.row, contact.sigma).unique);
        sets++;
      }
    } else {
      EXPECT_EQ(impact.hit, ObbHit::overlapping);
      EXPECT_NEAR(double(impact.depth), *c.depth, tol);
    }
    families.count(c, partsSoFar() == partsBefore);
  }
  families.print();
  std::printf("  unique points %d (%d by the table), sets %d, misses %d\n", unique, byTable, sets, misses);
  EXPECT_GE(unique, 70);
  EXPECT_GE(byTable, unique - 1);  // one pair meets corner to corner, with coefficients of zero
  EXPECT_GE(misses, 20);
  if (this->kDouble) {
    EXPECT_GE(sets, 24);
  }
}

// The bare table at a corner that meets a corner of a box with the same axes: its coefficients are zero, it says so, and
// its point is not one of contact.
TEST(ObbVectorsTable, SaysWhereItDoesNotHold) {
  for (const ObbCase& c : test::obbCases()) {
    if (c.id != 213) continue;
    ObbTablePointT<double> point = tablePoint(c.motion.a, advanced(c.motion.b, c.motion.velocityB, {}, *c.time), 0, 1);
    EXPECT_FALSE(point.unique);
    EXPECT_GT(length(point.point - *c.contactPoint), 0.1);
  }
}

}  // namespace
}  // namespace brickfall
