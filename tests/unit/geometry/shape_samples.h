// Random shapes of every type, and their outlines for slow reference methods.
#pragma once
#include <deque>
#include <utility>
#include <vector>

#include "geometry/hull.h"
#include "geometry/shape.h"
#include "support/random_geometry.h"

namespace brickfall::test {

// Owns the hulls of the shapes it makes.
class ShapeSamples {
 public:
  explicit ShapeSamples(std::uint64_t seed) : random_(seed) {}
  Random& random() { return random_; }
  Shape make(ShapeType type);
  Shape makeHull(const std::vector<Vec3>& points);

 private:
  Random random_;
  std::deque<Hull> hulls_;
};

// The core's corners and edges in its own frame; the radius is apart.
struct Outline {
  std::vector<Vec3> corners;
  std::vector<std::pair<Vec3, Vec3>> edges;
  double radius = 0;
};
Outline outlineOf(const Shape& shape);

// Distance of two segments by trying all end points and the crossing of the lines.
double segmentDistance(Vec3 a, Vec3 b, Vec3 c, Vec3 d);

}  // namespace brickfall::test
