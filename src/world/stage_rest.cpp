// For slow islands: do last step's forces balance without any motion?
#include "solver/island_step.h"
#include "world/stage_hash.h"
#include "world/stages.h"

namespace brickfall {

void checkRest(IslandSet& islands, StepContext& context) {
  for (IslandPointer& island : islands.awake) {
    context.statistics.islands++;
    restIsland(*island, context);
  }
}

void hashRest(const IslandSet& islands, HashItems& out) {
  out.islands(islands.awake, [](Mix& h, const Island& i) { h(!i.settled() && i.plan.slow, int(i.ending)); });
}

}  // namespace brickfall
