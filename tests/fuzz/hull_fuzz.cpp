// libFuzzer: any bytes as points. Whatever they are, buildHull gives an error that says why, or a hull that holds them,
// does not depend on their order, and with which queries make sense. The same entry point runs in the unit tests.
#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <string>
#include <vector>

#include "geometry/hull.h"
#include "geometry/mass_properties.h"
#include "geometry/queries.h"

namespace {

using namespace brickfall;

void require(bool condition, const char* what) {
  if (condition) return;
  std::fprintf(stderr, "hull_fuzz: %s\n", what);
  std::abort();
}

template <class T> bool take(const std::uint8_t*& data, std::size_t& size, T& value) {
  if (size < sizeof(T)) return false;
  std::memcpy(&value, data, sizeof(T));
  data += sizeof(T), size -= sizeof(T);
  return true;
}

double lattice(std::uint8_t byte) { return (byte % 16) - 7.5; }

// Four readings of the bytes: doubles of any kind, floats, a small lattice, the lattice with noise of chosen magnitude.
std::vector<Vec3> decode(const std::uint8_t* data, std::size_t size) {
  std::vector<Vec3> points;
  std::uint8_t mode = 0, magnitude = 0;
  if (!take(data, size, mode) || !take(data, size, magnitude)) return points;
  double noise = 1;
  for (int k = magnitude % 48; k > 0; k--) noise *= 0.5;
  double d[3];
  float f[3];
  std::uint8_t b[6];
  if (mode % 4 == 0) {
    while (take(data, size, d)) points.push_back({d[0], d[1], d[2]});
  } else if (mode % 4 == 1) {
    while (take(data, size, f)) points.push_back({f[0], f[1], f[2]});
  } else if (mode % 4 == 2) {
    for (std::uint8_t c[3]; take(data, size, c);) points.push_back({lattice(c[0]), lattice(c[1]), lattice(c[2])});
  } else {
    while (take(data, size, b)) {
      Vec3 shift{b[3] / 255.0 - 0.5, b[4] / 255.0 - 0.5, b[5] / 255.0 - 0.5};
      points.push_back(Vec3{lattice(b[0]), lattice(b[1]), lattice(b[2])} + shift * noise);
    }
  }
  return points;
}

// The hull meets itself, moved: distance and depth agree with each other and with the way it was moved.
void checkQueries(const Hull& hull, double size) {
  Shape shape;
  shape.type = ShapeType::hull;
  shape.hull = &hull;
  MassProperties mass = shapeMass(shape, 1);
  double rounding = 1e-9 + 1e-15 * size * size * size / hull.volume;  // needles and plates are little of their bounds
  require(std::fabs(mass.mass - hull.volume) <= rounding * hull.volume, "mass is not the volume");
  require(length(mass.centre - hull.centroid) <= rounding * size, "centre of mass is not the centroid");
  for (int axis = 0; axis < 3; axis++) {
    for (double distance : {0.1, 1.5}) {
      Transform pose;
      pose.position[axis] = distance * size;
      DistanceResult apart = shapeDistance(shape, shape, pose);
      double depth = penetrationDepth(shape, shape, pose);
      require(apart.distance <= distance * size, "further apart than it was moved");
      require(apart.distance <= 1e-9 * size || depth <= 2e-6 * size, "apart and overlapping");
      require(distance < 1 || apart.distance > 0.4 * size, "not apart");
      if (apart.distance > 0) {
        require(length(closestPoint(shape, apart.onA) - apart.onA) <= 1e-5 * size, "closest point is off the hull");
      }
    }
  }
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  std::vector<Vec3> points = decode(data, size);
  Result<Hull> hull = buildHull(points);
  std::reverse(points.begin(), points.end());
  Result<Hull> reversed = buildHull(points);
  require(hull.ok() == reversed.ok(), "builds in one order only");
  if (!hull) {
    require(hull.error().code != ErrorCode::none && !hull.error().message.empty(), "an error without a reason");
    require(hull.error().message.find("no clean solid") == std::string::npos, hull.error().message.c_str());
    return 0;
  }
  require(validate(*hull).empty(), "the hull is not valid");
  require(hull->vertices == reversed->vertices && hull->volume == reversed->volume, "the order of points matters");
  Vec3 lower = points[0], upper = lower;
  for (Vec3 p : points) lower = min(lower, p), upper = max(upper, p);
  double extent = length(upper - lower);
  for (Vec3 p : points) {
    for (const HullPlane& plane : hull->planes) {
      require(dot(plane.normal, p) <= plane.offset + 2e-6 * extent, "a point is outside the hull");
    }
  }
  for (Vec3 v : hull->vertices) {
    require(std::find(points.begin(), points.end(), v) != points.end(), "a vertex was not among the points");
  }
  checkQueries(*hull, extent);
  return 0;
}
