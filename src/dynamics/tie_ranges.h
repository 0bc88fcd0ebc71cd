// What a snapshot may say of ties.
#pragma once
#include <cmath>

#include "brickfall/math.h"

namespace brickfall::ties {

//! not of the method: what a snapshot may say
constexpr double kFarthest = 1e9, kLargestMemory = 1e30;

inline bool isNear(Vec3 v, double most) {
  return std::fabs(v.x) <= most && std::fabs(v.y) <= most && std::fabs(v.z) <= most;
}
inline bool hasUnitLength(Quat q) { return std::fabs(q.x * q.x + q.y * q.y + q.z * q.z + q.w * q.w - 1) < 1e-9; }

}  // namespace brickfall::ties
