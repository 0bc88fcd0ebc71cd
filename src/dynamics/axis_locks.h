// Axes along which a body may not move, or about which it may not turn, as bits: ways x, y, z, then turns x, y, z.
#pragma once
#include <cstdint>

#include "brickfall/body.h"

namespace brickfall {

//! not of the method: bits
constexpr std::uint8_t kAllWays = 7, kAllTurns = 7 << 3, kAllLocks = kAllWays | kAllTurns;

constexpr std::uint8_t lockBits(const AxisLocks& locks) {
  return std::uint8_t(locks.wayX | locks.wayY << 1 | locks.wayZ << 2 | locks.turnX << 3 | locks.turnY << 4 |
                      locks.turnZ << 5);
}
constexpr AxisLocks locksOf(std::uint8_t bits) {
  AxisLocks locks;
  locks.wayX = bits & 1;
  locks.wayY = bits & 2;
  locks.wayZ = bits & 4;
  locks.turnX = bits & 8;
  locks.turnY = bits & 16;
  locks.turnZ = bits & 32;
  return locks;
}

// Less its parts along the axes of three bits.
template <class Vector> Vector without(Vector v, unsigned bits) {
  if (bits & 1) v.x = 0;
  if (bits & 2) v.y = 0;
  if (bits & 4) v.z = 0;
  return v;
}

// The inverse of the inertia (world axes) of a body that turns about the free axes alone: 0 along locked ones.
Mat3 lockedInverse(const Mat3& inertia, std::uint8_t locks);

}  // namespace brickfall
