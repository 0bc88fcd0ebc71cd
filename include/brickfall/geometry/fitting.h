// Boxes and spheres around points and meshes. Points of either precision; all is computed in double. What comes back
// contains every point (to rounding), whatever the method and however degenerate the points are: one point, many equal
// ones, a line, a plane.
#pragma once
#include <cstdint>
#include <span>

#include "brickfall/geometry/obb.h"

namespace brickfall {

// How the axes of an oriented box are found; the extents along them are always as small as can be.
enum class ObbFit : std::uint8_t {
  // Eigenvectors of the covariance of the points, as in the report's source. Depends on how densely a region is sampled, and
  // on points inside.
  pointCovariance,
  // Of the surface of the triangles given (Gottschalk 1996): density no longer counts, inner surfaces still do. Meshes only;
  // for points the same as hullCovariance.
  surfaceCovariance,
  // Of the surface of the convex hull, Gottschalk's correction: only the outside counts. Good, and the one to build trees on.
  hullCovariance,
  // The smallest volume that is found from several starts (the coordinate axes, both covariances, the largest hull faces) by
  // turning about each axis in turn to the smallest rectangle around the projection. Some hundred times the cost; not
  // proven to be the least, never larger than the others.
  smallest,
};

// Errors: no point, a coordinate that is not finite or above 1e100, a triangle index out of range.
template <class T> Result<ObbT<T>> fitObb(std::span<const Vec3T<T>> points, ObbFit method = ObbFit::hullCovariance);
// Three indices a triangle; points that no triangle uses are left out.
template <class T>
Result<ObbT<T>> fitObb(std::span<const Vec3T<T>> points, std::span<const std::uint32_t> triangles,
                       ObbFit method = ObbFit::hullCovariance);

template <class T> Result<Aabb> fitAabb(std::span<const Vec3T<T>> points);

template <class T> struct SphereT {
  Vec3T<T> centre;
  T radius = 0;  // m
};
using Sphere = SphereT<double>;
using SphereF = SphereT<float>;
// The smallest sphere around the points: exact to rounding (about 1e-12 of the radius; float 1e-7), by exchanging the
// points it rests on, as the simplex method does.
template <class T> Result<SphereT<T>> fitSphere(std::span<const Vec3T<T>> points);

}  // namespace brickfall
