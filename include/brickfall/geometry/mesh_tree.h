// A tree of oriented boxes over a triangle mesh (S. Gottschalk, M. C. Lin, D. Manocha, "OBBTree: A Hierarchical Structure for
// Rapid Interference Detection", SIGGRAPH 1996): built once, then asked which triangles of two meshes meet, how far apart two
// meshes are, where a ray hits. Usable without a World. Immutable: may be shared between shapes, worlds and threads.
//
// Boxes only decide what to skip and are kept in single precision, a little larger than they need be; every answer comes from
// the triangles, in double precision.
#pragma once
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "brickfall/geometry/obb.h"
#include "brickfall/geometry/triangle_mesh.h"
#include "brickfall/math.h"

namespace brickfall {

// Faces of two meshes.
struct FacePair {
  std::uint32_t a = 0, b = 0;
  auto operator<=>(const FacePair&) const = default;
};

struct MeshDistance {
  double distance = 0;  // m, 0 when touching or overlapping
  Vec3 onA, onB;        // closest points (a common one when overlapping), frame of a
  FacePair faces;       // of which they are
};

struct MeshRayHit {
  Vec3 point, normal;   // normal unit, towards the ray's origin
  double distance = 0;  // m along the ray
  std::uint32_t face = 0;
  bool front = true;  // met from its front
};

struct MeshPoint {
  Vec3 point;
  double distance = 0;  // m
  std::uint32_t face = 0;
  TrianglePart part = TrianglePart::face;
  int index = 0;  // of edge or corner
};

// How much work a query was.
struct MeshQueryCost {
  std::int64_t boxTests = 0, triangleTests = 0;
};

class MeshTree {
 public:
  // Covariance of the triangles' surfaces gives a box's axes; faces are parted at the mean along the longest axis that
  // parts them. O(n log n); the same bits on every platform.
  static MeshTree build(TriangleMesh mesh);

  const TriangleMesh& mesh() const { return mesh_; }
  const Aabb& bounds() const { return mesh_.bounds(); }
  int boxCount() const { return int(nodes_.size()); }
  int height() const { return height_; }
  Obb box(int index) const;      // 0 is the root
  std::string validate() const;  // every invariant; empty text = all hold

  // Faces whose boxes meet this one (frame of the mesh), ascending: all that reach into it, and some that come near.
  void facesNear(const Aabb& box, std::vector<std::uint32_t>& out) const;
  // The nearest point within maxDistance; of equally near faces the first.
  std::optional<MeshPoint> closestPoint(Vec3 point, double maxDistance) const;
  // direction: unit. The first face met, from either side; of equally near ones the first. A ray through a common edge or
  // corner does not slip between.
  std::optional<MeshRayHit> castRay(Vec3 origin, Vec3 direction, double maxDistance) const;

  // Single-precision box, a cache line: axes and centre by component (lane k < 3: axis k, lane 3: centre).
  struct alignas(16) Node {
    float x[4], y[4], z[4];
    float half[3];
    std::int32_t child = 0;  // the first of two children, or ~place of a leaf's triangle
  };
  const std::vector<Node>& nodes() const { return nodes_; }
  // Triangles in the order of the leaves, and which face each is.
  const std::vector<Triangle>& leafTriangles() const { return triangles_; }
  const std::vector<std::uint32_t>& leafFaces() const { return order_; }
  Vec3 middle() const { return middle_; }  // origin of the boxes' coordinates, frame of the mesh
  double radius() const { return radius_; }

 private:
  explicit MeshTree(TriangleMesh mesh) : mesh_(std::move(mesh)) {}

  TriangleMesh mesh_;
  std::vector<Node> nodes_;
  std::vector<Triangle> triangles_;
  std::vector<std::uint32_t> order_;
  Vec3 middle_;
  double radius_ = 0;  // m, of all vertices about the middle
  int height_ = 0;
};

// All pairs of faces that share a point (as trianglesOverlap says), ascending. bInA: pose of b in the frame of a.
std::vector<FacePair> overlappingFaces(const MeshTree& a, const MeshTree& b, const Transform& bInA,
                                       MeshQueryCost* cost = nullptr);
// One such pair, or nothing. Which one is the same on every platform.
std::optional<FacePair> firstOverlap(const MeshTree& a, const MeshTree& b, const Transform& bInA,
                                     MeshQueryCost* cost = nullptr);
// Distance of the two surfaces. A solid inside another one has a distance, too: that of their surfaces.
MeshDistance meshDistance(const MeshTree& a, const MeshTree& b, const Transform& bInA, MeshQueryCost* cost = nullptr);

}  // namespace brickfall
