#include "solver/cycles.h"

#include <algorithm>

#include "base/take_larger.h"
#include "solver/direct_solve.h"
#include "solver/light_pass.h"
#include "solver/relaxation.h"

namespace brickfall {

namespace {

// How much of its free fall a body had in the step before: 1 in flight, 0 on firm ground.
float fallShare(const Island& island, std::size_t i, const StepContext& context) {
  BodyIndex body = island.bodies[i];
  const FreeMotion& free = context.free[body];
  Vec3 fall = (free.d * (1 / island.dt) - free.startVelocity) * (1 / island.dt);
  double most = lengthSquared(fall), had = dot(context.bodies->data[body].linearAcceleration, fall);
  return most > 0 ? float(std::clamp(had / most, 0.0, 1.0)) : 0;
}

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

// Free motion is the honest start: motion that cycles leave undone then falls. In large islands on the ground each body
// goes on with as much of its fall as it had. Otherwise a wall or a heap would fall by the undone motion, a little in
// every step. No brick hangs by this start: each one out of balance by itself is moved until it is in balance. A slow
// island there starts from where it is: on stiff contacts even micrometres a second of the last step are forces to be
// solved away.
void startMotion(Island& island, const StepContext& context) {
  for (std::size_t i = 0; i < island.bodies.size(); i++) {
    const SolveMass& free = island.masses[i];
    SolveMotion& out = island.motion[i];
    out = {};
    if (!island.plan.startsFree && island.plan.slow) continue;
    out.d = free.dFree;
    out.th = free.thFree;
    if (island.plan.startsFree) continue;
    if (island.plan.goesOn) {
      goOnAccelerating(island, i, context, out);
      continue;
    }
    const BodyMotion& m = context.bodies->motion[island.bodies[i]];
    float share = fallShare(island, i, context);
    Vec3f way = toFloat(m.linearVelocity * island.dt), turn = toFloat(m.angularVelocity * island.dt);
    out.d = way + (out.d - way) * share;
    out.th = turn + (out.th - turn) * share;
  }
}

// The impulse that stopped each impact tells how much the impact gives back. Nothing but this is then out of balance.
bool startRebounds(Island& island, const StepContext& context) {
  bool any = false;
  island.rows.eachKind([&](auto& kind) { any = kind.startRebounds(island, context) || any; });
  return any;
}

void countLeftOver(const Island& island, const StepContext& context, SolveStatistics& statistics) {
  takeLarger(statistics.residualRms, rmsResidual(island, *context.bodies));
  LeftOver left = leftOver(island, *context.bodies);
  takeLarger(statistics.worstResidual, left.worst);
  statistics.leftOver += left.bodies;
}

}  // namespace

bool goOn(Island& island, const StepContext& context, SolveStatistics& statistics) {
  bool done = relax(island, context, statistics);
  if (!island.plan.direct) return done;
  solveDirectly(island, context, island.plan.tolerance, statistics);
  return worstResidual(island, *context.bodies) < island.plan.tolerance;
}

void startCycles(Island& island, const StepContext& context) {
  island.hierarchy.refresh(island.masses);
  startMotion(island, context);
}

void runCycles(Island& island, const StepContext& context, SolveStatistics& statistics) {
  startCycles(island, context);
  bool done = goOn(island, context, statistics);
  if (startRebounds(island, context)) done = goOn(island, context, statistics);
  island.ending = done ? IslandEnding::balanced : IslandEnding::unbalanced;
  countLeftOver(island, context, statistics);
}

}  // namespace brickfall
