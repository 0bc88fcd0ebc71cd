// The motion of several bodies as one rigid body in a step.
#pragma once
#include "brickfall/math.h"
#include "math/free_turn.h"
#include "solver/rigid_sum.h"

namespace brickfall {

struct RigidWay {
  Vec3 move;    // m, of the centre
  Vec3 turn;    // rad
  Vec3 spin;    // rad: the angular velocity at the end x the step
  Vec3 centre;  // m, world
  Mat3 turned;  // by `turn`

  bool turns() const { return !(turn == Vec3{}); }
  // m: the way of a body.
  Vec3 of(Vec3 position) const {
    const Vec3 arm = position - centre;
    return turns() ? move + turned * arm - arm : move;
  }
  // m: its velocity at the end x the step.
  Vec3 endOf(Vec3 position) const { return turns() ? move + cross(spin, turned * (position - centre)) : move; }
};

// `sum`: with ways in the place of velocities. It turns freely.
inline RigidWay rigidWayOf(const RigidSum& sum) {
  const Mat3 inertia = sum.inertia();
  const Vec3 momentum = sum.angularMomentum();
  const Quat turn = turnFreely({}, momentum, principalInertia(inertia), 1);
  const Mat3 turned = toMatrix(turn);
  return {sum.velocity(), rotationVector(turn), turned * (inverse(inertia) * transposeTimes(turned, momentum)),
          sum.centre(), turned};
}

}  // namespace brickfall
