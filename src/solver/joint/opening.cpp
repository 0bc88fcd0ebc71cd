#include "solver/joint/opening.h"

#include <algorithm>
#include <limits>

#include "solver/finish/motion.h"
#include "solver/joint/equations.h"

namespace brickfall {

namespace {

//! of the outer radius of the smaller body | too small: cost of hits | too large: light links that are struck gape
constexpr double kOpens = 0.004;  // by which a joint may open in a part of a step that could be taken in halves

double openingAt(const Joint& joint, const JointPose& pose) { return errorOf(equationsOf(joint, pose).way); }

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
bool opens(const Joint& joint, const StepContext& context, double before) {
  const BodySet& bodies = *context.bodies;
  double size = std::numeric_limits<double>::infinity();
  for (BodyIndex body : {joint.bodyA, joint.bodyB})
    if (bodies.data[body].type == BodyType::dynamic) size = std::min(size, bodies.mass[body].outerRadius);
  const JointPose end(joint, placeAtEnd(joint.bodyA, context), placeAtEnd(joint.bodyB, context));
  return openingAt(joint, end) > before + kOpens * size;
}

}  // namespace

void tellOpenings(const Island& island, const StepContext& context, std::pmr::vector<double>& out) {
  const std::pmr::vector<JointIndex>& joints = island.rows.joints.tieOf;
  if (island.settled()) return out.resize(out.size() + joints.size());
  for (JointIndex index : joints) {
    const Joint& joint = context.ties->joints.slots[index];
    out.push_back(openingAt(joint, JointPose(joint, *context.bodies)));
  }
}

bool opensJoints(const Island& island, const StepContext& context, const double*& before) {
  const std::pmr::vector<JointIndex>& joints = island.rows.joints.tieOf;
  const double* had = before;
  before += joints.size();
  if (island.resting() || !island.plan.endVelocities) return false;
  return std::any_of(joints.begin(), joints.end(),
                     [&](JointIndex joint) { return opens(context.ties->joints.slots[joint], context, *had++); });
}

}  // namespace brickfall
