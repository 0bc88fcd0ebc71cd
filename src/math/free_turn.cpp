#include "math/free_turn.h"

#include <algorithm>
#include <cmath>

#include "math/symmetric_eigen.h"

namespace brickfall {

namespace {

//! rad | too small: cost | too large: energy of a spinning brick drifts
constexpr double kTurnPerSubstep = 0.1;                  // rad: energy error of a substep ~ its fourth power
constexpr double kSuzukiShare = 0.41449077179437571194;  // 1 / (4 - 4^(1/3))
constexpr double kSuzuki[] = {kSuzukiShare, kSuzukiShare, 1 - 4 * kSuzukiShare, kSuzukiShare, kSuzukiShare};

}  // namespace

PrincipalInertia principalInertia(const Mat3& inertia) {
  SymmetricEigen e = symmetricEigen(inertia);
  return {e.axes, {1 / e.values.x, 1 / e.values.y, 1 / e.values.z}};
}

Quat turnFreely(Quat rotation, Vec3 angularMomentum, const PrincipalInertia& inertia, double dt) {
  // In principal axes; the length of the momentum is kept by every part.
  Vec3 momentum = inertia.axes * rotate(conjugate(rotation), angularMomentum);
  double spin = length(scaled(inertia.inverse, momentum));
  int substeps = int(std::min(4096.0, std::floor(spin * dt / kTurnPerSubstep) + 1));
  Quat turned;  // since the start, in principal axes
  auto turn = [&](int axis, double t) {
    Vec3 w;
    w[axis] = inertia.inverse[axis] * momentum[axis] * t;
    Quat q = quatFromRotationVector(w);
    momentum = rotate(conjugate(q), momentum);
    turned = turned * q;
  };
  for (int s = 0; s < substeps; s++) {
    for (double share : kSuzuki) {
      double h = share * dt / substeps;
      turn(0, 0.5 * h);
      turn(1, 0.5 * h);
      turn(2, h);
      turn(1, 0.5 * h);
      turn(0, 0.5 * h);
    }
  }
  Vec3 axis = transposeTimes(inertia.axes, Vec3{turned.x, turned.y, turned.z});
  return normalized(rotation * Quat{axis.x, axis.y, axis.z, turned.w});
}

}  // namespace brickfall
