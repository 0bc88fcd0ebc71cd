// The one function that says how stiff a contact is: by its pair, its island's plan and the time step.
#include "solver/contact/stiffness.h"

#include "support/test_island.h"

namespace brickfall {
namespace {

using namespace test;

// Of a pair in an island of so many bodies, at rest or fast.
struct Asked {
  std::size_t bodies = 1000;
  double dt = 1.0 / 60, stretch = 1, part = 1, speed = 5;
  SolverSettings settings;
};
PairStiffness ofPair(const Asked& a, bool debris = false) {
  OnGround lab({}, 0, a.dt);
  lab.context.settings = a.settings;
  lab.context.stretch = a.stretch;
  lab.context.part = a.part;
  lab.prepare();
  lab.island().facts.bodies = a.bodies;
  lab.island().facts.fastest = lab.island().facts.fastestCentre = a.speed;
  lab.island().plan = planFor(lab.island().facts, lab.context.settings, a.dt);
  return stiffnessOf(lab.contact(lab.face), debris, lab.island(), lab.context);
}
// u
double full(const Asked& a) {
  const PairStiffness s = ofPair(a);
  return double(s.full) / double(s.unit);
}

TEST(Stiffness, LargeIslandsHaveAPartAtShortSteps) {
  for (std::size_t bodies : {25u, 1000u}) {
    EXPECT_FLOAT_EQ(full({bodies, 1.0 / 30}), 1000) << bodies;
    EXPECT_FLOAT_EQ(full({bodies, 1.0 / 60}), 1000) << bodies;
    EXPECT_FLOAT_EQ(full({bodies, 1.0 / 240}), 250) << bodies;
    EXPECT_FLOAT_EQ(full({bodies, 1e-5}), 60) << bodies << ", twice that of an impact";
  }
  SolverSettings soft;
  soft.restingStiffness = 50;
  EXPECT_FLOAT_EQ(full({.dt = 1e-5, .settings = soft}), 50) << "never beyond what was asked";
  for (std::size_t bodies : {1u, 12u}) EXPECT_FLOAT_EQ(full({bodies, 1.0 / 960}), 1000) << bodies;
}

// In units of mass / dt^2: so that in N/m it stays as it is.
TEST(Stiffness, IsThatOfTheTimeStepOfTheWorldsContacts) {
  for (std::size_t bodies : {1u, 12u, 25u, 1000u})
    for (double dt : {1.0 / 480, 1.0 / 240, 1.0 / 60, 1.0 / 30})
      for (double stretch : {0.5, 0.9, 1.1, 2.0})
        for (double speed : {0.0, 5.0}) {
          const double of = full({bodies, dt, 1, 1, speed}), now = full({bodies, dt * stretch, stretch, 1, speed});
          const bool least = bodies >= 25 && of * stretch * stretch < 60;
          EXPECT_NEAR(now, least ? 60 : of * stretch * stretch, 1e-4 * of)
              << bodies << ", " << dt << " s x " << stretch << (least ? ": never softer than twice an impact" : "");
        }
}

TEST(Stiffness, CalmSmallIslandsAreTenTimesAsFirm) {
  EXPECT_FLOAT_EQ(full({.bodies = 12, .speed = 0}), 10000);
  EXPECT_FLOAT_EQ(full({.bodies = 12, .speed = 5}), 1000);
  EXPECT_FLOAT_EQ(full({.bodies = 1000, .speed = 0}), 1000);
}

TEST(Stiffness, ImpactsAreSoftUnlessTheBodiesAreThin) {
  const PairStiffness s = ofPair({});
  EXPECT_FLOAT_EQ(s.soft, 30 * s.unit);
  EXPECT_FLOAT_EQ(s.ofImpact(-0.4f), s.soft);
  // 100 m/s, stopped within half of the brick's inner radius
  EXPECT_FLOAT_EQ(s.ofImpact(-100), float(100.0 / 60 / (0.5 * kBrick.y)) * s.unit);
  EXPECT_FLOAT_EQ(s.ofImpact(-1e6f), s.full);
  EXPECT_FLOAT_EQ(ofPair({}, true).full, s.soft) << "debris";
}

TEST(Stiffness, OfAPartIsThatOfTheWholeStep) {
  for (std::size_t bodies : {12u, 1000u}) {
    const double whole = full({bodies}), part = full({.bodies = bodies, .dt = 1.0 / 240, .part = 0.25});
    EXPECT_FLOAT_EQ(part, bodies > 80 ? whole / 16 : whole) << bodies;
  }
}

}  // namespace
}  // namespace brickfall
