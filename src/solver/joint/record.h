// A joint as the solve reads it: up to eight equations at its centre, the middle of its two anchors. Four are along
// ways of B against A: three axes, and the first axis once more, for a limit beside a motor. Four are about axes of
// turns in the same way. The law of each:
//
//   f = trial - k C, not below `least`, not above `most`        C: way (m) or turn (rad) in the step, along its axis
//
// A limit has two bounds: one is written so, and where trial - k C goes beyond `other`, the second one gives the rest.
// Hard joints have a multiplier in `trial`, which follows the force within the solve (rows.h). Limits, ropes, motors
// and springs differ from them in k, trial and range alone.
#pragma once
#include <algorithm>
#include <cstdint>
#include <iterator>

#include "dynamics/joint.h"
#include "math/wide.h"
#include "solver/reaction.h"
#include "solver/solve_body.h"

namespace brickfall {

// Four equations, field by field.
struct alignas(16) JointEquations {
  struct Axis {
    Vec3f unit;
    float pad = 0;
  };
  Axis axes[3] = {};
  float k[kJointLanes] = {};  // N/m, or N m/rad; 0: no equation, or a force that is given
  float trial[kJointLanes] = {};
  float least[kJointLanes] = {}, most[kJointLanes] = {};
  float other[kJointLanes] = {};  // above 0 of an upper bound, below 0 of a lower one; 0: there is one bound
};

struct alignas(16) JointRecord {
  Vec3f armA;  // m, from the centres of mass to the joint's centre
  std::uint32_t bodyA = 0;
  Vec3f armB;
  std::uint32_t bodyB = 0;
  JointEquations way, turn;
};
static_assert(sizeof(JointRecord) == 288);

namespace joint {

using wide::V;

// The motion along each equation's axis.
BRICKFALL_LANES V alongAxes(const JointEquations& e, V motion) {
  const V first = wide::load(&e.axes[0].unit.x) * motion;
  return wide::sums(first, wide::load(&e.axes[1].unit.x) * motion, wide::load(&e.axes[2].unit.x) * motion, first);
}
BRICKFALL_LANES V beyondOther(const JointEquations& e, V trial) {
  const V other = wide::load(e.other), none = {};
  return wide::keepIf((other > none) & (trial > other), trial - other) +
         wide::keepIf((none > other) & (other > trial), trial - other);
}
BRICKFALL_LANES V clamped(const JointEquations& e, V trial) {
  return -wide::max(-wide::max(trial, wide::load(e.least)), -wide::load(e.most)) + beyondOther(e, trial);
}
BRICKFALL_LANES V trialOf(const JointEquations& e, V motion) {
  return wide::load(e.trial) - wide::load(e.k) * alongAxes(e, motion);
}
// The vector that the equations' forces sum to.
BRICKFALL_LANES V sumOf(const JointEquations& e, V forces) {
  return wide::load(&e.axes[0].unit.x) * (wide::spread<0>(forces) + wide::spread<3>(forces)) +
         wide::load(&e.axes[1].unit.x) * wide::spread<1>(forces) +
         wide::load(&e.axes[2].unit.x) * wide::spread<2>(forces);
}

// Way and turn of B against A at the centre.
struct Relative {
  V way, turn;
};
BRICKFALL_LANES Relative relativeMotion(const JointRecord& r, const SolveMotion* motion) {
  const SolveMotion &a = motion[r.bodyA], &b = motion[r.bodyB];
  const V thA = wide::load(&a.th.x), thB = wide::load(&b.th.x);
  return {(wide::load(&b.d.x) + wide::cross3(thB, wide::load3Padded(r.armB))) -
              (wide::load(&a.d.x) + wide::cross3(thA, wide::load3Padded(r.armA))),
          thB - thA};
}

// By equation.
struct Forces {
  V way, turn;
};
BRICKFALL_LANES Forces forcesAt(const JointRecord& r, const SolveMotion* motion) {
  const Relative moved = relativeMotion(r, motion);
  return {clamped(r.way, trialOf(r.way, moved.way)), clamped(r.turn, trialOf(r.turn, moved.turn))};
}
inline Reading readingAt(const JointRecord& r, const SolveMotion* motion) {
  const Forces f = forcesAt(r, motion);
  return {sumOf(r.way, f.way), sumOf(r.turn, f.turn)};
}

// Equations within their range resist.
inline V resisting(const JointEquations& e, V motion) {
  const V trial = trialOf(e, motion), other = wide::load(e.other), none = {}, all = wide::load(e.k);
  return wide::keepIf((trial > wide::load(e.least)) & (wide::load(e.most) > trial), all) +
         wide::keepIf((other > none) & (trial > other), all) + wide::keepIf((none > other) & (other > trial), all);
}
// Adds the sum of their stiffness, from this row and column on.
inline void addStiffness(const JointEquations& e, V motion, int corner, BodyBlock& K) {
  const V k = resisting(e, motion);
  const double by[3] = {double(k[0]) + double(k[3]), double(k[1]), double(k[2])};
  for (int lane = 0; lane < 3; lane++) {
    const Vec3 axis = toDouble(e.axes[lane].unit);
    for (int i = 0; i < 3; i++)
      for (int j = 0; j < 3; j++) K[corner + i][corner + j] += by[lane] * (axis[i] * axis[j]);
  }
}
inline void writeStiffness(const JointRecord& r, const SolveMotion* motion, BodyBlock& K) {
  const Relative moved = relativeMotion(r, motion);
  for (auto& column : K) std::fill(std::begin(column), std::end(column), 0.0);
  addStiffness(r.way, moved.way, 0, K);
  addStiffness(r.turn, moved.turn, 3, K);
}
inline Stiffness stiffnessAt(const JointRecord& r, const SolveMotion* motion) {
  BodyBlock K;
  writeStiffness(r, motion, K);
  Stiffness s = {};
  for (int i = 0; i < 3; i++) {
    s.A[i] = V{float(K[i][0]), float(K[i][1]), float(K[i][2])};
    s.C[i] = V{float(K[i + 3][3]), float(K[i + 3][4]), float(K[i + 3][5])};
  }
  return s;
}

// Adds an arc to the ways of all equations, a limit beside a motor as well.
inline void takeArc(Vec3f arc, JointEquations& way) {
  for (int i = 0; i < kJointLanes; i++) way.trial[i] -= way.k[i] * dot(way.axes[i % 3].unit, arc);
}

}  // namespace joint
}  // namespace brickfall
