// Joints of an island, as the world tells of them: as bytes and hashes, in its checks, in the ledger.
#include <cmath>

#include "solver/island.h"
#include "solver/joint/equations.h"
#include "solver/rows_report.h"

namespace brickfall {

namespace {

template <class Visit> void eachNumber(const JointRecord& r, Visit visit) {
  for (const JointEquations* e : {&r.way, &r.turn})
    for (const float* list : {e->k, e->trial, e->least, e->most, e->other})
      for (int i = 0; i < kJointLanes; i++) visit(list[i]);
  for (const JointEquations* e : {&r.way, &r.turn})
    for (const auto& axis : e->axes)
      for (int i = 0; i < 3; i++) visit(axis.unit[i]);
  for (const Vec3f& v : {r.armA, r.armB})
    for (int i = 0; i < 3; i++) visit(v[i]);
}

}  // namespace

void JointRows::hashRecord(Mix& h, std::size_t k, const Ties&) const {
  eachNumber(records[k], [&](float number) { h(number); });
}

void JointRows::checkRanges(Findings& f) const {
  for (std::size_t k = 0; k < size(); k++) {
    bool fine = starts[k].follows < 256 && starts[k].hard < 256;
    eachNumber(records[k], [&](float number) { fine = fine && std::fabs(number) <= 1e35f; });
    for (int i = 0; i < 2 * kJointLanes; i++)
      fine = fine && std::fabs(starts[k].held[i]) <= 1e35f && std::fabs(starts[k].before[i]) <= 1e35f;
    f.expect(fine, "a joint's record is out of range");
  }
}

void JointRows::startAfresh(Ties& ties) const {
  for (JointIndex index : tieOf) {
    Joint& joint = ties.joints.slots[index];
    for (int i = 0; i < kJointLanes; i++) joint.way[i] = joint.turn[i] = 0;
    joint.force = joint.torque = {};
  }
}

// Of springs: all other joints hold places, and store none.
double JointRows::elasticEnergy(JointIndex index, const StepContext& context) {
  const Joint& joint = context.ties->joints.slots[index];
  if (joint.type != JointType::spring && joint.type != JointType::drag) return 0;
  const double stretch = length(JointPose(joint, *context.bodies).way) - joint.length;
  return 0.5 * joint.stiffness * stretch * stretch;
}

void JointRows::addWork(const Island& island, const StepContext& context, TieWork& sum) const {
  for (std::size_t k = 0; k < size(); k++) {
    const Joint& joint = at(k, *context.ties);
    const joint::Relative moved = joint::relativeMotion(records[k], island.motion.data());
    const Vec3 way = toDouble(wide::store3(moved.way));
    sum.work += dot(joint.force, way) + dot(joint.torque, toDouble(wide::store3(moved.turn)));
    if (joint.type != JointType::spring && joint.type != JointType::drag) continue;
    const double stretch = length(JointPose(joint, *context.bodies).way + way) - joint.length;
    sum.elastic += 0.5 * joint.stiffness * stretch * stretch;
  }
}

template struct TieRows<JointRows, JointSet, &Ties::joints, &JointSet::slots>;
template struct LastingRows<JointRows, JointSet, &Ties::joints>;

}  // namespace brickfall
