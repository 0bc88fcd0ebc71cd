// All shapes of a world. A shape keeps its slot for life, as a body does.
#pragma once
#include <functional>
#include <memory>
#include <vector>

#include "brickfall/shapes.h"
#include "dynamics/body_set.h"
#include "geometry/hull.h"
#include "geometry/shape.h"

namespace brickfall {

struct ShapeData {
  bool alive = false;
  std::uint16_t generation = 0;
  BodyIndex body = kNoIndex;
  ShapeDef def;  // as given
  Shape geometry;
  Transform inCentreFrame;     // pose in the frame of the body's centre of mass
  std::unique_ptr<Hull> hull;  // of hulls
  double innerRadius = 0;      // m
  Vec3 middle;                 // m, centroid in the frame of the body's centre of mass

  // Queries with this mask.
  bool answers(std::uint32_t mask) const { return (def.filter.category & mask) != 0 && !def.sensor; }
};

// What the program changed about two shapes for a part of a step.
struct PairEdit {
  ShapeIndex shapeA = 0, shapeB = 0;  // shapeA < shapeB
  float friction = 0, restitution = 0;
  bool enabled = true;  // false: they do not touch
};

class ShapeSet {
 public:
  ShapeIndex create();
  void destroy(ShapeIndex shape);
  bool alive(ShapeIndex shape) const { return shape < data.size() && data[shape].alive; }
  std::size_t slots() const { return data.size(); }
  const std::vector<ShapeIndex>& unused() const { return free_; }

  Transform worldPose(ShapeIndex shape, const BodySet& bodies) const {
    const ShapeData& s = data[shape];
    return bodies.pose(s.body) * s.inCentreFrame;
  }

  // Of two bodies: neither is a sensor, their filters allow it, and `asked` does.
  bool mayTouch(ShapeIndex a, ShapeIndex b) const;

  const PairEdit* editOf(ShapeIndex a, ShapeIndex b) const;  // null: none

  std::vector<ShapeData> data;
  std::vector<PairEdit> edits;                        // by shapes: of this part of the step
  std::function<bool(ShapeIndex, ShapeIndex)> asked;  // the program's own filter, lower slot first; empty: none

 private:
  friend class SnapshotArchive;
  std::vector<ShapeIndex> free_;
};

// Combined values of two touching materials.
double mixFriction(const Material& a, const Material& b);
double mixRestitution(const Material& a, const Material& b);
// m: of a body that rolls on something flat, its radius; where two round ones roll on each other, as their curvatures add
// up. 0 if neither is round.
double rollingRadius(const ShapeDef& a, const ShapeDef& b);
bool filtersAllow(const CollisionFilter& a, const CollisionFilter& b);

}  // namespace brickfall
