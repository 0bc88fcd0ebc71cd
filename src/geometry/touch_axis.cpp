// Apart, the nearest points say it (distance.cpp). Overlapping or almost touching, it is a search over directions: the best
// of those that sharp-edged shapes would have, then uphill. One step uphill moves b along the direction until it just
// stands clear: the nearest points of shapes so moved show a direction that is better, or none is.
#include "geometry/touch_axis.h"

#include <cmath>

#include "geometry/core.h"
#include "geometry/queries.h"

namespace brickfall {

namespace {

constexpr double kClear = 1e-3;  // of the smaller inner radius: how far apart directions are told from nearest points
constexpr double kFaceFirst = 1e-4;  // of the smaller inner radius: by which another direction must beat a face's
constexpr double kUphill = 1e-10;    // share of the clearance that is no progress
constexpr int kMostUphill = 40;

Shape withoutRadius(Shape shape) {
  if (isRound(shape.type)) shape.radius = 0;
  return shape;
}

class AxisSearch {
 public:
  AxisSearch(const Shape& a, const Shape& b, const Transform& bInA)
      : a_(withoutRadius(a)), b_(withoutRadius(b)), pose_(bInA), turn_(toMatrix(bInA.rotation)) {
    double inner = 1e30;
    for (const Shape* shape : {&a, &b})  // triangles and points have none
      if (const double own = innerRadius(*shape); own > 0) inner = std::fmin(inner, own);
    clear_ = kClear * inner, faceFirst_ = kFaceFirst * inner, size_ = coreSize(a_) + coreSize(b_);
  }

  double clear() const { return clear_; }
  DistanceResult distance() const { return shapeDistance(a_, b_, pose_); }

  // The directions of faces, then all others, which must be better by a little: a face shows more points.
  Vec3 best() {
    offerFaces(a_, {}, 1), offerFaces(b_, turn_, -1);
    found_ += faceFirst_;
    if (lengthSquared(pose_.position) > 0) offer(normalized(pose_.position));
    offerSides(a_, {}, b_, pose_, 1), offerSides(b_, pose_, a_, {}, -1);
    return best_;
  }

  // Separation of the cores along a direction.
  double along(Vec3 n) const {
    return dot(n, turn_ * coreSupport(b_, transposeTimes(turn_, -n)) + pose_.position) - dot(n, coreSupport(a_, n));
  }

  TouchAxis climb(Vec3 n) const {
    TouchAxis out{n, along(n), {}, {}};
    for (int step = 0; step < kMostUphill; step++) {
      const Vec3 shift = out.normal * (clear_ - out.separation);
      const DistanceResult now = shapeDistance(a_, b_, {pose_.position + shift, pose_.rotation});
      out.onA = now.onA, out.onB = now.onB - shift;
      if (!(now.distance > clear_ + kUphill * clear_ + 1e-14 * size_)) break;
      const Vec3 next = normalized(now.onB - now.onA);
      const double found = along(next);
      if (!(found > out.separation)) break;
      out.normal = next, out.separation = found;
    }
    return out;
  }

 private:
  void offer(Vec3 n) {
    const double found = along(n);
    if (found > found_) found_ = found, best_ = n;
  }

  void offerFaces(const Shape& shape, const Mat3& turn, double sign) {
    if (shape.type == ShapeType::box) {
      for (int k = 0; k < 6; k++) {
        Vec3 n;
        n[k / 2] = k & 1 ? sign : -sign;
        offer(turn * n);
      }
    } else if (shape.type == ShapeType::hull) {
      for (const HullPlane& plane : shape.hull->planes) offer(turn * plane.normal * sign);
    } else if (isFrustum(shape.type)) {
      offer(turn * Vec3{0, sign, 0}), offer(turn * Vec3{0, -sign, 0});
    }
  }

  // Normals of the side of `round` that look at a corner of the other, or lie across one of its edges.
  void offerSides(const Shape& round, const Transform& pose, const Shape& other, const Transform& otherPose,
                  double sign) {
    if (!isFrustum(round.type)) return;
    double out, up;
    frustumOf(round).sideNormal(out, up);
    const Mat3 turn = toMatrix(pose.rotation), otherTurn = toMatrix(otherPose.rotation);
    const Vec3 axis = turn.column(1), base = axis * (up * sign);
    auto towards = [&](Vec3 point) {
      Vec3 across = otherTurn * point + otherPose.position - pose.position;
      across -= axis * dot(axis, across);
      if (lengthSquared(across) > 0) offer(base + normalized(across) * (out * sign));
    };
    auto over = [&](Vec3 edge) {
      const Vec3 e = otherTurn * edge;
      const double lies = dot(axis, e);
      Vec3 across = e - axis * lies;
      const double width = length(across);
      if (!(width > 1e-9 * length(e))) return;
      across *= 1 / width;
      const double x = -up * lies / (out * width), left = 1 - x * x;
      if (!(left >= 0)) return;
      const Vec3 beside = cross(axis, across) * std::sqrt(left);
      offer(base + (across * x + beside) * (out * sign)), offer(base + (across * x - beside) * (out * sign));
    };
    towards({});
    if (other.type == ShapeType::box) {
      const Vec3 h = other.halfExtents;
      for (int k = 0; k < 8; k++) towards({k & 1 ? h.x : -h.x, k & 2 ? h.y : -h.y, k & 4 ? h.z : -h.z});
      over({1, 0, 0}), over({0, 1, 0}), over({0, 0, 1});
    } else if (other.type == ShapeType::hull) {
      const Hull& hull = *other.hull;
      for (Vec3 v : hull.vertices) towards(v);
      for (std::size_t e = 0; e < hull.edges.size(); e += 2)
        over(hull.vertices[hull.edges[e + 1].origin] - hull.vertices[hull.edges[e].origin]);
    } else if (other.type != ShapeType::sphere) {
      towards({0, other.halfHeight, 0}), towards({0, -other.halfHeight, 0});
      over({0, 1, 0});
    }
  }

  Shape a_, b_;
  Transform pose_;
  Mat3 turn_;
  double clear_ = 0, faceFirst_ = 0, size_ = 0;
  Vec3 best_{0, 1, 0};
  double found_ = -1e300;
};

}  // namespace

std::optional<TouchAxis> findTouchAxis(const Shape& a, const Shape& b, const Transform& bInA, double margin) {
  AxisSearch search(a, b, bInA);
  const double radiusA = coreRadius(a), radiusB = coreRadius(b);
  const DistanceResult apart = search.distance();
  if (apart.distance - radiusA - radiusB > margin) return {};
  TouchAxis axis;
  if (apart.distance > search.clear()) {
    axis = {normalized(apart.onB - apart.onA), apart.distance, apart.onA, apart.onB};
  } else {
    axis = search.climb(search.best());
  }
  axis.separation -= radiusA + radiusB;
  axis.onA += axis.normal * radiusA;
  axis.onB = axis.onA + axis.normal * axis.separation;
  return axis;
}

}  // namespace brickfall
