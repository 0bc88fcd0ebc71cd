#include "solver/joint/spins.h"

#include <algorithm>
#include <cmath>

#include "solver/step_context.h"

namespace brickfall {

namespace {

Vec3 hingeAxis(const Joint& joint, bool ofB, const BodySet& bodies) {
  return rotate(bodies.motion[ofB ? joint.bodyB : joint.bodyA].rotation * (ofB ? joint.frameB : joint.frameA),
                Vec3{1, 0, 0});
}

// kg m2: about the axis about which it is least, through its centre.
double leastInertia(const BodyMass& mass) {
  const Vec3 inv = mass.principalInvInertia;
  return 1 / std::max({inv.x, inv.y, inv.z});
}

double spinAt(const Joint& joint, bool ofB, const BodySet& bodies) {
  const BodyIndex body = ofB ? joint.bodyB : joint.bodyA, partner = ofB ? joint.bodyA : joint.bodyB;
  if (bodies.data[body].type != BodyType::dynamic) return 0;
  const BodyMotion& m = bodies.motion[body];
  if (joint.type != JointType::revolute) return length(m.angularVelocity);
  const Vec3 axis = hingeAxis(joint, ofB, bodies);
  const double along = dot(axis, m.angularVelocity);
  double share = 0;
  if (bodies.data[partner].type == BodyType::dynamic) {
    const Vec3 arm = (ofB ? joint.anchorA : joint.anchorB) - bodies.data[partner].localCentre;
    const double both = leastInertia(bodies.mass[body]) + leastInertia(bodies.mass[partner]) +
                        bodies.mass[partner].mass * lengthSquared(arm);
    share = std::min(1.0, dot(axis, bodies.worldInertia(body) * axis) / both);
  }
  return length(m.angularVelocity - axis * along) + share * std::fabs(along);
}

}  // namespace

double jointedSpin(const Island& island, const StepContext& context) {
  double most = 0;
  const JointRows& joints = island.rows.joints;
  for (std::size_t k = 0; k < joints.size(); k++) {
    const Joint& joint = joints.at(k, *context.ties);
    most = std::max({most, spinAt(joint, false, *context.bodies), spinAt(joint, true, *context.bodies)});
  }
  return most;
}

JointPose withSpins(JointPose pose, const Joint& joint, const BodySet& bodies, double dt) {
  if (joint.type != JointType::revolute) return pose;
  auto turn = [&](BodyIndex body, bool ofB) {
    return std::fabs(dot(hingeAxis(joint, ofB, bodies), bodies.motion[body].angularVelocity)) * dt;
  };
  const double byB = turn(joint.bodyB, true);
  pose.spinsB = byB > kLargestTurn && byB > turn(joint.bodyA, false);
  return pose;
}

}  // namespace brickfall
