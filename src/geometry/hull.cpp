// Building: points are put on an integer grid of 2^30 steps a side, their hull is found without rounding
// (hull_triangles.h), nearly coplanar triangles are merged (hull_faces.h), and planes are fitted to the corners as they
// were given. The result is checked by validate() before anyone sees it. Points are sorted first, so the hull does not
// depend on their order.
#include "geometry/hull.h"

#include <algorithm>
#include <cstdio>
#include <string>

#include "brickfall/shapes.h"
#include "geometry/hull_faces.h"

namespace brickfall {

namespace {

constexpr std::size_t kMaxPoints = 4096;
// Corners this near to a plane, as a share of the size, are on it: a little more than the rounding of 32-bit coordinates,
// in which most meshes come. If no solid comes out, finer ones are tried.
constexpr double kFlatness[] = {5e-7, 5e-8, 5e-9};
constexpr double kThinnest = 2e-6;  // thickness, as a share of the size, below which points count as coplanar

struct Welded {
  std::vector<Vec3> points;     // as given, without doubles, sorted
  std::vector<GridPoint> grid;  // the same on the grid
  Vec3 middle;                  // of the bounds
  double size = 0;              // longest side of the bounds, m
};

std::string text(double value) {
  char buffer[32];
  std::snprintf(buffer, sizeof buffer, "%.6g", value);
  return buffer;
}

Status checkInput(std::span<const Vec3> points) {
  std::string found = std::to_string(points.size());
  if (points.size() < 4) {
    return Error{ErrorCode::badGeometry, "vertices: found " + found + " points, expected at least 4"};
  }
  if (points.size() > kMaxPoints) {
    return Error{ErrorCode::limitExceeded, "vertices: found " + found + " points, expected at most 4096"};
  }
  for (std::size_t k = 0; k < points.size(); k++) {
    if (!isFinite(points[k])) {
      return Error{ErrorCode::invalidArgument, "vertices[" + std::to_string(k) + "]: found a coordinate that is not " +
                                                   "finite, expected finite numbers"};
    }
  }
  return {};
}

Result<Welded> weld(std::span<const Vec3> points) {
  Welded out;
  Vec3 lower = points[0], upper = lower;
  for (Vec3 p : points) lower = min(lower, p), upper = max(upper, p);
  Vec3 extent = upper - lower;
  out.size = std::max({extent.x, extent.y, extent.z});
  out.middle = lower + extent * 0.5;
  if (!(out.size > 1e-100 && out.size < 1e100)) {
    return Error{ErrorCode::badGeometry, "vertices: found a size of " + text(out.size) +
                                             " m, expected points that differ, between 1e-100 and 1e100 m apart"};
  }
  std::vector<Vec3> sorted(points.begin(), points.end());
  std::sort(sorted.begin(), sorted.end(), [](Vec3 a, Vec3 b) {
    return a.x != b.x ? a.x < b.x : a.y != b.y ? a.y < b.y : a.z < b.z;
  });
  for (Vec3 p : sorted) {
    Vec3 q = (p - out.middle) * (1 / out.size) * kGridSteps;
    GridPoint g{std::int64_t(std::floor(q.x + 0.5)), std::int64_t(std::floor(q.y + 0.5)),
                std::int64_t(std::floor(q.z + 0.5))};
    bool known = false;
    for (std::size_t k = out.grid.size(); k-- > 0 && g.x - out.grid[k].x <= 1 && !known;) {
      known = std::abs(g.y - out.grid[k].y) <= 1 && std::abs(g.z - out.grid[k].z) <= 1;
    }
    if (known) continue;
    out.points.push_back(p);
    out.grid.push_back(g);
  }
  return out;
}

// Vertices and half edges from the corners of the faces. No edges if two faces claim the same side of one.
Hull connect(const Welded& welded, const std::vector<std::vector<int>>& faces) {
  Hull hull;
  std::vector<int> place(welded.points.size(), -1);
  for (const std::vector<int>& face : faces) {
    for (int p : face) place[std::size_t(p)] = 0;
  }
  for (std::size_t p = 0; p < place.size(); p++) {
    if (place[p] < 0) continue;
    place[p] = int(hull.vertices.size());
    hull.vertices.push_back(welded.points[p]);
  }
  std::size_t count = hull.vertices.size();
  if (count > std::size_t(kMaxHullVertices)) return hull;
  std::vector<int> edgeOf(count * count, -1);  // by origin and end
  std::vector<bool> taken;                     // by edge
  for (std::size_t f = 0; f < faces.size(); f++) {
    std::vector<int> loop;
    for (std::size_t k = 0; k < faces[f].size(); k++) {
      std::size_t a = std::size_t(place[std::size_t(faces[f][k])]);
      std::size_t b = std::size_t(place[std::size_t(faces[f][(k + 1) % faces[f].size()])]);
      if (edgeOf[a * count + b] < 0) {
        edgeOf[a * count + b] = int(hull.edges.size());
        edgeOf[b * count + a] = int(hull.edges.size()) + 1;
        hull.edges.resize(hull.edges.size() + 2);
        taken.resize(hull.edges.size());
      }
      int e = edgeOf[a * count + b];
      if (taken[std::size_t(e)]) return Hull{hull.vertices, {}, {}, {}, {}, 0};
      taken[std::size_t(e)] = true;
      hull.edges[std::size_t(e)].origin = std::uint8_t(a);
      hull.edges[std::size_t(e)].face = std::uint8_t(f);
      loop.push_back(e);
    }
    for (std::size_t k = 0; k < loop.size(); k++) {
      hull.edges[std::size_t(loop[k])].next = std::uint16_t(loop[(k + 1) % loop.size()]);
    }
    hull.firstEdge.push_back(std::uint16_t(loop[0]));
  }
  return hull;
}

// Planes through the faces by Newell's method, moved out to the furthest vertex; volume and centroid by the divergence
// theorem. In units of the size, so that nothing over- or underflows.
void measure(Hull& hull, Vec3 middle, double size) {
  auto corner = [&](std::uint16_t e) { return (hull.vertices[hull.edges[e].origin] - middle) * (1 / size); };
  double sixfold = 0;
  Vec3 moment;
  for (std::uint16_t start : hull.firstEdge) {
    Vec3 a = corner(start), area;
    for (std::uint16_t e = hull.edges[start].next; hull.edges[e].next != start; e = hull.edges[e].next) {
      Vec3 b = corner(e), c = corner(hull.edges[e].next);
      Vec3 twice = cross(b - a, c - a);
      double volume = dot(a, twice);
      area += twice;
      sixfold += volume;
      moment += (a + b + c) * volume;
    }
    HullPlane plane;
    plane.normal = normalized(area);
    plane.offset = dot(plane.normal, hull.vertices[0]);
    for (Vec3 v : hull.vertices) plane.offset = std::max(plane.offset, dot(plane.normal, v));
    hull.planes.push_back(plane);
  }
  hull.volume = sixfold / 6 * size * size * size;
  hull.centroid = middle + moment * (size / (4 * sixfold));
}

}  // namespace

Result<Hull> buildHull(std::span<const Vec3> points) {
  if (Status status = checkInput(points); !status) return status.error();
  Result<Welded> welded = weld(points);
  if (!welded) return welded.error();
  GridSimplex start = widestSimplex(welded->grid);
  if (!(start.width >= kThinnest * kGridSteps && start.height >= kThinnest * kGridSteps)) {
    bool line = !(start.width >= kThinnest * kGridSteps);
    return Error{ErrorCode::badGeometry, std::string("vertices: all lie ") + (line ? "on a line" : "in a plane") +
                                             ", expected a thickness of at least " + text(kThinnest * welded->size) +
                                             " m"};
  }
  std::vector<HullTriangle> triangles = hullTriangles(welded->grid, start);
  std::string fault;
  for (double flatness : kFlatness) {
    std::vector<std::vector<int>> faces = mergedFaces(welded->grid, triangles, flatness * kGridSteps);
    if (faces.size() < 4) continue;
    Hull hull = connect(*welded, faces);
    if (hull.vertices.size() > std::size_t(kMaxHullVertices)) {
      return Error{ErrorCode::limitExceeded, "vertices: the hull has " + std::to_string(hull.vertices.size()) +
                                                 " corners, expected at most " + std::to_string(kMaxHullVertices)};
    }
    if (hull.edges.empty()) continue;
    measure(hull, welded->middle, welded->size);
    fault = validate(hull);
    if (fault.empty()) return hull;
  }
  return Error{ErrorCode::badGeometry, "vertices: no clean solid comes out of these points (" + fault +
                                           "), expected points that are further apart"};
}

}  // namespace brickfall
