// A slow answer to "do these two convex bodies meet?" that shares nothing with the engine: the point of their difference nearest to 0
// by Frank and Wolfe (1956), with a bound that proves it when they are apart.
#pragma once
#include <vector>

#include "brickfall/brickfall.h"

namespace brickfall::test {

// A shape at a place, drawn along `way`: what it sweeps over.
struct Convex {
  const ShapeDef* shape = nullptr;
  Transform at;
  Vec3 way;
};

// Its farthest point along `d`, which need not be unit.
inline Vec3 farthest(const Convex& convex, Vec3 d) {
  const ShapeDef& shape = *convex.shape;
  const Vec3 l = rotate(conjugate(convex.at.rotation), d);
  const double side = std::sqrt(l.x * l.x + l.z * l.z), up = l.y < 0 ? -1 : 1;
  const Vec3 out = side > 0 ? Vec3{l.x / side, 0, l.z / side} : Vec3{};
  Vec3 p;
  switch (shape.type) {
    case ShapeType::box:
      for (int k = 0; k < 3; k++) p[k] = l[k] < 0 ? -shape.halfExtents[k] : shape.halfExtents[k];
      break;
    case ShapeType::sphere:
      p = normalized(l) * shape.radius;
      break;
    case ShapeType::capsule:
      p = normalized(l) * shape.radius + Vec3{0, up * shape.halfHeight, 0};
      break;
    case ShapeType::cylinder:
      p = out * shape.radius + Vec3{0, up * shape.halfHeight, 0};
      break;
    case ShapeType::cone: {
      const Vec3 low = out * shape.radius - Vec3{0, shape.halfHeight, 0};
      const Vec3 high = out * shape.topRadius + Vec3{0, shape.halfHeight, 0};
      p = dot(low, l) > dot(high, l) ? low : high;
      break;
    }
    default:
      p = shape.vertices[0];
      for (const Vec3& vertex : shape.vertices)
        if (dot(vertex, l) > dot(p, l)) p = vertex;
  }
  return convex.at.position + rotate(convex.at.rotation, p) + (dot(convex.way, d) > 0 ? convex.way : Vec3{});
}

// m: the distance of the two lies between these. Both 0: they overlap for sure. Near to each other it may not find out.
struct Between {
  double least = 0, most = 0;
  bool apart(double by = 1e-6) const { return least > by; }
  bool overlap() const { return most == 0; }
};

// Unless `close` they need not lie close to each other where the two are apart.
inline Between between(const Convex& a, const Convex& b, bool close = false) {
  Vec3 v = a.at.position - b.at.position;
  Between found{0, length(v)};
  for (int i = 0; i < 300; i++) {
    if (found.most < 1e-7) return {0, 0};
    const Vec3 w = farthest(a, -v) - farthest(b, v);
    found.least = std::max(found.least, dot(v, w) / found.most);
    if (found.least > 1e-6 && (!close || found.most - found.least < 1e-3 * found.most)) break;
    const Vec3 step = w - v;
    const double along = lengthSquared(step);
    if (!(along > 0)) break;
    v = v + step * std::min(1.0, std::max(0.0, -dot(v, step) / along));
    found.most = length(v);
  }
  return found;
}

}  // namespace brickfall::test
