// The convex hull of points on an integer grid, as triangles, without rounding: every decision is the sign of a
// determinant of 31-bit numbers, which fits in 128 bits. So no input can make the topology inconsistent, which is what
// breaks hull builders that decide with tolerances. Tolerances come later, when nearly coplanar triangles are merged.
#pragma once
#include <cstdint>
#include <span>
#include <vector>

namespace brickfall {

constexpr double kGridSteps = 1 << 30;  // along the longest side of the points' bounds

// |coordinate| <= 2^29
struct GridPoint {
  std::int64_t x = 0, y = 0, z = 0;
};

// Exactly in one plane.
bool coplanar(GridPoint a, GridPoint b, GridPoint c, GridPoint d);

// Corners counter-clockwise seen from outside; across[k] is the triangle on the other side of corner[k] -> corner[k + 1].
struct HullTriangle {
  int corner[3];
  int across[3];
};

// Four points that span as much as is easily found, with the size of what they span, grid steps.
struct GridSimplex {
  int corner[4] = {0, 0, 0, 0};
  double width = 0;   // distance of corner 2 from the line 0-1
  double height = 0;  // distance of corner 3 from the plane 0-1-2
};
GridSimplex widestSimplex(std::span<const GridPoint> points);

// The points differ from each other and the simplex has a volume. Quickhull (Barber, Dobkin, Huhdanpaa 1996): the points
// that stick out most come first, and those that stick out by less than `flatness` (grid steps, >= 0) are left out.
// Leaving points out is always safe; what decides which triangles a point replaces stays exact.
std::vector<HullTriangle> hullTriangles(std::span<const GridPoint> points, const GridSimplex& start, double flatness);

}  // namespace brickfall
