// Contacts read two at a time, in halves and in eight lanes, against one at a time in four: the same bits.
#include "solver/face/pairs.h"

#include <gtest/gtest.h>

#include <cstring>

#include "math/random.h"
#include "solver/contact/rows.h"

namespace brickfall {
namespace {

constexpr std::uint32_t kBodies = 4, kFirstRow = 5;

struct PairScene {
  ContactRows rows{std::pmr::get_default_resource()};
  std::vector<SolveMotion> motion{kBodies};
  std::vector<SolveMass> masses{kBodies};
  std::vector<Reading> readings{kFirstRow};  // of rows of some other kind
  std::vector<std::uint32_t> sides;

  // Points that stick, slide, are open or near, are missing, or push apart; resistance to rolling.
  PairScene(Random& random, std::uint32_t count) {
    auto vector = [&](double size) {
      return Vec3f{float(random.between(-size, size)), float(random.between(-size, size)),
                   float(random.between(-size, size))};
    };
    for (std::uint32_t i = 0; i < kBodies; i++) {
      motion[i].d = vector(1e-4);
      motion[i].th = vector(1e-3);
      masses[i].position = vector(1);
      masses[i].mass = 1000;
    }
    for (std::uint32_t k = 0; k < count; k++) {
      FaceRecord r;
      Vec3 n = normalized(toDouble(vector(1)));
      r.n = toFloat(n);
      r.t1 = toFloat(normalized(cross(n, toDouble(vector(1)))));
      r.armA = vector(0.1);
      r.armB = vector(0.1);
      r.bodyA = std::uint32_t(random.between(0, kBodies - 1));
      r.bodyB = (r.bodyA + 1) % kBodies;
      const int points = int(random.between(1, 5));
      for (int i = 0; i < points; i++) {
        r.s1[i] = float(random.between(-0.1, 0.1));
        r.s2[i] = float(random.between(-0.1, 0.1));
        r.k[i] = float(random.between(0.5e6, 1e6));
        r.trialN[i] = float(random.between(-6000, 3000));
        r.trial1[i] = float(random.between(-500, 500));
        r.trial2[i] = float(random.between(-500, 500));
        r.limit[i] = random.between(0, 1) < 0.3 ? 0 : float(random.between(0, 800));
        r.leastN[i] = random.between(0, 1) < 0.8 ? 0 : float(random.between(-300, 300));
      }
      if (points < 4 && random.between(0, 1) < 0.4) {  // the last lane resists rolling
        r.rolls = 1;
        r.s1[3] = float(random.between(0.01, 0.5));
        r.trialN[3] = -kLargestPointForce;
        r.k[3] = 7e5f;
        r.trial1[3] = float(random.between(-50, 50));
        r.limit[3] = float(random.between(0, 60));
      }
      rows.tieOf.push_back(k);
      rows.records.push_back(r);
      readings.push_back({wide::load3(vector(900)), wide::load3(vector(90))});
      sides.push_back(2 * (kFirstRow + k) + (random.between(0, 1) < 0.5 ? 1 : 0));
    }
  }
  Boundary boundary(Reading* trial, bool single, bool exact) const {
    Boundary b;
    b.sides = sides.data();
    b.count = std::uint32_t(sides.size());
    b.firstRow = kFirstRow;
    b.motion = motion.data();
    b.masses = masses.data();
    b.readings = readings.data();
    b.trial = trial;
    b.centre = wide::load3({0.1f, -0.2f, 0.3f});
    b.single = single;
    b.exact = exact;
    return b;
  }
};

struct Sums {
  wide::V force = {}, torque = {}, dd[3] = {}, thd[3] = {}, B[3] = {}, thth[3] = {}, rB[3] = {};
};

void crossRows(wide::V r, const wide::V* m, wide::V* out) {
  out[0] = r[1] * m[2] - r[2] * m[1];
  out[1] = r[2] * m[0] - r[0] * m[2];
  out[2] = r[0] * m[1] - r[1] * m[0];
}

// The same without pairs: four lanes, one side after the other.
Sums oneByOne(const PairScene& s, const Boundary& b) {
  Sums sums;
  for (std::uint32_t i = 0; i < b.count; i++) {
    std::uint32_t row = b.sides[i] / 2, k = row - b.firstRow;
    bool isB = b.sides[i] & 1;
    StiffReaction x = s.rows.reactStiff(k, b.motion, b.exact ? Resist::exactly : Resist::nearly);
    b.trial[i] = {x.force, x.torque};
    wide::V arm = isB ? x.armB : x.armA;
    RowEnds ends = s.rows.ends(k);
    if (!b.single) arm += wide::load3(s.masses[isB ? ends.b : ends.a].position) - b.centre;
    wide::V sign = wide::set(isB ? 1.0f : -1.0f), force = x.force - b.readings[row].force;
    sums.force += sign * force;
    sums.torque += sign * (wide::cross3(arm, force) + (x.torque - b.readings[row].torque));
    wide::V rA[3], rB[3];
    crossRows(arm, x.stiffness.A, rA);
    crossRows(arm, x.stiffness.B, rB);
    for (int c = 0; c < 3; c++) {
      sums.dd[c] += x.stiffness.A[c];
      sums.thd[c] += rA[c];
      sums.B[c] += x.stiffness.B[c];
      sums.thth[c] += wide::cross3(arm, rA[c]) + x.stiffness.C[c];
      sums.rB[c] += rB[c];
    }
  }
  return sums;
}

::testing::AssertionResult same(const wide::V& a, const wide::V& b) {
  if (std::memcmp(&a, &b, 3 * sizeof(float)) == 0) return ::testing::AssertionSuccess();
  return ::testing::AssertionFailure() << a[0] << " " << a[1] << " " << a[2] << " and " << b[0] << " " << b[1] << " "
                                       << b[2];
}

// But for the sign of zeros, which no sum sees: beside a face that resists rolling, zeros are added.
bool same(const StiffReaction& a, const StiffReaction& b) {
  auto sum = [](wide::V x, wide::V y) { return same(x + wide::V{}, y + wide::V{}); };
  bool all = sum(a.force, b.force) && sum(a.torque, b.torque) && sum(a.armA, b.armA) && sum(a.armB, b.armB);
  for (int i = 0; i < 3; i++)
    all = all && sum(a.stiffness.A[i], b.stiffness.A[i]) && sum(a.stiffness.B[i], b.stiffness.B[i]) &&
          sum(a.stiffness.C[i], b.stiffness.C[i]);
  return all;
}

void compare(const PairFunctions& pairs) {
  Random random(7);
  for (int n = 0; n < 600; n++) {
    PairScene s(random, std::uint32_t(n % 12));
    const bool single = n % 2, exact = n % 3 == 0;
    std::vector<Reading> wantedTrial(s.sides.size());
    const Reading mark{wide::set(17), wide::set(19)};  // nothing is written beyond the last
    std::vector<Reading> trial(s.sides.size() + 1, mark), trialWithMatrix = trial, read = trial;
    Sums wanted = oneByOne(s, s.boundary(wantedTrial.data(), single, exact));
    MatrixSums matrix;
    BoundarySums found, withMatrix;
    withMatrix.matrix = &matrix;
    pairs.sumWithMatrix(s.boundary(trialWithMatrix.data(), single, exact), s.rows.records.data(), withMatrix);
    pairs.sum(s.boundary(trial.data(), single, exact), s.rows.records.data(), found);
    pairs.read(s.rows.records.data(), s.rows.size(), s.motion.data(), read.data());
    std::vector<std::uint32_t> faces;  // every other one, and the first again
    for (std::uint32_t k = 0; k < s.rows.size(); k += 2) faces.insert(faces.end(), {k, 0});
    std::vector<StiffReaction> stiff(faces.size());
    const Resist how = exact ? Resist::exactly : Resist::nearly;
    pairs.readStiff(s.rows.records.data(), faces.data(), faces.size(), s.motion.data(), how, stiff.data());
    for (std::size_t i = 0; i < faces.size(); i++)
      ASSERT_TRUE(same(stiff[i], s.rows.reactStiff(faces[i], s.motion.data(), how))) << "case " << n;
    ASSERT_TRUE(same(found.force, wanted.force) && same(withMatrix.force, wanted.force)) << "case " << n;
    ASSERT_TRUE(same(found.torque, wanted.torque) && same(withMatrix.torque, wanted.torque)) << "case " << n;
    for (int c = 0; c < 3; c++) {
      ASSERT_TRUE(same(matrix.dd[c], wanted.dd[c])) << "case " << n;
      ASSERT_TRUE(same(matrix.thd[c], wanted.thd[c])) << "case " << n;
      ASSERT_TRUE(same(matrix.B[c], wanted.B[c])) << "case " << n;
      ASSERT_TRUE(same(matrix.thth[c], wanted.thth[c])) << "case " << n;
      ASSERT_TRUE(same(matrix.rB[c], wanted.rB[c])) << "case " << n;
    }
    for (const auto& readings : {trial, trialWithMatrix, read}) {
      for (std::size_t i = 0; i < wantedTrial.size(); i++)
        ASSERT_TRUE(same(readings[i].force, wantedTrial[i].force) && same(readings[i].torque, wantedTrial[i].torque))
            << i;
      ASSERT_EQ(std::memcmp(&readings.back(), &mark, sizeof mark), 0) << "case " << n;
    }
  }
}

TEST(ContactPairs, InHalvesHaveTheBitsOfOneByOne) { compare(pairsInHalves()); }

TEST(ContactPairs, InEightLanesHaveTheBitsOfOneByOne) {
#if defined(__x86_64__)
  PairFunctions eight = pairsInEight();
  if (!eight.sum) GTEST_SKIP() << "missing: a compiler that can AVX2";
  if (!__builtin_cpu_supports("avx2")) GTEST_SKIP() << "missing: a processor with AVX2";
  compare(eight);
#else
  EXPECT_EQ(pairsInEight().sum, nullptr);
#endif
}

}  // namespace
}  // namespace brickfall
