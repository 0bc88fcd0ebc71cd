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

JointIndex JointSet::create(const Joint& joint) {
  changed = true;
  JointIndex index = JointIndex(joints.size());
  std::uint16_t generation = 1;
  if (!free_.empty()) {
    index = free_.back();
    free_.pop_back();
    generation = std::uint16_t(joints[index].generation + 1);
  } else {
    joints.emplace_back();
  }
  joints[index] = joint;
  joints[index].alive = joints[index].born = true;
  joints[index].generation = generation;
  joints[index].order = nextOrder_++;
  awake_.insert(std::lower_bound(awake_.begin(), awake_.end(), index), index);
  for (auto* list : {&awake_, &asleep_}) list->reserve(joints.capacity());  // all may fall asleep or wake at once
  if (!joint.collide) {
    const Pair pair = pairOf(joint.bodyA, joint.bodyB);
    apart_.insert(std::lower_bound(apart_.begin(), apart_.end(), pair), pair);
  }
  return index;
}

void JointSet::destroy(JointIndex index) {
  changed = true;
  Joint& joint = joints[index];
  for (auto* list : {&awake_, &asleep_}) std::erase(*list, index);
  if (!joint.collide) {
    const Pair pair = pairOf(joint.bodyA, joint.bodyB);
    apart_.erase(std::lower_bound(apart_.begin(), apart_.end(), pair));
  }
  const std::uint16_t generation = joint.generation;
  joint = {};
  joint.generation = generation;
  free_.push_back(index);
}

std::vector<JointIndex> JointSet::inOrder() const {
  std::vector<JointIndex> out;
  for (JointIndex i = 0; i < joints.size(); i++)
    if (joints[i].alive) out.push_back(i);
  std::sort(out.begin(), out.end(), [&](JointIndex a, JointIndex b) { return joints[a].order < joints[b].order; });
  return out;
}

void JointSet::dropOf(BodyIndex body) {
  if (!any()) return;
  for (JointIndex i = 0; i < joints.size(); i++)
    if (joints[i].alive && joints[i].names(body)) destroy(i);
}

void JointSet::renewConstants(BodyIndex body, const ShapeSet&, const BodySet& bodies) {
  auto isDynamic = [&](BodyIndex b) { return bodies.data[b].type == BodyType::dynamic; };
  for (Joint& j : joints) {
    if (!j.alive || !j.names(body)) continue;
    const bool idle = !isDynamic(j.bodyA) && !isDynamic(j.bodyB);
    changed = changed || idle != j.idle;
    j.idle = idle;
  }
}

void JointSet::beginStep() {
  for (JointIndex joint : awake_) joints[joint].earlierForce = joints[joint].earlierTorque = {};
}

void JointSet::hash(Mix& h, JointIndex joint) const {
  const Joint& j = joints[joint];
  h(j.order, j.speed, j.length, j.lent, j.wound, j.over, j.meanForce, j.meanTorque, j.anchorA);
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
                       &j.breakForce, &j.breakTorque, &j.lent, &j.wound, &j.over, &j.meanForce, &j.meanTorque})
    a.value(*number);
  a.value(j.way);
  a.value(j.turn);
}

//! not of the method: fewest bytes of a slot in a snapshot
constexpr std::size_t kLeastJoint = 3;

}  // namespace

template <class Archive, class Set> void JointSet::archiveAll(Archive& a, Set& set) {
  const std::uint64_t count = a.count(set.joints.size(), kLeastJoint);
  if constexpr (Archive::kReading) set.joints.resize(std::size_t(count));
  for (auto& joint : set.joints) {
    a.flag(joint.alive);
    a.value(joint.generation);
    if (joint.alive) archiveJoint(a, joint);
  }
  a.list(set.awake_);
  a.list(set.asleep_);
  a.list(set.free_);
  a.value(set.nextOrder_);
  a.flag(set.changed);
}
void JointSet::archive(WriteArchive& a) const { archiveAll(a, *this); }
void JointSet::archive(ReadArchive& a) {
  archiveAll(a, *this);
  for (auto* list : {&awake_, &asleep_}) list->reserve(joints.size());
  findApart();
}

