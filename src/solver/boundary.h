// The rows on a cluster's boundary, read: what they do at the present motion, by what that has changed since it was last read,
// and what a Newton step of the cluster needs of it. A kind of rows reads two at a time and adds them here in their order.
#pragma once
#include <cstdint>

#include "solver/newton_matrix.h"

namespace brickfall {

struct Boundary {
  const std::uint32_t* sides = nullptr;  // of Level::sides, all of one kind
  std::uint32_t count = 0;
  std::uint32_t firstRow = 0;  // of that kind
  const SolveMotion* motion = nullptr;
  const SolveMass* masses = nullptr;  // of bodies
  const Reading* readings = nullptr;  // by row: what was read before
  Reading* trial = nullptr;           // by side: what is read now
  wide::V centre = {};                // of the cluster, m
  bool single = false;                // of one body: arms are those of its rows
  bool exact = false;                 // open points are not counted as closed when they are near
};

// Force and torque on the cluster, about its centre, by what has changed; the stiffness of its rows there.
struct BoundarySums {
  wide::V force = {}, torque = {};
  MatrixSums* matrix = nullptr;  // if wanted
};

// Sides i and j, the same one if there is no other: L is one of math/wide_pair.h, i in its low half.
template <class L> struct SidePair {
  static constexpr float kSign[2] = {-1, 1};  // of what a row does to A and to B: looked up, since a branch is a guess

  SidePair(const Boundary& of, std::uint32_t i, std::uint32_t j) : boundary(of), first(i), second(j) {}
  const Boundary& boundary;
  std::uint32_t first, second;

  bool both() const { return first != second; }
  // What read(side) gives for each, in its half.
  template <class Read> BRICKFALL_LANES L halves(Read read) const {
    return L(read(boundary.sides[first]), read(boundary.sides[second]));
  }

  // `arm`: from the centre of the cluster's body to the row's, by side.
  BRICKFALL_LANES void add(L nowForce, L nowTorque, L arm, BoundarySums& sums) const {
    const Reading* readings = boundary.readings;
    Reading* trial = boundary.trial;
    trial[first] = {lowOf(nowForce), lowOf(nowTorque)};
    trial[second] = {highOf(nowForce), highOf(nowTorque)};
    L sign = halves([](std::uint32_t side) { return wide::set(kSign[side & 1]); });
    L force = nowForce - halves([readings](std::uint32_t side) { return readings[side / 2].force; });
    L torque = nowTorque - halves([readings](std::uint32_t side) { return readings[side / 2].torque; });
    L onCluster = sign * force, turning = sign * (cross3(arm, force) + torque);
    sums.force += lowOf(onCluster);
    sums.torque += lowOf(turning);
    if (both()) {
      sums.force += highOf(onCluster);
      sums.torque += highOf(turning);
    }
  }
};

}  // namespace brickfall
