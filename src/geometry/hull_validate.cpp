// What every hull must satisfy, whoever made it.
#include <algorithm>

#include "brickfall/shapes.h"
#include "geometry/hull.h"

namespace brickfall {

namespace {

constexpr double kPlanarity = 2e-6;  // how far a face's own corners may be below its plane, as a share of the size

std::string at(const char* what, std::size_t index, const char* fault) {
  return std::string(what) + " " + std::to_string(index) + " " + fault;
}

std::string checkCounts(const Hull& hull) {
  std::size_t v = hull.vertices.size(), f = hull.planes.size(), e = hull.edges.size();
  if (v < 4 || v > std::size_t(kMaxHullVertices)) return "number of vertices not 4 .. 64";
  if (f < 4 || f != hull.firstEdge.size()) return "number of faces below 4 or not that of the first edges";
  if (e % 2 != 0 || v + f != e / 2 + 2) return "vertices - edges + faces is not 2";
  return {};
}

// Every edge belongs to one face loop, its twin runs backwards, and every vertex has an edge.
std::string checkTopology(const Hull& hull) {
  std::size_t visited = 0;
  for (std::size_t k = 0; k < hull.edges.size(); k++) {
    const HullEdge& edge = hull.edges[k];
    if (edge.origin >= hull.vertices.size() || edge.face >= hull.planes.size() || edge.next >= hull.edges.size()) {
      return at("edge", k, "points outside the hull's arrays");
    }
  }
  for (std::size_t f = 0; f < hull.planes.size(); f++) {
    if (hull.firstEdge[f] >= hull.edges.size()) return at("face", f, "has no such first edge");
    std::size_t e = hull.firstEdge[f], corners = 0;
    do {
      if (hull.edges[e].face != f) return at("face", f, "has an edge of another face");
      if (++corners > hull.edges.size()) return at("face", f, "does not close");
      e = hull.edges[e].next;
    } while (e != hull.firstEdge[f]);
    if (corners < 3) return at("face", f, "has fewer than three corners");
    visited += corners;
  }
  if (visited != hull.edges.size()) return "an edge is in no face";
  std::vector<bool> used(hull.vertices.size(), false);
  for (std::size_t k = 0; k < hull.edges.size(); k++) {
    const HullEdge &edge = hull.edges[k], &twin = hull.edges[k ^ 1];
    if (twin.origin != hull.edges[edge.next].origin) return at("edge", k, "does not end where its twin starts");
    if (twin.face == edge.face) return at("edge", k, "has the same face on both sides");
    used[edge.origin] = true;
  }
  if (std::find(used.begin(), used.end(), false) != used.end()) return "a vertex has no edge";
  return {};
}

std::string checkFace(const Hull& hull, std::size_t f, double size, double rounding) {
  const HullPlane& plane = hull.planes[f];
  if (!(std::fabs(length(plane.normal) - 1) <= 1e-12)) return at("face", f, "has a normal that is not unit");
  for (Vec3 v : hull.vertices) {
    if (!(dot(plane.normal, v) <= plane.offset + rounding)) return at("face", f, "has a vertex above it");
  }
  std::uint16_t e = hull.firstEdge[f];
  do {
    const HullEdge& edge = hull.edges[e];
    Vec3 a = hull.vertices[edge.origin], b = hull.vertices[hull.edges[edge.next].origin];
    Vec3 c = hull.vertices[hull.edges[hull.edges[edge.next].next].origin];
    if (!(dot(plane.normal, a) >= plane.offset - kPlanarity * size - rounding)) {
      return at("face", f, "has a corner off its plane");
    }
    // The corner b must not lie inside the line a-c by more than the planarity.
    double inwards = -dot(cross(b - a, c - b), plane.normal) / std::max(length(c - a), 1e-9 * size);
    if (!(inwards <= kPlanarity * size + rounding)) return at("face", f, "is not convex");
    e = edge.next;
  } while (e != hull.firstEdge[f]);
  return {};
}

}  // namespace

std::string validate(const Hull& hull) {
  if (std::string fault = checkCounts(hull); !fault.empty()) return fault;
  if (std::string fault = checkTopology(hull); !fault.empty()) return fault;
  Vec3 lower = hull.vertices[0], upper = lower;
  double furthest = 0;
  for (Vec3 v : hull.vertices) {
    if (!isFinite(v)) return "a vertex is not finite";
    lower = min(lower, v), upper = max(upper, v);
    furthest = std::max(furthest, length(v));
  }
  double size = length(upper - lower), rounding = 1e-14 * furthest;
  for (std::size_t f = 0; f < hull.planes.size(); f++) {
    if (std::string fault = checkFace(hull, f, size, rounding); !fault.empty()) return fault;
  }
  if (!(hull.volume > 0 && std::isfinite(hull.volume))) return "the volume is not positive";
  for (std::size_t f = 0; f < hull.planes.size(); f++) {
    if (!(dot(hull.planes[f].normal, hull.centroid) < hull.planes[f].offset)) return "the centroid is outside";
  }
  return {};
}

}  // namespace brickfall
