// Closed forms for the round and square shapes; hulls as a sum of tetrahedra (divergence theorem).
#include "geometry/mass_properties.h"

#include <cmath>

#include "geometry/frustum.h"
#include "geometry/hull.h"

namespace brickfall {

namespace {

constexpr double kPi = 3.14159265358979323846;

Mat3 outer(Vec3 a, Vec3 b) { return {{b * a.x, b * a.y, b * a.z}}; }
double trace(const Mat3& m) { return m.row[0].x + m.row[1].y + m.row[2].z; }
// Inertia from the second moments of mass, int p p^T dm: I = trace(C) 1 - C.
Mat3 inertiaFromMoments(const Mat3& c) {
  double t = trace(c);
  return diagonal(Vec3{t, t, t}) + c * -1.0;
}

MassProperties sphereMass(double r, double density) {
  double mass = density * (4.0 / 3.0) * kPi * r * r * r, i = 0.4 * mass * r * r;
  return {mass, {}, diagonal(Vec3{i, i, i})};
}

MassProperties boxMass(Vec3 h, double density) {
  double mass = density * 8 * h.x * h.y * h.z;
  Vec3 s = scaled(h, h);
  return {mass, {}, diagonal(Vec3{s.y + s.z, s.z + s.x, s.x + s.y} * (mass / 3))};
}

// A cylinder and two half balls; a half ball's centre of mass is 3/8 r from its flat side.
MassProperties capsuleMass(double r, double h, double density) {
  double cylinder = density * kPi * r * r * 2 * h, ball = density * (4.0 / 3.0) * kPi * r * r * r;
  double along = 0.5 * cylinder * r * r + 0.4 * ball * r * r;
  double across = cylinder * (0.25 * r * r + h * h / 3) + ball * (0.4 * r * r + h * h + 0.75 * h * r);
  return {cylinder + ball, {}, diagonal(Vec3{across, along, across})};
}

// Discs from end to end: with radii from R to r over the height, the integrals of r^2, y r^2, y^2 r^2 and r^4.
MassProperties frustumMass(const Frustum& f, double density) {
  const double R = f.low, r = f.high, height = 2 * f.half, squares = R * R + R * r + r * r;
  const double mass = density * kPi * height * squares / 3;
  const double fromLow = f.centre() + f.half;
  const double fourth = R * R * R * R + R * R * R * r + R * R * r * r + R * r * r * r + r * r * r * r;
  const double along = 0.3 * mass * fourth / squares;
  const double up = mass * height * height * 0.1 * (R * R + 3 * R * r + 6 * r * r) / squares;  // about the low end
  const double across = 0.5 * along + up - mass * fromLow * fromLow;
  return {mass, {0, f.centre(), 0}, diagonal(Vec3{across, along, across})};
}

// Tetrahedra from the centroid to a fan of triangles on each face. Over a tetrahedron (0, a, b, c) of volume V, with
// s = a + b + c:  int p p^T = V/20 (a a^T + b b^T + c c^T + s s^T).
MassProperties hullMass(const Hull& hull, double density) {
  double volume = 0;
  Vec3 first;
  Mat3 second = diagonal(Vec3{});
  for (std::uint16_t start : hull.firstEdge) {
    Vec3 a = hull.vertices[hull.edges[start].origin] - hull.centroid;
    for (std::uint16_t e = hull.edges[start].next; hull.edges[e].next != start; e = hull.edges[e].next) {
      Vec3 b = hull.vertices[hull.edges[e].origin] - hull.centroid;
      Vec3 c = hull.vertices[hull.edges[hull.edges[e].next].origin] - hull.centroid;
      double v = dot(a, cross(b - a, c - a)) / 6;  // by differences: stays exact for needles and plates
      Vec3 sum = a + b + c;
      volume += v;
      first += sum * (v / 4);
      second = second + (outer(a, a) + outer(b, b) + outer(c, c) + outer(sum, sum)) * (v / 20);
    }
  }
  Vec3 shift = first * (1 / volume);
  Mat3 central = second + outer(shift, shift) * -volume;
  return {density * volume, hull.centroid + shift, inertiaFromMoments(central * density)};
}

}  // namespace

MassProperties shapeMass(const Shape& shape, double density) {
  switch (shape.type) {
    case ShapeType::box:
      return boxMass(shape.halfExtents, density);
    case ShapeType::sphere:
      return sphereMass(shape.radius, density);
    case ShapeType::capsule:
      return capsuleMass(shape.radius, shape.halfHeight, density);
    case ShapeType::hull:
      return hullMass(*shape.hull, density);
    case ShapeType::cylinder:
    case ShapeType::cone:
      return frustumMass(frustumOf(shape), density);
    case ShapeType::plane:
    case ShapeType::mesh:
      break;
  }
  return {};
}

MassProperties shapeMass(const Shape& shape, double density, const MassProperties* atOne) {
  if (!atOne) return shapeMass(shape, density);
  return {atOne->mass * density, atOne->centre, atOne->inertia * density};
}

// Of a mass m between low and high with its centre at c, the second moment about c is at most m (high - c) (c - low)
// (Bhatia and Davis 2000). The second moments C = trace(I) / 2 - I are those of some mass if C is positive: then the principal
// moments of inertia obey the triangle inequality.
std::string impossibleMass(const MassProperties& p, const Aabb& bounds) {
  constexpr double kSlack = 1e-9;
  if (!(p.mass > 0 && p.mass <= 1e15)) return "mass: found " + std::to_string(p.mass) + " m3, expected more than 0";
  const Mat3& I = p.inertia;
  if (!isFinite(p.centre) || !isFinite(I.row[0]) || !isFinite(I.row[1]) || !isFinite(I.row[2]))
    return "found a number that is not finite";
  const Vec3 size = bounds.upper - bounds.lower;
  Mat3 c = diagonal(Vec3{1, 1, 1} * (0.5 * trace(I))) + I * -1.0;
  for (int i = 0; i < 3; i++) {
    const double above = bounds.upper[i] - p.centre[i], below = p.centre[i] - bounds.lower[i];
    if (!(above > 0 && below > 0)) return "centre: found it outside the shape";
    if (!(c.row[i][i] <= p.mass * above * below * (1 + kSlack))) return "inertia: found more than fits into the shape";
    // Each axis in units of its size, so that thin shapes are judged as others are.
    for (int k = 0; k < 3; k++) {
      if (!(std::fabs(I.row[i][k] - I.row[k][i]) <= kSlack * trace(I))) return "inertia: found it not symmetric";
      c.row[i][k] /= p.mass * size[i] * size[k];
    }
  }
  const double minor = c.row[0].x * c.row[1].y - c.row[0].y * c.row[1].x;
  const bool positive = c.row[0].x > kSlack && minor > kSlack * kSlack && dot(c.row[0], cross(c.row[1], c.row[2])) > 0;
  return positive ? "" : "inertia: found principal moments of which one is not less than the sum of the others";
}

MassProperties transformed(const MassProperties& properties, const Transform& pose) {
  Mat3 turn = toMatrix(pose.rotation);
  return {properties.mass, transformPoint(pose, properties.centre), turn * properties.inertia * transpose(turn)};
}

MassProperties combined(std::span<const MassProperties> parts) {
  MassProperties whole;
  Vec3 moment;
  for (const MassProperties& part : parts) {
    whole.mass += part.mass;
    moment += part.centre * part.mass;
  }
  if (!(whole.mass > 0)) return {};
  whole.centre = moment * (1 / whole.mass);
  for (const MassProperties& part : parts) {  // parallel axes (Steiner)
    Vec3 d = part.centre - whole.centre;
    whole.inertia = whole.inertia + part.inertia + inertiaFromMoments(outer(d, d) * part.mass);
  }
  return whole;
}

}  // namespace brickfall
