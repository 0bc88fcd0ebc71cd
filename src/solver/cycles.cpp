#include "solver/cycles.h"

#include "base/take_larger.h"
#include "solver/joint/swings.h"
#include "solver/light_pass.h"
#include "solver/renewals.h"

namespace brickfall {

namespace {

// The change of velocity of the last step once more, but no more than that of free motion: an impact's is over. Goes on
// with that what rolls or slides under a constant force: all of it is in balance from the start.
void goOnAccelerating(const Island& island, std::size_t i, const StepContext& context, SolveMotion& out) {
  const BodyIndex body = island.bodies[i];
  const BodyMotion& m = context.bodies->motion[body];
  const BodyData& data = context.bodies->data[body];
  const FreeMotion& free = context.free[body];
  const double most = length(free.d * (1 / island.dt) - free.startVelocity) / island.dt;
  const double had =
      length(data.linearAcceleration) + length(data.angularAcceleration) * context.bodies->mass[body].innerRadius;
  const double time = island.dt * (had > most ? most / had : 1);
  out.d = toFloat((m.linearVelocity + data.linearAcceleration * time) * island.dt);
  out.th = toFloat((m.angularVelocity + data.angularAcceleration * time) * island.dt);
}

// Free motion is the honest start: motion that cycles leave undone then falls. Large islands on the ground start from
// where their velocities lead. Otherwise a wall or a heap would fall by the undone motion, a little in every step. No
// brick hangs by this start: each one out of balance by itself is moved until it is in balance.
void startMotion(Island& island, const StepContext& context) {
  for (std::size_t i = 0; i < island.bodies.size(); i++) {
    const SolveMass& free = island.masses[i];
    const BodyMotion& m = context.bodies->motion[island.bodies[i]];
    const FreeMotion& started = context.free[island.bodies[i]];
    SolveMotion& out = island.motion[i];
    out = {};
    out.d = island.plan.startsFree ? free.dFree : toFloat((m.linearVelocity - started.late) * island.dt);
    out.th = island.plan.startsFree ? free.thFree : toFloat((m.angularVelocity - started.lateSpin) * island.dt);
    if (island.plan.goesOn) goOnAccelerating(island, i, context, out);
  }
  island.chunks.start(island, context);
}

void countLeftOver(const Island& island, const StepContext& context, SolveStatistics& statistics) {
  takeLarger(statistics.residualRms, rmsResidual(island, *context.bodies));
  LeftOver left = leftOver(island, *context.bodies);
  takeLarger(statistics.worstResidual, left.worst);
  statistics.leftOver += left.bodies;
}

}  // namespace

bool Renewals::next(Island& island, const StepContext& context, Renewal when) {
  if (made_ == kMostRenewals) return false;
  bool any = false;
  island.rows.eachKind([&](auto& kind) { any = kind.renewFrozen(island, context, when) || any; });
  made_ += any;
  return any;
}

bool goOn(Island& island, const StepContext& context, SolveStatistics& statistics, Renewals* renewals) {
  // Moved one by one, bodies on joints get nowhere; but they find which bounds are reached.
  if (island.plan.direct && island.facts.jointsAlone() && !hasBounds(island))
    lightPass(island, false, statistics.lightVisits);
  else if (const bool done = relax(island, context, statistics, renewals); !island.plan.direct)
    return done;
  solveDirectly(island, context, island.plan.tolerance, statistics);
  return worstResidual(island, *context.bodies) < island.plan.tolerance;
}

void startCycles(Island& island, const StepContext& context) {
  island.hierarchy.refresh(island.masses);
  startMotion(island, context);
}

void runCycles(Island& island, const StepContext& context, SolveStatistics& statistics) {
  startCycles(island, context);
  Renewals renewals;
  bool done = goOn(island, context, statistics, &renewals);
  for (Renewal when = Renewal::first; renewals.next(island, context, when); when = Renewal::again)
    done = goOn(island, context, statistics, &renewals);
  island.ending = done ? IslandEnding::balanced : IslandEnding::unbalanced;
  countLeftOver(island, context, statistics);
}

}  // namespace brickfall
