// The residual against the law summed point by point in double (support/newton_law.h, which reads neither records nor
// kernels), and the two figures by which it is judged.
#include "solver/light_pass.h"

#include <gtest/gtest.h>

#include <cmath>

#include "math/random.h"
#include "support/newton_law.h"
#include "support/test_island.h"

namespace brickfall {
namespace {

using test::kBrick;
using test::kBrickMass;
using test::kBrickWeight;
using test::kG;
using test::TestIsland;

Vec3 vector(Random& random, double size) {
  double x = random.between(-size, size), y = random.between(-size, size);
  return {x, y, random.between(-size, size)};
}

// Bricks in a leaning pile whose points remember loads and drifts, and which move by micrometres.
void disturb(TestIsland& lab, Random& random) {
  for (Contact& c : lab.contacts.contacts) {
    lab.load(ContactIndex(&c - lab.contacts.contacts.data()), random.between(0.5, 5) * kBrickWeight, 1e6);
    for (int i = 0; i < c.count; i++) {
      c.points.drift1[i] = float(random.between(-1e-5, 1e-5));
      c.points.multiplier2[i] = c.points.force2[i] = float(random.between(-1, 1));
      if (random.unit() < 0.2) c.points.gap[i] = 1e-4f;
    }
  }
  lab.prepare();
  for (SolveMotion& m : lab.island().motion) {
    m.d = toFloat(vector(random, 2e-5));
    m.th = toFloat(vector(random, 2e-4));
  }
  for (std::size_t i = lab.island().bodies.size(); i < lab.island().motion.size(); i++) lab.island().motion[i] = {};
}

TEST(LightPass, ResidualIsTheLawPointByPoint) {
  Random random(31);
  for (int n = 0; n < 40; n++) {
    TestIsland lab;
    lab.pile(lab.ground(), 1 + int(random.below(6)), 0, {0.03, 0, 0.01});
    disturb(lab, random);
    double visits = 0;
    lightPass(lab.island(), false, visits);
    EXPECT_EQ(visits, 4.0 * double(lab.contacts.contacts.size()));
    std::vector<oracle::Load> wanted =
        oracle::residuals(oracle::problemOf(lab.island(), lab.context), oracle::engineMotion(lab.island()));
    double most = 0, worst = 0, squares = 0;
    for (std::size_t i = 0; i < wanted.size(); i++) {
      const oracle::Load& load = wanted[i];
      const double scale = std::max(kBrickWeight, kHeavyLoad * double(lab.island().loads[i]));
      most = std::max({most, length(load.force), length(load.torque) / kBrick.y});
      worst = std::max({worst, length(load.force) / scale, length(load.torque) / (scale * kBrick.y)});
      squares += lengthSquared(load.force) / (kBrickWeight * kBrickWeight);
    }
    // Terms: M / h^2 times 2e-5 m, k times the same: some 200 N of which floats keep 6e-8.
    for (std::size_t i = 0; i < wanted.size(); i++) {
      EXPECT_LT(length(toDouble(lab.island().residual[i].force) - wanted[i].force), 1e-3) << "of " << most << " N";
      EXPECT_LT(length(toDouble(lab.island().residual[i].torque) - wanted[i].torque), 1e-3 * kBrick.x);
    }
    EXPECT_NEAR(worstResidual(lab.island(), lab.bodies), worst, 1e-4 * worst);
    EXPECT_NEAR(rmsResidual(lab.island(), lab.bodies), std::sqrt(squares / double(wanted.size())), 1e-4 * worst);
  }
}

TEST(LightPass, OneOfItsBodiesIsNotANumber) {
  for (std::size_t which : {0u, 1u, 2u}) {
    TestIsland lab;
    lab.pile(lab.ground(), 3);
    lab.prepare();
    for (bool torque : {false, true}) {
      double visits = 0;
      lightPass(lab.island(), false, visits);
      Wrench& of = lab.island().residual[which];
      (torque ? of.torque : of.force).y = std::nanf("");
      EXPECT_FALSE(worstResidual(lab.island(), lab.bodies) < 1e9) << "body " << which << " counts as balanced";
    }
  }
}

// The friction bound of a point that carried nothing follows its force, but no further than what stops it and carries it.
TEST(LightPass, BoundsOfNewPointsFollowTheirForce) {
  TestIsland lab;
  BodyIndex under = lab.ground(), body = lab.brick({0, kBrick.y, 0});
  ContactIndex face = lab.touch(under, body, 0.5f);
  lab.at(body).linearVelocity = {0, -0.2, 0};
  lab.prepare();
  double visits = 0, h = lab.context.dt, stopping = kBrickMass * (0.2 + kG * h) / h;
  float k = lab.points(face).stiffness[0];
  for (double force : {0.0, 0.25 * stopping, stopping, 7 * stopping}) {
    lab.island().motion[0].d = {0, -float(force) / k, 0};
    lightPass(lab.island(), false, visits);
    float before = lab.record().limit[0];
    lightPass(lab.island(), true, visits);
    for (int i = 0; i < 4; i++)
      EXPECT_NEAR(double(lab.record().limit[i]), 0.5 * std::min(force, stopping), 1e-5 * stopping) << force;
    if (force > 0 && force <= stopping) {
      EXPECT_NE(before, lab.record().limit[0]);
    }
  }
  lab.load(face, kBrickWeight, double(k));  // has carried something: frozen
  lab.prepare();
  for (double force : {0.0, 100.0}) {
    lab.island().motion[0].d = {0, -float(force) / k, 0};
    lightPass(lab.island(), true, visits);
    for (float limit : lab.record().limit) EXPECT_FLOAT_EQ(limit, float(0.5 * kBrickWeight / 4));
  }
}

}  // namespace
}  // namespace brickfall
