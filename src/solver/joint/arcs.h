// Arcs: what turns of bodies add to the ways of a joint's ends, besides turn x arm.
#pragma once
#include <algorithm>
#include <cmath>

#include "brickfall/math.h"
#include "math/float3.h"

namespace brickfall {

// m: what a turn moves the end of an arm besides turn x arm.
inline Vec3 arcOf(Vec3 turn, Vec3 arm) {
  const double angle = length(turn);
  if (!(angle > 1e-12)) return {};
  double sine, cosine;
  sinCos(angle, sine, cosine);
  const Vec3 once = cross(turn, arm), twice = cross(turn, once);
  return once * (sine / angle - 1) + twice * ((1 - cosine) / (angle * angle));
}

// A turn as a body goes on it: about its axis of symmetry, and then with that (finish/motion.cpp).
struct ArmTurns {
  Vec3 first, then;  // rad

  static ArmTurns of(Vec3 turn, Vec3f axis) {
    const Vec3 about = toDouble(axis) * dot(toDouble(axis), turn);
    return {about, turn - about};
  }
  ArmTurns back() const { return {-then, -first}; }
  // m: what it moves the end of an arm besides turn x arm.
  Vec3 arc(Vec3 arm) const {
    const Vec3 once = arcOf(first, arm), gone = cross(first, arm) + once;
    return once + arcOf(then, arm + gone) + cross(then, gone);
  }
};

// m: what the ways of B in the frame of A gain by turns, besides the way of the point between both anchors.
inline Vec3 arcOfSlide(Vec3 between, ArmTurns turnsA, Vec3 turnA, Vec3 turnB, Vec3 way, Vec3 arc) {
  const Vec3 end = between + way + cross(turnA + turnB, between) * 0.5 + arc;
  return turnsA.back().arc(end) - cross(turnA, end) + end - between - way;
}

// m: what a way of one end of a line against the other makes it longer, besides the way along it.
inline double arcOfLine(double span, Vec3 along, Vec3 way) {
  const double far = dot(along, way), across = lengthSquared(way) - far * far, left = std::max(span + far, 0.1 * span);
  return across > 0 ? across / (left + std::sqrt(left * left + across)) : 0;
}

}  // namespace brickfall
