#include "solver/rest.h"

#include "solver/light_pass.h"

namespace brickfall {

void dampSlowIsland(const Island& island, BodySet& bodies) {
  if (!island.plan.slow || island.facts.energy >= island.facts.energyBefore) return;
  for (BodyIndex body : island.bodies) {
    bodies.motion[body].linearVelocity = {};
    bodies.motion[body].angularVelocity = {};
    bodies.data[body].lastKineticEnergy = 0;
  }
}

void restCheck(Island& island, StepContext& context) {
  island.ending = IslandEnding::unsolved;
  for (std::size_t i = 0; i < island.bodies.size(); i++) island.motion[i] = {};
  if (!island.plan.slow) return;
  lightPass(island, false, context.statistics.lightVisits);
  if (!(worstResidual(island, *context.bodies) < context.settings.restTolerance)) return;
  island.ending = IslandEnding::rested;
  context.statistics.restingIslands++;
}

namespace {

// How far any point of the body is from where it was in that pose.
double strayed(const BodySet& bodies, BodyIndex body, const Transform& from) {
  const BodyMotion& m = bodies.motion[body];
  Quat turned = conjugate(from.rotation) * m.rotation;
  double angle = 2 * length(Vec3{turned.x, turned.y, turned.z});
  return length(m.position - from.position) + angle * bodies.mass[body].outerRadius;
}

}  // namespace

void restInPlace(Island& island, const StepContext& context) {
  const BodySet& bodies = *context.bodies;
  if (!island.plan.slow || island.resting()) {
    island.placePoses.clear();
    return;
  }
  bool inPlace = island.placePoses.size() == island.bodies.size();
  for (std::size_t i = 0; inPlace && i < island.bodies.size(); i++)
    inPlace = strayed(bodies, island.bodies[i], island.placePoses[i]) < kInPlaceMove;
  if (!inPlace) {
    island.inPlaceTime = 0;
    island.placePoses.clear();
    for (BodyIndex body : island.bodies) island.placePoses.push_back(bodies.pose(body));
  }
  island.inPlaceTime += context.dt;
  if (island.inPlaceTime < kInPlaceTime) return;
  island.placePoses.clear();
  island.ending = IslandEnding::inPlace;
}

}  // namespace brickfall
