// Islands: which bodies ties join. Built only if ties came or went, or bodies woke.
#include "world/activity.h"
#include "world/diary.h"
#include "world/registry.h"
#include "world/stage_hash.h"
#include "world/stages.h"

namespace brickfall {

void renewIslands(const Registry& registry, const StepContext& context, Activity& activity, Ties& ties) {
  IslandSet& islands = activity.islands;
  if (!activity.current(ties)) {
    buildIslands(islands, ties, context, activity.awake);
    activity.islandOf.assign(registry.bodies.slots(), kNoIndex);
    activity.renumberIslands();
    ties.islandsAreBuilt();
    activity.membershipChanged = false;
  }
  for (IslandPointer& island : islands.awake)
    for (BodyIndex partner : island->partners)
      if (!registry.bodies.still[partner]) island->unsettle();
}

void hashIslands(const Ties& ties, const IslandSet& islands, HashItems& out) {
  out.bodies(islands.single, [](Mix&, BodyIndex) {});
  out.islands(islands.awake, [&](Mix& h, const Island& i) {
    h.list(i.bodies.data(), int(i.bodies.size())).list(i.partners.data(), int(i.partners.size()));
    i.rows.each([&](const auto& kind, std::size_t k) { kind.hashName(h, k, ties); });
  });
}

// Books every change since the step began: by the contacts and by quarantine.
void bookIslands(const Registry& registry, const StepContext& context, Diary& diary) {
  Balance now = balanceNow(registry.bodies, context);
  diary.ledgerState.bookElastic(diary.report.ledger->remade, now.elastic);
  diary.ledgerState.book(diary.report.ledger->quarantine, now);
}

}  // namespace brickfall
