// Joints of an island, as the world tells of them: as bytes and hashes, in its checks, in the ledger.
#include <cmath>

#include "solver/island.h"
#include "solver/joint/equations.h"

namespace brickfall {

void JointRows::archive(WriteArchive& a) const {
  a.list(jointOf);
  a.list(records);
  a.list(starts);
}
void JointRows::archive(ReadArchive& a) {
  a.list(jointOf);
  a.list(records);
  a.list(starts);
}

namespace {

template <class Visit> void eachNumber(const JointRecord& r, Visit visit) {
  for (const JointEquations* e : {&r.way, &r.turn})
    for (const float* list : {e->k, e->trial, e->least, e->most})
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

void JointRows::checkStructure(Findings& f, const Island& island, const Ties& ties, const BodySet& bodies,
                               bool current) const {
  const std::size_t all = island.bodies.size() + island.partners.size();
  f.expect(records.size() == size() && starts.size() == size(), "islands: lists of joints of different lengths");
  for (JointIndex joint : jointOf) f.expect(joint < ties.joints.slots.size(), "islands: a joint that is not there");
  for (const JointRecord& r : records) f.expect(r.bodyA < all && r.bodyB < all, "islands: a joint's row names no body");
  if (f.any() || !current) return;
  for (std::size_t k = 0; k < size(); k++) {
    const Joint& joint = jointAt(k, ties);
    f.expect(joint.alive && bodies.alive(joint.bodyA) && bodies.alive(joint.bodyB), "islands: a joint that has ended");
  }
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

void JointRows::check(Findings& f, const Island& island, const Ties& ties, bool current) const {
  const std::size_t own = island.bodies.size();
  auto bodyOf = [&](std::uint32_t local) { return local < own ? island.bodies[local] : island.partners[local - own]; };
  for (std::size_t k = 0; k < size(); k++) {
    const Joint& joint = jointAt(k, ties);
    // Rows of joints that have ended go when the islands are made anew; those of others stay.
    if (!current && (!joint.alive || joint.born)) continue;
    f.expect(bodyOf(records[k].bodyA) == joint.bodyA && bodyOf(records[k].bodyB) == joint.bodyB,
             "islands: a joint's row is of other bodies");
  }
}

void JointRows::startAfresh(Ties& ties) const {
  for (JointIndex index : jointOf) {
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
    const Joint& joint = jointAt(k, *context.ties);
    const joint::Relative moved = joint::relativeMotion(records[k], island.motion.data());
    const Vec3 way = toDouble(wide::store3(moved.way));
    sum.work += dot(joint.force, way) + dot(joint.torque, toDouble(wide::store3(moved.turn)));
    if (joint.type != JointType::spring && joint.type != JointType::drag) continue;
    const double stretch = length(JointPose(joint, *context.bodies).way + way) - joint.length;
    sum.elastic += 0.5 * joint.stiffness * stretch * stretch;
  }
}

void JointRows::addSupport(const Island& island, const StepContext& context, BalanceChange& sum) const {
  const BodySet& bodies = *context.bodies;
  for (std::size_t k = 0; k < size(); k++) {
    const JointRecord& r = records[k];
    const bool partnerA = r.bodyA >= island.bodies.size(), partnerB = r.bodyB >= island.bodies.size();
    if (!partnerA && !partnerB) continue;
    const Joint& joint = jointAt(k, *context.ties);
    const BodyMotion& partner = bodies.motion[partnerA ? joint.bodyA : joint.bodyB];
    const Vec3 centre = partner.position + toDouble(partnerA ? r.armA : r.armB);
    const double sign = partnerA ? island.dt : -island.dt;
    const Vec3 impulse = joint.force * sign, turning = joint.torque * sign;
    sum.linear += impulse;
    sum.angular += cross(centre, impulse) + turning;
    sum.energy += dot(impulse, partner.linearVelocity + cross(partner.angularVelocity, centre - partner.position)) +
                  dot(turning, partner.angularVelocity);
  }
}

}  // namespace brickfall
