// New poses and velocities. A body that became non-finite is quarantined here: it stays where it was, out of all
// contacts.
#include <algorithm>
#include <cmath>

#include "solver/finish/motion.h"
#include "solver/store.h"
#include "world/activity.h"
#include "world/diary.h"
#include "world/move_body.h"
#include "world/proximity.h"
#include "world/quarantine.h"
#include "world/stage_hash.h"
#include "world/stages.h"

namespace brickfall {

namespace {

struct Integration {
  const Clock& clock;
  BodySet& bodies;
  const Registry& registry;
  Proximity& proximity;
  Ties& ties;
  const StepContext& context;
  Quarantine& quarantine;

  void finishBody(BodyIndex body);
  void finishIsland(Island& island);
  void salvage(Island& island);
  void drive(BodyIndex body);
  void rememberDriven(BodyIndex body);
  void rememberSpeed(BodyIndex body);
};

// Pose, velocity and acceleration of a body after the solve.
void Integration::finishBody(BodyIndex body) {
  BodyData& data = bodies.data[body];
  BodyMotion& m = bodies.motion[body];
  if (context.solved[body].rest) {
    m.linearVelocity = m.angularVelocity = {};
    data.steady = {};
    data.impactLoss = 0;
    bodies.still[body] = 1;
  } else {
    bodies.still[body] = 0;
    if (!moveBody(body, bodies, context)) quarantine.hold(body);
    proximity.keepBounds(registry, body);
  }
  if (!clock.lastPart) return;
  data.linearAcceleration = (m.linearVelocity - data.lastLinearVelocity) * (1 / clock.callDt);
  data.angularAcceleration = (m.angularVelocity - data.lastAngularVelocity) * (1 / clock.callDt);
  rememberSpeed(body);
}

// The sums of an island overflowed. Its fastest body, which must have caused it, is quarantined. The others stay where
// they are for this step, with the velocities they had, and their contacts start afresh.
void Integration::salvage(Island& island) {
  BodyIndex culprit = island.bodies.front();
  double fastest = -1;
  for (BodyIndex body : island.bodies) {
    const FreeMotion& free = context.free[body];
    double speed = length(free.startVelocity) + length(free.startSpin) * bodies.mass[body].outerRadius;
    speed += length(free.d) + length(free.th) * bodies.mass[body].outerRadius;
    if (!(speed <= fastest)) {  // also takes NaN
      culprit = body;
      fastest = std::isfinite(speed) ? speed : 1e300;
    }
  }
  for (BodyIndex body : island.bodies) {
    bodies.motion[body].linearVelocity = context.free[body].startVelocity;
    bodies.motion[body].angularVelocity = context.free[body].startSpin;
    bodies.still[body] = 0;
  }
  island.rows.eachKind([&](const auto& kind) { kind.startAfresh(ties); });
  island.ending = IslandEnding::unsolved;
  quarantine.hold(culprit);
}

void Integration::finishIsland(Island& island) {
  if (island.settled()) {
    // The island does not move, and it did not move in the last step.
    for (BodyIndex body : island.bodies)
      if (!bodies.still[body]) finishBody(body);
    return;
  }
  if (!solvedWell(island, context)) {
    salvage(island);
    return;
  }
  advanceRows(island, ties, context);
  for (BodyIndex body : island.bodies) finishBody(body);
}

// A kinematic body goes on at its velocity.
void Integration::drive(BodyIndex body) {
  BodyMotion& m = bodies.motion[body];
  m.position += m.linearVelocity * context.dt;
  bodies.setRotation(body, normalized(quatFromRotationVector(m.angularVelocity * context.dt) * m.rotation));
  bodies.still[body] = 0;
  proximity.keepBounds(registry, body);
}

// What stands has no motion that goes on.
void Integration::rememberDriven(BodyIndex body) {
  double& usual = bodies.data[body].usualChange;
  const double kept = clock.lastPart ? kUsualKept * usual : usual;
  usual = bodies.isDriven(body) ? std::max(kept, bodies.speedChange(body)) : 0;
  rememberSpeed(body);
}

void Integration::rememberSpeed(BodyIndex body) {
  bodies.data[body].lastLinearVelocity = bodies.motion[body].linearVelocity;
  bodies.data[body].lastAngularVelocity = bodies.motion[body].angularVelocity;
}

}  // namespace

void integrate(const Clock& clock, const StepContext& context, Registry& registry, Activity& activity,
               Proximity& proximity, Ties& ties, Quarantine quarantine) {
  Integration all{clock, registry.bodies, registry, proximity, ties, context, quarantine};
  for (IslandPointer& island : activity.islands.awake) all.finishIsland(*island);
  for (BodyIndex body : activity.islands.single) all.finishBody(body);
  for (BodyIndex body : activity.moving) all.rememberDriven(body);
  for (BodyIndex body : activity.unsettled)
    if (!registry.bodies.isDriven(body)) all.rememberDriven(body);
  activity.settleUnmoved(registry.bodies);
  for (BodyIndex body : activity.moving) all.drive(body);
  quarantine.isolateHeld();
}

void hashIntegrate(const Registry& registry, const Activity& activity, const Ties& ties, HashItems& out) {
  const BodySet& bodies = registry.bodies;
  for (const auto* list : {&activity.awake, &activity.moving})
    out.bodies(*list, [&](Mix& h, BodyIndex body) {
      mix(h, bodies.motion[body]);
      h(bodies.still[body], bodies.data[body].quarantined, bodies.data[body].linearAcceleration,
        bodies.data[body].angularAcceleration);
    });
  out.memories(activity.islands, ties);
}

void bookIntegrate(const Registry& registry, const Activity& activity, const StepContext& context, Diary& diary) {
  const BodySet& bodies = registry.bodies;
  LedgerState& s = diary.ledgerState;
  StepLedger& ledger = *diary.report.ledger;
  double work = 0;
  for (BodyIndex body : activity.pushed)
    work +=
        dot(bodies.data[body].force, context.solved[body].d) + dot(bodies.data[body].torque, context.solved[body].th);
  Balance now = balanceNow(bodies, context);
  double fallen = now.potential - s.now.potential;
  ledger.forces.energy += work;
  ledger.solve.energy += fallen - work;
  s.now.potential = now.potential;
  bool quarantined = diary.report.quarantined.size() > s.quarantined;
  s.bookElastic(quarantined ? ledger.quarantine : ledger.renewed, now.elastic);
  s.book(quarantined ? ledger.quarantine : ledger.integrate, now);
  ledger.after = s.last = now;
  s.begun = true;
}

}  // namespace brickfall
