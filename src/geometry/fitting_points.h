// Points as the fits take them: around the origin, the longest side of their bounds one, so that tolerances are numbers.
#pragma once
#include <cstdint>
#include <span>
#include <vector>

#include "brickfall/geometry/fitting.h"

namespace brickfall {

struct FitPoints {
  std::vector<Vec3> points;  // scaled
  Vec3 middle;               // of the bounds, world
  double size = 0;           // longest side of the bounds, m; 0 if all points are one
};

// The hull of scaled points: in space triangles, in a plane a fan of triangles, on a line or in a point none.
struct FitHull {
  int dimensions = 0;                    // 0 one point, 1 a line, 2 a plane, 3
  std::vector<Vec3> corners;             // a line: its ends
  std::vector<std::uint32_t> triangles;  // three indices into corners each
  Vec3 direction;                        // a line's, or a plane's normal; unit
};
FitHull fitHull(std::span<const Vec3> scaled);

// Covariance of the surface of triangles, about its centre of area, divided by the area.
Mat3 surfaceCovariance(std::span<const Vec3> points, std::span<const std::uint32_t> triangles);
Mat3 pointCovariance(std::span<const Vec3> points);
// Rows: eigenvectors of a symmetric matrix, right-handed, largest eigenvalue first.
Mat3 principalAxes(const Mat3& symmetric);

// Axes (rows, right-handed) of a small box around the hull's corners, from the best of `starts`.
Mat3 smallestBoxAxes(const FitHull& hull, std::span<const Mat3> starts);

// Corners of the convex hull of points in the plane, counter-clockwise, as indices.
struct PlanePoint {
  double u, v;
};
std::vector<std::uint32_t> planeHull(std::span<const PlanePoint> points);

}  // namespace brickfall
