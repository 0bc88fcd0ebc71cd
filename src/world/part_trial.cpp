#include "world/part_trial.h"

#include <algorithm>
#include <limits>
#include <tuple>

#include "solver/finish/motion.h"
#include "solver/joint/equations.h"
#include "world/core_sweep.h"

namespace brickfall {

namespace {

//! of the outer radius of the smaller body | too small: cost of hits | too large: light links that are struck gape
constexpr double kOpens = 0.004;  // by which a joint may open in a part of a step that could be taken in halves

// Where a body is when the part ends.
JointPlace placeAtEnd(BodyIndex body, const StepContext& context) {
  const BodySet& bodies = *context.bodies;
  const BodyMotion& m = bodies.motion[body];
  const bool driven = bodies.data[body].type != BodyType::dynamic;
  const Quat rotation = driven ? normalized(quatFromRotationVector(m.angularVelocity * context.dt) * m.rotation)
                               : rotationAtEnd(body, context);
  return {m.position + (driven ? m.linearVelocity * context.dt : context.solved[body].d), rotation, toMatrix(rotation),
          bodies.data[body].localCentre};
}

// A solve that its joints' arcs or contacts kept from its end opens them, and so does a way that is cut short.
bool opens(const Joint& joint, const StepContext& context) {
  const BodySet& bodies = *context.bodies;
  double size = std::numeric_limits<double>::infinity();
  for (BodyIndex body : {joint.bodyA, joint.bodyB})
    if (bodies.data[body].type == BodyType::dynamic) size = std::min(size, bodies.mass[body].outerRadius);
  auto gapeAt = [&](const JointPose& pose) { return errorOf(equationsOf(joint, pose).way); };
  const JointPose end(joint, placeAtEnd(joint.bodyA, context), placeAtEnd(joint.bodyB, context));
  return gapeAt(end) > gapeAt(JointPose(joint, bodies)) + kOpens * size;
}

}  // namespace

bool mayEndDeep(const BodySet& bodies, const IslandSet& islands, double dt) {
  auto goesFar = [&](BodyIndex body) {
    const BodyMotion& m = bodies.motion[body];
    const BodyMass& mass = bodies.mass[body];
    const double speed = length(m.linearVelocity) + length(m.angularVelocity) * mass.outerRadius;
    return speed * dt > kCoreShare * mass.innerRadius;
  };
  return std::any_of(islands.awake.begin(), islands.awake.end(), [&](const IslandPointer& island) {
    return !island->settled() && std::any_of(island->bodies.begin(), island->bodies.end(), goesFar);
  });
}

bool endsApart(const IslandSet& islands, const Ties& ties, const StepContext& context) {
  if (context.overlap > kCoreShare) return true;
  return std::any_of(islands.awake.begin(), islands.awake.end(), [&](const IslandPointer& island) {
    if (island->resting() || !island->plan.endVelocities || !island->facts.grounded) return false;
    const auto& joints = island->rows.joints.tieOf;
    return std::any_of(joints.begin(), joints.end(),
                       [&](JointIndex joint) { return opens(ties.joints.slots[joint], context); });
  });
}

PartTrial::PartTrial(BodySet& bodies, const IslandSet& islands, Ties& ties, Diary& diary,
                     std::pmr::memory_resource* memory)
    : bodies_(bodies),
      islands_(islands),
      diary_(diary),
      tried_(memory),
      singles_(memory),
      ledger_(diary.report.ledger),
      ledgerState_(diary.ledgerState),
      hits_(diary.events.hits.size()),
      impacts_(diary.report.impacts) {
  ties.beginStep();  // as the stage of impacts does: hits of the part before must not come back
  for (const IslandPointer& island : islands.awake)
    if (!island->settled()) tried_.emplace_back(*island, ties, bodies);
  for (BodyIndex body : islands.single) singles_.emplace_back(bodies.motion[body], bodies.data[body]);
}

void PartTrial::restore() {
  for (const IslandTrial& island : tried_) island.restore();
  for (const IslandPointer& island : islands_.awake)
    if (!island->settled()) island->placePoses.clear();  // the trial has looked at its place, too
  for (std::size_t i = 0; i < singles_.size(); i++)
    std::tie(bodies_.motion[islands_.single[i]], bodies_.data[islands_.single[i]]) = singles_[i];
  diary_.report.ledger = ledger_;
  diary_.ledgerState = ledgerState_;
  diary_.events.hits.resize(hits_);
  diary_.report.impacts = impacts_;
}

}  // namespace brickfall
