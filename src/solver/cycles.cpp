#include "solver/cycles.h"

#include "base/take_larger.h"
#include "solver/direct_solve.h"
#include "solver/light_pass.h"
#include "solver/relaxation.h"
#include "solver/rigid_sum.h"

namespace brickfall {

namespace {

// Free motion is the honest start: whatever cycles leave undone falls. Large islands on the ground go on as they moved instead:
// what cycles leave undone in a wall would fall through it a little in every step, and make it lean; and no brick hangs by it,
// since each that is out of balance by itself is moved until it is not.
void startMotion(Island& island, const StepContext& context) {
  for (std::size_t i = 0; i < island.bodies.size(); i++) {
    const BodyMotion& m = context.bodies->motion[island.bodies[i]];
    island.motion[i].d = island.plan.startsFree ? island.masses[i].dFree : toFloat(m.linearVelocity * island.dt);
    island.motion[i].th = island.plan.startsFree ? island.masses[i].thFree : toFloat(m.angularVelocity * island.dt);
  }
}

// By what it takes to stop each impact, what it gives back is known; nothing but that is then out of balance.
bool startRebounds(Island& island, const StepContext& context) {
  bool any = false;
  island.rows.eachKind([&](auto& kind) { any = kind.startRebounds(island, context, island.credit) || any; });
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
  solveDirectly(island, context, kSlowTolerance, statistics);
  return worstResidual(island, *context.bodies) < kSlowTolerance;
}

void startCycles(Island& island, const StepContext& context) {
  island.byStrength.refresh(island.masses);
  island.byMechanism.refresh(island.masses);
  startMotion(island, context);
}

void runCycles(Island& island, const StepContext& context, SolveStatistics& statistics) {
  startCycles(island, context);
  bool done = goOn(island, context, statistics);
  if (startRebounds(island, context)) done = goOn(island, context, statistics);
  island.ending = done ? IslandEnding::balanced : IslandEnding::unbalanced;
  countLeftOver(island, context, statistics);
}

void correctMomentum(Island& island, const StepContext& context) {
  if (island.grounded()) return;
  const BodySet& bodies = *context.bodies;
  RigidSum missing(island.origin);  // what the solve left, as displacements
  for (std::size_t i = 0; i < island.bodies.size(); i++) {
    BodyIndex body = island.bodies[i];
    double m = bodies.mass[body].mass;
    Mat3 inertia = bodies.worldInertia(body);
    // thFree as the solve read it
    missing.add(m, bodies.motion[body].position, inertia,
                (context.free[body].d - island.travel - toDouble(island.motion[i].d)) * m,
                inertia * (toDouble(island.masses[i].thFree) - toDouble(island.motion[i].th)));
  }
  Vec3 centre = missing.centre(), move = missing.velocity(), turn = missing.spin();
  for (std::size_t i = 0; i < island.bodies.size(); i++) {
    Vec3 r = bodies.motion[island.bodies[i]].position - centre;
    island.motion[i].d += toFloat(move + cross(turn, r));
    island.motion[i].th += toFloat(turn);
    // Rows are not stretched by it: the residuals change by inertia alone, and their sum is none.
    if (island.residual.empty()) continue;
    island.residual[i].force -= toFloat((move + cross(turn, r)) * double(island.masses[i].mass));
    island.residual[i].torque -= toFloat(bodies.worldInertia(island.bodies[i]) * turn * (1 / (island.dt * island.dt)));
  }
}

}  // namespace brickfall
