// The last check on the energy of each island, once, when nothing changes its motion any more. A group that it lets go
// freely goes a way that nobody has looked along: then once more.
#include "solver/island_step.h"
#include "solver/joint/velocities.h"
#include "world/activity.h"
#include "world/diary.h"
#include "world/registry.h"
#include "world/stage_hash.h"
#include "world/stages.h"

namespace brickfall {

void balanceIslands(const Registry& registry, const Activity& activity, const Proximity& proximity, Ties& ties,
                    StepContext& context) {
  auto balance = [&] {
    context.freed = false;
    for (const IslandPointer& island : activity.islands.awake)
      context.statistics.energyTaken += balanceIsland(*island, ties, context);
    return !context.freed;
  };
  if (balance()) return;
  stopAtObstacles(registry, activity, proximity, context, true);
  balance();
}

void hashBalance(const IslandSet& islands, const StepContext& context, HashItems& out) { out.solved(islands, context); }

void bookBalance(const Registry& registry, const Activity& activity, const StepContext& context, Diary& diary) {
  BalanceChange supports;
  for (const IslandPointer& island : activity.islands.awake)
    if (!island->resting()) supports += supportAtEnd(*island);
  diary.report.ledger->supports += supports;
  diary.report.ledger->balance += BalanceChange() - supports;
  bookSolved(diary.report.ledger->balance, registry.bodies, activity.awake, context, diary.ledgerState);
}

}  // namespace brickfall
