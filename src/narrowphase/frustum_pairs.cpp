// Cylinders and cones. With a plane and with spheres in closed form. With all other shapes the axis of touch
// (geometry/touch_axis.h) decides: where a face lies across it, what the other shows is cut to that face; where two lines lie
// side by side, the ends of their common stretch are the points; else there is one point, where the shapes are nearest.
#include <algorithm>

#include "geometry/frustum.h"
#include "geometry/touch_axis.h"
#include "narrowphase/features.h"
#include "narrowphase/outline.h"
#include "narrowphase/pairs.h"

namespace brickfall {

namespace {

constexpr double kFlushFace = 0.998;  // cosine of 3.6 degrees: a face lies across the axis
constexpr double kEquallyFlush = 1e-8;
constexpr double kLeastStretch = 0.1;   // of the smaller inner radius: lines that share less touch in a point
constexpr double kMostSideways = 0.05;  // of the smaller inner radius: by which lines part over their common stretch
constexpr double kFair = 0.005;         // of the smaller inner radius: what a common normal may be off in depth

struct FrustumPair {
  const Shape &a, &b;
  const Transform& bInA;
  double margin, smaller;
  const LoadedPoints& loaded;
  TouchAxis axis{};

  bool isFair(double least) const { return std::fabs(least - axis.separation) <= kFair * smaller; }

  // What one shows over a face of the other. False: it says something else than the axis.
  bool faceContact(const Outline& flush, bool refIsA, Manifold& out) const {
    const Outline ref =
        refIsA ? outlineOf(a, {}, flush.normal, cornerOfA(0)) : outlineOf(b, bInA, flush.normal, cornerOfB(0));
    const Vec3 normal = ref.normal;
    Outline over = refIsA ? outlineOf(b, bInA, -normal, cornerOfB(0)) : outlineOf(a, {}, -normal, cornerOfA(0));
    const ContactTolerances tolerances = contactTolerances(smaller);
    cutToFace(over, ref, tolerances.slack);
    const Vec3 origin = ref.corner[0].p, u = normalized(ref.corner[1].p - origin), v = cross(normal, u);
    PatchPoint patch[kMaxPatchPoints];
    int count = 0;
    double least = 1e30;
    for (int i = 0; i < over.count; i++) {
      const Vec3 p = over.corner[i].p - origin;
      const double separation = dot(normal, p) - over.radius;
      least = std::min(least, separation);
      if (separation <= margin) patch[count++] = {dot(u, p), dot(v, p), separation, over.corner[i].feature};
    }
    if (count == 0 || !isFair(least)) return false;
    const ReducedPatch reduced = reducePatch(patch, count, tolerances, loaded);
    out.normal = refIsA ? normal : -normal;
    out.count = reduced.count;
    out.partial = reduced.partial;
    out.rolls = over.wanders;
    for (int i = 0; i < out.count; i++) {
      const Vec3 onRef = origin + u * patch[i].u + v * patch[i].v, onOther = onRef + normal * patch[i].separation;
      out.points[i] = {refIsA ? onRef : onOther, refIsA ? onOther : onRef, patch[i].separation, patch[i].feature};
    }
    return true;
  }

