// Kinetic damping; where each body would go if nothing touched it; contacts to records. A settled island, in which
// nothing can change, is passed over from here to the balance.
#include "solver/free_motion.h"
#include "solver/island_step.h"
#include "world/activity.h"
#include "world/diary.h"
#include "world/registry.h"
#include "world/stage_hash.h"
#include "world/stages.h"

namespace brickfall {

void prepare(Registry& registry, IslandSet& islands, Ties& ties, StepContext& context) {
  BodySet& bodies = registry.bodies;
  context.makeRoom(bodies.slots());
  predictFreeMotions(context, bodies, islands.single, context.dt, false);
  for (IslandPointer& island : islands.awake) prepareIsland(*island, ties, bodies, context);
}

void hashPrepare(const Registry& registry, const IslandSet& islands, const Ties& ties, const StepContext& context,
                 HashItems& out) {
  out.bodies(islands.single, [&](Mix& h, BodyIndex body) { mix(h, context.free[body]); });
  for (const IslandPointer& island : islands.awake) {
    if (island->settled()) continue;
    out.bodies(island->bodies, [&](Mix& h, BodyIndex body) {
      mix(h, context.free[body]);
      mix(h, registry.bodies.motion[body]);
    });
  }
  out.rows(islands, ties, [&](Mix& h, const Island&, const auto& kind, std::size_t k) {
    kind.hashMemory(h, k, ties);
    kind.hashRecord(h, k, ties);
  });
}

namespace {

// Balance of the bodies for which free motion was predicted, before damping and drag.
Balance atStart(const BodySet& bodies, const IslandSet& islands, const StepContext& context) {
  Balance sum;
  auto addTo = [&](BodyIndex body) {
    const FreeMotion& free = context.free[body];
    addBody(sum, bodies.mass[body], bodies.motion[body].position, free.startVelocity, free.startSpin,
            bodies.worldInertia(body) * free.startSpin);
  };
  for (BodyIndex body : islands.single) addTo(body);
  for (const IslandPointer& island : islands.awake)
    if (!island->settled())
      for (BodyIndex body : island->bodies) addTo(body);
  return sum;
}

}  // namespace

void bookPrepare(const Registry& registry, const Activity& activity, const StepContext& context, Diary& diary) {
  const BodySet& bodies = registry.bodies;
  LedgerState& s = diary.ledgerState;
  StepLedger& ledger = *diary.report.ledger;
  s.book(ledger.stopped, s.moving(atStart(bodies, activity.islands, context)));
  BalanceChange blows;
  for (const IslandPointer& island : activity.islands.awake)
    if (!island->settled()) blows += island->blows.change;
  ledger.stopped = ledger.stopped - blows;
  ledger.impacts += blows;
  Balance start = balanceNow(bodies, context);
  s.bookElastic(ledger.renewed, start.elastic);
  s.book(ledger.damping, start);
  BalanceChange gravity, forces;
  for (BodyIndex body : activity.awake) {
    const BodyData& data = bodies.data[body];
    std::uint32_t in = activity.islandOf[body];
    double dt = in == kNoIndex ? context.dt : activity.islands.awake[in]->dt;
    Vec3 at = bodies.motion[body].position;
    Vec3 weight = context.gravity * (bodies.mass[body].mass * data.gravityScale * dt), force = data.force * dt;
    gravity += {weight, cross(at, weight), 0};
    forces += {force, cross(at, force) + data.torque * dt, 0};
  }
  ledger.gravity += gravity;
  ledger.forces += forces;
  s.push = gravity;
  s.push += forces;
}

}  // namespace brickfall
