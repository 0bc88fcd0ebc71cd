#include "solver/rest.h"

#include <algorithm>
#include <cmath>

#include "solver/imbalance.h"
#include "solver/joint/swings.h"
#include "solver/light_pass.h"
#include "solver/support.h"

namespace brickfall {

namespace {

// Keeps the energies for the next steps to compare with.
void watchEnergy(const Island& island, bool grows, BodySet& bodies) {
  for (BodyIndex body : island.bodies)
    bodies.data[body].turnEnergy = std::copysign(bodies.kineticEnergy(body), grows ? 1.0 : -1.0);
}

// True in the step in which the kinetic energy has passed a maximum, by more than a trifle. The waves of a large island
// die away without one: each step that takes so much of them counts.
bool passesMaximum(const Island& island, BodySet& bodies) {
  double sum = 0;
  for (BodyIndex body : island.bodies) sum += bodies.data[body].turnEnergy;
  const double energy = island.facts.energy, turn = std::fabs(sum);
  const bool large = island.plan.large, grew = large || sum > 0;
  const bool turns = grew ? energy < (1 - kTrifle) * turn : energy > (1 + kTrifle) * turn, grows = grew != turns;
  if (turns || large || grows == (energy > turn)) watchEnergy(island, grows, bodies);
  return turns && !grows && std::isfinite(turn);
}

// As the rest check, but each body is judged by its load, and clusters by their weight. An island that leans or slides
// as a whole is out of balance as a whole, however little each of its bodies is.
bool balancedByLoad(const Island& island, const StepContext& context) {
  const float still = float(kLeftOver * context.settings.restSpeed);
  for (std::size_t i = 0; i < island.bodies.size(); i++) {
    if (!(island.speeds[i] < still)) return false;
    if (!isWithin(island.residual[i], measureOf(island, *context.bodies, i, kLoadShare),
                  context.settings.cycleTolerance))
      return false;
  }
  if (!island.hierarchy.valid) return true;
  for (const Level& level : island.hierarchy.levels)
    for (const Cluster& c : level.clusters) {
      if (c.bodyEnd - c.bodyBegin == 1) continue;
      if (!isWithin(residualOf(island, level, c), measureOf(island, level, c, kLoadShare),
                    context.settings.cycleTolerance))
        return false;
    }
  return true;
}

// Where a swing turns back, the last of its velocity and gravity balance for a step: that is no rest. Of what hangs on
// joints alone, its forces must balance as well.
bool forcesBalance(const Island& island, const StepContext& context) {
  for (std::size_t i = 0; i < island.bodies.size(); i++) {
    const BodyIndex body = island.bodies[i];
    const FreeMotion& free = context.free[body];
    const Vec3 move = (free.startVelocity - free.late) * (context.bodies->mass[body].mass / island.dt),
               turn = context.bodies->worldInertia(body) * (free.startSpin - free.lateSpin) * (1 / island.dt);
    const Wrench left{island.residual[i].force - toFloat(move), island.residual[i].torque - toFloat(turn)};
    if (!isWithin(left, measureOf(island, *context.bodies, i, kHeavyLoad), context.settings.restTolerance))
      return false;
  }
  return true;
}

// As slow as what rests.
bool standsStill(const Island& island, const StepContext& context) {
  const double most = context.settings.restTolerance * island.facts.scale.gravity * island.dt;
  return std::all_of(island.bodies.begin(), island.bodies.end(), [&](BodyIndex body) {
    const BodyMotion& m = context.bodies->motion[body];
    return length(m.linearVelocity) + length(m.angularVelocity) * context.bodies->mass[body].outerRadius <= most;
  });
}

// How far any point of the body is from its place in the pose `from`.
double strayed(const BodySet& bodies, BodyIndex body, const Transform& from) {
  const BodyMotion& m = bodies.motion[body];
  Quat turned = conjugate(from.rotation) * m.rotation;
  double angle = 2 * length(Vec3{turned.x, turned.y, turned.z});
  return length(m.position - from.position) + angle * bodies.mass[body].outerRadius;
}

}  // namespace

void dampSlowIsland(Island& island, const StepContext& context, BodySet& bodies) {
  const bool passed = passesMaximum(island, bodies);
  if (island.facts.jointed) fadeSwing(island, context, bodies);
  if (!passed || !island.plan.mayBeStopped || island.facts.swung || isDriven(island, context)) return;
  // A body that nothing presses on has no part in a vibration: it falls.
  std::pmr::vector<char> touched(island.bodies.size() + island.partners.size(), 0, island.memory);
  island.rows.each([&](const auto& kind, std::size_t k) {
    if (kind.ties(k, context)) touched[kind.ends(k).a] = touched[kind.ends(k).b] = 1;
  });
  const Vec3 left =
      slideLeft(island, touched, context, [&](BodyIndex body) { return bodies.motion[body].linearVelocity; });
  for (std::size_t i = 0; i < island.bodies.size(); i++) {
    if (!touched[i]) continue;
    BodyIndex body = island.bodies[i];
    bodies.motion[body].linearVelocity = bodies.freeWay(body, left);
    bodies.motion[body].angularVelocity = {};
  }
  watchEnergy(island, false, bodies);
}

void restCheck(Island& island, StepContext& context) {
  island.ending = IslandEnding::unsolved;
  for (std::size_t i = 0; i < island.bodies.size(); i++) island.motion[i] = {};
  if (!island.plan.slow || !(island.plan.large || standsStill(island, context))) return;
  lightPass(island, false, context.statistics.lightVisits);
  const bool balanced = island.plan.large ? balancedByLoad(island, context)
                                          : worstResidual(island, *context.bodies) < context.settings.restTolerance;
  if (!balanced || (island.facts.energy > 0 && slides(island, context))) return;
  if (island.plan.swings && !forcesBalance(island, context)) return;
  island.ending = IslandEnding::rested;
  context.statistics.restingIslands++;
}

void restInPlace(Island& island, const StepContext& context) {
  const BodySet& bodies = *context.bodies;
  if (!island.plan.slow) {
    island.placePoses.clear();
    return;
  }
  bool inPlace = island.placePoses.size() == island.bodies.size();
  for (std::size_t i = 0; inPlace && i < island.bodies.size(); i++)
    inPlace = strayed(bodies, island.bodies[i], island.placePoses[i]) <
              kNearlyClosed * island.facts.scale.ofBody(bodies.mass[island.bodies[i]].innerRadius).length;
  if (!inPlace) {
    island.inPlaceTime = 0;
    island.placePoses.clear();
    for (BodyIndex body : island.bodies) island.placePoses.push_back(bodies.pose(body));
  }
  island.inPlaceTime += island.dt;
  // Steps in which the island rests count as well: at the edge of the limit it rests in some of them only.
  if (island.resting() || island.inPlaceTime < kInPlaceTime * island.facts.scale.time) return;
  island.placePoses.clear();
  island.ending = IslandEnding::inPlace;
}

}  // namespace brickfall
