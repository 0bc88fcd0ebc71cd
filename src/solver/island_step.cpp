#include "solver/island_step.h"

#include "solver/cycles.h"
#include "solver/finish/balance.h"
#include "solver/finish/finish.h"
#include "solver/finish/motion.h"
#include "solver/free_motion.h"
#include "solver/impact.h"
#include "solver/island_builder.h"
#include "solver/joint/swings.h"
#include "solver/joint/velocities.h"
#include "solver/prepare.h"
#include "solver/rest.h"
#include "solver/store.h"

namespace brickfall {

namespace {

// After the forces of the step are stored. Sets the groups of the island, and StepContext::solved of its bodies.
void finishMotion(Island& island, Ties& ties, StepContext& context) {
  island.groups.find(island, context);
  storeMotion(island, context);
  if (island.resting()) return;
  finishGroups(island, context);
  finishLoneBody(island, ties, context);
  turnFarFreely(island, context);
  if (island.plan.endVelocities) finishSwings(island, ties, context);
}

// Arms of joints know their arcs, as those of mortar in flight do. Of a part of a turn the rest would be added after
// the solve, and tear them.
void findHeld(const Island& island, const Ties& ties, StepContext& context) {
  for (BodyIndex body : island.bodies) {
    FreeMotion& free = context.free[body];
    free.held = free.jointed = free.asOne = false;
  }
  island.rows.eachKind([&]<class Kind>(const Kind& kind) {
    if (!Kind::kFirm) return;
    const bool knowsArcs = Kind::kLasts ? island.plan.endVelocities : !island.grounded();
    for (std::size_t k = 0; k < kind.size(); k++) {
      const RowEnds ends = kind.ends(k);
      for (std::uint32_t i : {ends.a, ends.b}) {
        if (i >= island.bodies.size()) continue;
        FreeMotion& free = context.free[island.bodies[i]];
        free.held = free.held || knowsArcs;
        free.jointed = free.jointed || Kind::kLasts;
        free.asOne = free.asOne || kind.turnsAsOne(k, ties);
      }
    }
  });
}

}  // namespace

void prepareIsland(Island& island, Ties& ties, BodySet& bodies, StepContext& context) {
  if (island.settled()) {
    island.ending = IslandEnding::settled;
    return;
  }
  island.rows.eachKind([&](auto& kind) { kind.takeRoom(island, ties); });
  const bool last = island.part == IslandPart::last;
  for (BodyIndex body : island.bodies) context.free[body].struckSpin = -bodies.motion[body].angularVelocity;
  giveBlows(island, last, ties, bodies, context);
  for (BodyIndex body : island.bodies) context.free[body].struckSpin += bodies.motion[body].angularVelocity;
  island.facts = findFacts(island, context);
  island.plan = planFor(island.facts, context.settings, island.dt);
  if (last) dampSlowIsland(island, context, bodies);
  if (island.plan.endVelocities) beginSwings(island, context, bodies);
  findHeld(island, ties, context);
  predictFreeMotions(context, bodies, island.bodies, island.dt, island.part != IslandPart::flight,
                     island.plan.endVelocities && island.part != IslandPart::flight);
  prepareBodies(island, context);
  prepareRows(island, ties, context);
  if (island.toImpact()) island.rows.eachKind([&](auto& kind) { kind.leaveOut(ties, context); });
}

void restIsland(Island& island, StepContext& context) {
  if (island.settled())
    context.statistics.restingIslands++;
  else if (island.part == IslandPart::last)
    restCheck(island, context);
  else
    island.ending = IslandEnding::unsolved;
}

void solveIsland(Island& island, const StepContext& context, SolveStatistics& statistics) {
  if (island.resting() || island.part == IslandPart::flight) return;
  updateHierarchy(island, context);
  runCycles(island, context, statistics);
}

void storeIsland(Island& island, Ties& ties, StepContext& context) {
  if (island.settled()) return;
  if (island.part == IslandPart::flight) {
    for (BodyIndex body : island.bodies) storeFreeBody(body, island.dt, context);
    return;
  }
  const bool last = island.part == IslandPart::last, changed = storeRows(island, ties, context);
  if (!last || island.dt < context.dt) tellMean(island, ties, context.dt);
  if (last && island.resting() && !changed) island.ending = IslandEnding::settled;
  if (last) restInPlace(island, context);
  finishMotion(island, ties, context);
}

double balanceIsland(Island& island, Ties& ties, StepContext& context) {
  if (island.part == IslandPart::flight || island.resting() || !solvedWell(island, context)) return 0;
  return holdVelocities(island, ties, context) + checkEnergy(island, context);
}

void stepIsland(Island& island, IslandPart part, double dt, Ties& ties, BodySet& bodies, StepContext& context,
                SolveStatistics& statistics) {
  island.part = part;
  island.dt = dt;
  prepareIsland(island, ties, bodies, context);
  restIsland(island, context);
  solveIsland(island, context, statistics);
  storeIsland(island, ties, context);
  statistics.energyTaken += balanceIsland(island, ties, context);
  island.part = IslandPart::last;
}

}  // namespace brickfall
