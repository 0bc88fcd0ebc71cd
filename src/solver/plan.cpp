#include "solver/plan.h"

#include <algorithm>

#include "base/take_larger.h"
#include "solver/island.h"
#include "solver/joint/swings.h"

namespace brickfall {

namespace {

//! m/s | too small: late collapses; walls that sway are softened, and sag | too large: cost; debris does not converge
constexpr double kDebrisSpeed = 0.5;  // of a body: its island is debris. It is not solved directly, and its contacts of
                                      // moving bodies are soft
//! x `maxCycles` | too small: large islands that are widely out of balance stay so: they shake on, and rest late
//! | too large: cost
constexpr int kMostCycles = 3;  // while many bodies of a large island are out of balance
//! - | too small: bodies that hang by one corner take all cycles | too large: cost
constexpr int kRounds = 3;  // sweeps over the bodies in a cycle

// Small islands are cheap. They take exact steps, since open points counted as closed delay their collapses. They are
// stiffer when calm, since they converge all the same. Larger islands would lose walls by it. A body alone: its cycle
// is the whole Newton step.
//! not of the method: docs/step.md prints the table
constexpr std::size_t kAny = std::size_t(-1);
constexpr PlanRow kRows[] = {
    {"1 to 80, with joints", 80, true, false, false, true, 1, true, false},
    {"one body", 1, false, false, false, true, 10, false, false},
    {"2 to 24", 24, false, false, false, true, 10, true, false},
    {"25 to 80, grounded, none faster than 0.5 m/s", 80, false, false, true, false, 1, true, false},
    {"81 to 400, joints in a line", 400, true, true, false, true, 1, true, false},
    {"25 and more", kAny, false, false, false, false, 1, false, true},
};

const PlanRow& rowOf(const IslandFacts& facts) {
  bool slow = facts.grounded && facts.fastestCentre < kDebrisSpeed;
  return *std::find_if(std::begin(kRows), std::end(kRows), [&](const PlanRow& row) {
    return facts.bodies <= row.mostBodies && (facts.jointed || !row.jointed) && (facts.inLine() || !row.inLine) &&
           (slow || !row.onlySlow);
  });
}

// m: the median of the inner radii. By the least size a shard between blocks would decide for all of them. By a mean by
// mass a ball would that outweighs the wall that it hits.
double typicalSize(const Island& island, const BodySet& bodies) {
  std::pmr::vector<double> sizes(island.memory);
  sizes.reserve(island.bodies.size());
  for (BodyIndex body : island.bodies) sizes.push_back(bodies.mass[body].innerRadius);
  const auto middle = sizes.begin() + std::ptrdiff_t((sizes.size() - 1) / 2);
  std::nth_element(sizes.begin(), middle, sizes.end());
  return *middle;
}

// What holds the island to what is fixed or kinematic.
void findSupport(const Island& island, const StepContext& context, IslandFacts& facts) {
  island.rows.each([&](const auto& kind, std::size_t k) {
    if (facts.pinned) return;  // in a wall, one of the first rows tells
    const RowEnds ends = kind.ends(k);
    if (ends.a < facts.bodies && ends.b < facts.bodies) return;
    facts.pressed = facts.pressed || kind.carriesForce(k, context);
    facts.pinned = kind.pins(k, context);
  });
}

// Its locks keep the body from falling: what lies on it is supported.
bool holdsItself(BodyIndex body, const StepContext& context) {
  const unsigned ways = context.bodies->mass[body].locks & kAllWays;
  return ways == kAllWays ||
         (ways != 0 && context.gravity != Vec3{} && context.bodies->freeWay(body, context.gravity) == Vec3{});
}

}  // namespace

std::span<const PlanRow> planRows() { return kRows; }

IslandFacts findFacts(const Island& island, const StepContext& context) {
  const BodySet& bodies = *context.bodies;
  IslandFacts facts;
  facts.scale = scaleOf(typicalSize(island, bodies), context.judgingGravity);
  facts.bodies = island.bodies.size();
  facts.grounded = island.grounded();
  facts.ties = island.rows.size();
  facts.jointed = island.rows.anyLasting();
  facts.swung = facts.jointed && hasSwung(island);
  facts.mortared = island.rows.anyYielding();
  facts.firm = island.rows.anyFirm();
  island.rows.eachKind([&]<class Kind>(const Kind& kind) { facts.joints += Kind::kLasts ? kind.size() : 0; });
  for (BodyIndex body : island.bodies) {
    const BodyMotion& m = bodies.motion[body];
    facts.locked = facts.locked || bodies.mass[body].locks != 0;
    facts.grounded = facts.grounded || holdsItself(body, context);
    facts.energy += bodies.kineticEnergy(body);
    facts.heaviest = std::max(facts.heaviest, bodies.mass[body].mass);
    const double unit = facts.scale.ofBody(bodies.mass[body].innerRadius).speed;
    double speed = length(m.linearVelocity);  // a speed that is not a number is not slow
    takeLarger(facts.fastestCentre, speed / unit);
    double withSpin = speed + length(m.angularVelocity) * bodies.mass[body].outerRadius;
    takeLarger(facts.fastest, withSpin / unit);
  }
  for (BodyIndex body : island.partners) {
    const BodyMotion& m = bodies.motion[body];
    facts.partnersGo = facts.partnersGo || lengthSquared(m.linearVelocity) > 0 || lengthSquared(m.angularVelocity) > 0;
    facts.partnersMove = facts.partnersMove || facts.partnersGo || bodies.carries(body);
  }
  if (facts.grounded && facts.fastest > context.settings.restSpeed) findSupport(island, context, facts);
  return facts;
}

SolvePlan planFor(const IslandFacts& facts, const SolverSettings& settings, double dt) {
  const PlanRow& row = rowOf(facts);
  bool supported = facts.grounded && !facts.partnersMove;
  bool calm =
      supported && facts.fastest <= settings.restSpeed + kCalmShare * facts.scale.gravity * dt / facts.scale.speed;
  SolvePlan plan;
  plan.alone = facts.bodies == 1;
  plan.slow = supported && facts.fastest <= settings.restSpeed;
  plan.mayBeStopped = supported && facts.fastest <= (row.large ? kMovingSpeed : settings.restSpeed);
  plan.endVelocities = facts.jointed && !facts.locked;
  plan.holds = plan.endVelocities && !row.large && facts.joints + 1 >= facts.bodies;
  plan.swings = plan.holds && facts.joints == facts.ties && !facts.partnersMove;
  plan.exactSteps = row.exactSteps;
  plan.direct = row.direct;
  plan.calm = calm;
  plan.calmStiffening = calm ? double(row.calmStiffening) : 1;
  plan.leastMass = row.direct ? kTrifle * facts.heaviest : 0;
  plan.large = row.large;
  plan.startsFree = !facts.grounded || !(row.large || facts.mortared);
  plan.goesOn = row.large && facts.pressed && !facts.pinned && !plan.slow;
  plan.softDebris = row.large && facts.fastest > kDebrisSpeed;
  plan.tolerance = row.large ? settings.cycleTolerance : kSmallTolerance;
  plan.minCycles = row.direct && row.exactSteps ? 1 : settings.minCycles;
  plan.maxCycles = row.direct   ? plan.minCycles
                   : plan.alone ? std::max(settings.maxCycles, settings.maxCyclesSmall)
                                : settings.maxCycles;
  plan.mostCycles = row.large ? kMostCycles * settings.maxCycles : plan.maxCycles;
  plan.rounds = kRounds;
  if (!row.large || !facts.mortared) return plan;
  // Firm ties spread what all must do together through cycles, not through sweeps: as many sweeps, one in a cycle. They
  // are linear, so that all bodies at once find what strains them; as rigid clusters they would be too firm for it.
  plan.together = 0;
  plan.rounds = 1;
  plan.renewAfter = plan.maxCycles;
  plan.mostCycles *= kRounds;
  return plan;
}

}  // namespace brickfall
