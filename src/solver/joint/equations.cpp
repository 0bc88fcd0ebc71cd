#include "solver/joint/equations.h"

#include <algorithm>
#include <cmath>

#include "solver/step_context.h"

namespace brickfall {

namespace {

Vec3 axisOf(Quat frame, int i) { return rotate(frame, Vec3{i == 0 ? 1.0 : 0, i == 1 ? 1.0 : 0, i == 2 ? 1.0 : 0}); }

// Two unit vectors across a unit vector.
void completeAxes(Vec3 (&axes)[3]) {
  const Vec3 n = axes[0], size = abs(n);
  const Vec3 other = size.x <= size.y && size.x <= size.z ? Vec3{1, 0, 0}
                     : size.y <= size.z                   ? Vec3{0, 1, 0}
                                                          : Vec3{0, 0, 1};
  axes[1] = normalized(cross(n, other));
  axes[2] = cross(n, axes[1]);
}

void setHard(EquationSet& set, Vec3 error, int first = 0) {
  for (int i = first; i < 3; i++) set.of[i] = {JointLaw::hard, dot(set.axes[i], error)};
}

// The nearer bound, as an equation of what is `at`.
JointEquation limitOf(const Joint& joint, double at) {
  if (!(joint.lower < joint.upper)) return {JointLaw::hard, at - joint.upper};
  const bool upper = joint.upper - at < at - joint.lower;
  return {upper ? JointLaw::atMost : JointLaw::atLeast, at - (upper ? joint.upper : joint.lower), 0,
          joint.upper - joint.lower};
}

void setFree(const Joint& joint, double at, EquationSet& set) {
  if (joint.driven) set.of[0] = {JointLaw::motor, 0, joint.speed};
  if (joint.limited) set.of[3] = limitOf(joint, at);
}

// rad, world: the turn that takes axis a to axis b.
Vec3 swingOf(Vec3 a, Vec3 b) {
  const Vec3 across = cross(a, b);
  return rotationVector(normalized(Quat{across.x, across.y, across.z, std::max(1e-9, 1 + dot(a, b))}));
}

// Points: all three ways. The axes are the world's, whatever turns.
void spherical(const Joint& joint, const JointPose& pose, Vec3 turning, JointSystem& out) {
  setHard(out.way, pose.way);
  if (!joint.limited && !joint.coned) return;
  const Vec3 a = axisOf(pose.frameA, 0), b = axisOf(pose.frameB, 0), swing = swingOf(a, b);
  out.turn.axes[0] = normalized(a + b);
  if (out.turn.axes[0] == Vec3{}) out.turn.axes[0] = a;
  completeAxes(out.turn.axes);
  if (joint.limited) out.turn.of[0] = limitOf(joint, out.position);
  if (!joint.coned) return;
  Vec3 leads = swing + turning;
  leads -= out.turn.axes[0] * dot(out.turn.axes[0], leads);
  if (lengthSquared(leads) > 0) {
    out.turn.axes[1] = normalized(leads);
    out.turn.axes[2] = cross(out.turn.axes[0], out.turn.axes[1]);
  }
  out.turn.of[1] = {JointLaw::atMost, dot(out.turn.axes[1], swing) - joint.cone, 0, 2 * joint.cone};
}

Vec3 turnBetween(const JointPose& pose) { return rotationVector(normalized(pose.frameB * conjugate(pose.frameA))); }

void fixed(const Joint&, const JointPose& pose, JointSystem& out) {
  setHard(out.way, pose.way);
  setHard(out.turn, turnBetween(pose));
}

void revolute(const Joint& joint, const JointPose& pose, JointSystem& out) {
  setHard(out.way, pose.way);
  for (int i = 0; i < 3; i++) out.turn.axes[i] = axisOf(pose.frameA, i);
  setHard(out.turn, swingOf(out.turn.axes[0], axisOf(pose.frameB, 0)), 1);
  setFree(joint, out.position, out.turn);
}

void prismatic(const Joint& joint, const JointPose& pose, JointSystem& out) {
  out.onA = out.onB = 0.5;
  for (int i = 0; i < 3; i++) out.way.axes[i] = axisOf(pose.frameA, i);
  setHard(out.way, pose.way, 1);
  setFree(joint, out.position, out.way);
  setHard(out.turn, turnBetween(pose));
}

void alongLine(const Joint& joint, const JointPose& pose, JointSystem& out) {
  const double span = length(pose.way);
  if (span > kNoGap) out.way.axes[0] = pose.way * (1 / span);
  completeAxes(out.way.axes);
  const JointLaw law = joint.type == JointType::distance ? JointLaw::hard
                       : joint.type == JointType::rope   ? JointLaw::atMost
                                                         : JointLaw::spring;
  out.way.of[0] = {law, span - joint.length};
  out.span = span;
  out.way.of[1] = out.way.of[2] = {JointLaw::across};
}

void drag(const Joint&, const JointPose& pose, JointSystem& out) {
  const double far = length(pose.way);
  if (far > kNoGap) out.way.axes[0] = pose.way * (1 / far);
  completeAxes(out.way.axes);
  out.onA = out.onB = 1;
  for (int i = 0; i < 3; i++) out.way.of[i] = {JointLaw::spring, dot(out.way.axes[i], pose.way)};
}

double positionOf(const Joint& joint, const JointPose& pose) {
  switch (joint.type) {
    case JointType::spherical:
    case JointType::revolute:
      return twistOf(pose.frameA, pose.frameB);
    case JointType::prismatic:
      return dot(axisOf(pose.frameA, 0), pose.way);
    case JointType::fixed:
      return 0;
    case JointType::distance:
    case JointType::rope:
    case JointType::spring:
    case JointType::drag:
      return length(pose.way);
  }
  return 0;
}

}  // namespace

JointSystem equationsOf(const Joint& joint, const JointPose& pose, Vec3 turning) {
  JointSystem out;
  out.position = positionOf(joint, pose);
  switch (joint.type) {
    case JointType::spherical:
      spherical(joint, pose, turning, out);
      break;
    case JointType::fixed:
      fixed(joint, pose, out);
      break;
    case JointType::revolute:
      revolute(joint, pose, out);
      break;
    case JointType::prismatic:
      prismatic(joint, pose, out);
      break;
    case JointType::distance:
    case JointType::rope:
    case JointType::spring:
      alongLine(joint, pose, out);
      break;
    case JointType::drag:
      drag(joint, pose, out);
      break;
  }
  return out;
}

}  // namespace brickfall
