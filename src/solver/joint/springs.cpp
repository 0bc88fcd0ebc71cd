#include "solver/joint/springs.h"

#include <algorithm>
#include <cmath>

#include "solver/joint/velocity_system.h"

namespace brickfall {

namespace {

//! (angular frequency x dt)^2 | too small: springs lose amplitude | too large: stiff springs gain energy
constexpr double kResolved = 2;  // of a spring that swings half with the leapfrog, half damped

bool isSpring(const Joint& joint) { return joint.type == JointType::spring || joint.type == JointType::drag; }

// Along the axes of a spring.
template <class Of> Vec3 sumAlong(const EquationSet& set, Of of) {
  Vec3 sum;
  for (int i = 0; i < 3; i++)
    if (set.of[i].law == JointLaw::spring) sum += set.axes[i] * of(i);
  return sum;
}
Vec3 stretchOf(const EquationSet& set) {
  return sumAlong(set, [&](int i) { return set.of[i].error; });
}
Vec3 partOf(const EquationSet& set, Vec3 v) {
  return sumAlong(set, [&](int i) { return dot(set.axes[i], v); });
}

// `before` and `after`: stretches at both ends of a step.
Vec3 forceBy(const Joint& joint, double inert, Vec3 before, Vec3 after, Vec3 speed, double dt) {
  const double slowed = joint.damping / (1 + joint.damping / (2 * inert * dt));
  const Vec3 stretch = after + (before - after) * (0.5 * resolvedPart(joint.stiffness, inert));
  const Vec3 force = stretch * -joint.stiffness - speed * slowed;
  const double size = length(force);
  return joint.type == JointType::drag && size > joint.strength ? force * (joint.strength / size) : force;
}

// N, on B: as if its ends had gone straight to where they are.
Vec3 forceBefore(const Joint& joint, const JointPose& pose, const BodySet& bodies, bool ownA, bool ownB, double dt) {
  const BodyMotion &a = bodies.motion[joint.bodyA], &b = bodies.motion[joint.bodyB];
  const EquationSet set = equationsOf(joint, pose).way;
  const Vec3 speed = partOf(set, b.linearVelocity + cross(b.angularVelocity, pose.armB) - a.linearVelocity -
                                     cross(a.angularVelocity, pose.armA));
  const double gives = (ownA ? givenWay(bodies.mass[joint.bodyA], pose.armA) : 0.0) +
                       (ownB ? givenWay(bodies.mass[joint.bodyB], pose.armB) : 0.0);
  const Vec3 stretch = stretchOf(set);
  return forceBy(joint, 1 / (gives * dt * dt), stretch - speed * dt, stretch, speed, dt);
}

// J. Beyond what a drag is strong enough for, its force stays.
double heldAt(const Joint& joint, double stretch) {
  const double size = std::fabs(stretch);
  const bool slips = joint.type == JointType::drag && joint.stiffness * size > joint.strength;
  const double firm = slips ? joint.strength / joint.stiffness : size;
  return joint.stiffness * firm * (size - 0.5 * firm);
}

// Where it was before the last step.
JointPlace placeBefore(const Island& island, std::uint32_t local, const StepContext& context) {
  const BodyIndex body = bodyOf(island, local);
  const BodyMotion& m = context.bodies->motion[body];
  const Quat rotation = normalized(quatFromRotationVector(m.angularVelocity * -island.dt) * m.rotation);
  return {m.position - m.linearVelocity * island.dt, rotation, toMatrix(rotation),
          context.bodies->data[body].localCentre};
}

double released(const Island& island, std::size_t k, bool flies, const StepContext& context) {
  const JointRecord& r = island.rows.joints.records[k];
  const Joint& joint = island.rows.joints.at(k, *context.ties);
  auto stretch = [&](const JointPose& pose) { return length(pose.way) - joint.length; };
  const double now = stretch({joint, *context.bodies}),
               end = stretch({joint, placeAtEnd(island, r.bodyA, context), placeAtEnd(island, r.bodyB, context)});
  if (!flies) return heldAt(joint, now) - heldAt(joint, end);
  const double before = stretch({joint, placeBefore(island, r.bodyA, context), placeBefore(island, r.bodyB, context)});
  return heldAt(joint, 0.5 * (before + now)) - heldAt(joint, 0.5 * (now + end));
}

}  // namespace

double resolvedPart(double stiffness, double inert) {
  const double fast = stiffness / inert;  // (angular frequency x dt)^2
  return kResolved * kResolved / (kResolved * kResolved + fast * fast);
}

double meanInertia(const BodyMass& mass) {
  return (mass.inertia.row[0].x + mass.inertia.row[1].y + mass.inertia.row[2].z) / 3;
}
double givenWay(const BodyMass& mass, Vec3 arm) { return 1 / mass.mass + lengthSquared(arm) / meanInertia(mass); }

Vec3 springForce(const JointRows& joints, std::size_t k, const Joint& joint, const EquationSet& atEnd, Vec3 speed,
                 double dt) {
  const JointStart& start = joints.starts[k];
  Vec3 before;
  for (int i = 0; i < 3; i++)
    if (atEnd.of[i].law == JointLaw::spring)
      before += toDouble(joints.records[k].way.axes[i].unit) * double(start.error[i]);
  return forceBy(joint, double(start.inert), before, stretchOf(atEnd), partOf(atEnd, speed), dt);
}

void addSpringsBefore(const Island& island, const StepContext& context, std::span<const char> begins, BodySet& bodies) {
  const JointRows& joints = island.rows.joints;
  const std::size_t own = island.bodies.size();
  for (std::size_t k = 0; k < joints.size(); k++) {
    const Joint& joint = joints.at(k, *context.ties);
    const JointRecord& r = joints.records[k];
    if (!isSpring(joint) || (!begins[r.bodyA] && !begins[r.bodyB])) continue;
    const JointPose pose(joint, bodies);
    const Vec3 force = forceBefore(joint, pose, bodies, r.bodyA < own, r.bodyB < own, island.dt);
    auto give = [&](std::uint32_t local, BodyIndex body, Vec3 arm, Vec3 f) {
      if (!begins[local]) return;
      bodies.data[body].steady.linear += f * bodies.mass[body].invMass;
      bodies.data[body].steady.angular += bodies.worldInvInertia(body) * cross(arm, f);
    };
    give(r.bodyA, joint.bodyA, pose.armA, -force);
    give(r.bodyB, joint.bodyB, pose.armB, force);
  }
}

double releasedBySprings(const Island& island, std::uint32_t group, const StepContext& context) {
  const JointRows& joints = island.rows.joints;
  double sum = 0;
  for (std::size_t k = 0; k < joints.size(); k++) {
    const RowEnds ends = joints.ends(k);
    const std::uint32_t of = island.groups.groupOf(ends.a < island.bodies.size() ? ends.a : ends.b);
    if (of == group && isSpring(joints.at(k, *context.ties)))
      sum += released(island, k, island.groups.flies(group), context);
  }
  return sum;
}

}  // namespace brickfall
