// The law of mortar by its damage D, the share of the energy that breaks it which is spent.
//
// Four points at a times the corners of its kern carry a quarter of the face each. With
//
//   cap  = S ft A / 4           S starts a step at (1 - D) / (1 + 2 D)
//   arm  = 1 + 2 D              x the kern's: 1 intact, 3 at the corners
//
// the face bears a moment of (1 - D) ft W + N (t / 6 + D t / 3): it cracks at the true moment, and broken it rocks
// about its edge.
#pragma once
#include <algorithm>
#include <cmath>

#include "dynamics/mortar.h"
#include "solver/step_context.h"

namespace brickfall {
struct Holding;
struct Island;
}  // namespace brickfall

namespace brickfall::mortar {

//! not of the method: follows from kTrifle
constexpr double kBroken = 1 - kTrifle;  // damage from which a joint counts as broken
//! of the energy | too small: joints break that hold | too large: chance, and the step, decide how many break
constexpr double kThread = 0.9;  // damage from which a joint that opens no further counts as broken: 4 % of it are left

//! not of the method: 1 / sqrt(3): the kern's corners, of the radii of gyration
constexpr double kKern = 0.57735026918962576;
//! not of the method: kern points turn a third as firmly as the face
constexpr double kFirmer = 3;

// From kThread on it stays, until the energy is spent.
inline double strengthLeft(double damage) {
  const double d = damage < kThread ? damage : kThread;
  return (1 - d) / (1 + 2 * d);
}
// Of a joint: what has crushed ties no more.
inline double strengthOf(const Mortar& m) { return m.crushed ? 0 : strengthLeft(m.damage); }
inline float armOf(double damage) { return float(1 + 2 * damage); }
//! not of the method: arm of the points of what is broken
constexpr float kBroadest = 3;
// Points further out than the damage says bear the less pull.
inline double pullLeft(double damage, float arm) {
  return arm > armOf(damage) ? strengthLeft(0.5 * (double(arm) - 1)) : 1;
}
// N/m, of a point.
inline double stiffnessOf(const Mortar& m) { return kFirmer * m.shared->stiffness * m.area / kMortarPoints; }
// N, of a point of intact mortar: pull and, without pressure, shear.
inline double pullOf(const Mortar& m) { return double(m.strength.tension) * m.area / kMortarPoints; }
inline double shearOf(const Mortar& m) { return double(m.strength.cohesion) * m.area / kMortarPoints; }
// N, of a point: the pressure that crushes it; m: how far it yields under it.
inline double pressOf(const Mortar& m) { return double(m.shared->compression) * m.area / kMortarPoints; }
inline double yieldOf(const Mortar& m) {
  return (1 - m.damage) * double(m.shared->crushingEnergy) / double(m.shared->compression);
}
// Of the energy that breaks it, what is left. What a blow crushes besides is owed (`tougher` - 1, for an intact joint)
// as far as the joint still bears: a thread presses too little to crush.
inline double energyLeft(double damage, double tougher) {
  const double left = 1 - damage;
  return left * (1 + (tougher - 1) * left);
}
// The damage that `spent` of the energy makes, which also pays what is owed.
inline double damageFor(double damage, double tougher, double spent) {
  const double owed = tougher - 1, left = energyLeft(damage, tougher) - spent;
  if (!(owed > 0)) return spent;
  if (!(left > 0)) return 1 - damage;
  return std::max(0.0, 1 - damage - 2 * left / (1 + std::sqrt(1 + 4 * owed * left)));
}
// J: that breaks it, by mode.
inline double pullEnergy(const Mortar& m) { return double(m.strength.tensionEnergy) * m.area; }
inline double shearEnergy(const Mortar& m) { return double(m.strength.shearEnergy) * m.area; }
inline double crushEnergy(const Mortar& m) { return double(m.shared->crushingEnergy) * m.area; }

// m: along the face's axes, of point i; `arm` as Mortar::arm.
struct PointPlace {
  double s1, s2;
};
inline PointPlace placeOf(const Mortar& m, int i, double arm) {
  return {kMortarSide1[i] * kKern * m.gyration[0] * arm, kMortarSide2[i] * kKern * m.gyration[1] * arm};
}
// m, in the frame of A: of B against A.
inline Vec3 gapAt(const MortarPose& pose, PointPlace at) {
  return pose.displaced + pose.along1 * at.s1 + pose.along2 * at.s2;
}
// The face was measured anew, in floats or on another body. Its points carry what they carried.
inline void keepForces(Mortar& m, const MortarPose& was, const MortarPose& is) {
  for (int i = 0; i < kMortarPoints; i++) {
    const PointPlace at = placeOf(m, i, double(m.arm));
    const Vec3 more = gapAt(is, at) - gapAt(was, at);
    m.opening[i] = float(double(m.opening[i]) + more.x);
    m.slip1[i] = float(double(m.slip1[i]) + more.y);
    m.slip2[i] = float(double(m.slip2[i]) + more.z);
  }
}

// What a joint bears along a direction, and the energy that breaks it there.
void addHolding(const Mortar& m, const BodySet& bodies, Vec3 along, Holding& out);

// N: the joint's force before its island was solved last; where it was not, as it is.
Vec3T<float> forceBefore(const Island& island, MortarIndex mortar, const Mortar& m);

// m: the end of an arm goes so much further than turn x arm.
inline Vec3 arcOfArm(Vec3 turn, Vec3 arm) {
  if (!(lengthSquared(turn) > 1e-16)) return {};
  return rotate(quatFromRotationVector(turn), arm) - arm - cross(turn, arm);
}

}  // namespace brickfall::mortar
