// Mass, centre and inertia of bodies of several shapes against the divergence theorem over triangles, in extended
// precision. Parts that overlap are summed: a body weighs what its shapes weigh.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>

#include "geometry/hull.h"
#include "support/random_geometry.h"
#include "support/world_helpers.h"

namespace brickfall {
namespace {

using Real = long double;
using Vector = Vec3T<Real>;

Vector wide(Vec3 v) { return {v.x, v.y, v.z}; }

struct Moments {
  Real mass = 0;
  Vector first{};
  Real second[3][3] = {};

  // Signed tetrahedron from the origin over a triangle seen counter-clockwise from outside.
  void add(Vector a, Vector b, Vector c, Real density) {
    Real m = dot(a, cross(b, c)) / 6 * density;
    Vector s = a + b + c;
    mass += m;
    first += s * (m / 4);
    for (int i = 0; i < 3; i++)
      for (int k = 0; k < 3; k++) second[i][k] += m / 20 * (a[i] * a[k] + b[i] * b[k] + c[i] * c[k] + s[i] * s[k]);
  }
};

using Triangles = std::vector<std::array<Vector, 3>>;

Triangles hullTriangles(const std::vector<Vec3>& points) {
  Triangles out;
  Hull hull = buildHull(points).value();
  for (std::uint16_t start : hull.firstEdge)
    for (std::uint16_t e = hull.edges[start].next; hull.edges[e].next != start; e = hull.edges[e].next)
      out.push_back({wide(hull.vertices[hull.edges[start].origin]), wide(hull.vertices[hull.edges[e].origin]),
                     wide(hull.vertices[hull.edges[hull.edges[e].next].origin])});
  return out;
}

// A ball of rings, drawn apart along y: a capsule, or a sphere if halfHeight is 0.
Triangles roundTriangles(Real radius, Real halfHeight, int n) {
  const Real pi = 3.14159265358979323846264L;
  auto at = [&](int ring, int k) {
    Real up = pi * ring / (2 * n), around = 2 * pi * k / (4 * n);  // ring n is the equator, there twice
    Real y = std::cos(up) * radius;
    return Vector{radius * std::sin(up) * std::cos(around), y, radius * std::sin(up) * std::sin(around)};
  };
  auto lifted = [&](Vector v, bool upper) { return v + Vector{0, upper ? halfHeight : -halfHeight, 0}; };
  Triangles out;
  auto quad = [&](Vector a, Vector b, Vector c, Vector d) {
    out.push_back({a, b, c});
    out.push_back({a, c, d});
  };
  for (int k = 0; k < 4 * n; k++) {
    for (int ring = 0; ring < 2 * n; ring++) {
      bool upper = ring < n;
      quad(lifted(at(ring, k), upper), lifted(at(ring, k + 1), upper), lifted(at(ring + 1, k + 1), upper),
           lifted(at(ring + 1, k), upper));
    }
    quad(lifted(at(n, k), true), lifted(at(n, k + 1), true), lifted(at(n, k + 1), false), lifted(at(n, k), false));
  }
  return out;
}

Triangles trianglesOf(const ShapeDef& s, int n) {
  if (s.type == ShapeType::hull) return hullTriangles(s.vertices);
  if (s.type == ShapeType::sphere) return roundTriangles(s.radius, 0, n);
  if (s.type == ShapeType::capsule) return roundTriangles(s.radius, s.halfHeight, n);
  std::vector<Vec3> corners;
  for (int k = 0; k < 8; k++)
    corners.push_back(scaled(s.halfExtents, {k & 1 ? 1. : -1., k & 2 ? 1. : -1., k & 4 ? 1. : -1.}));
  return hullTriangles(corners);
}

void addShape(Moments& sum, const ShapeDef& s, int n, Real weight) {
  Mat3T<Real> turn =
      toMatrix(normalized(QuatT<Real>{s.local.rotation.x, s.local.rotation.y, s.local.rotation.z, s.local.rotation.w}));
  auto place = [&](Vector v) { return turn * v + wide(s.local.position); };
  for (const auto& [a, b, c] : trianglesOf(s, n)) {
    bool out = dot(cross(b - a, c - a), a + b + c) >= 0;  // all shapes here hold their own origin
    sum.add(place(a), place(out ? b : c), place(out ? c : b), Real(s.material.density) * weight);
  }
}

ShapeDef randomShape(Random& random, int type) {
  auto size = [&] { return std::pow(10.0, random.between(-2, 0)); };
  ShapeDef s = test::boxOf({size(), size(), size()});
  if (type == 1) s = test::sphereOf(size());
  if (type == 2) s = test::capsuleOf(size(), size());
  if (type == 3) {
    s.type = ShapeType::hull;
    s.vertices = test::randomPoints(random, 8, s.halfExtents, true);
    for (double side : {-1.0, 1.0})  // the origin is inside
      for (int k = 0; k < 3; k++) {
        Vec3 tip;
        tip[k] = side * s.halfExtents[k];
        s.vertices.push_back(tip);
      }
  }
  s.material.density = std::pow(10.0, random.between(1, 4));
  s.local = test::randomPose(random, 0.5);
  return s;
}

TEST(CompoundMass, AgreesWithTheDivergenceTheorem) {
  Random random(12);
  World world = test::makeWorld();
  int kinds[4] = {};
  for (int round = 0; round < 200; round++) {
    BodyDef def;
    int count = round < 80 ? 1 : 2 + int(random.below(4));
    for (int i = 0; i < count; i++) {
      int type = count == 1 ? round % 4 : int(random.below(4));
      kinds[type]++;
      def.shapes.push_back(randomShape(random, type));
    }
    MassProperties found = *world.massProperties(test::add(world, def));
    // Round shapes converge with the square of the number of rings: two meshes give the limit (Richardson).
    Moments sum;
    for (const ShapeDef& s : def.shapes) {
      bool isRound = s.type == ShapeType::sphere || s.type == ShapeType::capsule;
      addShape(sum, s, 24, isRound ? 4.0L / 3 : 1.0L);
      if (isRound) addShape(sum, s, 12, -1.0L / 3);
    }
    SCOPED_TRACE("round " + std::to_string(round));
    Vector centre = sum.first * (1 / sum.mass);
    Real trace = 0, mass = sum.mass, c[3][3];
    for (int i = 0; i < 3; i++)
      for (int k = 0; k < 3; k++) c[i][k] = sum.second[i][k] - mass * centre[i] * centre[k];
    for (int i = 0; i < 3; i++) trace += c[i][i];
    EXPECT_NEAR(found.mass / double(mass), 1, 2e-5);
    EXPECT_LE(length(wide(found.centre) - centre), 2e-5L * std::sqrt(trace / mass) + 1e-12L);
    for (int i = 0; i < 3; i++)
      for (int k = 0; k < 3; k++)
        EXPECT_NEAR(found.inertia.row[i][k], double((i == k ? trace : 0) - c[i][k]), 1e-4 * double(trace)) << i << k;
    Vec3 d{found.inertia.row[0].x, found.inertia.row[1].y, found.inertia.row[2].z};
    EXPECT_GE(d.x + d.y, d.z * (1 - 1e-12));
    EXPECT_GE(d.y + d.z, d.x * (1 - 1e-12));
    EXPECT_GE(d.z + d.x, d.y * (1 - 1e-12));
  }
  for (int n : kinds) EXPECT_GT(n, 50);
}

// Two equal boxes in one place weigh twice as much as one.
TEST(CompoundMass, OverlappingPartsAreSummed) {
  World world = test::makeWorld();
  BodyDef one = test::bodyOf(test::boxOf({0.1, 0.2, 0.3}), {}), two = one;
  two.shapes.push_back(two.shapes[0]);
  MassProperties a = *world.massProperties(test::add(world, one)), b = *world.massProperties(test::add(world, two));
  EXPECT_DOUBLE_EQ(b.mass, 2 * a.mass);
  EXPECT_NEAR(b.inertia.row[0].x, 2 * a.inertia.row[0].x, 1e-12 * b.inertia.row[0].x);
}

}  // namespace
}  // namespace brickfall
