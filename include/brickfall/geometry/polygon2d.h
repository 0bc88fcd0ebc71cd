// The separating axis test in the plane, where it is easiest to see: the report's Algorithm 1. Two convex shapes are apart
// if and only if some line has one on each side, and for polygons it is enough to try lines along their edges. So: for each
// edge direction take the axis across it, project both shapes on it, and stop at the first axis on which the projections do
// not meet. obb.h is the same in space, with the crossed edges as further axes.
#pragma once
#include <cmath>
#include <limits>
#include <span>
#include <string>
#include <vector>

#include "brickfall/result.h"

namespace brickfall {

template <class T> struct Vec2T {
  T x = 0, y = 0;
  bool operator==(const Vec2T&) const = default;
};
using Vec2 = Vec2T<double>;
using Vec2F = Vec2T<float>;
template <class T> inline Vec2T<T> operator+(Vec2T<T> a, Vec2T<T> b) { return {a.x + b.x, a.y + b.y}; }
template <class T> inline Vec2T<T> operator-(Vec2T<T> a, Vec2T<T> b) { return {a.x - b.x, a.y - b.y}; }
template <class T> inline Vec2T<T> operator*(Vec2T<T> a, T s) { return {a.x * s, a.y * s}; }
template <class T> inline T dot(Vec2T<T> a, Vec2T<T> b) { return a.x * b.x + a.y * b.y; }
// > 0 if b is to the left of a.
template <class T> inline T cross(Vec2T<T> a, Vec2T<T> b) { return a.x * b.y - a.y * b.x; }
template <class T> inline T length(Vec2T<T> a) { return std::sqrt(dot(a, a)); }

// A rectangle turned in the plane.
template <class T> struct RectangleT {
  Vec2T<T> centre;
  Vec2T<T> axis{1, 0};                 // unit; the second axis is this one turned to the left
  Vec2T<T> halfExtents{T(.5), T(.5)};  // m, > 0
};
using Rectangle = RectangleT<double>;
using RectangleF = RectangleT<float>;

// Corners counter-clockwise.
template <class T> inline std::vector<Vec2T<T>> corners(const RectangleT<T>& r) {
  Vec2T<T> u = r.axis * r.halfExtents.x, v = Vec2T<T>{-r.axis.y, r.axis.x} * r.halfExtents.y;
  return {r.centre - u - v, r.centre + u - v, r.centre + u + v, r.centre - u + v};
}

// Convex polygons are lists of at least three corners, counter-clockwise; corners within an edge are allowed, equal
// neighbours are not.
template <class T> inline Status checkPolygon(std::span<const Vec2T<T>> polygon, const char* name = "polygon") {
  auto bad = [&](const std::string& what) {
    return Error{ErrorCode::invalidArgument, std::string(name) + ": " + what};
  };
  const std::size_t n = polygon.size();
  if (n < 3) return bad("found " + std::to_string(n) + " corners, expected at least 3");
  T turns = 0;
  for (std::size_t k = 0; k < n; k++) {
    Vec2T<T> a = polygon[k], b = polygon[(k + 1) % n], c = polygon[(k + 2) % n];
    if (!(std::isfinite(a.x) && std::isfinite(a.y))) return bad("corner " + std::to_string(k) + " is not finite");
    if (!(length(b - a) > 0)) return bad("corner " + std::to_string(k) + " equals the next, expected different ones");
    // Rounding of corners within an edge is allowed for.
    T slack = 16 * std::numeric_limits<T>::epsilon() * length(b - a) * length(c - b);
    if (!(cross(b - a, c - b) >= -slack) || (cross(b - a, c - b) <= slack && dot(b - a, c - b) < 0)) {
      return bad("turns right at corner " + std::to_string((k + 1) % n) + ", expected convex and counter-clockwise");
    }
    turns += cross(b - a, c - b) > 0 ? 1 : 0;
    // Once round, not several times (a star): seen from the first corner everything keeps to the left.
    if (k > 0 && !(cross(a - polygon[0], b - polygon[0]) >=
                   -slack - length(a - polygon[0]) * length(b - a) * 16 * std::numeric_limits<T>::epsilon())) {
      return bad("goes round more than once, expected a simple polygon");
    }
  }
  if (!(turns >= 2)) return bad("found no area");
  return {};
}

template <class T> struct Separation2T {
  int axis = -1;       // number of the first axis that separates: edges of a, then edges of b; -1: they overlap
  Vec2T<T> direction;  // of that axis; unit, outwards across the edge
  T gap = 0;           // m, along it
  int tested = 0;      // axes looked at
};

namespace polygon2d {

template <class T> struct Projection { T low, high; };
template <class T> inline Projection<T> project(std::span<const Vec2T<T>> polygon, Vec2T<T> axis) {
  T low = dot(axis, polygon[0]), high = low;
  for (Vec2T<T> corner : polygon) {
    T along = dot(axis, corner);
    if (along < low) low = along;
    if (along > high) high = along;
  }
  return {low, high};
}
// Unit, outwards across edge k.
template <class T> inline Vec2T<T> across(std::span<const Vec2T<T>> polygon, std::size_t k) {
  Vec2T<T> edge = polygon[(k + 1) % polygon.size()] - polygon[k];
  return Vec2T<T>{edge.y, -edge.x} * (1 / length(edge));
}

}  // namespace polygon2d

// Algorithm 1. Touching counts as overlapping.
template <class T>
inline Result<Separation2T<T>> separatingAxis(std::span<const Vec2T<T>> a, std::span<const Vec2T<T>> b) {
  if (Status good = checkPolygon(a, "a"); !good) return good.error();
  if (Status good = checkPolygon(b, "b"); !good) return good.error();
  Separation2T<T> out;
  for (std::span<const Vec2T<T>> polygon : {a, b}) {
    for (std::size_t k = 0; k < polygon.size(); k++) {
      Vec2T<T> axis = polygon2d::across(polygon, k);
      auto ofA = polygon2d::project(a, axis), ofB = polygon2d::project(b, axis);
      T gap = ofA.high < ofB.low ? ofB.low - ofA.high : ofA.low - ofB.high;
      out.tested++;
      if (gap > 0) {  // early exit: one axis that separates is enough
        out.axis = out.tested - 1;
        out.direction = axis;
        out.gap = gap;
        return out;
      }
    }
  }
  return out;
}

// The same for rectangles: opposite edges share an axis, so four are enough (0, 1 of a; 2, 3 of b), and half extents
// replace the loop over corners.
template <class T> inline Result<Separation2T<T>> separatingAxis(const RectangleT<T>& a, const RectangleT<T>& b) {
  int number = 0;
  for (const RectangleT<T>& r : {a, b}) {
    std::string name = number++ == 0 ? "a" : "b";
    if (!(std::isfinite(r.centre.x) && std::isfinite(r.centre.y))) {
      return Error{ErrorCode::invalidArgument, name + ".centre: expected finite numbers"};
    }
    if (!(r.halfExtents.x > 0 && r.halfExtents.y > 0 && std::isfinite(r.halfExtents.x + r.halfExtents.y))) {
      return Error{ErrorCode::invalidArgument, name + ".halfExtents: expected finite numbers above 0"};
    }
    if (!(std::fabs(dot(r.axis, r.axis) - 1) < T(1e-4))) {
      return Error{ErrorCode::invalidArgument, name + ".axis: expected a unit vector"};
    }
  }
  Separation2T<T> out;
  const Vec2T<T> d = b.centre - a.centre;
  const Vec2T<T> axes[4] = {a.axis, {-a.axis.y, a.axis.x}, b.axis, {-b.axis.y, b.axis.x}};
  for (int k = 0; k < 4; k++) {
    T reachA = std::fabs(dot(axes[k], axes[0])) * a.halfExtents.x + std::fabs(dot(axes[k], axes[1])) * a.halfExtents.y;
    T reachB = std::fabs(dot(axes[k], axes[2])) * b.halfExtents.x + std::fabs(dot(axes[k], axes[3])) * b.halfExtents.y;
    T gap = std::fabs(dot(axes[k], d)) - (reachA + reachB);
    out.tested++;
    if (gap > 0) {
      out.axis = k;
      out.direction = dot(axes[k], d) < 0 ? axes[k] * T(-1) : axes[k];
      out.gap = gap;
      return out;
    }
  }
  return out;
}

// Moving polygons, constant velocity of b seen from a: on each axis the projections meet during one interval of time.
template <class T> struct Impact2T {
  bool hit = false;
  T time = 0;       // s; 0 if they overlap at the start
  int axis = -1;    // the last axis to separate, numbered as above; -1 if they overlap at the start
  Vec2T<T> normal;  // unit, from a to b; zero if they overlap at the start
};
template <class T>
inline Result<Impact2T<T>> firstContact(std::span<const Vec2T<T>> a, std::span<const Vec2T<T>> b, Vec2T<T> velocity,
                                        T maxTime) {
  if (Status good = checkPolygon(a, "a"); !good) return good.error();
  if (Status good = checkPolygon(b, "b"); !good) return good.error();
  if (!(std::isfinite(velocity.x) && std::isfinite(velocity.y))) {
    return Error{ErrorCode::invalidArgument, "velocity: expected finite numbers"};
  }
  if (!(maxTime >= 0)) return Error{ErrorCode::invalidArgument, "maxTime: expected 0 or more"};
  Impact2T<T> out;
  T first = 0, last = maxTime;
  int number = 0;
  for (std::span<const Vec2T<T>> polygon : {a, b}) {
    for (std::size_t k = 0; k < polygon.size(); k++, number++) {
      Vec2T<T> axis = polygon2d::across(polygon, k);
      auto ofA = polygon2d::project(a, axis), ofB = polygon2d::project(b, axis);
      T speed = dot(axis, velocity), toMeet = ofB.low - ofA.high, toPart = ofB.high - ofA.low;
      if (speed == 0) {
        if (toMeet > 0 || toPart < 0) return Impact2T<T>{};
        continue;
      }
      // b ahead of a (toMeet > 0) meets as it falls back; b behind (toPart < 0) as it comes forward.
      T enter = speed < 0 ? -toMeet / speed : -toPart / speed, leave = speed < 0 ? -toPart / speed : -toMeet / speed;
      if (leave < last) last = leave;
      if (enter > first || (enter == 0 && first == 0 && out.axis < 0 && (toMeet == 0 || toPart == 0))) {
        first = enter;
        out.axis = number;
        out.normal = speed < 0 ? axis : axis * T(-1);
      }
    }
  }
  if (!(first <= last)) return Impact2T<T>{};
  out.hit = true;
  out.time = first;
  return out;
}

}  // namespace brickfall
