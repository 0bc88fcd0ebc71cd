// Mass, centre and inertia of bodies of several shapes against the divergence theorem over triangles, in extended
// precision. Parts that overlap are summed: a body weighs what its shapes weigh.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "geometry/hull.h"
#include "math/symmetric_eigen.h"
#include "support/random_geometry.h"
#include "support/validation_record.h"
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

// Checked and kept for the validation page.
void keep(const char* name, double found, double limit, int bodies) {
  EXPECT_LE(found, limit) << name;
  test::ValidationRow row;
  row.section = "mass";
  row.name = name;
  row.expected = limit, row.found = found, row.atMost = true;
  row.pass = found <= limit;
  row.cases = bodies;
  test::record(row);
}

TEST(CompoundMass, AgreesWithTheDivergenceTheorem) {
  Random random(12);
  World world = test::makeWorld();
  int kinds[4] = {};
  double worstMass = 0, worstCentre = 0, worstInertia = 0;
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
    worstMass = std::max(worstMass, std::fabs(found.mass / double(mass) - 1));
    Real radius = std::sqrt(trace / mass);  // of gyration
    worstCentre = std::max(worstCentre, double(length(wide(found.centre) - centre) / radius));
    EXPECT_LE(length(wide(found.centre) - centre), 2e-5L * std::sqrt(trace / mass) + 1e-12L);
    for (int i = 0; i < 3; i++)
      for (int k = 0; k < 3; k++) {
        double right = double((i == k ? trace : 0) - c[i][k]);
        EXPECT_NEAR(found.inertia.row[i][k], right, 1e-4 * double(trace)) << i << k;
        worstInertia = std::max(worstInertia, std::fabs(found.inertia.row[i][k] - right) / double(trace));
      }
    Vec3 d{found.inertia.row[0].x, found.inertia.row[1].y, found.inertia.row[2].z};
    EXPECT_GE(d.x + d.y, d.z * (1 - 1e-12));
    EXPECT_GE(d.y + d.z, d.x * (1 - 1e-12));
    EXPECT_GE(d.z + d.x, d.y * (1 - 1e-12));
  }
  for (int n : kinds) EXPECT_GT(n, 50);
  keep("mass against the divergence theorem", worstMass, 2e-5, 200);
  keep("centre of mass against the divergence theorem, of the radius of gyration", worstCentre, 2e-5, 200);
  keep("inertia against the divergence theorem, of its trace", worstInertia, 1e-4, 200);
}

// Whether a shape holds a point of its own frame. What the sums below are made of: no face, no formula.
bool holds(const ShapeDef& s, const std::vector<HullPlane>& planes, Vec3 p) {
  if (s.type == ShapeType::box)
    return std::fabs(p.x) <= s.halfExtents.x && std::fabs(p.y) <= s.halfExtents.y && std::fabs(p.z) <= s.halfExtents.z;
  if (s.type == ShapeType::hull)
    return std::all_of(planes.begin(), planes.end(), [&](const HullPlane& f) { return dot(f.normal, p) <= f.offset; });
  double axis = s.type == ShapeType::capsule ? std::clamp(p.y, -s.halfHeight, s.halfHeight) : 0;
  return length(p - Vec3{0, axis, 0}) <= s.radius;
}

// Sums of small cubes, n along each side of the shape's own bounds; `from` is turned and moved with the shape's pose.
void addVoxels(Moments& sum, const ShapeDef& s, int n) {
  std::vector<HullPlane> planes;
  if (s.type == ShapeType::hull) planes = buildHull(s.vertices).value().planes;
  Vec3 reach = s.halfExtents;
  if (s.type == ShapeType::sphere) reach = {s.radius, s.radius, s.radius};
  if (s.type == ShapeType::capsule) reach = {s.radius, s.radius + s.halfHeight, s.radius};
  if (s.type == ShapeType::hull) {
    reach = {};
    for (Vec3 v : s.vertices)
      for (int k = 0; k < 3; k++) reach[k] = std::max(reach[k], std::fabs(v[k]));
  }
  Vec3 cell = reach * (2.0 / n);
  Real mass = Real(cell.x) * cell.y * cell.z * s.material.density;
  for (int i = 0; i < n; i++)
    for (int j = 0; j < n; j++)
      for (int k = 0; k < n; k++) {
        Vec3 p{(i + 0.5) * cell.x - reach.x, (j + 0.5) * cell.y - reach.y, (k + 0.5) * cell.z - reach.z};
        if (!holds(s, planes, p)) continue;
        Vector q = wide(transformPoint(s.local, p));
        sum.mass += mass;
        sum.first += q * mass;
        for (int r = 0; r < 3; r++)
          for (int c = 0; c < 3; c++) sum.second[r][c] += mass * q[r] * q[c];
      }
}

