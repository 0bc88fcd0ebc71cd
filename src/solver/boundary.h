// The rows on a cluster's boundary, read: their forces at the present motion, the change since they were last read, and
// the matrix for a Newton step of the cluster. A kind of rows reads two at a time and adds them here in their order.
#pragma once
#include <cstdint>

#include "solver/newton_matrix.h"

namespace brickfall {

struct Boundary {
  const std::uint32_t* sides = nullptr;  // of Level::sides, all of one kind
  std::uint32_t count = 0;
  std::uint32_t firstRow = 0;  // of this kind
  const SolveMotion* motion = nullptr;
  const SolveMass* masses = nullptr;  // of bodies
  const Reading* readings = nullptr;  // by row: as last read
  Reading* trial = nullptr;           // by side: as read now
  wide::V centre = {};                // of the cluster, m
  bool single = false;                // a cluster of one body: arms are those of its rows
  bool exact = false;                 // near open points do not count as closed
};

// Force and torque on the cluster, about its centre, by their changes; the stiffness of its rows there.
struct BoundarySums {
  wide::V force = {}, torque = {};
  MatrixSums* matrix = nullptr;  // null if not wanted
};

// Sides i and j, or i twice if there is no other. L is one of math/wide_pair.h, with i in its low half.
template <class L> struct SidePair {
  static constexpr float kSign[2] = {-1, 1};  // of a row's action on A and on B: looked up, since a branch is a guess

  SidePair(const Boundary& of, std::uint32_t i, std::uint32_t j) : boundary(of), first(i), second(j) {}
  const Boundary& boundary;
  std::uint32_t first, second;

  bool both() const { return first != second; }
  // The results of read(side), each in its half.
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
