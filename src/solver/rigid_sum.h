// The rigid body that a group of bodies makes up: its mass, centre, inertia and momenta. For corrections that must
// leave a floating island's linear and angular momentum exact.
#pragma once
#include "brickfall/math.h"
#include "math/free_turn.h"

namespace brickfall {

// A rigid motion: velocity `move` (m/s) at `centre`, and spin (rad/s). Or, over a step, a way and a turn.
struct RigidMotion {
  Vec3 centre, move, spin;
  Vec3 at(Vec3 place) const { return move + cross(spin, place - centre); }
};

class RigidSum {
 public:
  // Positions are summed relative to `origin`, somewhere near the group.
  explicit RigidSum(Vec3 origin) : origin_(origin) {}

  // `inertia` and `angularMomentum` are about the body's own centre, in world axes.
  void add(double mass, Vec3 position, const Mat3& inertia, Vec3 momentum, Vec3 angularMomentum) {
    Vec3 r = position - origin_;
    mass_ += mass;
    moment_ += r * mass;
    momentum_ += momentum;
    angular_ += cross(r, momentum) + angularMomentum;
    inertia_ = inertia_ + inertia + pointInertia(r, mass);
  }

  double mass() const { return mass_; }
  Vec3 centre() const { return origin_ + moment_ * (1 / mass_); }
  Vec3 velocity() const { return momentum_ * (1 / mass_); }
  // Both are about the common centre.
  Vec3 angularMomentum() const { return angular_ - cross(moment_ * (1 / mass_), momentum_); }
  Mat3 inertia() const { return inertia_ + pointInertia(moment_ * (1 / mass_), mass_) * -1.0; }
  Vec3 spin() const { return inverse(inertia()) * angularMomentum(); }
  RigidMotion motion() const { return {centre(), velocity(), spin()}; }

 private:
  static Mat3 pointInertia(Vec3 r, double m) {
    double rr = dot(r, r);
    return {{{m * (rr - r.x * r.x), -m * r.x * r.y, -m * r.x * r.z},
             {-m * r.x * r.y, m * (rr - r.y * r.y), -m * r.y * r.z},
             {-m * r.x * r.z, -m * r.y * r.z, m * (rr - r.z * r.z)}}};
  }

  Vec3 origin_, moment_, momentum_, angular_;
  double mass_ = 0;
  Mat3 inertia_{{{0, 0, 0}, {0, 0, 0}, {0, 0, 0}}};
};

// The motion of such a body in a step.
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
