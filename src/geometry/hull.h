// Convex hulls: 4 .. 64 vertices, faces as convex polygons, half-edge structure.
#pragma once
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "brickfall/math.h"
#include "brickfall/result.h"

namespace brickfall {

struct HullPlane {
  Vec3 normal;        // unit, outwards
  double offset = 0;  // dot(normal, p) = offset on the face
};
// Half edges come in pairs: the twin of edge e is e ^ 1.
struct HullEdge {
  std::uint8_t origin = 0;  // vertex
  std::uint8_t face = 0;    // left of the edge, counter-clockwise seen from outside
  std::uint16_t next = 0;   // along the face
};
struct Hull {
  std::vector<Vec3> vertices;
  std::vector<HullPlane> planes;         // per face; coplanar triangles are merged
  std::vector<std::uint16_t> firstEdge;  // per face
  std::vector<HullEdge> edges;
  Vec3 centroid;
  double volume = 0;  // m3
};

// Convex hull of at most 4096 points. It does not depend on their order, and its vertices are among them. Points closer than
// 1e-9 of the size (longest side of the bounds) are one; what sticks out by less than 5e-7 of it, about the rounding of
// 32-bit coordinates, counts as flat, so no point is further outside than 1e-6 of the size. Errors: fewer than four points,
// not finite, all in a plane (thinner than 2e-6 of the size), more than 64 corners on the hull, more than 1e7 sizes from the
// origin.
Result<Hull> buildHull(std::span<const Vec3> points);
// Every invariant (Euler, twins, convexity, planes); empty text = all hold.
std::string validate(const Hull& hull);

}  // namespace brickfall
