#include "ccd_verdict.h"

#include <ccd/ccd.h>

#include "geometry/hull.h"

namespace brickfall::oracle {

namespace {

struct Placed {
  const Shape& shape;
  Transform pose;
};

Vec3 support(const Shape& s, Vec3 d) {
  if (s.type == ShapeType::box)
    return {d.x < 0 ? -s.halfExtents.x : s.halfExtents.x, d.y < 0 ? -s.halfExtents.y : s.halfExtents.y,
            d.z < 0 ? -s.halfExtents.z : s.halfExtents.z};
  if (s.type == ShapeType::hull) {
    Vec3 best = s.hull->vertices[0];
    for (Vec3 v : s.hull->vertices)
      if (dot(v, d) > dot(best, d)) best = v;
    return best;
  }
  Vec3 out = normalized(d) * s.radius;
  if (s.type == ShapeType::capsule) out.y += d.y < 0 ? -s.halfHeight : s.halfHeight;
  return out;
}

void supportOf(const void* object, const ccd_vec3_t* direction, ccd_vec3_t* out) {
  const Placed& placed = *static_cast<const Placed*>(object);
  Vec3 d = rotate(conjugate(placed.pose.rotation), Vec3{direction->v[0], direction->v[1], direction->v[2]});
  Vec3 p = transformPoint(placed.pose, support(placed.shape, d));
  ccdVec3Set(out, p.x, p.y, p.z);
}

}  // namespace

bool ccdOverlap(const Shape& a, const Shape& b, const Transform& bInA) {
  ccd_t ccd;
  CCD_INIT(&ccd);
  ccd.support1 = ccd.support2 = supportOf;
  ccd.max_iterations = 500;
  Placed placedA{a, {}}, placedB{b, bInA};
  return ccdGJKIntersect(&placedA, &placedB, &ccd) != 0;
}

}  // namespace brickfall::oracle
