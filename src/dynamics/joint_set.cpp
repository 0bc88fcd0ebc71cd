#include "dynamics/joint_set.h"

#include <cmath>

#include "dynamics/tie_ranges.h"

namespace brickfall {

namespace {

JointPlace placeOf(BodyIndex body, const BodySet& bodies) {
  const BodyMotion& m = bodies.motion[body];
  return {m.position, m.rotation, m.orientation, bodies.data[body].localCentre};
}

}  // namespace

JointPose::JointPose(const Joint& joint, const JointPlace& a, const JointPlace& b) {
  armA = a.orientation * (joint.anchorA - a.localCentre);
  armB = b.orientation * (joint.anchorB - b.localCentre);
  pointA = a.position + armA;
  way = (b.position - a.position) + (armB - armA);
  frameA = a.rotation * joint.frameA;
  frameB = b.rotation * joint.frameB;
}
JointPose::JointPose(const Joint& joint, const BodySet& bodies)
    : JointPose(joint, placeOf(joint.bodyA, bodies), placeOf(joint.bodyB, bodies)) {}

double twistOf(Quat frameA, Quat frameB) {
  const Quat q = conjugate(frameA) * frameB;
  if (!(q.x * q.x + q.w * q.w > 1e-12)) return 0;  // the axes point against each other
  return rotationVector(normalized(Quat{q.x, 0, 0, q.w})).x;
}

void JointSet::renewConstants(BodyIndex body, const ShapeSet&, const BodySet& bodies) { renewIdle(body, bodies); }

void JointSet::beginStep() {
  for (JointIndex joint : awake()) slots[joint].earlierForce = slots[joint].earlierTorque = {};
}

void JointSet::hash(Mix& h, JointIndex joint) const {
  const Joint& j = slots[joint];
  h(j.order, j.speed, j.length, j.lent, j.held, j.wound, j.over, j.meanForce, j.meanTorque, j.anchorA);
  h.list(j.way, kJointLanes).list(j.turn, kJointLanes);
}

namespace {

template <class Archive, class One> void archiveJoint(Archive& a, One& j) {
  a.choice(j.type, JointType(kJointTypeCount - 1));
  for (auto* flag : {&j.born, &j.idle, &j.collide, &j.limited, &j.coned, &j.driven}) a.flag(*flag);
  for (auto* body : {&j.bodyA, &j.bodyB}) a.value(*body);
  for (auto* number : {&j.order, &j.userData}) a.value(*number);
  for (auto* place : {&j.anchorA, &j.anchorB, &j.force, &j.torque, &j.earlierForce, &j.earlierTorque}) a.value(*place);
  for (auto* frame : {&j.frameA, &j.frameB}) a.value(*frame);
  for (auto* number : {&j.lower, &j.upper, &j.cone, &j.speed, &j.strength, &j.length, &j.stiffness, &j.damping,
                       &j.breakForce, &j.breakTorque, &j.lent, &j.held, &j.wound, &j.over, &j.meanForce, &j.meanTorque})
    a.value(*number);
  a.value(j.way);
  a.value(j.turn);
}

//! not of the method: fewest bytes of a slot in a snapshot
constexpr std::size_t kLeastJoint = 3;

}  // namespace

void JointSet::archive(WriteArchive& a) const {
  archiveSlots(a, *this, kLeastJoint, [](auto& to, const Joint& j) { archiveJoint(to, j); });
}
void JointSet::archive(ReadArchive& a) {
  archiveSlots(a, *this, kLeastJoint, [](auto& from, Joint& j) { archiveJoint(from, j); });
  findApart();
}

void JointSet::checkStructure(Findings& f, const BodySet& bodies, const ShapeSet&) const {
  checkLists(f, bodies, "joints");
}

namespace {

using namespace ties;

bool isSoundJoint(const Joint& j) {
  bool fine = isNear(j.anchorA, kFarthest) && isNear(j.anchorB, kFarthest) && hasUnitLength(j.frameA) &&
              hasUnitLength(j.frameB) && j.lower <= 0 && j.upper >= 0 && j.lower >= -kFarthest &&
              j.upper <= kFarthest && j.cone >= 0 && j.cone <= kFarthest && isFinite(Vec3{j.speed, 0, 0}) &&
              j.strength >= 0 && j.strength <= kLargestMemory && j.length >= 0 && j.length <= kFarthest &&
              j.stiffness >= 0 && j.stiffness <= kLargestMemory && j.damping >= 0 && j.damping <= kLargestMemory &&
              j.breakForce > 0 && j.breakTorque > 0 && std::fabs(j.lent) <= kLargestMemory &&
              std::fabs(j.held) <= kLargestMemory && j.wound >= 0 && j.wound <= kFarthest && j.over >= 0 &&
              j.over <= 1 && j.meanForce >= 0 && j.meanForce <= kLargestMemory && j.meanTorque >= 0 &&
              j.meanTorque <= kLargestMemory;
  for (Vec3 v : {j.force, j.torque, j.earlierForce, j.earlierTorque}) fine = fine && isNear(v, kLargestMemory);
  for (int i = 0; i < kJointLanes; i++)
    fine = fine && std::fabs(j.way[i]) <= kLargestMemory && std::fabs(j.turn[i]) <= kLargestMemory;
  return fine;
}

}  // namespace

void JointSet::checkRanges(Findings& f) const {
  for (const Joint& j : slots) f.expect(!j.alive || isSoundJoint(j), "joints: what one remembers is out of range");
}

void JointSet::check(Findings& f, const BodySet& bodies, const ShapeSet&) const { checkAsleep(f, bodies, "joints"); }

}  // namespace brickfall
