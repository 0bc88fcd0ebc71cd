// Small vector algebra used by the public API: double precision, SI units, Y up, right-handed.
// T is float only inside the solver; everything a user sees is double.
#pragma once
#include <cmath>

namespace brickfall {

template <class T> struct Vec3T {
  T x = 0, y = 0, z = 0;

  T operator[](int i) const { return i == 0 ? x : i == 1 ? y : z; }
  T& operator[](int i) { return i == 0 ? x : i == 1 ? y : z; }
  bool operator==(const Vec3T&) const = default;
};
template <class T> inline Vec3T<T> operator+(Vec3T<T> a, Vec3T<T> b) { return {a.x + b.x, a.y + b.y, a.z + b.z}; }
template <class T> inline Vec3T<T> operator-(Vec3T<T> a, Vec3T<T> b) { return {a.x - b.x, a.y - b.y, a.z - b.z}; }
template <class T> inline Vec3T<T> operator-(Vec3T<T> a) { return {-a.x, -a.y, -a.z}; }
template <class T> inline Vec3T<T> operator*(Vec3T<T> a, T s) { return {a.x * s, a.y * s, a.z * s}; }
template <class T> inline Vec3T<T> operator*(T s, Vec3T<T> a) { return a * s; }
template <class T> inline Vec3T<T>& operator+=(Vec3T<T>& a, Vec3T<T> b) { return a = a + b; }
template <class T> inline Vec3T<T>& operator-=(Vec3T<T>& a, Vec3T<T> b) { return a = a - b; }
template <class T> inline Vec3T<T>& operator*=(Vec3T<T>& a, T s) { return a = a * s; }
template <class T> inline T dot(Vec3T<T> a, Vec3T<T> b) { return a.x * b.x + a.y * b.y + a.z * b.z; }
template <class T> inline Vec3T<T> cross(Vec3T<T> a, Vec3T<T> b) {
  return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}
template <class T> inline T lengthSquared(Vec3T<T> a) { return dot(a, a); }
template <class T> inline T length(Vec3T<T> a) { return std::sqrt(dot(a, a)); }
template <class T> inline Vec3T<T> min(Vec3T<T> a, Vec3T<T> b) {
  return {a.x < b.x ? a.x : b.x, a.y < b.y ? a.y : b.y, a.z < b.z ? a.z : b.z};
}
template <class T> inline Vec3T<T> max(Vec3T<T> a, Vec3T<T> b) {
  return {a.x > b.x ? a.x : b.x, a.y > b.y ? a.y : b.y, a.z > b.z ? a.z : b.z};
}
template <class T> inline Vec3T<T> abs(Vec3T<T> a) { return {std::fabs(a.x), std::fabs(a.y), std::fabs(a.z)}; }
// Product component by component.
template <class T> inline Vec3T<T> scaled(Vec3T<T> a, Vec3T<T> b) { return {a.x * b.x, a.y * b.y, a.z * b.z}; }
// Unit vector along a; {0, 0, 0} stays as it is.
template <class T> inline Vec3T<T> normalized(Vec3T<T> a) {
  T l = length(a);
  return l > 0 ? a * (1 / l) : a;
}
template <class T> inline bool isFinite(Vec3T<T> a) {
  return std::isfinite(a.x) && std::isfinite(a.y) && std::isfinite(a.z);
}

// 3 x 3 matrix by rows.
template <class T> struct Mat3T {
  Vec3T<T> row[3] = {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}};

  Vec3T<T> column(int i) const { return {row[0][i], row[1][i], row[2][i]}; }
};
template <class T> inline Vec3T<T> operator*(const Mat3T<T>& m, Vec3T<T> v) {
  return {dot(m.row[0], v), dot(m.row[1], v), dot(m.row[2], v)};
}
// transpose(m) * v
template <class T> inline Vec3T<T> transposeTimes(const Mat3T<T>& m, Vec3T<T> v) {
  return m.row[0] * v.x + m.row[1] * v.y + m.row[2] * v.z;
}
template <class T> inline Mat3T<T> transpose(const Mat3T<T>& m) { return {{m.column(0), m.column(1), m.column(2)}}; }
template <class T> inline Mat3T<T> operator*(const Mat3T<T>& a, const Mat3T<T>& b) {
  Mat3T<T> out;
  for (int i = 0; i < 3; i++) out.row[i] = transposeTimes(b, a.row[i]);
  return out;
}
template <class T> inline Mat3T<T> operator+(const Mat3T<T>& a, const Mat3T<T>& b) {
  return {{a.row[0] + b.row[0], a.row[1] + b.row[1], a.row[2] + b.row[2]}};
}
template <class T> inline Mat3T<T> operator*(const Mat3T<T>& a, T s) {
  return {{a.row[0] * s, a.row[1] * s, a.row[2] * s}};
}
template <class T> inline Mat3T<T> diagonal(Vec3T<T> d) { return {{{d.x, 0, 0}, {0, d.y, 0}, {0, 0, d.z}}}; }
template <class T> inline T determinant(const Mat3T<T>& m) { return dot(m.row[0], cross(m.row[1], m.row[2])); }
// Inverse of a regular matrix (adjugate over determinant).
template <class T> inline Mat3T<T> inverse(const Mat3T<T>& m) {
  Vec3T<T> a = cross(m.row[1], m.row[2]), b = cross(m.row[2], m.row[0]), c = cross(m.row[0], m.row[1]);
  T s = 1 / dot(m.row[0], a);
  return {{{a.x * s, b.x * s, c.x * s}, {a.y * s, b.y * s, c.y * s}, {a.z * s, b.z * s, c.z * s}}};
}

