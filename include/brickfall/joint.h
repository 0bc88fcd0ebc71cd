// Joints: ties between two bodies that a program makes and destroys. Each type holds some of the six ways in which one
// body may move against the other, with limits, a motor or a spring where the type has them. A joint may break.
#pragma once
#include <cstdint>
#include <limits>
#include <optional>

#include "brickfall/ids.h"
#include "brickfall/math.h"

namespace brickfall {

// type      | holds                                     | is free            | reads
// ----------+-------------------------------------------+--------------------+---------------------------------------
// spherical | a point of both at one place              | turns              | anchor; axis, cone, limit (of the twist)
// fixed     | a point of both at one place, and turns   | nothing            | anchor
// revolute  | a point and an axis of both in one line   | turn about axis    | anchor, axis, limit, motor
// prismatic | an axis of both in one line, and turns    | way along axis     | anchor, axis, limit, motor
// distance  | two points at a distance                  | all else           | anchor, anchorB, length
// rope      | two points at no more than a distance     | all else           | anchor, anchorB, length
// spring    | nothing: pulls two points to a distance   | all                | anchor, anchorB, length, stiffness, damping
// drag      | nothing: pulls a point of B to one of A   | all                | anchor, anchorB, stiffness, damping, strength
enum class JointType : std::uint8_t { spherical, fixed, revolute, prismatic, distance, rope, spring, drag };
constexpr int kJointTypeCount = 8;

// What a joint is made from. Places and axes are those of the world at the moment in which the joint is made; the
// joint then keeps them in the frames of its bodies. Only the fields of its type are read.
struct JointDef {
  JointType type = JointType::spherical;
  // Two different bodies, at least one of them dynamic. What is fixed to the world is joined to a fixed body.
  BodyId bodyA, bodyB;
  Vec3 anchor;                  // m, world, |coordinate| <= 1e6: a point of A, and of B unless `anchorB` is read
  std::optional<Vec3> anchorB;  // m, world: a point of B; none: at `anchor`
  Vec3 axis{0, 1, 0};           // world, any finite length but zero: of the turn, the way or the twist

  // A range that the joint stays in: rad of the turn of B against A about `axis` (-pi .. pi), or m of the way of B
  // along it; 0 is where the joint was made. lower <= 0 <= upper.
  struct Limit {
    double lower = 0, upper = 0;
  };
  std::optional<Limit> limit;  // none: free
  std::optional<double> cone;  // rad, 0.01 .. 3: the axis of B stays within this angle of the axis of A; none: free

  // Drives the free turn or way of B against A. With speed 0 it is the friction of a hinge or a slide: it holds up to its
  // strength, then rubs with it.
  struct Motor {
    double speed = 0;     // rad/s or m/s, at most 1e5 either way
    double strength = 0;  // N m or N, 0 .. 1e12: the most with which it drives or brakes
  };
  std::optional<Motor> motor;  // none: free

  // m, 1e-4 .. 1e4: of distance, rope and spring; none: as far as the anchors are apart. Anchors of a distance joint
  // must be apart.
  std::optional<double> length;
  double stiffness = 1000;  // N/m, 0 .. 1e12: of spring and drag
  double damping = 0;       // N s/m, 0 .. 1e12: of spring and drag
  double strength = 1e12;   // N, 0 .. 1e12: drag pulls with no more

  // The joint breaks in a step in which its force or its torque, as a mean over 1/60 s or the step if that is longer,
  // is more: it ends, with an event. More than 0; infinity: never.
  double breakForce = std::numeric_limits<double>::infinity();   // N
  double breakTorque = std::numeric_limits<double>::infinity();  // N m
  bool collide = false;                                          // the shapes of its two bodies may touch each other
  std::uint64_t userData = 0;                                    // yours; never read
};

// A joint as the last step left it.
struct JointState {
  JointType type = JointType::spherical;
  BodyId bodyA, bodyB;
  Vec3 anchorA, anchorB;  // m, world: the two points now
  Vec3 axis;              // unit, world: that of A; zero for types without one
  Vec3 force;             // N, from A on B, at `anchorB`: mean over the last step
  Vec3 torque;            // N m, from A on B, about `anchorB`, of motors and limits as well
  double position = 0;    // rad of a revolute joint's turn and a spherical joint's twist, -pi .. pi; m of a prismatic
                          // joint's way; m between the anchors of distance, rope, spring and drag; else 0
  double speed = 0;       // its change, rad/s or m/s
  double error = 0;       // m: how far the joint is from what it holds
  double turnError = 0;   // rad: the same for turns
  bool awake = true;      // a body of it is
  std::uint64_t userData = 0;
};

}  // namespace brickfall
