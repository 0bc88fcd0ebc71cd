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
  std::vector<HullPlane> planes;          // per face; coplanar triangles are merged
  std::vector<std::uint16_t> firstEdge;   // per face
  std::vector<HullEdge> edges;
  Vec3 centroid;
  double volume = 0;                      // m3
};

// Convex hull of points (any finite, at most 4096). Points closer than 1e-9 of the size are one. Errors: fewer than four
// points, not finite, all in a plane, more than 64 corners on the hull.
Result<Hull> buildHull(std::span<const Vec3> points);
// Every invariant (Euler, twins, convexity, planes); empty text = all hold.
std::string validate(const Hull& hull);

}  // namespace brickfall
