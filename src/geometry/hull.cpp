// Building: points are put on an integer grid of 2^30 steps a side, their hull is found without rounding
// (hull_triangles.h), nearly coplanar triangles are merged (hull_faces.h), and planes are fitted to the corners as they
// were given. The result is checked by validate() before anyone sees it. Points are sorted first, so the hull does not
// depend on their order.
#include "geometry/hull.h"

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <functional>
#include <string>

#include "brickfall/shapes.h"
#include "geometry/hull_faces.h"

namespace brickfall {

namespace {

constexpr std::size_t kMaxPoints = 4096;
// Corners this near to a plane, as a share of the size, are on it: a little more than the rounding of 32-bit coordinates,
// in which most meshes come. If no solid comes out, finer ones are tried.
constexpr double kFlatness[] = {5e-7, 5e-8, 5e-9, 0};
constexpr double kOutside =
    1e-6;  // how far a point may stick out of the hull that was made of it, as a share of the size
constexpr double kGoodFit = 1e-12;  // how far corners may be below a face's plane without another look for it, the same
constexpr double kThinnest = 2e-6;  // thickness, as a share of the size, below which points count as coplanar
constexpr double kNearest = 1e-7;   // size over distance from the origin below which rounding would show

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

GridPoint toGrid(Vec3 p, const Welded& welded) {
  Vec3 q = (p - welded.middle) * (1 / welded.size) * kGridSteps;
  return {std::int64_t(std::floor(q.x + 0.5)), std::int64_t(std::floor(q.y + 0.5)),
          std::int64_t(std::floor(q.z + 0.5))};
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
  Vec3 reach = max(abs(lower), abs(upper));
  double furthest = std::max({reach.x, reach.y, reach.z});
  if (!(out.size >= kNearest * furthest)) {
    return Error{ErrorCode::badGeometry,
                 "vertices: found a solid of " + text(out.size) + " m at " + text(furthest) +
                     " m from the origin, where coordinates are too coarse, expected it nearer " + "than " +
                     text(out.size / kNearest) + " m"};
  }
  std::vector<Vec3> sorted(points.begin(), points.end());
  std::sort(sorted.begin(), sorted.end(), [](Vec3 a, Vec3 b) {
    return a.x != b.x ? a.x < b.x : a.y != b.y ? a.y < b.y : a.z < b.z;
  });
  for (Vec3 p : sorted) {
    GridPoint g = toGrid(p, out);
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

// The plane along a face, moved out to the furthest vertex. The normal is Newell's, from the corners as given or, where a
// sliver leaves those to chance, from the grid, on which the hull is convex: whichever lies better.
HullPlane fitPlane(const Hull& hull, const std::vector<Vec3>& onGrid, std::uint16_t start, double size) {
  HullPlane best;
  double bestSpread = -1;
  for (const std::vector<Vec3>& points : {std::cref(hull.vertices), std::cref(onGrid)}) {
    Vec3 area, origin = points[hull.edges[start].origin];
    for (std::uint16_t e = hull.edges[start].next; hull.edges[e].next != start; e = hull.edges[e].next) {
      Vec3 b = points[hull.edges[e].origin] - origin, c = points[hull.edges[hull.edges[e].next].origin] - origin;
      area += cross(b * (1 / size), c * (1 / size));
    }
    HullPlane plane{normalized(area), -1e300};
    for (Vec3 v : hull.vertices) plane.offset = std::max(plane.offset, dot(plane.normal, v));
    double spread = 0;
    std::uint16_t e = start;
    do {
      spread = std::max(spread, plane.offset - dot(plane.normal, hull.vertices[hull.edges[e].origin]));
      e = hull.edges[e].next;
    } while (e != start);
    if (bestSpread < 0 || spread < bestSpread) best = plane, bestSpread = spread;
    if (bestSpread <= kGoodFit * size) break;
  }
  return best;
}

// Planes, and volume and centroid by the divergence theorem; in units of the size, so that nothing over- or underflows.
void measure(Hull& hull, const Welded& welded) {
  double size = welded.size, sixfold = 0;
  std::vector<Vec3> onGrid;
  Vec3 inside;
  for (Vec3 v : hull.vertices) {
    inside += (v - welded.middle) * (1 / size) * (1 / double(hull.vertices.size()));
    GridPoint g = toGrid(v, welded);
    onGrid.push_back(Vec3{double(g.x), double(g.y), double(g.z)} * (size / kGridSteps));
  }
  auto corner = [&](std::uint16_t e) {
    return (hull.vertices[hull.edges[e].origin] - welded.middle) * (1 / size) - inside;
  };
  Vec3 moment;
  for (std::uint16_t start : hull.firstEdge) {
    Vec3 a = corner(start);
    for (std::uint16_t e = hull.edges[start].next; hull.edges[e].next != start; e = hull.edges[e].next) {
      Vec3 b = corner(e), c = corner(hull.edges[e].next);
      double volume = dot(a, cross(b - a, c - a));
      sixfold += volume;
      moment += (a + b + c) * volume;
    }
    hull.planes.push_back(fitPlane(hull, onGrid, start, size));
  }
  hull.volume = sixfold / 6 * size * size * size;
  hull.centroid = welded.middle + (inside + moment * (1 / (4 * sixfold))) * size;
}

bool holdsAll(const Hull& hull, const Welded& welded) {
  for (const HullPlane& plane : hull.planes) {
    for (Vec3 p : welded.points) {
      if (!(dot(plane.normal, p) <= plane.offset + kOutside * welded.size)) return false;
    }
  }
  return true;
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
  std::string fault;
  for (double flatness : kFlatness) {
    std::vector<HullTriangle> triangles = hullTriangles(welded->grid, start, flatness * kGridSteps);
    std::vector<std::vector<int>> faces = mergedFaces(welded->grid, triangles, flatness * kGridSteps);
    if (faces.size() < 4) continue;
    Hull hull = connect(*welded, faces);
    if (hull.vertices.size() > std::size_t(kMaxHullVertices)) {
      return Error{ErrorCode::limitExceeded, "vertices: the hull has " + std::to_string(hull.vertices.size()) +
                                                 " corners, expected at most " + std::to_string(kMaxHullVertices)};
    }
    if (hull.edges.empty()) continue;
    measure(hull, *welded);
    fault = validate(hull);
    if (fault.empty() && holdsAll(hull, *welded)) return hull;
  }
  return Error{ErrorCode::badGeometry, "vertices: no clean solid comes out of these points (" + fault +
                                           "), expected points that are further apart"};
}

}  // namespace brickfall
