#include "solver/rest.h"

namespace brickfall {

void dampSlowIsland(Island& island, StepContext& context) {
  BodySet& bodies = *context.bodies;
  double before = 0, now = 0;
  island.slow = island.grounded && !island.partnersMove;
  for (BodyIndex body : island.bodies) {
    BodyData& data = bodies.data[body];
    const BodyMotion& m = bodies.motion[body];
    before += data.lastKineticEnergy;
    data.lastKineticEnergy = bodies.kineticEnergy(body);
    now += data.lastKineticEnergy;
    double speed = length(m.linearVelocity) + length(m.angularVelocity) * bodies.mass[body].innerRadius;
    if (!(speed <= context.settings.restSpeed)) island.slow = false;
  }
  if (!island.slow || now >= before) return;
  for (BodyIndex body : island.bodies) {
    bodies.motion[body].linearVelocity = {};
    bodies.motion[body].angularVelocity = {};
    bodies.data[body].lastKineticEnergy = 0;
  }
}

void restCheck(Island& island, StepContext& context) {
  island.resting = false;
  for (std::size_t i = 0; i < island.bodies.size(); i++) island.motion[i] = {};
  if (!island.slow) return;
  lightPass(island, *context.contacts, false, context.dt, context.statistics.lightVisits);
  if (!(worstResidual(island, *context.bodies) < context.settings.restTolerance)) return;
  island.resting = true;
  context.statistics.restingIslands++;
}

void restIfHeld(Island& island, StepContext& context) {
  if (island.resting) return;
  bool held = island.slow;
  for (BodyIndex body : island.bodies) {
    const SolvedMotion& s = context.solved[body];
    held = held && length(s.d) + length(s.th) * context.bodies->mass[body].outerRadius < kHeldMove;
  }
  island.heldSteps = held ? island.heldSteps + 1 : 0;
  if (island.heldSteps < kHeldSteps) return;
  island.heldSteps = 0;
  island.resting = island.settled = true;
  for (BodyIndex body : island.bodies) {
    context.solved[body] = {};
    context.solved[body].freeTurn = false;
    context.solved[body].rest = true;
  }
}

}  // namespace brickfall
