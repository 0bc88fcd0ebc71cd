// Results of the solve are kept: forces for the next step, motions for the stages to come. Hits are told here, by the
// forces of the solve.

#include "solver/finish/motion.h"
#include "solver/island_step.h"
#include "solver/store.h"
#include "world/activity.h"
#include "world/diary.h"
#include "world/registry.h"
#include "world/stage_hash.h"
#include "world/stages.h"

namespace brickfall {

namespace {

void collectHits(const WorldDef& def, const Registry& registry, const Island& island, const StepContext& context,
                 std::vector<HitEvent>& out) {
  std::pmr::vector<TieImpact> impacts(island.memory);
  impacts.assign(island.blows.impacts.begin(), island.blows.impacts.end());
  island.rows.eachKind([&](const auto& kind) { kind.findHits(island, context, def.hitEventSpeed, impacts); });
  tellHits(def, registry, impacts, out);
}

// The work of ties, and how it changed their elastic energy.
BalanceChange tiesNow(const IslandSet& islands, const StepContext& context, double elasticBefore, double& rebound,
                      StepLedger& ledger) {
  BalanceChange out;
  double elastic = elasticAsleep(context);
  for (const IslandPointer& island : islands.awake) {
    TieWork ofTies = workOf(*island, context);
    out.energy += ofTies.work;
    rebound += ofTies.rebound;
    ledger.tensionFracture += ofTies.pull;
    ledger.shearFracture += ofTies.shear;
    ledger.crushing += ofTies.crush;
    elastic += ofTies.elastic;
  }
  out.elastic = elastic - elasticBefore;
  return out;
}

}  // namespace

void storeSolution(const WorldDef& def, const Registry& registry, IslandSet& islands, Ties& ties, StepContext& context,
                   Events& events) {
  for (BodyIndex body : islands.single) storeFreeBody(body, context.dt, context);
  for (IslandPointer& island : islands.awake) {
    const bool solved = !island->resting();  // even if it is put to rest in place below
    storeIsland(*island, ties, context);
    if (solved) collectHits(def, registry, *island, context, events.hits);
  }
}

void hashStore(const IslandSet& islands, const Ties& ties, const StepContext& context, HashItems& out) {
  out.solved(islands, context);
  out.rows(islands, ties, [&](Mix& h, const Island& island, const auto& kind, std::size_t k) {
    kind.hashMemory(h, k, ties);
    h(int(island.ending), island.inPlaceTime, island.fastestLately);
  });
}

void bookStore(const Registry& registry, const Activity& activity, const StepContext& context, Diary& diary) {
  const BodySet& bodies = registry.bodies;
  LedgerState& s = diary.ledgerState;
  StepLedger& ledger = *diary.report.ledger;
  BalanceChange supports;
  for (const IslandPointer& island : activity.islands.awake) supports += supportOf(*island, context);
  Vec3 inFlight, inContact;
  for (BodyIndex body : activity.awake) {
    const SolvedMotion& m = context.solved[body];
    (m.flying ? inFlight : inContact) += cross(m.d, m.velocity * bodies.mass[body].mass);
  }
  supports.angular += inContact;
  ledger.supports += supports;
  ledger.gravity.angular += inFlight;
  Balance now = s.moving(solvedBalance(activity.awake, bodies, context));
  double rebound = 0;
  BalanceChange ofTies = tiesNow(activity.islands, context, s.now.elastic, rebound, ledger);
  ledger.solve += now - s.now - s.push - supports - BalanceChange{{}, inFlight, ofTies.energy + rebound};
  ledger.rebound.energy += rebound;
  s.now = now;
  s.now.elastic += ofTies.elastic;
  ledger.contacts += ofTies;
}

}  // namespace brickfall