// Mass, centre and inertia by counting cubes: crude, but with nothing in common with the engine's formulas.
TEST(CompoundMass, AgreesWithSumsOfSmallCubes) {
  Random random(77);
  World world = test::makeWorld();
  double mass = 0, centre = 0, inertia = 0;
  int kinds[4] = {}, bodies = 0;
  for (; bodies < 30; bodies++) {
    BodyDef def;
    Moments sum;
    int count = 1 + bodies % 4;
    for (int i = 0; i < count; i++) {
      int type = int(random.below(4));
      kinds[type]++;
      def.shapes.push_back(randomShape(random, type));
      addVoxels(sum, def.shapes.back(), 48);
    }
    MassProperties found = *world.massProperties(test::add(world, def));
    Vector middle = sum.first * (1 / sum.mass);
    Real trace = 0, c[3][3];
    for (int i = 0; i < 3; i++)
      for (int k = 0; k < 3; k++) c[i][k] = sum.second[i][k] - sum.mass * middle[i] * middle[k];
    for (int i = 0; i < 3; i++) trace += c[i][i];
    double radius = std::sqrt(double(trace / sum.mass));  // of gyration
    mass = std::max(mass, std::fabs(found.mass / double(sum.mass) - 1));
    centre = std::max(centre, double(length(wide(found.centre) - middle)) / radius);
    for (int i = 0; i < 3; i++)
      for (int k = 0; k < 3; k++)
        inertia = std::max(inertia,
                           std::fabs(found.inertia.row[i][k] - double((i == k ? trace : 0) - c[i][k])) / double(trace));
  }
  keep("mass against sums of small cubes", mass, 0.01, bodies);
  keep("centre of mass against sums of small cubes, of the radius of gyration", centre, 0.01, bodies);
  keep("inertia against sums of small cubes, of its trace", inertia, 0.015, bodies);
  for (int n : kinds) EXPECT_GT(n, 8);
}

// Principal moments: they and their axes make the inertia again, they add up to its trace, and none is more than the sum
// of the other two (of any mass that is not negative), in one body of any shape, flat and long ones too.
TEST(CompoundMass, PrincipalMomentsAreThoseOfAMass) {
  Random random(5);
  World world = test::makeWorld();
  double again = 0, sums = 0, triangle = 0;
  int slender = 0, bodies = 0;
  for (; bodies < 2000; bodies++) {
    BodyDef def;
    int count = 1 + bodies % 4;
    for (int i = 0; i < count; i++) def.shapes.push_back(randomShape(random, int(random.below(4))));
    const Mat3 inertia = world.massProperties(test::add(world, def))->inertia;
    SymmetricEigen principal = symmetricEigen(inertia);
    Vec3 m = principal.values;
    double trace = inertia.row[0].x + inertia.row[1].y + inertia.row[2].z;
    sums = std::max(sums, std::fabs(m.x + m.y + m.z - trace) / trace);
    for (int i = 0; i < 3; i++) {
      EXPECT_GT(m[i], 0);
      triangle = std::max(triangle, (m[i] - (trace - m[i])) / trace);
      Vec3 axis = principal.axes.row[i];
      again = std::max(again, length(inertia * axis - axis * m[i]) / trace);
    }
    slender += std::min({m.x, m.y, m.z}) < 0.05 * trace;
  }
  keep("principal axes: inertia along each, off by, of its trace", again, 1e-14, bodies);
  keep("principal moments against the trace", sums, 1e-14, bodies);
  keep("principal moment over the sum of the other two, of the trace", triangle, 1e-14, bodies);
  EXPECT_GT(slender, bodies / 50);
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