// Rotation quaternion (x, y, z, w), unit length, as in glTF and three.js.
template <class T> struct QuatT {
  T x = 0, y = 0, z = 0, w = 1;
  bool operator==(const QuatT&) const = default;
};
template <class T> inline QuatT<T> operator*(QuatT<T> a, QuatT<T> b) {
  return {a.w * b.x + a.x * b.w + a.y * b.z - a.z * b.y, a.w * b.y - a.x * b.z + a.y * b.w + a.z * b.x,
          a.w * b.z + a.x * b.y - a.y * b.x + a.z * b.w, a.w * b.w - a.x * b.x - a.y * b.y - a.z * b.z};
}
template <class T> inline QuatT<T> conjugate(QuatT<T> q) { return {-q.x, -q.y, -q.z, q.w}; }
template <class T> inline QuatT<T> normalized(QuatT<T> q) {
  T s = 1 / std::sqrt(q.x * q.x + q.y * q.y + q.z * q.z + q.w * q.w);
  return {q.x * s, q.y * s, q.z * s, q.w * s};
}
template <class T> inline bool isFinite(QuatT<T> q) {
  return std::isfinite(q.x) && std::isfinite(q.y) && std::isfinite(q.z) && std::isfinite(q.w);
}
template <class T> inline Mat3T<T> toMatrix(QuatT<T> q) {
  T x = q.x, y = q.y, z = q.z, w = q.w;
  return {{{1 - 2 * (y * y + z * z), 2 * (x * y - w * z), 2 * (x * z + w * y)},
           {2 * (x * y + w * z), 1 - 2 * (x * x + z * z), 2 * (y * z - w * x)},
           {2 * (x * z - w * y), 2 * (y * z + w * x), 1 - 2 * (x * x + y * y)}}};
}
template <class T> inline Vec3T<T> rotate(QuatT<T> q, Vec3T<T> v) {
  Vec3T<T> u{q.x, q.y, q.z};
  Vec3T<T> t = cross(u, v) * T(2);
  return v + t * q.w + cross(u, t);
}

// Rotation, then translation: point -> rotation * point + position.
template <class T> struct TransformT {
  Vec3T<T> position;
  QuatT<T> rotation;
};
template <class T> inline Vec3T<T> transformPoint(const TransformT<T>& t, Vec3T<T> p) {
  return rotate(t.rotation, p) + t.position;
}
template <class T> inline TransformT<T> operator*(const TransformT<T>& a, const TransformT<T>& b) {
  return {transformPoint(a, b.position), a.rotation * b.rotation};
}
template <class T> inline TransformT<T> inverse(const TransformT<T>& t) {
  QuatT<T> q = conjugate(t.rotation);
  return {-rotate(q, t.position), q};
}

using Vec3 = Vec3T<double>;
using Mat3 = Mat3T<double>;
using Quat = QuatT<double>;
using Transform = TransformT<double>;

// Axis-aligned box, lower <= upper.
struct Aabb {
  Vec3 lower, upper;
};
inline bool overlaps(const Aabb& a, const Aabb& b) {
  return a.lower.x <= b.upper.x && b.lower.x <= a.upper.x && a.lower.y <= b.upper.y && b.lower.y <= a.upper.y &&
         a.lower.z <= b.upper.z && b.lower.z <= a.upper.z;
}
inline bool contains(const Aabb& outer, const Aabb& inner) {
  return outer.lower.x <= inner.lower.x && outer.lower.y <= inner.lower.y && outer.lower.z <= inner.lower.z &&
         inner.upper.x <= outer.upper.x && inner.upper.y <= outer.upper.y && inner.upper.z <= outer.upper.z;
}
inline Aabb merged(const Aabb& a, const Aabb& b) { return {min(a.lower, b.lower), max(a.upper, b.upper)}; }
inline Aabb grown(const Aabb& a, double by) { return {a.lower - Vec3{by, by, by}, a.upper + Vec3{by, by, by}}; }

// Sine and cosine of the same bits on every platform (no libm); |radians| <= 1e5, error under 2e-16.
void sinCos(double radians, double& sine, double& cosine);
// Quaternion of a rotation by |v| radians about v. Any finite v; lengths above 1e5 count as 1e5.
Quat quatFromRotationVector(Vec3 v);
// Rotation vector of a unit quaternion, length 0..pi.
Vec3 rotationVector(Quat q);
Quat quatFromAxisAngle(Vec3 unitAxis, double radians);

}  // namespace brickfall
