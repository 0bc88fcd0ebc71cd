// A small box by turning: with one axis fixed, the best rectangle around the projection has a side along an edge of the
// projection's hull (Freeman, Shapira 1975), so all its edges are tried; then the next axis is fixed, until nothing improves.
// That ends in a local minimum, so it is begun from several places.
#include <algorithm>

#include "geometry/fitting_points.h"

namespace brickfall {

namespace {

constexpr int kFaceStarts = 12, kRounds = 24;

Vec3 anyAcross(Vec3 d) { return normalized(cross(std::fabs(d.x) < 0.6 ? Vec3{1, 0, 0} : Vec3{0, 1, 0}, d)); }

double extent(std::span<const Vec3> corners, Vec3 axis) {
  double low = dot(corners[0], axis), high = low;
  for (Vec3 p : corners) {
    double along = dot(p, axis);
    low = std::min(low, along), high = std::max(high, along);
  }
  return high - low;
}

// Of the least area around the outline (counter-clockwise): the direction of its side. Each edge in turn, with the furthest
// corners in the four directions followed round the outline (Toussaint's calipers).
struct Side {
  double u = 1, v = 0, area = -1;
};
Side smallestRectangle(const std::vector<PlanePoint>& outline) {
  Side best;
  const std::size_t n = outline.size();
  if (n < 3) return best;
  std::size_t right = 1, top = 1, left = 1;
  for (std::size_t k = 0; k < n; k++) {
    PlanePoint p = outline[k], q = outline[(k + 1) % n];
    double du = q.u - p.u, dv = q.v - p.v, size = std::sqrt(du * du + dv * dv);
    if (!(size > 0)) continue;
    du /= size, dv /= size;
    auto along = [&](std::size_t m) { return outline[m % n].u * du + outline[m % n].v * dv; };
    auto up = [&](std::size_t m) { return outline[m % n].v * du - outline[m % n].u * dv; };
    right = std::max(right, k + 1);
    while (right < k + n && along(right + 1) >= along(right)) right++;
    top = std::max(top, right);
    while (top < k + n && up(top + 1) >= up(top)) top++;
    left = std::max(left, top);
    while (left < k + n && along(left + 1) <= along(left)) left++;
    double area = (along(right) - along(left)) * (up(top) - up(k));
    if (best.area < 0 || area < best.area) best = {du, dv, area};
  }
  return best;
}

// Turns the other two axes about axis k; true if the area across it got smaller.
bool turnAbout(const std::vector<Vec3>& corners, int k, Mat3& axes) {
  const Vec3 u = axes.row[(k + 1) % 3], v = axes.row[(k + 2) % 3];
  std::vector<PlanePoint> plane, outline;
  plane.reserve(corners.size());
  for (Vec3 p : corners) plane.push_back({dot(p, u), dot(p, v)});
  for (std::uint32_t index : planeHull(plane)) outline.push_back(plane[index]);
  Side side = smallestRectangle(outline);
  double before = extent(corners, u) * extent(corners, v);
  if (!(side.area >= 0 && side.area < before * (1 - 1e-9))) return false;
  axes.row[(k + 1) % 3] = normalized(u * side.u + v * side.v);
  axes.row[(k + 2) % 3] = normalized(cross(axes.row[k], axes.row[(k + 1) % 3]));
  return true;
}

// Volume; of flat points the area of the two longer sides.
double measure(const FitHull& hull, const Mat3& axes) {
  double sides[3];
  for (int k = 0; k < 3; k++) sides[k] = extent(hull.corners, axes.row[k]);
  std::sort(sides, sides + 3);
  return hull.dimensions == 3 ? sides[0] * sides[1] * sides[2] : sides[1] * sides[2];
}

Mat3 axesFrom(Vec3 first) {
  Vec3 second = anyAcross(first);
  return {{first, second, cross(first, second)}};
}

// Normals of the largest hull faces, each once.
std::vector<Vec3> largeFaces(const FitHull& hull) {
  struct Face {
    Vec3 normal;
    double area;
  };
  std::vector<Face> faces;
  for (std::size_t t = 0; t + 2 < hull.triangles.size(); t += 3) {
    Vec3 p = hull.corners[hull.triangles[t]];
    Vec3 area = cross(hull.corners[hull.triangles[t + 1]] - p, hull.corners[hull.triangles[t + 2]] - p);
    if (length(area) > 0) faces.push_back({normalized(area), length(area)});
  }
  std::stable_sort(faces.begin(), faces.end(), [](const Face& a, const Face& b) { return a.area > b.area; });
  std::vector<Vec3> out;
  for (const Face& face : faces) {
    if (int(out.size()) == kFaceStarts) break;
    bool known =
        std::any_of(out.begin(), out.end(), [&](Vec3 n) { return lengthSquared(cross(n, face.normal)) < 1e-6; });
    if (!known) out.push_back(face.normal);
  }
  return out;
}

}  // namespace

Mat3 smallestBoxAxes(const FitHull& hull, std::span<const Mat3> given) {
  std::vector<Mat3> starts(given.begin(), given.end());
  if (hull.dimensions == 2) starts = {axesFrom(hull.direction)};
  if (hull.dimensions == 3) {
    for (Vec3 normal : largeFaces(hull)) starts.push_back(axesFrom(normal));
  }
  Mat3 best = starts[0];
  double least = measure(hull, best);
  for (Mat3 axes : starts) {
    int idle = 0;
    // A flat hull has one axis to turn about: its normal, the first.
    for (int round = 0; round < kRounds && idle < 3; round++) {
      bool better = (hull.dimensions == 3 || round % 3 == 0) && turnAbout(hull.corners, round % 3, axes);
      idle = better ? 0 : idle + 1;
    }
    double found = measure(hull, axes);
    if (found < least) least = found, best = axes;
  }
  return best;
}

}  // namespace brickfall
