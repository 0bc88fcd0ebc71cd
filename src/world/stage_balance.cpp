// The last check on the energy of each island, once, when nothing changes its motion any more.
#include "solver/island_step.h"
#include "world/activity.h"
#include "world/diary.h"
#include "world/registry.h"
#include "world/stage_hash.h"
#include "world/stages.h"

namespace brickfall {

void balanceIslands(const IslandSet& islands, StepContext& context) {
  for (const IslandPointer& island : islands.awake) context.statistics.energyTaken += balanceIsland(*island, context);
}

void hashBalance(const IslandSet& islands, const StepContext& context, HashItems& out) { out.solved(islands, context); }

void bookBalance(const Registry& registry, const Activity& activity, const StepContext& context, Diary& diary) {
  bookSolved(diary.report.ledger->balance, registry.bodies, activity.awake, context, diary.ledgerState);
}

}  // namespace brickfall
