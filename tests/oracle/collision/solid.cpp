#include "solid.h"

#include <algorithm>
#include <cmath>

#include "geometry/hull.h"

namespace brickfall::oracle {

namespace {

constexpr Real kFar = 1e30L;

// Each row counter-clockwise seen from outside. Corner bits: 1 = x+, 2 = y+, 4 = z+.
constexpr int kBoxFaces[6][4] = {{0, 4, 6, 2}, {1, 3, 7, 5}, {0, 1, 5, 4}, {2, 6, 7, 3}, {0, 2, 3, 1}, {4, 5, 7, 6}};

void addPolytope(Solid& solid, const std::vector<std::vector<int>>& faces) {
  solid.faces = faces;
  for (const std::vector<int>& face : faces) {
    Vector twiceArea{}, middle{};
    const Vector origin = solid.corners[std::size_t(face[0])];
    for (std::size_t k = 0; k < face.size(); k++) {
      int from = face[k], to = face[(k + 1) % face.size()];
      const Vector p = solid.corners[std::size_t(from)];
      twiceArea += cross(p - origin, solid.corners[std::size_t(to)] - origin);
      middle += p * (1 / Real(face.size()));
      if (from < to) solid.edges.push_back({from, to});
    }
    Vector normal = normalized(twiceArea);
    solid.normals.push_back(normal);
    solid.offsets.push_back(dot(normal, middle));
  }
}

Vector nearestOnSegment(Vector p, Vector a, Vector b) {
  Vector along = b - a;
  Real squared = dot(along, along), t = squared > 0 ? dot(p - a, along) / squared : 0;
  return a + along * std::clamp(t, Real(0), Real(1));
}

struct Nearest {
  Real distance = kFar;
  Vector onA, onB;
  void offer(Vector a, Vector b) {
    Real d = length(b - a);
    if (d < distance) distance = d, onA = a, onB = b;
  }
};

bool aboveFace(const Solid& solid, std::size_t face, Vector p) {
  const std::vector<int>& loop = solid.faces[face];
  for (std::size_t k = 0; k < loop.size(); k++) {
    Vector a = solid.corners[std::size_t(loop[k])], b = solid.corners[std::size_t(loop[(k + 1) % loop.size()])];
    if (dot(cross(solid.normals[face], b - a), p - a) < 0) return false;
  }
  return true;
}

// Corners of `points` over the faces of `solid`. `swap`: solid is b.
void cornersOverFaces(const Solid& points, const Solid& solid, bool swap, Nearest& best) {
  for (Vector p : points.corners)
    for (std::size_t f = 0; f < solid.faces.size(); f++) {
      Real height = dot(solid.normals[f], p) - solid.offsets[f];
      if (height < 0 || height >= best.distance || !aboveFace(solid, f, p)) continue;
      Vector foot = p - solid.normals[f] * height;
      swap ? best.offer(p, foot) : best.offer(foot, p);
    }
}

void edgeAgainstEdge(Vector a0, Vector a1, Vector b0, Vector b1, Nearest& best) {
  Vector u = a1 - a0, v = b1 - b0, n = cross(u, v);
  Real squared = dot(n, n);
  if (squared > 0) {
    Real s = dot(cross(b0 - a0, v), n) / squared, t = dot(cross(b0 - a0, u), n) / squared;
    if (s >= 0 && s <= 1 && t >= 0 && t <= 1) best.offer(a0 + u * s, b0 + v * t);
  }
}

// Of cores that are apart.
Nearest nearestPoints(const Solid& a, const Solid& b) {
  Nearest best;
  for (Vector p : a.corners) {
    for (Vector q : b.corners) best.offer(p, q);
    for (auto [from, to] : b.edges)
      best.offer(p, nearestOnSegment(p, b.corners[std::size_t(from)], b.corners[std::size_t(to)]));
  }
  for (Vector q : b.corners)
    for (auto [from, to] : a.edges)
      best.offer(nearestOnSegment(q, a.corners[std::size_t(from)], a.corners[std::size_t(to)]), q);
  for (auto [a0, a1] : a.edges)
    for (auto [b0, b1] : b.edges)
      edgeAgainstEdge(a.corners[std::size_t(a0)], a.corners[std::size_t(a1)], b.corners[std::size_t(b0)],
                      b.corners[std::size_t(b1)], best);
  cornersOverFaces(b, a, false, best);
  cornersOverFaces(a, b, true, best);
  return best;
}

struct Span {
  Real low = kFar, high = -kFar;
};
Span spanOf(const Solid& solid, Vector axis) {
  Span out;
  for (Vector p : solid.corners) {
    Real along = dot(p, axis);
    out.low = std::min(out.low, along), out.high = std::max(out.high, along);
  }
  return out;
}

// Best of all face normals and of all cross products of edges, without radii.
Separation bestAxis(const Solid& a, const Solid& b) {
  Separation best;
  best.value = -kFar;
  auto offer = [&](Vector axis) {  // both ways
    Span sa = spanOf(a, axis), sb = spanOf(b, axis);
    if (sb.low - sa.high > best.value) best.value = sb.low - sa.high, best.axis = axis;
    if (sa.low - sb.high > best.value) best.value = sa.low - sb.high, best.axis = -axis;
  };
  for (Vector n : a.normals) offer(n);
  for (Vector n : b.normals) offer(n);
  for (auto [a0, a1] : a.edges)
    for (auto [b0, b1] : b.edges) {
      Vector u = a.corners[std::size_t(a1)] - a.corners[std::size_t(a0)];
      Vector v = b.corners[std::size_t(b1)] - b.corners[std::size_t(b0)], n = cross(u, v);
      Real squared = dot(n, n);
      if (squared > 1e-26L * dot(u, u) * dot(v, v)) offer(n * (1 / std::sqrt(squared)));
    }
  return best;
}

Separation fromHalfSpace(const Solid& plane, const Solid& other) {
  Real low = kFar;
  for (Vector p : other.corners) low = std::min(low, dot(plane.normals[0], p));
  return {low - plane.offsets[0] - other.radius, plane.normals[0], false};
}

}  // namespace

Solid solidOf(const Shape& shape, const Transform& pose) {
  QuatT<Real> q = normalized(QuatT<Real>{pose.rotation.x, pose.rotation.y, pose.rotation.z, pose.rotation.w});
  Mat3T<Real> turn = toMatrix(q);
  Vector origin = wide(pose.position);
  Solid out;
  auto add = [&](Vector local) { out.corners.push_back(turn * local + origin); };
  switch (shape.type) {
    case ShapeType::plane:
      out.halfSpace = true;
      out.normals = {turn * Vector{0, 1, 0}};
      out.offsets = {dot(out.normals[0], origin)};
      break;
    case ShapeType::mesh:      // not convex
    case ShapeType::cylinder:  // frustum_test.cpp
    case ShapeType::cone:
      break;
    case ShapeType::sphere:
      out.radius = shape.radius;
      add({});
      break;
    case ShapeType::capsule:
      out.radius = shape.radius;
      add({0, -Real(shape.halfHeight), 0});
      add({0, Real(shape.halfHeight), 0});
      out.edges = {{0, 1}};
      break;
    case ShapeType::box: {
      Vector h = wide(shape.halfExtents);
      for (int k = 0; k < 8; k++) add({k & 1 ? h.x : -h.x, k & 2 ? h.y : -h.y, k & 4 ? h.z : -h.z});
      std::vector<std::vector<int>> faces;
      for (const auto& face : kBoxFaces) faces.emplace_back(face, face + 4);
      addPolytope(out, faces);
      break;
    }
    case ShapeType::hull: {
      const Hull& hull = *shape.hull;
      for (Vec3 v : hull.vertices) add(wide(v));
      std::vector<std::vector<int>> faces;
      for (std::uint16_t start : hull.firstEdge) {
        std::vector<int> loop;
        std::uint16_t e = start;
        do {
          loop.push_back(hull.edges[e].origin);
          e = hull.edges[e].next;
        } while (e != start);
        faces.push_back(loop);
      }
      addPolytope(out, faces);
      break;
    }
  }
  return out;
}

Separation separationOf(const Solid& a, const Solid& b) {
  if (a.halfSpace) return fromHalfSpace(a, b);
  if (b.halfSpace) {
    Separation s = fromHalfSpace(b, a);
    return {s.value, -s.axis, false};
  }
  Real radii = a.radius + b.radius;
  bool solid = !a.faces.empty() || !b.faces.empty();  // point and segment cores enclose nothing
  Separation best;
  if (solid) best = bestAxis(a, b);
  if (!solid || best.value > 0) {
    Nearest nearest = nearestPoints(a, b);
    Vector between = nearest.onB - nearest.onA;
    Real size = length(a.corners[0] - nearest.onA) + length(b.corners[0] - nearest.onB) + radii;
    bool sure = nearest.distance > 1e-12L * size;
    if (sure || !solid) best.axis = sure ? between * (1 / nearest.distance) : Vector{};
    if (!sure && !solid && !a.edges.empty() && !b.edges.empty())  // crossing axes of capsules: out across both
      best.axis = normalized(cross(a.corners[1] - a.corners[0], b.corners[1] - b.corners[0]));
    best.value = nearest.distance;
  } else {
    best.deep = true;
  }
  best.value -= radii;
  return best;
}

Real separationAlong(const Solid& a, const Solid& b, Vector axis) {
  if (a.halfSpace || b.halfSpace) {
    const Solid &plane = a.halfSpace ? a : b, &other = a.halfSpace ? b : a;
    Vector up = plane.normals[0], out = a.halfSpace ? axis : -axis;
    return dot(up, out) > 1 - 1e-12L ? fromHalfSpace(plane, other).value : -kFar;
  }
  return spanOf(b, axis).low - spanOf(a, axis).high - a.radius - b.radius;
}

Real heightOver(const Solid& solid, Vector point) {
  if (solid.halfSpace) return dot(solid.normals[0], point) - solid.offsets[0];
  Real highest = -kFar;
  for (std::size_t f = 0; f < solid.faces.size(); f++)
    highest = std::max(highest, dot(solid.normals[f], point) - solid.offsets[f]);
  if (!solid.faces.empty() && highest <= 0) return highest - solid.radius;
  Solid dot;
  dot.corners = {point};
  return nearestPoints(solid, dot).distance - solid.radius;
}

}  // namespace brickfall::oracle
