// Two boxes by corners and edges, with nothing of the separating axis test in it: slow, simple, double.
#pragma once
#include <array>
#include <vector>

#include "brickfall/geometry/obb.h"

namespace brickfall::test {

struct SlowBox {
  explicit SlowBox(const Obb& box);
  Obb box;
  std::array<Vec3, 8> corner;
  struct Edge {
    int from, to;
  };
  static const std::array<Edge, 12>& edges();
  bool contains(Vec3 point, double slack = 0) const;
};

// Some edge of one meets the other solid, or one holds the other's corners.
bool slowOverlap(const SlowBox& a, const SlowBox& b);
// Corners against solids and all 144 pairs of edges.
double slowDistance(const SlowBox& a, const SlowBox& b);
// Least overlap of the corners' projections on face normals and on crossed edges more than `parallel` rad apart, all taken
// from the corners. Negative: apart.
double slowDepth(const SlowBox& a, const SlowBox& b, double parallel = 1e-9);
// > 0 distance, < 0 minus the depth.
double slowGap(const SlowBox& a, const SlowBox& b);
// Corners of one within `slack` of the other, and crossings of edges that pass within it.
std::vector<Vec3> slowContact(const SlowBox& a, const SlowBox& b, double slack);

}  // namespace brickfall::test
