// One function per pair of types, each in its own file. `a` is the type named first; everything is in the frame of a.
// They fill `out` (count 0 on entry) or leave it. collide() orders the arguments. `loaded`: as there.
#pragma once
#include "geometry/shape.h"
#include "narrowphase/manifold.h"

namespace brickfall {

void collidePlaneSphere(const Shape& plane, const Shape& sphere, const Transform& bInA, double margin, Manifold& out);
void collidePlaneBox(const Shape& plane, const Shape& box, const Transform& bInA, double margin, Manifold& out);
void collidePlaneCapsule(const Shape& plane, const Shape& capsule, const Transform& bInA, double margin, Manifold& out);
void collidePlaneHull(const Shape& plane, const Shape& hull, const Transform& bInA, double margin,
                      const LoadedPoints& loaded, Manifold& out);
void collideSphereSphere(const Shape& a, const Shape& b, const Transform& bInA, double margin, Manifold& out);
void collideSphereBox(const Shape& sphere, const Shape& box, const Transform& bInA, double margin, Manifold& out);
void collideSphereCapsule(const Shape& sphere, const Shape& capsule, const Transform& bInA, double margin,
                          Manifold& out);
void collideSphereHull(const Shape& sphere, const Shape& hull, const Transform& bInA, double margin, Manifold& out);
void collideCapsuleCapsule(const Shape& a, const Shape& b, const Transform& bInA, double margin, Manifold& out);
// b: box or hull
void collideCapsuleHull(const Shape& capsule, const Shape& b, const Transform& bInA, double margin, Manifold& out);
void collideBoxBox(const Shape& a, const Shape& b, const Transform& bInA, double margin, const LoadedPoints& loaded,
                   Manifold& out);
// Each a box or a hull
void collideHullHull(const Shape& a, const Shape& b, const Transform& bInA, double margin, const LoadedPoints& loaded,
                     Manifold& out);
// Cylinders and cones. The last: a capsule, box, hull, cylinder or cone with one of the two.
void collidePlaneFrustum(const Shape& plane, const Shape& b, const Transform& bInA, double margin,
                         const LoadedPoints& loaded, Manifold& out);
void collideSphereFrustum(const Shape& sphere, const Shape& b, const Transform& bInA, double margin, Manifold& out);
void collideConvexFrustum(const Shape& a, const Shape& b, const Transform& bInA, double margin,
                          const LoadedPoints& loaded, Manifold& out);

}  // namespace brickfall
