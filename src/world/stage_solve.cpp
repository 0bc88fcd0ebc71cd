// The solve: cycles over the hierarchies of every island that does not rest, side by side; each touches nothing but itself.
#include <algorithm>

#include "solver/cycles.h"
#include "solver/island_builder.h"
#include "world/solve_state.h"
#include "world/stage_hash.h"
#include "world/stages.h"

namespace brickfall {

void solveIslands(IslandSet& islands, SolveState& state) {
  StepContext& context = state.context;
  std::pmr::vector<SolveStatistics> counts(islands.awake.size(), &state.memory);
  auto solveOne = [&](std::size_t i) {
    Island& island = *islands.awake[i];
    if (island.resting()) return;
    updateHierarchy(island, context);
    runCycles(island, context, counts[i]);
    correctMomentum(island, context);
  };
  // One reference: what holds more takes memory of the heap.
  state.workers->forRange(int(islands.awake.size()), 1, [&solveOne](int begin, int end) {
    for (int i = begin; i < end; i++) solveOne(std::size_t(i));
  });
  for (const SolveStatistics& s : counts) {
    context.statistics.cycles += s.cycles;
    context.statistics.solveSides += s.solveSides;
    context.statistics.lightVisits += s.lightVisits;
    context.statistics.residualRms = std::max(context.statistics.residualRms, s.residualRms);
    context.statistics.worstResidual = std::max(context.statistics.worstResidual, s.worstResidual);
    context.statistics.leftOver += s.leftOver;
  }
}

void hashSolve(const Registry& registry, const IslandSet& islands, HashItems& out) {
  for (const IslandPointer& island : islands.awake) {
    if (island->resting()) continue;
    for (std::size_t k = 0; k < island->bodies.size(); k++) {
      Mix h;
      h(island->motion[k].d, island->motion[k].th);
      out.add(registry.idOf(island->bodies[k]), {}, h);
    }
  }
}

}  // namespace brickfall
