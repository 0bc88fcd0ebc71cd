// Single precision vectors, for the solver's own quantities: displacements of one step, arms, forces. Never for positions.
#pragma once
#include "brickfall/math.h"

namespace brickfall {

using Vec3f = Vec3T<float>;
using Mat3f = Mat3T<float>;

inline Vec3f toFloat(Vec3 v) { return {float(v.x), float(v.y), float(v.z)}; }
inline Vec3 toDouble(Vec3f v) { return {v.x, v.y, v.z}; }
inline Vec3 toDouble(Vec3 v) { return v; }  // where a template takes both

}  // namespace brickfall