  // Two lines side by side.
  bool lineContact(Manifold& out) const {
    const Outline one = lineOf(a, {}, axis.normal, cornerOfA(0)), other = lineOf(b, bInA, -axis.normal, cornerOfB(0));
    if (one.count < 2 || other.count < 2) return false;
    const Vec3 p = one.corner[0].p, along = one.corner[1].p - p, q = other.corner[0].p, beside = other.corner[1].p - q;
    const double squared = lengthSquared(along), pace = dot(along, beside) / squared,
                 start = dot(along, q - p) / squared;
    const double from = std::max(0.0, std::min(start, start + pace)), to = std::min(1.0, std::max(start, start + pace));
    const double stretch = (to - from) * std::sqrt(squared);
    const double sine = length(cross(along, beside)) / std::sqrt(squared * lengthSquared(beside));
    if (!(stretch > kLeastStretch * smaller && stretch * sine < kMostSideways * smaller)) return false;
    const double radii = one.radius + other.radius;
    double least = 1e30;
    out.count = 0;
    for (int end = 0; end < 2; end++) {
      const double t = end == 0 ? from : to;
      const Vec3 onOne = p + along * t, onOther = q + beside * ((t - start) / pace);
      const double separation = dot(axis.normal, onOther - onOne) - radii;
      least = std::min(least, separation);
      const Vec3 onA = onOne + axis.normal * one.radius;
      if (separation <= margin)
        out.points[out.count++] = {onA, onA + axis.normal * separation, separation, roundPoint(end)};
    }
    out.normal = axis.normal;
    out.rolls = true;
    return out.count > 0 && isFair(least);
  }
};

}  // namespace

void collidePlaneFrustum(const Shape&, const Shape& shape, const Transform& bInA, double margin,
                         const LoadedPoints& loaded, Manifold& out) {
  const Outline shown = outlineOf(shape, bInA, {0, -1, 0}, cornerOfB(0));
  PatchPoint patch[kMaxPatchPoints];
  int count = 0;
  for (int i = 0; i < shown.count; i++) {
    const Vec3 p = shown.corner[i].p;
    if (p.y <= margin) patch[count++] = {p.x, p.z, p.y, shown.corner[i].feature};
  }
  if (count == 0) return;
  const ReducedPatch reduced = reducePatch(patch, count, contactTolerances(innerRadius(shape)), loaded);
  out.normal = {0, 1, 0};
  out.count = reduced.count;
  out.partial = reduced.partial;
  out.rolls = shown.wanders;
  for (int i = 0; i < out.count; i++) {
    const PatchPoint& p = patch[i];
    out.points[i] = {{p.u, 0, p.v}, {p.u, p.separation, p.v}, p.separation, p.feature};
  }
}

void collideSphereFrustum(const Shape& sphere, const Shape& shape, const Transform& bInA, double margin,
                          Manifold& out) {
  const Mat3 turn = toMatrix(bInA.rotation);
  const FrustumFoot foot = footOn(frustumOf(shape), transposeTimes(turn, -bInA.position));
  const double separation = foot.distance - sphere.radius;
  if (!(separation <= margin)) return;
  out.normal = -(turn * foot.normal);
  out.count = 1;
  const Vec3 onA = out.normal * sphere.radius;
  out.points[0] = {onA, onA + out.normal * separation, separation, roundPoint(0)};
}

void collideConvexFrustum(const Shape& a, const Shape& b, const Transform& bInA, double margin,
                          const LoadedPoints& loaded, Manifold& out) {
  const std::optional<TouchAxis> axis = findTouchAxis(a, b, bInA, margin);
  if (!axis) return;
  const FrustumPair pair{a, b, bInA, margin, std::min(innerRadius(a), innerRadius(b)), loaded, *axis};
  const Outline fromA = outlineOf(a, {}, axis->normal, cornerOfA(0)),
                fromB = outlineOf(b, bInA, -axis->normal, cornerOfB(0));
  const double flushA = fromA.face ? dot(fromA.normal, axis->normal) : -1,
               flushB = fromB.face ? -dot(fromB.normal, axis->normal) : -1;
  const bool refIsA = flushA >= flushB - kEquallyFlush;
  if (std::max(flushA, flushB) > kFlushFace && pair.faceContact(refIsA ? fromA : fromB, refIsA, out)) return;
  if (pair.lineContact(out)) return;
  out.normal = axis->normal;
  out.count = 1;
  out.partial = false;
  out.rolls = true;
  out.points[0] = {axis->onA, axis->onB, axis->separation, roundPoint(2)};
}

}  // namespace brickfall
