// A joint between two bodies: what it was made from, in the frames of its bodies, and the forces that it remembers.
#pragma once
#include <cstdint>
#include <limits>

#include "brickfall/joint.h"
#include "dynamics/body_set.h"

namespace brickfall {

using JointIndex = std::uint32_t;

// The equations of a joint: ways along three axes and turns about three axes, and one more of each along the first
// axis, for a limit beside a motor (solver/joint/equations.h).
//! not of the method: a count
constexpr int kJointLanes = 4;

struct Joint {
  JointType type = JointType::spherical;
  std::uint16_t generation = 0;
  bool alive = false;
  bool born = true;      // made since the islands were built
  bool idle = false;     // neither body is dynamic, or one takes no part
  bool collide = false;  // its bodies may collide with each other
  bool limited = false, coned = false, driven = false;
  BodyIndex bodyA = kNoIndex, bodyB = kNoIndex;
  std::uint64_t order = 0;  // grows with creation
  std::uint64_t userData = 0;

  Vec3 anchorA, anchorB;           // m, body frames
  Quat frameA, frameB;             // body frames: the axes of the joint; the first is that of turn, way or twist
  double lower = 0, upper = 0;     // rad or m
  double cone = 0;                 // rad
  double speed = 0, strength = 0;  // rad/s or m/s, N m or N: of the motor; N, of a drag
  double length = 0;               // m
  double stiffness = 0, damping = 0;
  double breakForce = std::numeric_limits<double>::infinity();   // N
  double breakTorque = std::numeric_limits<double>::infinity();  // N m

  double way[kJointLanes] = {}, turn[kJointLanes] = {};  // N, N m: by equation, of the last part of the step
  Vec3 force, torque;                // N, N m: from A on B at the middle of the anchors, of the last part of the step
  Vec3 earlierForce, earlierTorque;  // of the parts before, and of impacts: by their share of the step
  double lent = 0;   // J: work that it took and may give back, or owes, since its errors and arcs hold it
  double held = 0;   // J: the energy that swings keep, less theirs where a step ends (solver/joint/swings.cpp)
  double wound = 0;  // m or rad: its length or limits were changed by so much from outside, and it has not gone it yet
  double over = 0;   // s: the step over which its errors grew
  double meanForce = 0, meanTorque = 0;  // N, N m: over kReferenceStep, what a break is judged by

  bool gone() const { return false; }
  bool endsNow() const { return false; }
  bool collides() const { return collide; }
  bool names(BodyIndex body) const { return bodyA == body || bodyB == body; }
};

// Where a body is, as its joints ask.
struct JointPlace {
  Vec3 position;  // m, of the centre of mass
  Quat rotation;
  Mat3 orientation;
  Vec3 localCentre;  // m, body frame
};
// Where a joint's points and axes are.
struct JointPose {
  JointPose(const Joint& joint, const JointPlace& a, const JointPlace& b);
  JointPose(const Joint& joint, const BodySet& bodies);
  Vec3 armA, armB;      // m, from the centres of mass to the anchors
  Vec3 pointA, way;     // m: the anchor of A; from it to that of B
  Quat frameA, frameB;  // world
  bool spinsB = false;  // B spins so fast about its first axis that a hinge's is that of B
};

// The turn of B's frame against A's about the first axis, rad, -pi .. pi: the twist.
double twistOf(Quat frameA, Quat frameB);

}  // namespace brickfall
