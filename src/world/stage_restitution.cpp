// Rebound of impacts.
#include "solver/finish/rebound.h"
#include "world/activity.h"
#include "world/diary.h"
#include "world/registry.h"
#include "world/stage_hash.h"
#include "world/stages.h"

namespace brickfall {

void restitute(IslandSet& islands, ContactSet& contacts, StepContext& context) {
  for (IslandPointer& island : islands.awake) {
    if (island->settled()) continue;
    rebound(*island, Ties{contacts}, context);
  }
}

void hashRestitution(const IslandSet& islands, const ContactSet& contacts, const StepContext& context, HashItems& out) {
  out.solved(islands, context);
  out.contacts(islands, contacts);
}

void bookRestitution(const Registry& registry, const Activity& activity, const StepContext& context, Diary& diary) {
  bookSolved(diary.report.ledger->rebound, registry.bodies, activity.awake, context, diary.ledgerState);
}

}  // namespace brickfall
