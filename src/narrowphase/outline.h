// What a shape shows towards a direction, as contacts with cylinders and cones need it: a face, or a line, by its corners.
//
// A cap has no corners. Flush, or nearly, it shows as many fixed points of its rim as make a tilt limit right to half a
// percent: they are places of the body, stay where they are as it stands, and the ones that carry are kept. Tilted, as a coin
// that rolls, it shows the lowest point of the rim, wherever that is, and those across from it and beside it.
#pragma once
#include "geometry/shape.h"
#include "narrowphase/clipping.h"

namespace brickfall {

struct OutlineCorner {
  Vec3 p;
  std::uint32_t feature = 0;
};

struct Outline {
  static constexpr int kMost = kMaxPatchPoints;

  OutlineCorner corner[kMost];
  int count = 0;
  bool face = false;     // corners in a plane, counter-clockwise from outside; else a line or a point
  bool wanders = false;  // its points are no fixed places of the body
  Vec3 normal;           // of a face: unit, outwards
  double radius = 0;     // of the ball around a capsule's line

  void add(Vec3 p, std::uint32_t feature) { corner[count++] = {p, feature}; }
};

// The face or line that looks along `direction` (unit) most; capsules, boxes, hulls, cylinders and cones. `names`: what makes
// the features of one shape differ from those of another (cornerOfA(0), cornerOfB(0)).
Outline outlineOf(const Shape& shape, const Transform& pose, Vec3 direction, std::uint32_t names);
// The line of its surface that lies across `direction`: a line of a side, or an edge. Without corners if it has none.
Outline lineOf(const Shape& shape, const Transform& pose, Vec3 direction, std::uint32_t names);

// Cuts off what is beyond the sides of a face, seen along its normal. `slack`: as ContactTolerances has it.
void cutToFace(Outline& outline, const Outline& face, double slack);
// Cuts off what is beyond one side: outward . p > offset + slack.
void cutToSide(Outline& outline, Vec3 outward, double offset, double slack, std::uint32_t name);

}  // namespace brickfall
