// The faces of a convex hull, found by trying the plane of every three points: with 64 points that is 40 000 planes, which
// costs nothing beside writing a file, and leaves no case for a cleverer method to get wrong.
#include <algorithm>
#include <cmath>

#include "output/mesh.h"

namespace brickfall {
namespace {

struct Face {
  Vec3 normal;
  std::vector<int> corners;  // counter-clockwise seen from outside
};

// The corners of points that lie on a plane, around it; those inside or on an edge are dropped.
std::vector<int> outline(const std::vector<Vec3>& points, const std::vector<int>& on, Vec3 normal, double tolerance) {
  Vec3 u = normalized(cross(std::fabs(normal.x) < 0.6 ? Vec3{1, 0, 0} : Vec3{0, 1, 0}, normal)), v = cross(normal, u);
  std::vector<int> order = on;
  std::sort(order.begin(), order.end(), [&](int a, int b) {
    double ua = dot(points[a], u), ub = dot(points[b], u);
    return ua != ub ? ua < ub : dot(points[a], v) < dot(points[b], v);
  });
  // Andrew's monotone chain: the lower half from left to right, then the upper half back.
  std::vector<int> chain;
  auto turn = [&](int a, int b, int c) { return dot(normal, cross(points[b] - points[a], points[c] - points[b])); };
  auto add = [&](int c, std::size_t least) {
    while (chain.size() >= least + 2) {
      int a = chain[chain.size() - 2], b = chain.back();
      if (turn(a, b, c) > tolerance * length(points[c] - points[a])) break;
      chain.pop_back();
    }
    chain.push_back(c);
  };
  for (int c : order) add(c, 0);
  std::size_t least = chain.size() - 1;
  for (std::size_t k = order.size() - 1; k-- > 0;) add(order[k], least);
  chain.pop_back();
  return chain;
}

std::vector<Face> facesOf(const std::vector<Vec3>& points) {
  std::vector<Face> faces;
  double size = 0;
  for (Vec3 p : points) size = std::max(size, length(p - points[0]));
  const double tolerance = 1e-6 * size;
  const int count = int(points.size());
  for (int a = 0; a < count; a++) {
    for (int b = a + 1; b < count; b++) {
      for (int c = b + 1; c < count; c++) {
        Vec3 raw = cross(points[b] - points[a], points[c] - points[a]);
        if (!(length(raw) > tolerance * size)) continue;
        Vec3 normal = normalized(raw);
        double most = 0, least = 0;
        for (Vec3 p : points) {
          double off = dot(normal, p - points[a]);
          most = std::max(most, off);
          least = std::min(least, off);
        }
        if (most > tolerance && least < -tolerance) continue;  // points on both sides: not a face
        if (most - least <= tolerance) return {};              // all in one plane
        if (most > tolerance) normal = -normal;
        bool known = std::any_of(faces.begin(), faces.end(), [&](const Face& f) {
          return dot(f.normal, normal) > 1 - 1e-9 &&
                 std::fabs(dot(f.normal, points[f.corners[0]] - points[a])) <= tolerance;
        });
        if (known) continue;
        std::vector<int> on;
        for (int k = 0; k < count; k++) {
          if (std::fabs(dot(normal, points[k] - points[a])) <= tolerance) on.push_back(k);
        }
        std::vector<int> corners = outline(points, on, normal, tolerance);
        if (corners.size() >= 3) faces.push_back({normal, std::move(corners)});
      }
    }
  }
  return faces;
}

}  // namespace

Mesh hullMesh(const std::vector<Vec3>& vertices) {
  Mesh mesh;
  if (vertices.size() < 4) return mesh;
  for (const Face& face : facesOf(vertices)) {
    auto first = std::uint32_t(mesh.positions.size());
    Vec3 origin = vertices[face.corners[0]], u = normalized(vertices[face.corners[1]] - origin),
         v = cross(face.normal, u);
    for (std::size_t k = 0; k < face.corners.size(); k++) {
      Vec3 p = vertices[face.corners[k]];
      mesh.positions.push_back({float(p.x), float(p.y), float(p.z)});
      mesh.normals.push_back({float(face.normal.x), float(face.normal.y), float(face.normal.z)});
      mesh.uvs.push_back({float(dot(p - origin, u)), float(-dot(p - origin, v))});
      auto corner = std::uint32_t(k);
      if (k >= 2) mesh.indices.insert(mesh.indices.end(), {first, first + corner - 1, first + corner});
    }
  }
  return mesh;
}

}  // namespace brickfall
