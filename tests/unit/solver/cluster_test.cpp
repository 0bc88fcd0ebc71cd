// Forces and stiffness of a cluster against the contact law written out point by point in double, and its Newton matrix
// against differences of its residual.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "math/random.h"
#include "solver/cluster_step.h"

namespace brickfall {
namespace {

enum class Regime { sticks, slides, open, mixed, rolls };

// Two bodies and a fixed partner, one contact between each two, random frames, arms and points.
struct Scene {
  Island island;
  SolveStatistics counts;
  Wrench followed;  // the residual after step(), by what it changed
  Level level;      // one cluster: body 0, or bodies 0 and 1 together

  Scene(Random& random, Regime regime, bool both) {
    auto vector = [&](double size) {
      return Vec3f{float(random.between(-size, size)), float(random.between(-size, size)),
                   float(random.between(-size, size))};
    };
    island.dt = 1.0 / 60;
    island.bodies = {0, 1};
    island.partners = {2};
    island.motion.resize(3);
    island.masses.resize(2);
    for (int i = 0; i < 2; i++) {
      SolveMass& m = island.masses[std::size_t(i)];
      m.mass = 1000;
      m.inertia[0] = 3;
      m.inertia[2] = 4;
      m.inertia[5] = 5;
      m.inertia[1] = 0.2f;
      m.dFree = vector(1e-3);
      m.thFree = vector(1e-3);
      m.position = vector(0.3);
    }
    for (SolveMotion& m : island.motion) {
      m.d = vector(1e-4);
      m.th = vector(1e-3);
    }
    const std::uint32_t ends[3][2] = {{0, 1}, {2, 0}, {1, 2}};
    for (std::uint32_t k = 0; k < 3; k++) {
      FaceRecord r;
      Vec3 n = normalized(toDouble(vector(1))), t1 = normalized(cross(n, toDouble(vector(1))));
      r.n = toFloat(n);
      r.t1 = toFloat(t1);
      r.armA = vector(0.1);
      r.armB = vector(0.1);
      // Of two bodies of one cluster: one place, or action and reaction would not cancel.
      if (k == 0) r.armB = r.armA + island.masses[0].position - island.masses[1].position;
      r.bodyA = ends[k][0];
      r.bodyB = ends[k][1];
      for (int i = 0; i < 4; i++) {
        bool open = regime == Regime::open || (regime == Regime::mixed && i == 1);
        bool slides = regime == Regime::slides || (regime == Regime::mixed && i >= 2);
        r.s1[i] = float(random.between(-0.1, 0.1));
        r.s2[i] = float(random.between(-0.1, 0.1));
        r.k[i] = float(random.between(0.5e6, 1e6));
        r.trialN[i] = open ? -1e6f : float(random.between(2000, 3000));
        r.trial1[i] = float(random.between(-500, 500));
        r.trial2[i] = float(random.between(200, 500));
        r.limit[i] = slides ? 60.0f : 1e6f;
      }
      if (regime == Regime::rolls) {  // against resistance, which two of the three overcome
        r.rolls = 1;
        r.s2[3] = 0;
        r.trialN[3] = -kLargestPointForce;
        if (k > 0) r.limit[3] = 60;
      }
      island.rows.contacts.tieOf.push_back(k);
      island.rows.contacts.records.push_back(r);
    }
    level.clusterOf = {0, both ? 0u : 1u};
    level.bodies = {0};
    if (both) level.bodies.push_back(1);
    level.sides = {both ? 3u : 0u, both ? 4u : 3u};
    Cluster c;
    c.bodyEnd = std::uint32_t(level.bodies.size());
    c.sideEnd = 2;
    c.centre = both ? (island.masses[0].position + island.masses[1].position) * 0.5f : island.masses[0].position;
    c.mass = both ? 2000.0f : 1000.0f;
    // The matrix is only ever compared without the inertia of more than one body.
    for (int i = 0; i < 6; i++) c.inertia[i] = island.masses[0].inertia[i];
    level.clusters = {c};
  }
  // With `matrix`, also the cluster's Newton matrix.
  Wrench residual(Symmetric6* matrix = nullptr) {
    RowForces forces(island, counts);
    forces.readAll();
    if (matrix) *matrix = clusterMatrix(forces, level, level.clusters[0], island.plan.exactSteps);
    return residualOf(island, level, level.clusters[0]);
  }
  // One Newton step, taken.
  void step() {
    ClusterFactor factor;
    step(factor);
  }
  void step(ClusterFactor& factor) {
    RowForces forces(island, counts);
    forces.readAll();
    const Cluster& cluster = level.clusters[0];
    ClusterStep made =
        tryStep(forces, level, cluster, factor, residualOf(island, level, cluster), island.plan.exactSteps);
    if (made.part == 0) return;
    forces.acceptBoundary(level, cluster);
    addInertiaOfStep(island, level, cluster, made);
    followed = residualOf(island, level, cluster);
  }
};

struct WrenchD {
  Vec3 force, torque;
};

// The law, written out: point by point, world axes, double.
WrenchD direct(const Scene& s, bool both) {
  WrenchD sum;
  Vec3 centre = toDouble(s.level.clusters[0].centre);
  for (std::uint32_t body : s.level.bodies) {
    const SolveMass& m = s.island.masses[body];
    const SolveMotion& x = s.island.motion[body];
    Vec3 e = toDouble(m.dFree) - toDouble(x.d), t = toDouble(m.thFree) - toDouble(x.th);
    Mat3 inertia{{{m.inertia[0], m.inertia[1], m.inertia[3]},
                  {m.inertia[1], m.inertia[2], m.inertia[4]},
                  {m.inertia[3], m.inertia[4], m.inertia[5]}}};
    Vec3 force = e * double(m.mass);
    sum.force += force;
    sum.torque += inertia * t + cross(toDouble(m.position) - centre, force);
  }
  for (const FaceRecord& r : s.island.rows.contacts.records) {
    bool inA = r.bodyA == 0 || (both && r.bodyA == 1), inB = r.bodyB == 0 || (both && r.bodyB == 1);
    if (inA == inB) continue;
    Vec3 n = toDouble(r.n), t1 = toDouble(r.t1), t2 = cross(n, t1);
    const SolveMotion &a = s.island.motion[r.bodyA], &b = s.island.motion[r.bodyB];
    std::uint32_t body = inB ? r.bodyB : r.bodyA;
    for (int i = 0; i < 4; i++) {
      if (r.rolls && i == 3) {
        const Vec3 w = toDouble(b.th) - toDouble(a.th);
        double m1 = double(r.trial1[i]) - double(r.k[i]) * double(r.s1[i]) * dot(t1, w),
               m2 = double(r.trial2[i]) - double(r.k[i]) * double(r.s1[i]) * dot(t2, w);
        const double over = std::min(1.0, double(r.limit[i]) / std::hypot(m1, m2));
        sum.torque += (t1 * m1 + t2 * m2) * (over * double(r.s1[i]) * (inB ? 1.0 : -1.0));
        continue;
      }
      Vec3 place = t1 * double(r.s1[i]) + t2 * double(r.s2[i]);
      Vec3 armA = toDouble(r.armA) + place, armB = toDouble(r.armB) + place;
      Vec3 u = toDouble(b.d) + cross(toDouble(b.th), armB) - toDouble(a.d) - cross(toDouble(a.th), armA);
      double fn = std::max(double(r.trialN[i]) - double(r.k[i]) * dot(n, u), double(r.leastN[i]));
      double f1 = double(r.trial1[i]) - double(r.k[i]) * dot(t1, u),
             f2 = double(r.trial2[i]) - double(r.k[i]) * dot(t2, u);
      double size = std::hypot(f1, f2), limit = double(r.limit[i]);
      if (size > limit) {
        f1 *= limit / size;
        f2 *= limit / size;
      }
      Vec3 force = (n * fn + t1 * f1 + t2 * f2) * (inB ? 1.0 : -1.0);
      sum.force += force;
      sum.torque += cross(toDouble(s.island.masses[body].position) - centre + (inB ? armB : armA), force);
    }
  }
  return sum;
}

const Regime kRegimes[] = {Regime::sticks, Regime::slides, Regime::open, Regime::mixed, Regime::rolls};

TEST(Cluster, ResidualIsTheContactLawPointByPoint) {
  Random random(21);
  for (Regime regime : kRegimes)
    for (int n = 0; n < 50; n++)
      for (bool both : {false, true}) {
        Scene s(random, regime, both);
        Wrench found = s.residual();
        WrenchD wanted = direct(s, both);
        EXPECT_LT(length(toDouble(found.force) - wanted.force), 1e-2) << "of some thousand N, regime " << int(regime);
        EXPECT_LT(length(toDouble(found.torque) - wanted.torque), 1e-2) << "regime " << int(regime);
      }
}

TEST(Cluster, MatrixIsTheDerivativeOfTheResidual) {
  Random random(22);
  for (Regime regime : kRegimes)
    for (int n = 0; n < 20; n++) {
      Scene s(random, regime, false);
      Symmetric6 matrix;
      s.residual(&matrix);
      for (int column = 0; column < 6; column++) {
        // In double, by central differences of the law itself.
        auto moved = [&](float by) {
          Scene t(s);
          SolveMotion& m = t.island.motion[0];
          (column < 3 ? m.d : m.th)[column % 3] += by;
          return direct(t, false);
        };
        float step = 0x1p-16f;
        WrenchD plus = moved(step), minus = moved(-step);
        SolveMotion high = s.island.motion[0], low = high;
        (column < 3 ? high.d : high.th)[column % 3] += step;
        (column < 3 ? low.d : low.th)[column % 3] -= step;
        double width = column < 3 ? double(high.d[column % 3]) - double(low.d[column % 3])
                                  : double(high.th[column % 3]) - double(low.th[column % 3]);
        for (int row = 0; row < 6; row++) {
          double slope = row < 3 ? (minus.force[row] - plus.force[row]) / width
                                 : (minus.torque[row - 3] - plus.torque[row - 3]) / width;
          double found = double(matrix.at(std::max(row, column), std::min(row, column)));
          double scale = (row < 3 ? 1e7 : 1e6) * (column < 3 ? 1 : 0.1);
          EXPECT_NEAR(found, slope, 3e-4 * scale) << "row " << row << " column " << column << " regime " << int(regime);
        }
      }
    }
}

TEST(Cluster, NearOpenPointsBraceTheMatrixButPullNothing) {
  Random random(23);
  Scene s(random, Regime::open, false);
  for (FaceRecord& r : s.island.rows.contacts.records) {
    r.near = float(kNearContact);
    for (int i = 0; i < 4; i++) {
      r.trialN[i] = -r.k[i] * 1e-6f;  // a micrometre apart
      r.limit[i] = 0;
    }
  }
  for (SolveMotion& m : s.island.motion) m = {};
  Symmetric6 near;
  Wrench residual = s.residual(&near);
  EXPECT_NEAR(double(length(residual.force)), double(length(s.island.masses[0].dFree) * 1000), 1e-3);
  EXPECT_GT(near.at(0, 0) + near.at(1, 1) + near.at(2, 2), 1e6f);
}

// A ball at rest between walls: forces of 1e-20 N and ways of 1e-26 m, of which floats no longer hold the product. The
// search along such a step divided nothing by nothing.
TEST(Cluster, ForcesTooSmallForTheirProductLeaveTheMotionFinite) {
  Random random(25);
  int underflown = 0;
  for (Regime regime : kRegimes)
    for (int exponent = -100; exponent < -30; exponent++)
      for (int n = 0; n < 10; n++) {
        Scene s(random, regime, false);
        float scale = std::ldexp(1.0f, exponent);
        s.island.plan.exactSteps = true;
        for (SolveMass& m : s.island.masses) {
          m.dFree *= scale;
          m.thFree *= scale;
        }
        for (SolveMotion& m : s.island.motion) m = {};
        for (FaceRecord& r : s.island.rows.contacts.records)
          for (int i = 0; i < 4; i++)
            for (float* force : {r.trialN, r.trial1, r.trial2, r.limit}) force[i] *= scale;
        Wrench start = s.residual();
        underflown += dot(start.force, start.force) < 1e-37f;
        for (int k = 0; k < 4; k++) s.step();
        const SolveMotion& end = s.island.motion[0];
        ASSERT_TRUE(std::isfinite(length(end.d)) && std::isfinite(length(end.th))) << "2^" << exponent;
      }
  EXPECT_GT(underflown, 100);
}

// A linear cluster of one body, its residual and what a step has read of its boundary.
struct LinearScene : Scene {
  explicit LinearScene(Random& random) : Scene(random, Regime::sticks, false) {
    for (FaceRecord& r : island.rows.contacts.records)
      for (float& least : r.leastN) least = -1e9f;  // nothing opens
  }
  double force() { return double(length(residual().force)); }
  double readings() { return counts.solveSides / (4.0 * level.sides.size()); }
};

TEST(Cluster, AFactorServesAsLongAsItsStepsEndWell) {
  Random random(25);
  for (int n = 0; n < 50; n++) {
    LinearScene s(random);
    ClusterFactor factor;
    double before = s.force();
    s.step(factor);
    EXPECT_TRUE(factor.valid);
    EXPECT_EQ(s.readings(), 2) << "matrix and step";
    for (int i = 0; i < 3; i++) s.island.motion[0].d[i] += 1e-4f;
    s.step(factor);
    EXPECT_EQ(s.readings(), 3) << "only the step";
    EXPECT_LT(s.force(), 1e-3 * before);
  }
}

TEST(Cluster, AFactorThatIsOffIsMadeAnew) {
  Random random(26);
  for (int n = 0; n < 50; n++) {
    LinearScene s(random);
    double before = s.force();
    // Of a boundary a tenth as stiff: steps go too far, and are tried again.
    ClusterFactor soft, firm;
    auto scaled = [&](float by, ClusterFactor& factor) {
      for (FaceRecord& r : s.island.rows.contacts.records)
        for (float& k : r.k) k *= by;
      s.residual(&factor.matrix);
      ASSERT_TRUE(factor.matrix.factor());
      factor.valid = factor.kept = true;
      for (FaceRecord& r : s.island.rows.contacts.records)
        for (float& k : r.k) k /= by;
    };
    scaled(0.1f, soft);
    scaled(10, firm);
    double was = s.readings();
    s.step(soft);
    EXPECT_EQ(s.readings() - was, 4) << "the step, back, matrix and step";
    EXPECT_TRUE(soft.valid);
    EXPECT_LT(s.force(), 1e-3 * before);
    // Ten times as stiff: the step falls short, and holds, but the next has a factor of its own.
    for (int i = 0; i < 3; i++) s.island.motion[0].d[i] += 1e-4f;
    double apart = s.force();
    s.step(firm);
    EXPECT_FALSE(firm.valid);
    EXPECT_LT(s.force(), apart);
    s.step(firm);
    EXPECT_TRUE(firm.valid);
    EXPECT_LT(s.force(), 1e-3 * before);
  }
}

TEST(Cluster, StepBringsTheResidualOfALinearClusterToZero) {
  Random random(24);
  for (int n = 0; n < 50; n++)
    for (bool both : {false, true}) {
      Scene s(random, Regime::sticks, both);
      for (FaceRecord& r : s.island.rows.contacts.records)
        for (float& least : r.leastN) least = -1e9f;  // nothing opens
      double before = double(length(s.residual().force));
      if (both) {  // the inertia of the pair about its centre
        Cluster& c = s.level.clusters[0];
        for (float& x : c.inertia) x = 0;
        for (const SolveMass& m : s.island.masses) {
          Vec3f r = m.position - c.centre;
          c.inertia[0] += m.inertia[0] + m.mass * (r.y * r.y + r.z * r.z);
          c.inertia[1] += m.inertia[1] - m.mass * r.x * r.y;
          c.inertia[2] += m.inertia[2] + m.mass * (r.x * r.x + r.z * r.z);
          c.inertia[3] += m.inertia[3] - m.mass * r.x * r.z;
          c.inertia[4] += m.inertia[4] - m.mass * r.y * r.z;
          c.inertia[5] += m.inertia[5] + m.mass * (r.x * r.x + r.y * r.y);
        }
      }
      Vec3f apart = s.island.motion[1].th - s.island.motion[0].th;
      s.step();
      EXPECT_GT(s.counts.solveSides, 0);
      if (both) {
        EXPECT_LT(length((s.island.motion[1].th - s.island.motion[0].th) - apart), 1e-6f) << "a cluster moves rigidly";
      }
      Wrench read = s.residual();
      EXPECT_LT(double(length(read.force)), 1e-3 * before);
      EXPECT_NEAR(double(length(read.force - s.followed.force)), 0, 1e-5 * before) << "residuals follow what changes";
    }
}

}  // namespace
}  // namespace brickfall
