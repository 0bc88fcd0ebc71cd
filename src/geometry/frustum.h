// Cylinders and cones as one: the solid between two circles about its own y, of which one may be a point.
#pragma once
#include "geometry/shape.h"

namespace brickfall {

struct Frustum {
  double low = 0, high = 0, half = 0;  // m: radii at y = -half and y = half

  double radius(int end) const { return end == 0 ? low : high; }
  double height(int end) const { return end == 0 ? -half : half; }
  double radiusAt(double y) const { return 0.5 * (low + high) + 0.5 * (high - low) * (y / half); }
  // Normal of the side, in the plane through the axis: outwards and up.
  void sideNormal(double& out, double& up) const;
  // The point furthest along a direction; of a cap that looks along it its middle, of a side the lower end.
  Vec3 furthest(Vec3 direction) const;
  // Height of the centre of mass above y = 0.
  double centre() const;
};

inline bool isFrustum(ShapeType type) { return type == ShapeType::cylinder || type == ShapeType::cone; }

// Of a cylinder or cone.
inline Frustum frustumOf(const Shape& shape) {
  return {shape.radius, shape.type == ShapeType::cone ? shape.topRadius : shape.radius, shape.halfHeight};
}

// The point of the border nearest to one inside, and of the solid nearest to one outside, with the normal between them.
struct FrustumFoot {
  Vec3 point, normal;   // normal: unit, outwards
  double distance = 0;  // of the point asked for, m; negative inside
};
FrustumFoot footOn(const Frustum& frustum, Vec3 point);

}  // namespace brickfall
