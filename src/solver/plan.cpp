#include "solver/plan.h"

#include <algorithm>
#include <cmath>

#include "base/take_larger.h"
#include "solver/island.h"

namespace brickfall {

namespace {

//! m/s | too small: late collapses | too large: cost
constexpr double kDirectSpeed = 1;  // m/s: grounded islands of dozens of bodies are solved directly if none is faster

// Small islands are cheap: they take exact steps, since open points counted as closed delay their collapses, and are
// stiffer when calm, since they converge all the same. Larger ones would lose walls by it. A body alone: its cycle is the
// whole Newton step.
//! not of the method: docs/step.md prints the table
constexpr std::size_t kAny = std::size_t(-1);
constexpr PlanRow kRows[] = {
    {"one body", 1, false, true, 10, false},
    {"2 to 12", 12, false, true, 10, true},
    {"13 to 24, grounded, none faster than 1 m/s", 24, true, true, 10, true},
    {"13 to 24", 24, false, true, 10, false},
    {"25 to 80, grounded, none faster than 1 m/s", 80, true, false, 1, true},
    {"25 and more", kAny, false, false, 1, false},
};

// Small islands, when they collapse, need more cycles than a wall to move at their true speed.
int cycleBudget(const IslandFacts& facts, bool slow, const SolverSettings& settings) {
  int bySize = int(640 / facts.bodies);
  int budget = std::clamp(bySize, settings.maxCycles, std::max(settings.maxCycles, settings.maxCyclesSmall));
  return slow ? std::max(budget, kMaxCyclesSlow) : budget;
}

const PlanRow& rowOf(const IslandFacts& facts) {
  bool slow = facts.grounded && facts.fastestCentre < kDirectSpeed;
  return *std::find_if(std::begin(kRows), std::end(kRows),
                       [&](const PlanRow& row) { return facts.bodies <= row.mostBodies && (slow || !row.onlySlow); });
}

}  // namespace

std::span<const PlanRow> planRows() { return kRows; }

IslandFacts findFacts(const Island& island, BodySet& bodies) {
  IslandFacts facts;
  facts.bodies = island.bodies.size();
  facts.grounded = island.grounded();
  for (BodyIndex body : island.bodies) {
    BodyData& data = bodies.data[body];
    const BodyMotion& m = bodies.motion[body];
    facts.energyBefore += data.lastKineticEnergy;
    data.lastKineticEnergy = bodies.kineticEnergy(body);
    facts.energy += data.lastKineticEnergy;
    double speed = length(m.linearVelocity);  // what is not a number is not slow
    takeLarger(facts.fastestCentre, speed);
    takeLarger(facts.fastest, speed + length(m.angularVelocity) * bodies.mass[body].innerRadius);
  }
  for (BodyIndex body : island.partners) {
    const BodyMotion& m = bodies.motion[body];
    facts.partnersMove =
        facts.partnersMove || lengthSquared(m.linearVelocity) > 0 || lengthSquared(m.angularVelocity) > 0;
  }
  return facts;
}

SolvePlan planFor(const IslandFacts& facts, const SolverSettings& settings, double dt) {
  const PlanRow& row = rowOf(facts);
  bool supported = facts.grounded && !facts.partnersMove;
  bool calm = supported && facts.fastest <= settings.restSpeed + kCalmShare * kReferenceGravity * dt;
  SolvePlan plan;
  plan.slow = supported && facts.fastest <= settings.restSpeed;
  plan.exactSteps = row.exactSteps;
  plan.direct = row.direct;
  plan.stiffening = calm ? double(row.calmStiffening) : 1;
  // The loose stop on forces alone would hold up, or set back, a block that is just past its balance.
  plan.judgeWorst = plan.slow || row.exactSteps;
  plan.tolerance = plan.judgeWorst ? kSlowTolerance : settings.cycleTolerance;
  plan.minCycles = settings.minCycles;
  plan.maxCycles = row.direct ? settings.minCycles : cycleBudget(facts, plan.slow, settings);
  return plan;
}

}  // namespace brickfall
