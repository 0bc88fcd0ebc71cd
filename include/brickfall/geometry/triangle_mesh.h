// Surfaces of triangles. A TriangleMesh is checked when it is made and never changed afterwards, so that shapes, worlds and
// threads may share it. Usable without a World.
#pragma once
#include <cstdint>
#include <span>
#include <vector>

#include "brickfall/math.h"
#include "brickfall/result.h"

namespace brickfall {

struct Triangle {
  Vec3 corner[3];  // counter-clockwise seen from the front
};

// What create() found and did. A mesh that others made is seldom perfect: none of this is an error.
struct MeshReport {
  int mergedVertices = 0;       // vertices at exactly the place of an earlier one: made one with it
  int unusedVertices = 0;       // named by no triangle that was kept: dropped
  int degenerateTriangles = 0;  // lower than 1e-10 of their longest edge: dropped
  int doubledTriangles = 0;     // same corners, same front as an earlier one: dropped
  int openEdges = 0;            // with one triangle
  int oddEdges = 0;  // with more than two triangles, or with two whose fronts do not agree; they count as open
  bool closed() const { return openEdges == 0 && oddEdges == 0; }
};

constexpr std::uint32_t kNoTriangle = 0xffffffffu;

class TriangleMesh {
 public:
  static constexpr std::size_t kMaxVertices = 1u << 24, kMaxTriangles = 1u << 23;
  static constexpr double kLargestCoordinate = 1e6;  // m

  // Three indices a triangle, counter-clockwise seen from the front. Errors (naming the vertex or index): a coordinate not
  // finite or beyond kLargestCoordinate, a count of indices that is no multiple of three, an index without a vertex, too
  // many of either, no triangle left after dropping.
  static Result<TriangleMesh> create(std::span<const Vec3> vertices, std::span<const std::uint32_t> indices);

  struct Face {
    std::uint32_t vertex[3];
    std::uint32_t source = 0;  // number of the triangle as given
  };

  const std::vector<Vec3>& vertices() const { return vertices_; }
  const std::vector<Face>& faces() const { return faces_; }
  std::size_t count() const { return faces_.size(); }
  const MeshReport& report() const { return report_; }
  const Aabb& bounds() const { return bounds_; }

  Triangle triangle(std::uint32_t face) const {
    const Face& f = faces_[face];
    return {{vertices_[f.vertex[0]], vertices_[f.vertex[1]], vertices_[f.vertex[2]]}};
  }
  Vec3 normal(std::uint32_t face) const {
    Triangle t = triangle(face);
    return normalized(cross(t.corner[1] - t.corner[0], t.corner[2] - t.corner[0]));
  }
  // The face across the edge from corner k to corner (k + 1) % 3; kNoTriangle where the surface ends.
  std::uint32_t neighbour(std::uint32_t face, int k) const {
    return neighbours_[3 * std::size_t(face) + std::size_t(k)];
  }
  // Vertices joined to this one by an edge, ascending.
  std::span<const std::uint32_t> around(std::uint32_t vertex) const {
    return {ring_.data() + ringStart_[vertex], ring_.data() + ringStart_[vertex + 1]};
  }

 private:
  TriangleMesh() = default;
  void takeFaces(std::span<const Vec3> given, std::span<const std::uint32_t> indices);
  void dropUnused();
  void connect();

  std::vector<Vec3> vertices_;
  std::vector<Face> faces_;
  std::vector<std::uint32_t> neighbours_;  // three a face
  std::vector<std::uint32_t> ring_;        // of all vertices, one after the other
  std::vector<std::uint32_t> ringStart_;
  MeshReport report_;
  Aabb bounds_;
};

// --- Two triangles, and a triangle and a point. Double precision; corners in one frame.

// Whether they share a point. Touching counts: "no" is only said if an axis proves a gap of more than 1e-13 of their size
// (largest coordinate difference). Coplanar and needle-like triangles are fine.
bool trianglesOverlap(const Triangle& a, const Triangle& b);

struct TriangleDistance {
  double distance = 0;  // m, 0 when they overlap
  Vec3 onA, onB;        // closest points; a common point when they overlap
};
TriangleDistance triangleDistance(const Triangle& a, const Triangle& b);

// Where on a triangle: inside, on the edge from corner `index` on, or at corner `index`.
enum class TrianglePart : std::uint8_t { face, edge, corner };
struct TrianglePoint {
  Vec3 point;
  TrianglePart part = TrianglePart::face;
  int index = 0;
};
TrianglePoint closestPoint(const Triangle& triangle, Vec3 point);

}  // namespace brickfall
