// The motion of several bodies as one rigid body in a step.
#pragma once
#include "brickfall/math.h"
#include "math/free_turn.h"
#include "solver/rigid_sum.h"

namespace brickfall {

struct RigidWay {
  Vec3 move;    // m, of the centre
  Vec3 turn;    // rad
  Vec3 centre;  // m, world
  Mat3 turned{{{0, 0, 0}, {0, 0, 0}, {0, 0, 0}}};  // less the identity

  Vec3 of(Vec3 position) const { return turn == Vec3{} ? move : move + turned * (position - centre); }
};

// `sum`: with ways in the place of velocities. It turns freely.
inline RigidWay rigidWayOf(const RigidSum& sum) {
  const Quat turned = turnFreely({}, sum.angularMomentum(), principalInertia(sum.inertia()), 1);
  RigidWay way{sum.velocity(), rotationVector(turned), sum.centre()};
  const Mat3 end = toMatrix(turned);
  for (int i = 0; i < 3; i++) {
    way.turned.row[i] = end.row[i];
    way.turned.row[i][i] -= 1;
  }
  return way;
}

}  // namespace brickfall
