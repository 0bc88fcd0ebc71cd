#include "solver/joint/equations.h"

#include <algorithm>
#include <cmath>
#include <iterator>

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
  out.position = twistOf(pose.frameA, pose.frameB);
  out.arcs = JointArcs::points;
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
  out.turn.of[2] = {JointLaw::across};
  out.span = joint.cone;
}

Vec3 turnBetween(const JointPose& pose) { return rotationVector(normalized(pose.frameB * conjugate(pose.frameA))); }

void fixed(const Joint&, const JointPose& pose, Vec3, JointSystem& out) {
  out.arcs = JointArcs::points;
  setHard(out.way, pose.way);
  setHard(out.turn, turnBetween(pose));
}

// The turns that it holds lie across the axis of A, or of B where that spins far in a step. Across the other one they
// would read a part of that spin, as large as the hinge's error: it grew, and wheels of 70 rad/s left their axles at
// 1/60 s.
void revolute(const Joint& joint, const JointPose& pose, Vec3, JointSystem& out) {
  out.position = twistOf(pose.frameA, pose.frameB);
  out.arcs = JointArcs::points;
  setHard(out.way, pose.way);
  const Vec3 swing = swingOf(axisOf(pose.frameA, 0), axisOf(pose.frameB, 0));
  const Quat onto = quatFromRotationVector(pose.spinsB ? swing : Vec3{});
  for (int i = 0; i < 3; i++) out.turn.axes[i] = rotate(onto, axisOf(pose.frameA, i));
  setHard(out.turn, swing, 1);
  setFree(joint, out.position, out.turn);
}

void prismatic(const Joint& joint, const JointPose& pose, Vec3, JointSystem& out) {
  out.arcs = JointArcs::slide;
  out.onA = out.onB = 0.5;
  for (int i = 0; i < 3; i++) out.way.axes[i] = axisOf(pose.frameA, i);
  out.position = dot(out.way.axes[0], pose.way);
  setHard(out.way, pose.way, 1);
  setFree(joint, out.position, out.way);
  setHard(out.turn, turnBetween(pose));
}

// The first axis along a way, if that has a direction. Returns its length.
double pointAlong(Vec3 way, EquationSet& set) {
  const double span = length(way);
  if (span > kNoGap) set.axes[0] = way * (1 / span);
  completeAxes(set.axes);
  return span;
}

void alongLine(const Joint& joint, const JointPose& pose, Vec3, JointSystem& out) {
  out.arcs = JointArcs::line;
  out.position = out.span = pointAlong(pose.way, out.way);
  const JointLaw law = joint.type == JointType::distance ? JointLaw::hard
                       : joint.type == JointType::rope   ? JointLaw::atMost
                                                         : JointLaw::spring;
  out.way.of[0] = {law, out.span - joint.length};
  out.way.of[1] = out.way.of[2] = {JointLaw::across};
}

void drag(const Joint&, const JointPose& pose, Vec3, JointSystem& out) {
  out.position = pointAlong(pose.way, out.way);
  out.onA = out.onB = 1;
  for (int i = 0; i < 3; i++) out.way.of[i] = {JointLaw::spring, dot(out.way.axes[i], pose.way)};
}

}  // namespace

double errorOf(const EquationSet& set) {
  double square = 0;
  for (const JointEquation& e : set.of) {
    const double error = e.law == JointLaw::hard      ? e.error
                         : e.law == JointLaw::atMost  ? std::max(0.0, e.error)
                         : e.law == JointLaw::atLeast ? std::min(0.0, e.error)
                                                      : 0;
    square += error * error;
  }
  return std::sqrt(square);
}

JointSystem equationsOf(const Joint& joint, const JointPose& pose, Vec3 turning) {
  // By JointType.
  constexpr void (*kWrite[])(const Joint&, const JointPose&, Vec3, JointSystem&) = {
      spherical, fixed, revolute, prismatic, alongLine, alongLine, alongLine, drag};
  static_assert(std::size(kWrite) == kJointTypeCount);
  JointSystem out;
  kWrite[std::size_t(joint.type)](joint, pose, turning, out);
  return out;
}

}  // namespace brickfall
