#include "solver/cycles.h"

#include <algorithm>

#include "solver/cluster_step.h"
#include "solver/direct_solve.h"
#include "solver/light_pass.h"
#include "solver/rigid_sum.h"

namespace brickfall {

namespace {

bool balanced(const Island& island, const StepContext& context) {
  double residual =
      island.plan.judgeWorst ? worstResidual(island, *context.bodies) : rmsResidual(island, *context.bodies);
  return residual < island.plan.tolerance;
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
  bool done = false;
  for (int cycle = 0; cycle < island.plan.maxCycles && !done; cycle++) {
    const Hierarchy& h = cycle % 2 == 0 ? island.byStrength : island.byMechanism;
    for (std::size_t l = h.levels.size(); l-- > 0;)
      for (const Cluster& cluster : h.levels[l].clusters)
        if (cluster.sideBegin != cluster.sideEnd) clusterStep(island, h.levels[l], cluster, statistics.solveSides);
    statistics.cycles++;
    lightPass(island, true, statistics.lightVisits);
    done = cycle + 1 >= island.plan.minCycles && balanced(island, context);
  }
  if (island.plan.direct) {
    solveDirectly(island, context, kSlowTolerance, statistics);
    done = balanced(island, context);
  }
  island.ending = done ? IslandEnding::balanced : IslandEnding::unbalanced;
  statistics.residualRms = std::max(statistics.residualRms, rmsResidual(island, *context.bodies));
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
  }
}

}  // namespace brickfall
