// The table that decides how an island is treated: each of its rows, budgets, stops, and the facts that it reads. And the page
// that prints it.
#include "solver/plan.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <set>
#include <sstream>

#include "support/test_island.h"

namespace brickfall {
namespace {

using test::kBrick;
using test::TestIsland;

constexpr double kDt = 1.0 / 60;

IslandFacts factsOf(std::size_t bodies, bool grounded, double speed) {
  IslandFacts facts;
  facts.bodies = bodies;
  facts.grounded = grounded;
  facts.fastest = facts.fastestCentre = speed;
  return facts;
}
SolvePlan planOf(const IslandFacts& facts) { return planFor(facts, {}, kDt); }

TEST(Plan, EveryRowOfTheTableIsReached) {
  struct Case {
    std::size_t bodies;
    bool grounded;
    double speed;
    std::size_t row;
    bool jointed = false;
    std::size_t ties = 0;
  };
  const Case cases[] = {{1, true, 0, 1},
                        {1, false, 50, 1},
                        {2, true, 0, 2},
                        {24, false, 50, 2},
                        {13, true, 0.49, 2},
                        {24, true, 50, 2},
                        {25, true, 0.49, 3},
                        {80, true, 0, 3},
                        {25, true, 0.5, 5},
                        {25, false, 0, 5},
                        {80, false, 0, 5},
                        {81, true, 0, 5},
                        {100000, true, 0, 5},
                        {100000, false, 9, 5},
                        {1, true, 0, 0, true},
                        {80, false, 50, 0, true},
                        {81, true, 0, 4, true, 91},
                        {400, false, 50, 4, true, 400},
                        {81, true, 0, 5, true, 92},
                        {401, true, 0, 5, true, 400}};
  std::set<std::size_t> reached;
  for (const Case& c : cases) {
    SCOPED_TRACE(std::to_string(c.bodies) + (c.grounded ? " grounded, " : " floating, ") + std::to_string(c.speed));
    const PlanRow& row = planRows()[c.row];
    IslandFacts facts = factsOf(c.bodies, c.grounded, c.speed);
    facts.jointed = c.jointed;
    facts.ties = c.ties;
    facts.joints = std::min(c.ties, c.bodies);
    SolvePlan plan = planOf(facts);
    EXPECT_EQ(plan.exactSteps, row.exactSteps);
    EXPECT_EQ(plan.direct, row.direct);
    EXPECT_EQ(plan.calmStiffening, c.grounded && c.speed == 0 ? double(row.calmStiffening) : 1);
    EXPECT_LE(c.bodies, row.mostBodies);
    reached.insert(c.row);
  }
  EXPECT_EQ(reached.size(), planRows().size());
}

TEST(Plan, SmallIslandsAreFirmForTheirHeaviestBody) {
  for (std::size_t bodies : {1u, 2u, 24u, 80u, 81u, 1000u}) {
    IslandFacts facts = factsOf(bodies, true, 0);
    facts.heaviest = 500;
    EXPECT_EQ(planOf(facts).leastMass, bodies > 1 && bodies <= 80 ? 5 : 0) << bodies;
  }
  TestIsland lab;
  BodyIndex brick = lab.brick({}), other = lab.brick({0, 2 * kBrick.y, 0});
  lab.touch(brick, other);
  lab.prepare();
  EXPECT_EQ(lab.island().facts.heaviest, lab.bodies.mass[brick].mass);
}

TEST(Plan, SlowIsGroundedStillAndUnderTheRestSpeed) {
  for (std::size_t bodies : {1u, 12u, 24u, 80u, 1000u}) {
    EXPECT_TRUE(planOf(factsOf(bodies, true, 0.01)).slow) << bodies;
    EXPECT_FALSE(planOf(factsOf(bodies, true, 0.01001)).slow) << bodies;
    EXPECT_FALSE(planOf(factsOf(bodies, false, 0)).slow) << bodies << ", nothing holds it";
    IslandFacts carried = factsOf(bodies, true, 0);
    carried.partnersMove = true;
    EXPECT_FALSE(planOf(carried).slow) << bodies << ", what carries it moves";
    EXPECT_EQ(planOf(carried).calmStiffening, 1) << bodies;
  }
}

TEST(Plan, CalmIsATenthOfGravitysStepBeyondSlow) {
  for (double dt : {1.0 / 30, 1.0 / 60, 1.0 / 240}) {
    double limit = 0.01 + 0.1 * 9.81 * dt;
    EXPECT_EQ(planFor(factsOf(1, true, 0.999 * limit), {}, dt).calmStiffening, 10) << dt;
    EXPECT_FALSE(planFor(factsOf(1, true, 0.999 * limit), {}, dt).slow) << dt;
    EXPECT_EQ(planFor(factsOf(1, true, 1.001 * limit), {}, dt).calmStiffening, 1) << dt;
    EXPECT_EQ(planFor(factsOf(25, true, 0), {}, dt).calmStiffening, 1) << "large islands are never stiffer";
  }
}

TEST(Plan, SupportedIslandsMayBeStoppedWhereWhatTheyLoseIsAVibrations) {
  struct Case {
    std::size_t bodies;
    double most;
  };
  for (const Case& c : {Case{1, 0.01}, {2, 0.01}, {80, 0.01}, {81, 0.03}, {1000, 0.03}}) {
    SCOPED_TRACE(c.bodies);
    IslandFacts facts = factsOf(c.bodies, true, c.most);
    EXPECT_TRUE(planOf(facts).mayBeStopped);
    facts.fastest = 1.01 * c.most;
    EXPECT_FALSE(planOf(facts).mayBeStopped);
    facts.fastest = 0;
    facts.grounded = false;
    EXPECT_FALSE(planOf(facts).mayBeStopped) << "nothing holds it";
  }
}

TEST(Plan, Cycles) {
  auto most = [](std::size_t bodies, bool grounded, double speed) {
    return planOf(factsOf(bodies, grounded, speed)).maxCycles;
  };
  EXPECT_EQ(most(1, false, 5), 64);
  for (std::size_t bodies : {26u, 80u, 1000u}) EXPECT_EQ(most(bodies, false, 5), 10) << bodies;
  EXPECT_EQ(most(1000, true, 5), 10);
  EXPECT_EQ(most(1000, true, 0), 10) << "slow";
  for (std::size_t bodies : {2u, 24u}) EXPECT_EQ(most(bodies, false, 5), 1) << "the direct solve goes on from there";
  for (std::size_t bodies : {25u, 80u}) EXPECT_EQ(most(bodies, true, 0), 4) << "the direct solve goes on from there";
  SolverSettings many;
  many.maxCycles = 100;
  EXPECT_EQ(planFor(factsOf(1000, false, 5), many, kDt).maxCycles, 100);
  EXPECT_EQ(planFor(factsOf(1, false, 5), many, kDt).maxCycles, 100);
  EXPECT_EQ(planFor(factsOf(1000, false, 5), many, kDt).mostCycles, 300);
  for (std::size_t bodies : {81u, 1000u}) EXPECT_EQ(planOf(factsOf(bodies, true, 5)).mostCycles, 30) << bodies;
  for (std::size_t bodies : {1u, 24u, 80u})
    EXPECT_EQ(planOf(factsOf(bodies, true, 0)).mostCycles, planOf(factsOf(bodies, true, 0)).maxCycles) << bodies;
  for (std::size_t bodies : {1u, 80u, 1000u}) EXPECT_EQ(planOf(factsOf(bodies, true, 0)).minCycles, 4);
  for (std::size_t bodies : {2u, 24u}) EXPECT_EQ(planOf(factsOf(bodies, true, 0)).minCycles, 1);
}

TEST(Plan, LargeIslandsAreJudgedByLoad) {
  struct Case {
    std::size_t bodies;
    double speed;
    bool large;
    double tolerance;
  };
  for (const Case& c : {Case{1, 5, false, 5e-4},
                        {24, 5, false, 5e-4},
                        {80, 0, false, 5e-4},
                        {25, 5, true, 2e-2},
                        {1000, 5, true, 2e-2},
                        {1000, 0, true, 2e-2}}) {
    SolvePlan plan = planOf(factsOf(c.bodies, true, c.speed));
    EXPECT_EQ(plan.large, c.large) << c.bodies << " at " << c.speed;
    EXPECT_EQ(plan.tolerance, c.tolerance) << c.bodies << " at " << c.speed;
  }
}

TEST(Plan, LargeIslandsOnTheGroundGoOnAsTheyFellAllOthersStartFree) {
  EXPECT_FALSE(planOf(factsOf(81, true, 0.5)).startsFree);
  EXPECT_FALSE(planOf(factsOf(81, true, 0.5)).softDebris);
  EXPECT_FALSE(planOf(factsOf(81, true, 0.51)).startsFree);
  EXPECT_TRUE(planOf(factsOf(81, true, 0.51)).softDebris);
  EXPECT_TRUE(planOf(factsOf(81, false, 0)).startsFree) << "nothing holds it";
  EXPECT_TRUE(planOf(factsOf(80, true, 0)).startsFree) << "it is solved to the end";
  EXPECT_FALSE(planOf(factsOf(24, true, 5)).softDebris);
}

TEST(Plan, WhatIsNotANumberIsNotSlow) {
  double nan = std::nan("");
  for (int which : {0, 1, 2}) {
    TestIsland lab;
    std::vector<BodyIndex> pile = lab.pile(lab.ground(), 3);
    lab.at(pile[std::size_t(which)]).linearVelocity.x = nan;
    IslandFacts facts = findFacts(lab.island(), lab.context);
    EXPECT_TRUE(std::isnan(facts.fastest) && std::isnan(facts.fastestCentre)) << "body " << which;
    facts.bodies = 25;  // too many to be solved directly at any speed
    SolvePlan plan = planOf(facts);
    EXPECT_FALSE(plan.slow || plan.direct);
    EXPECT_EQ(plan.calmStiffening, 1);
  }
}

TEST(Plan, FactsAreThoseOfTheBodies) {
  TestIsland lab;
  std::vector<BodyIndex> pile = lab.pile(lab.ground(), 2);
  lab.at(pile[0]).linearVelocity = {0.3, 0, 0.4};
  lab.at(pile[1]).linearVelocity = {0, 0.1, 0};
  lab.at(pile[1]).angularVelocity = {0, 20, 0};
  IslandFacts facts = findFacts(lab.island(), lab.context);
  double inertia = test::kBrickMass / 3 * (kBrick.x * kBrick.x + kBrick.z * kBrick.z);
  EXPECT_EQ(facts.bodies, 2u);
  EXPECT_TRUE(facts.grounded);
  EXPECT_FALSE(facts.partnersMove);
  EXPECT_DOUBLE_EQ(facts.fastestCentre, 0.5);
  EXPECT_DOUBLE_EQ(facts.fastest, 0.1 + 20 * length(kBrick)) << "spin counts at the outer radius";
  EXPECT_NEAR(facts.energy, 0.5 * test::kBrickMass * (0.25 + 0.01) + 0.5 * inertia * 400, 1e-12);
  for (BodyIndex body : pile) lab.at(body).angularVelocity = {};
  IslandFacts next = findFacts(lab.island(), lab.context);
  EXPECT_DOUBLE_EQ(next.fastest, 0.5);
  TestIsland space;
  BodyIndex first = space.brick({}), second = space.brick({0, 2 * kBrick.y, 0});
  space.touch(first, second);
  EXPECT_FALSE(findFacts(space.island(), space.context).grounded);
}

TEST(Plan, FactsAreJudgedOnTheScaleOfTheTypicalBody) {
  TestIsland lab;
  std::vector<BodyIndex> pile = lab.pile(lab.ground(), 5);
  EXPECT_EQ(findFacts(lab.island(), lab.context).scale.speed, 1) << "bricks under 9.81 m/s2 are the reference";
  lab.bodies.mass[pile[0]].innerRadius = kBrick.y / 64;  // a shard
  lab.bodies.mass[pile[1]].innerRadius = 4 * kBrick.y;   // a block
  lab.at(pile[1]).linearVelocity = {0, 0.1, 0};
  IslandFacts facts = findFacts(lab.island(), lab.context);
  EXPECT_EQ(facts.scale.size, kBrick.y) << "neither decides for all";
  EXPECT_EQ(facts.fastest, 0.1) << "what is larger is judged like those that it moves";
  lab.at(pile[0]).linearVelocity = {0, 0.1, 0};
  EXPECT_DOUBLE_EQ(findFacts(lab.island(), lab.context).fastest, 0.8) << "what is smaller by itself";
  lab.context.judgingGravity = 4 * kReferenceGravity;
  facts = findFacts(lab.island(), lab.context);
  EXPECT_DOUBLE_EQ(facts.fastest, 0.4);
  EXPECT_EQ(facts.scale.length, 1);
  EXPECT_DOUBLE_EQ(facts.scale.time, 0.5);
  EXPECT_EQ(judgingGravity({}), kReferenceGravity) << "nothing weighs anything";
  EXPECT_EQ(judgingGravity({0, 0, 1e-3}), 1e-3);
}

TEST(Plan, KnowsABodyAlone) {
  EXPECT_TRUE(planOf(factsOf(1, true, 0)).alone);
  EXPECT_FALSE(planOf(factsOf(2, true, 0)).alone);
}

TEST(Plan, APartnerThatBeginsToMoveIsSeenInTheSameStep) {
  for (Vec3 spin : {Vec3{}, Vec3{0, 1e-3, 0}}) {
    TestIsland lab;
    BodyIndex plate = lab.block({1, 0.05, 1}, {0, -0.05, 0}, BodyType::kinematic), brick = lab.brick({0, kBrick.y, 0});
    lab.touch(plate, brick);
    lab.at(brick).linearVelocity = {0.005, 0, 0};
    lab.prepare();
    EXPECT_TRUE(lab.island().plan.slow);
    lab.at(brick).linearVelocity = {0.004, 0, 0};  // less energy than before: on still ground it would be stopped
    lab.at(plate).linearVelocity = spin == Vec3{} ? Vec3{0.001, 0, 0} : Vec3{};
    lab.at(plate).angularVelocity = spin;
    lab.prepare();
    EXPECT_TRUE(lab.island().facts.partnersMove);
    EXPECT_FALSE(lab.island().plan.slow);
    EXPECT_EQ(lab.at(brick).linearVelocity.x, 0.004) << "was stopped by what was known of the last step";
  }
}

// --- docs/step.md

std::string yes(bool is) { return is ? "yes" : ""; }
std::string number(double value) {
  std::ostringstream out;
  out << value;
  return out.str();
}
// As people write it: 5e-4.
std::string tolerance(double value) {
  int power = int(std::floor(std::log10(value) + 1e-9));
  return number(std::round(value / std::pow(10, power))) + "e" + number(power);
}

std::string tableOfPlans() {
  std::string out =
      "| bodies of the island | exact steps | direct solve | stiffness when calm, x 1000 u | cycles at most | in "
      "balance "
      "under |\n";
  out += "|---|---|---|---|---|---|\n";
  std::size_t least = 1;
  for (const PlanRow& row : planRows()) {
    auto plan = [&](std::size_t bodies, double speed) {
      IslandFacts facts = factsOf(bodies, row.onlySlow || speed == 0, speed);
      facts.jointed = row.jointed;
      facts.joints = facts.ties = bodies;
      return planOf(facts);
    };
    bool endless = row.mostBodies == std::size_t(-1);
    std::size_t most = endless ? 100000 : row.mostBodies;
    double fast = row.onlySlow ? 0.4 : 2;
    int few = plan(most, fast).maxCycles, many = plan(least, fast).maxCycles, slow = plan(most, 0).maxCycles;
    IslandFacts of = factsOf(most, true, fast);
    of.jointed = row.jointed;
    of.joints = of.ties = most;
    int unbalanced = planOf(of).mostCycles;
    std::string cycles = few == many ? number(few) : number(many) + " to " + number(few);
    if (slow > few) cycles += "; slow: at least " + number(slow);
    if (unbalanced > few) cycles += "; while a twentieth is out of balance: " + number(unbalanced);
    std::string stop = tolerance(plan(most, fast).tolerance) + (row.large ? " of load" : " weights");
    out += "| " + std::string(row.islands) + " | " + yes(row.exactSteps) + " | " + yes(row.direct) + " | " +
           number(double(row.calmStiffening)) + " | " + cycles + " | " + stop + " |\n";
    if (!row.onlySlow && !row.jointed) least = row.mostBodies + 1;
  }
  return out;
}

TEST(Plan, DocumentationPrintsTheTable) {
  std::ifstream file(std::string(BRICKFALL_SOURCE_DIR) + "/docs/step.md");
  std::string page{std::istreambuf_iterator<char>(file), {}};
  ASSERT_FALSE(page.empty());
  const std::string begin = "<!-- made from the table of plans -->\n", end = "<!-- end -->", wanted = tableOfPlans();
  std::size_t from = page.find(begin);
  ASSERT_NE(from, std::string::npos) << "docs/step.md has no block `" << begin << wanted << end << "`";
  from += begin.size();
  std::size_t to = page.find(end, from);
  ASSERT_NE(to, std::string::npos);
  EXPECT_EQ(page.substr(from, to - from), wanted) << "docs/step.md: put this between the two marks:\n" << wanted;
}

}  // namespace
}  // namespace brickfall