void JointSet::findApart() {
  apart_.clear();
  for (const Joint& j : joints)
    if (j.alive && !j.collide) apart_.push_back(pairOf(j.bodyA, j.bodyB));
  std::sort(apart_.begin(), apart_.end());
}

void JointSet::checkStructure(Findings& f, const BodySet& bodies, const ShapeSet&) const {
  std::vector<bool> listed(joints.size(), false);
  for (const auto* list : {&awake_, &asleep_}) {
    f.expect(isAscending(*list), "joints: not sorted, or twice");
    for (JointIndex i : *list) {
      const bool fine = has(i) && !listed[i];
      f.expect(fine, "joints: one that is listed is not there, or is listed twice");
      if (fine) listed[i] = true;
    }
  }
  for (JointIndex i = 0; i < joints.size(); i++) {
    const Joint& j = joints[i];
    f.expect(j.alive == listed[i], "joints: one is neither awake nor asleep");
    if (!j.alive) continue;
    const bool fine = bodies.alive(j.bodyA) && bodies.alive(j.bodyB) && j.bodyA != j.bodyB &&
                      !bodies.data[j.bodyA].quarantined && !bodies.data[j.bodyB].quarantined;
    f.expect(fine, "joints: one names bodies that are not there");
    if (!fine) continue;
    const bool idle = bodies.data[j.bodyA].type != BodyType::dynamic && bodies.data[j.bodyB].type != BodyType::dynamic;
    f.expect(j.idle == idle, "joints: one is idle whose bodies move, or the reverse");
  }
  checkFreeSlots(f, free_, joints.size(), [&](std::size_t i) { return !joints[i].alive; });
}

namespace {

using namespace ties;

bool isSoundJoint(const Joint& j) {
  bool fine = isNear(j.anchorA, kFarthest) && isNear(j.anchorB, kFarthest) && hasUnitLength(j.frameA) &&
              hasUnitLength(j.frameB) && j.lower <= 0 && j.upper >= 0 && j.lower >= -kFarthest &&
              j.upper <= kFarthest && j.cone >= 0 && j.cone <= kFarthest && isFinite(Vec3{j.speed, 0, 0}) &&
              j.strength >= 0 && j.strength <= kLargestMemory && j.length >= 0 && j.length <= kFarthest &&
              j.stiffness >= 0 && j.stiffness <= kLargestMemory && j.damping >= 0 && j.damping <= kLargestMemory &&
              j.breakForce > 0 && j.breakTorque > 0 && std::fabs(j.lent) <= kLargestMemory && j.wound >= 0 &&
              j.wound <= kFarthest && j.over >= 0 && j.over <= 1 && j.meanForce >= 0 && j.meanForce <= kLargestMemory &&
              j.meanTorque >= 0 && j.meanTorque <= kLargestMemory;
  for (Vec3 v : {j.force, j.torque, j.earlierForce, j.earlierTorque}) fine = fine && isNear(v, kLargestMemory);
  for (int i = 0; i < kJointLanes; i++)
    fine = fine && std::fabs(j.way[i]) <= kLargestMemory && std::fabs(j.turn[i]) <= kLargestMemory;
  return fine;
}

}  // namespace

void JointSet::checkRanges(Findings& f) const {
  for (const Joint& j : joints) f.expect(!j.alive || isSoundJoint(j), "joints: what one remembers is out of range");
}

void JointSet::check(Findings& f, const BodySet& bodies, const ShapeSet&) const {
  for (JointIndex i : asleep_)
    for (BodyIndex body : {joints[i].bodyA, joints[i].bodyB})
      f.expect(joints[i].idle || (bodies.data[body].activity != BodyActivity::awake && !bodies.isDriven(body)),
               "joints: one asleep names a body that is not");
  std::size_t apart = 0;
  for (const Joint& j : joints) {
    if (!j.alive || j.collide) continue;
    apart++;
    f.expect(!mayCollide(j.bodyA, j.bodyB), "joints: bodies that may not collide are not listed");
  }
  f.expect(apart == apart_.size(), "joints: bodies are listed as apart that no joint parts");
}

}  // namespace brickfall
