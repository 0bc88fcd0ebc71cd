// The solve of every island that does not rest, side by side: each island's solve touches nothing but the island.
#include "solver/island_builder.h"
#include "solver/island_step.h"
#include "world/solve_state.h"
#include "world/stage_hash.h"
#include "world/stages.h"

namespace brickfall {

void solveIslands(IslandSet& islands, SolveState& state) {
  StepContext& context = state.context;
  std::pmr::vector<SolveStatistics> counts(islands.awake.size(), &state.memory);
  auto solveOne = [&](std::size_t i) { solveIsland(*islands.awake[i], context, counts[i]); };
  // The lambda captures one reference: a larger one takes memory from the heap.
  state.workers->forRange(int(islands.awake.size()), 1, [&solveOne](int begin, int end) {
    for (int i = begin; i < end; i++) solveOne(std::size_t(i));
  });
  for (const SolveStatistics& s : counts) context.statistics.add(s);
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
