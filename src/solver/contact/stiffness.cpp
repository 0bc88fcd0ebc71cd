#include "solver/contact/stiffness.h"

#include <algorithm>
#include <limits>

namespace brickfall {

namespace {

//! - | too small: resting contacts are softer than impacts
//! | too large: swaying walls do not converge at short steps, and stop a ball that goes through at longer ones
constexpr double kLeastFirm = 2;  // x impactStiffness: least stiffness of these contacts

// Share of restingStiffness in large islands, below kReferenceStep. That stiffness is in units of inertia over the time
// step squared, so it grows without bound as the step gets shorter; that of bricks does not. Small islands are solved
// to the end at any stiffness.
double firmShare(const SolverSettings& settings, double dt, double stretch, const Scale& scale) {
  double least = std::min(1.0, kLeastFirm * settings.impactStiffness / settings.restingStiffness);
  double share = std::min(1.0, std::max(dt / stretch / (kReferenceStep * scale.time), least));
  return std::max(least, share * stretch * stretch);
}

// Half of the distance between the middles of the two bodies. Past all of it the contact would turn round and let the
// bodies through each other.
double deepestOverlap(const BodyMass& a, const BodyMass& b) {
  constexpr double kPlane = 1e29;
  return 0.5 * ((a.innerRadius < kPlane ? a.innerRadius : 0) + (b.innerRadius < kPlane ? b.innerRadius : 0));
}

}  // namespace

Scale scaleOfPair(const Contact& pair, const StepContext& context) {
  auto size = [&](BodyIndex body) {
    const BodyMass& mass = context.bodies->mass[body];
    return mass.invMass > 0 ? mass.innerRadius : std::numeric_limits<double>::infinity();
  };
  return scaleOf(std::min(size(pair.bodyA), size(pair.bodyB)), context.judgingGravity);
}

float PairStiffness::ofImpact(float approach) const {
  float needed = unit * -approach * dt / deepest;
  return std::min(full, std::max(soft, needed));
}

// Contacts of small islands follow the parts of a substep. As soft as in the whole substep, they would let thin bodies
// through.
PairStiffness stiffnessOf(const Contact& pair, bool debris, const Island& island, const StepContext& context) {
  const SolverSettings& settings = context.settings;
  const SolvePlan& plan = island.plan;
  const Scale scale = scaleOfPair(pair, context);
  const double perDt2 = 1 / (island.dt * island.dt), stretch = context.stretch;
  const double share = plan.large ? firmShare(settings, island.dt, stretch * context.part, scale) : stretch * stretch;
  // Firmer springs would multiply what floats round in the way of a body to more than its own speed.
  const double most = plan.calm ? plan.leastMass : pair.effectiveMass / (kFloatsRound * settings.restingStiffness);
  const double unit = pair.effectiveMass * perDt2;
  const double firm = std::max(double(pair.effectiveMass), std::min(plan.leastMass, most)) * perDt2;
  const double full =
      debris ? settings.impactStiffness * unit : settings.restingStiffness * (plan.calmStiffening * share) * firm;
  const BodySet& bodies = *context.bodies;
  return {float(unit),
          float(full),
          float(settings.impactStiffness * unit),
          float(deepestOverlap(bodies.mass[pair.bodyA], bodies.mass[pair.bodyB])),
          float(island.dt),
          scale};
}

double leastStiffness(const Contact& pair, const StepContext& context) {
  return context.settings.restingStiffness *
         firmShare(context.settings, context.dt, context.stretch * context.part, scaleOfPair(pair, context)) *
         pair.effectiveMass / (context.dt * context.dt);
}

}  // namespace brickfall
