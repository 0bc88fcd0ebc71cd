#include "solver/joint/opening.h"

#include <algorithm>
#include <limits>

#include "solver/finish/motion.h"
#include "solver/joint/equations.h"

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

bool opensJoints(const Island& island, const StepContext& context) {
  if (island.resting() || !island.plan.endVelocities || !island.facts.grounded) return false;
  const std::pmr::vector<JointIndex>& joints = island.rows.joints.tieOf;
  return std::any_of(joints.begin(), joints.end(),
                     [&](JointIndex joint) { return opens(context.ties->joints.slots[joint], context); });
}

}  // namespace brickfall
