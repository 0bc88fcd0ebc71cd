// Axes from one of the methods, then extents along them measured on the points as they were given.
#include "brickfall/geometry/fitting.h"

#include <limits>
#include <string>

#include "geometry/fitting_points.h"

namespace brickfall {

namespace {

constexpr double kLargest = 1e100;  // squares stay finite
constexpr double kSmallest = 1e-100;

template <class T> Vec3 exact(Vec3T<T> v) { return {double(v.x), double(v.y), double(v.z)}; }

template <class T> Status checkPoints(std::span<const Vec3T<T>> points) {
  if (points.empty()) return Error{ErrorCode::invalidArgument, "points: found none, expected at least one"};
  for (std::size_t k = 0; k < points.size(); k++) {
    Vec3 p = abs(exact(points[k]));
    if (!(p.x <= kLargest && p.y <= kLargest && p.z <= kLargest)) {
      return Error{
          ErrorCode::invalidArgument,
          "points[" + std::to_string(k) + "]: found a coordinate that is not finite or above 1e100, expected less"};
    }
  }
  return {};
}

template <class T> Aabb boundsOf(std::span<const Vec3T<T>> points) {
  Aabb box{exact(points[0]), exact(points[0])};
  for (const Vec3T<T>& p : points) box.lower = min(box.lower, exact(p)), box.upper = max(box.upper, exact(p));
  return box;
}

template <class T> FitPoints scaledPoints(std::span<const Vec3T<T>> points) {
  FitPoints out;
  Aabb box = boundsOf(points);
  Vec3 extent = box.upper - box.lower;
  out.middle = box.lower + extent * 0.5;
  for (int k = 0; k < 3; k++) out.size = extent[k] > out.size ? extent[k] : out.size;
  if (!(out.size > kSmallest)) out.size = 0;
  const double scale = out.size > 0 ? 1 / out.size : 0;
  out.points.reserve(points.size());
  for (const Vec3T<T>& p : points) out.points.push_back((exact(p) - out.middle) * scale);
  return out;
}

// Extents that hold every point, seen from the box as it is stored, and rounded upwards. Not inlined: g++ 12.2 at -O2, when it
// sees double -> float -> double in one function, vectorises the rounding away and leaves points outside by 1e-8.
template <class T> [[gnu::noinline]] void setExtents(ObbT<T>& box, std::span<const Vec3T<T>> points) {
  const Mat3 axes{{exact(box.axes.row[0]), exact(box.axes.row[1]), exact(box.axes.row[2])}};
  const Vec3 centre = exact(box.centre);
  Vec3 half;
  for (const Vec3T<T>& p : points) half = max(half, abs(axes * (exact(p) - centre)));
  const T upwards = 1 + 2 * std::numeric_limits<T>::epsilon();
  box.halfExtents = {T(half.x) * upwards, T(half.y) * upwards, T(half.z) * upwards};
}
template <class T> [[gnu::noinline]] void setRadius(SphereT<T>& sphere, std::span<const Vec3T<T>> points) {
  const Vec3 centre = exact(sphere.centre);
  double radius = 0;
  for (const Vec3T<T>& p : points) {
    double distance = length(exact(p) - centre);
    if (distance > radius) radius = distance;
  }
  sphere.radius = T(radius) * (1 + 2 * std::numeric_limits<T>::epsilon());
}

// The box along these axes.
template <class T> ObbT<T> boxAlong(const Mat3& axes, std::span<const Vec3T<T>> points) {
  const Vec3 origin = exact(points[0]);
  Vec3 low, high;
  for (const Vec3T<T>& p : points) {
    Vec3 local = axes * (exact(p) - origin);
    low = min(low, local), high = max(high, local);
  }
  const Vec3 centre = origin + transposeTimes(axes, (low + high) * 0.5);
  ObbT<T> box;
  box.centre = {T(centre.x), T(centre.y), T(centre.z)};
  for (int k = 0; k < 3; k++) box.axes.row[k] = {T(axes.row[k].x), T(axes.row[k].y), T(axes.row[k].z)};
  setExtents(box, points);
  return box;
}

// Where a direction of the spread is not determined (a line, a point), any axes across it will do.
Mat3 axesOf(const FitHull& hull, const Mat3& covariance) {
  if (hull.dimensions == 0) return {};
  if (hull.dimensions == 1) {
    Vec3 d = hull.direction;
    return principalAxes({{d * d.x, d * d.y, d * d.z}});
  }
  return principalAxes(covariance);
}

struct Input {
  FitPoints points;
  std::span<const std::uint32_t> triangles;
};

Mat3 fitAxes(const Input& in, ObbFit method) {
  if (!(in.points.size > 0)) return {};
  std::span<const Vec3> points = in.points.points;
  if (method == ObbFit::pointCovariance) return principalAxes(pointCovariance(points));
  FitHull hull = fitHull(points);
  bool ofHull = method != ObbFit::surfaceCovariance || in.triangles.empty();
  Mat3 outside = axesOf(hull, surfaceCovariance(hull.corners, hull.triangles));
  if (!ofHull) return axesOf(hull, surfaceCovariance(points, in.triangles));
  if (method != ObbFit::smallest || hull.dimensions < 2) return outside;
  const Mat3 starts[] = {outside, principalAxes(pointCovariance(points)), Mat3{},
                         in.triangles.empty() ? outside : axesOf(hull, surfaceCovariance(points, in.triangles))};
  return smallestBoxAxes(hull, starts);
}

}  // namespace

template <class T> Result<ObbT<T>> fitObb(std::span<const Vec3T<T>> points, ObbFit method) {
  return fitObb(points, std::span<const std::uint32_t>{}, method);
}

template <class T>
Result<ObbT<T>> fitObb(std::span<const Vec3T<T>> points, std::span<const std::uint32_t> triangles, ObbFit method) {
  if (triangles.empty()) {
    if (Status good = checkPoints(points); !good) return good.error();
    return boxAlong(fitAxes({scaledPoints(points), {}}, method), points);
  }
  if (triangles.size() % 3 != 0) {
    return Error{ErrorCode::invalidArgument,
                 "triangles: found " + std::to_string(triangles.size()) + " indices, expected three a triangle"};
  }
  std::vector<std::uint32_t> place(points.size(), 0xffffffffu), renumbered;
  std::vector<Vec3T<T>> used;
  for (std::uint32_t index : triangles) {
    if (!(index < points.size())) {
      return Error{ErrorCode::invalidArgument, "triangles: found index " + std::to_string(index) +
                                                   ", expected less than " + std::to_string(points.size())};
    }
    if (place[index] == 0xffffffffu) {
      place[index] = std::uint32_t(used.size());
      used.push_back(points[index]);
    }
    renumbered.push_back(place[index]);
  }
  std::span<const Vec3T<T>> kept = used;
  if (Status good = checkPoints(kept); !good) return good.error();
  return boxAlong(fitAxes({scaledPoints(kept), renumbered}, method), kept);
}

template <class T> Result<Aabb> fitAabb(std::span<const Vec3T<T>> points) {
  if (Status good = checkPoints(points); !good) return good.error();
  return boundsOf(points);
}

namespace {

// The smallest ball through up to four points, its centre in the space they span; nothing if they do not determine one.
struct Ball {
  Vec3 centre;
  double squared = -1;
};

Ball ballThrough(const Vec3* points, int count) {
  Vec3 origin = points[0];
  if (count == 1) return {origin, 0};
  Vec3 u = points[1] - origin;
  if (count == 2) return {origin + u * 0.5, lengthSquared(u) * 0.25};
  Vec3 v = points[2] - origin, normal = cross(u, v);
  double area = lengthSquared(normal), uu = lengthSquared(u), vv = lengthSquared(v);
  if (!(area > 1e-24 * uu * vv)) return {};
  // From the first corner; lies in the plane of the triangle.
  Vec3 inPlane = (cross(v, normal) * uu + cross(normal, u) * vv) * (0.5 / area);
  if (count == 3) return {origin + inPlane, lengthSquared(inPlane)};
  Vec3 w = points[3] - origin;
  double height = dot(normal, w);
  if (!(height * height > 1e-24 * area * lengthSquared(w))) return {};
  Vec3 centre = inPlane + normal * ((0.5 * lengthSquared(w) - dot(w, inPlane)) / height);
  return {origin + centre, lengthSquared(centre)};
}

// Smallest ball around at most five points, by trying all subsets it could rest on; `support` becomes that subset.
Ball ballAround(Vec3* support, int& count) {
  Ball best;
  Vec3 kept[4];
  int keptCount = 0;
  for (int subset = 1; subset < 1 << count; subset++) {
    Vec3 chosen[5];
    int size = 0;
    for (int k = 0; k < count; k++) {
      if (subset >> k & 1) chosen[size++] = support[k];
    }
    if (size > 4) continue;
    Ball ball = ballThrough(chosen, size);
    if (ball.squared < 0 || (best.squared >= 0 && !(ball.squared < best.squared))) continue;
    bool around = true;
    for (int k = 0; k < count && around; k++) {
      around = lengthSquared(support[k] - ball.centre) <= ball.squared * (1 + 1e-12) + 1e-30;
    }
    if (!around) continue;
    best = ball;
    keptCount = size;
    for (int k = 0; k < size; k++) kept[k] = chosen[k];
  }
  if (best.squared < 0) return best;
  count = keptCount;
  for (int k = 0; k < count; k++) support[k] = kept[k];
  return best;
}

// Adds the point furthest outside to what the ball rests on until none is outside. The ball grows each time, so no subset
// comes twice; rounding can end it early, by some 1e-12 of the radius.
Vec3 smallestBallCentre(std::span<const Vec3> points) {
  Vec3 support[5] = {points[0]};
  int count = 1;
  Ball ball{points[0], 0};
  for (int round = 0; round < 1000; round++) {
    std::size_t furthest = 0;
    double most = -1;
    for (std::size_t k = 0; k < points.size(); k++) {
      double squared = lengthSquared(points[k] - ball.centre);
      if (squared > most) most = squared, furthest = k;
    }
    if (!(most > ball.squared * (1 + 1e-13) + 1e-30)) break;
    support[count++] = points[furthest];
    Ball next = ballAround(support, count);
    if (!(next.squared > ball.squared)) break;
    ball = next;
  }
  return ball.centre;
}

}  // namespace

template <class T> Result<SphereT<T>> fitSphere(std::span<const Vec3T<T>> points) {
  if (Status good = checkPoints(points); !good) return good.error();
  FitPoints scaled = scaledPoints(points);
  Vec3 centre = scaled.middle;
  if (scaled.size > 0) centre += smallestBallCentre(scaled.points) * scaled.size;
  SphereT<T> out;
  out.centre = {T(centre.x), T(centre.y), T(centre.z)};
  setRadius(out, points);
  return out;
}

#define BRICKFALL_FITTING(T)                                                                          \
  template Result<ObbT<T>> fitObb(std::span<const Vec3T<T>>, ObbFit);                                 \
  template Result<ObbT<T>> fitObb(std::span<const Vec3T<T>>, std::span<const std::uint32_t>, ObbFit); \
  template Result<Aabb> fitAabb(std::span<const Vec3T<T>>);                                           \
  template Result<SphereT<T>> fitSphere(std::span<const Vec3T<T>>);
BRICKFALL_FITTING(float)
BRICKFALL_FITTING(double)
#undef BRICKFALL_FITTING

}  // namespace brickfall
