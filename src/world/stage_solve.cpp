// The stages between contacts and new poses: islands, free motion, rest check, solve, forces, restitution. Each runs over
// the awake islands; an island whose forces came to a fixed point is passed over (nothing about it can change).
#include <algorithm>

#include "solver/cycles.h"
#include "solver/energy_guard.h"
#include "solver/free_motion.h"
#include "solver/prepare.h"
#include "solver/rest.h"
#include "solver/restitution.h"
#include "solver/store.h"
#include "world/world_impl.h"

namespace brickfall {

void World::Impl::buildIslands() {
  StageTimer timer(report, Stage::islands);
  if (contacts.changed || membershipChanged) {
    brickfall::buildIslands(islands, context, awake);
    islandOf.assign(bodies.slots(), kNoIndex);
    for (std::size_t i = 0; i < islands.awake.size(); i++)
      for (BodyIndex body : islands.awake[i]->bodies) islandOf[body] = std::uint32_t(i);
    contacts.changed = membershipChanged = false;
  }
  for (auto& island : islands.awake)
    for (BodyIndex partner : island->partners)
      if (!bodies.still[partner]) island->unsettle();
}

void World::Impl::prepare() {
  StageTimer timer(report, Stage::prepare);
  context.free.resize(bodies.slots());
  context.solved.resize(bodies.slots());
  for (BodyIndex body : islands.single) predictFreeMotion(context, body, def.airDensity, false);
  for (auto& island : islands.awake) {
    if (island->settled()) {
      island->ending = IslandEnding::settled;
      continue;
    }
    island->facts = findFacts(*island, context);
    island->plan = planFor(island->facts, context.settings, context.dt);
    dampSlowIsland(*island, context);
    for (BodyIndex body : island->bodies) predictFreeMotion(context, body, def.airDensity, true);
    prepareBodies(*island, context);
    prepareRows(*island, context);
  }
}

void World::Impl::checkRest() {
  StageTimer timer(report, Stage::rest);
  for (auto& island : islands.awake) {
    context.statistics.islands++;
    if (island->settled())
      context.statistics.restingIslands++;
    else
      restCheck(*island, context);
  }
}

void World::Impl::solve() {
  StageTimer timer(report, Stage::solve);
  std::pmr::vector<SolveStatistics> counts(islands.awake.size(), &stepMemory);
  pool->forRange(int(islands.awake.size()), 1, [&](int begin, int end) {
    for (int i = begin; i < end; i++) {
      Island& island = *islands.awake[std::size_t(i)];
      if (island.resting()) continue;
      updateHierarchies(island, context);
      runCycles(island, context, counts[std::size_t(i)]);
      correctMomentum(island, context);
    }
  });
  for (const SolveStatistics& s : counts) {
    context.statistics.cycles += s.cycles;
    context.statistics.solveSides += s.solveSides;
    context.statistics.lightVisits += s.lightVisits;
    context.statistics.residualRms = std::max(context.statistics.residualRms, s.residualRms);
  }
}

void World::Impl::store() {
  StageTimer timer(report, Stage::store);
  for (BodyIndex body : islands.single) storeFreeBody(body, context);
  for (auto& island : islands.awake) {
    if (island->settled()) continue;
    bool changed = storeRows(*island, context);
    if (!island->resting()) collectHits(*island);
    storeMotion(*island, context);
    correctFlight(*island, context);
    correctLoneBody(*island, context);
    if (island->resting() && !changed) island->ending = IslandEnding::settled;
    restIfHeld(*island, context);
  }
}

void World::Impl::restitute() {
  StageTimer timer(report, Stage::restitution);
  for (auto& island : islands.awake) {
    if (island->settled()) continue;
    applyRestitution(*island, context);
    guardEnergy(*island, context);
  }
}

}  // namespace brickfall
