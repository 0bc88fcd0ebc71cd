// Random pairs of shapes by the kinds of contact that go wrong in different ways.
#pragma once
#include <deque>
#include <vector>

#include "geometry/hull.h"
#include "solid.h"
#include "support/random_geometry.h"

namespace brickfall::oracle {

enum class Family {
  generic,       // any pose near touching
  nearParallel,  // faces or axes within 1e-9 .. 1e-2 rad of parallel
  flush,         // faces or axes exactly parallel
  edgeEdge,      // two edges cross
  cornerFace,    // a corner or cap points at a face
  touching,      // within 1e-9 of the size
  deep,          // centres close
  apart,         // further than the margin
  sizeRatio,     // one 100 to 10,000 times the other
  speculative,   // a margin as large as the shapes
};
constexpr int kFamilies = 10;
const char* nameOf(Family family);

struct Pair {
  Shape a, b;
  Transform bInA;
  double margin = 0;
  double size = 0;      // extent of the larger, m; of the other shape if one is a plane
  double smallest = 0;  // least inner radius: what the engine's tolerances scale with, m
};

// Two types, any order, not both planes. Keeps the hulls of the pairs it makes.
class PairSource {
 public:
  PairSource(ShapeType first, ShapeType second, std::uint64_t seed);
  bool has(Family family) const;
  Pair next(Family family);

 private:
  struct Feature {
    Vec3 point, outward, along;  // on the surface; unit out of it; unit in the surface
  };
  Shape shapeOf(ShapeType type, double scale);
  const Hull* hullOf(double scale);
  Feature face(const Shape& shape);
  Feature edge(const Shape& shape);
  Feature corner(const Shape& shape);
  Vec3 inside(const Shape& shape);
  void join(Pair& pair, const Feature& ofA, const Feature& ofB, double angle);
  void scales(Family family, double& first, double& second);

  ShapeType first_, second_;
  Random random_;
  std::deque<Hull> hulls_;
  std::vector<const Hull*> small_, middle_, large_;
};

// Moves b along the axis of least overlap (or of the distance) until the two are `target` apart.
void setSeparation(Pair& pair, double target);

}  // namespace brickfall::oracle
