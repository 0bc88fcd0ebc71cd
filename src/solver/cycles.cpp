#include "solver/cycles.h"

#include <algorithm>

#include "solver/direct_solve.h"
#include "solver/rigid_sum.h"

namespace brickfall {

namespace {

// Small islands are cheap and, when they collapse, need more cycles than a wall to move at their true speed.
int cycleBudget(const Island& island, const SolverSettings& settings) {
  int bySize = int(640 / island.bodies.size());
  int budget = std::clamp(bySize, settings.maxCycles, std::max(settings.maxCycles, settings.maxCyclesSmall));
  return island.slow ? std::max(budget, kMaxCyclesSlow) : budget;
}

bool balanced(const Island& island, const StepContext& context) {
  // The loose stop on forces alone would hold up, or set back, a block that is just past its balance.
  if (island.slow || island.exactSteps) return worstResidual(island, *context.bodies) < kSlowTolerance;
  return rmsResidual(island, *context.bodies) < context.settings.cycleTolerance;
}

void startFromFreeMotion(Island& island) {
  for (std::size_t i = 0; i < island.bodies.size(); i++) {
    island.motion[i].d = island.masses[i].dFree;
    island.motion[i].th = island.masses[i].thFree;
  }
}

}  // namespace

void runCycles(Island& island, const StepContext& context, SolveStatistics& statistics) {
  island.byStrength.refresh(island.masses);
  island.byMechanism.refresh(island.masses);
  // Any other start cheats: "nothing moves" would glue falling and sliding bodies in place.
  startFromFreeMotion(island);
  bool direct = solvesDirectly(island, context);
  int budget = direct ? context.settings.minCycles : cycleBudget(island, context.settings);
  island.exactSteps = island.bodies.size() <= kExactBodies;
  for (int cycle = 0; cycle < budget; cycle++) {
    const Hierarchy& h = cycle % 2 == 0 ? island.byStrength : island.byMechanism;
    for (std::size_t l = h.levels.size(); l-- > 0;)
      for (const Cluster& cluster : h.levels[l].clusters)
        if (cluster.sideBegin != cluster.sideEnd) clusterStep(island, h.levels[l], cluster, statistics.solveSides);
    statistics.cycles++;
    lightPass(island, *context.contacts, true, context.dt, statistics.lightVisits);
    if (cycle + 1 >= context.settings.minCycles && balanced(island, context)) break;
  }
  if (direct) solveDirectly(island, context, kSlowTolerance, statistics);
  statistics.residualRms = std::max(statistics.residualRms, rmsResidual(island, *context.bodies));
}

void correctMomentum(Island& island, const StepContext& context) {
  if (island.grounded) return;
  const BodySet& bodies = *context.bodies;
  RigidSum missing(island.origin);  // what the solve left, as displacements
  for (std::size_t i = 0; i < island.bodies.size(); i++) {
    BodyIndex body = island.bodies[i];
    double m = bodies.mass[body].mass;
    Mat3 inertia = bodies.worldInertia(body);
    // thFree as the solve read it
    missing.add(m, bodies.motion[body].position, inertia,
                (context.free[body].d - island.drift - toDouble(island.motion[i].d)) * m,
                inertia * (toDouble(island.masses[i].thFree) - toDouble(island.motion[i].th)));
  }
  Vec3 centre = missing.centre(), move = missing.velocity(), turn = missing.spin();
  for (std::size_t i = 0; i < island.bodies.size(); i++) {
    Vec3 r = bodies.motion[island.bodies[i]].position - centre;
    island.motion[i].d += toFloat(move + cross(turn, r));
    island.motion[i].th += toFloat(turn);
  }
}

}  // namespace brickfall
