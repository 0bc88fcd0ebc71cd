// Convex solids in extended precision (64-bit mantissa), and what there is to know about two of them, by trying every
// feature of one against every feature of the other. Slow, and without a single decision that rounding could turn: the
// reference for all contact functions and queries.
#pragma once
#include <array>
#include <vector>

#include "geometry/shape.h"

namespace brickfall::oracle {

using Real = long double;
using Vector = Vec3T<Real>;

inline Vector wide(Vec3 v) { return {v.x, v.y, v.z}; }
inline Vec3 narrow(Vector v) { return {double(v.x), double(v.y), double(v.z)}; }

// A core (point, segment or polytope) and a radius around it; or a half space.
struct Solid {
  std::vector<Vector> corners;
  std::vector<std::vector<int>> faces;  // corners of each, in order
  std::vector<Vector> normals;          // of the faces: unit, outwards
  std::vector<Real> offsets;
  std::vector<std::array<int, 2>> edges;
  Real radius = 0;
  bool halfSpace = false;  // below the first face's plane; no corners
};
Solid solidOf(const Shape& shape, const Transform& pose);

// How far b is from a: positive = distance, negative = depth, the shortest translation that parts them.
struct Separation {
  Real value = 0;
  Vector axis;        // unit, from a to b: moving b along it parts them
  bool deep = false;  // the cores overlap, not only the rounding around them
};
Separation separationOf(const Solid& a, const Solid& b);
// Gap between the two along a unit axis from a to b.
Real separationAlong(const Solid& a, const Solid& b, Vector axis);
// Signed distance of a point from the surface of a solid, negative inside.
Real heightOver(const Solid& solid, Vector point);

}  // namespace brickfall::oracle
