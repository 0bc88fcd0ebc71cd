// Contacts of a convex shape with a triangle mesh. One shape may lean on differently sloped triangles at once, so there can be
// several manifolds: one for each direction in which the surface pushes.
//
// A mesh is a surface, not a solid: it pushes towards the front of its faces, and only shapes whose centre is in front of a
// face feel it. What is further behind moves freely.
#pragma once
#include <cstdint>
#include <span>
#include <vector>

#include "geometry/hull.h"
#include "geometry/shape.h"
#include "narrowphase/manifold.h"
#include "narrowphase/mesh_face.h"

namespace brickfall {

constexpr int kMaxMeshManifolds = 8;

// What the search needs for itself; kept from call to call so that memory is taken once.
struct MeshScratch {
  std::vector<std::uint32_t> faces;
  std::vector<MeshContactPoint> points;
  Hull triangle;  // of cylinders and cones: a face as a shape

  MeshScratch() { triangle.vertices.resize(3), triangle.edges.resize(6), triangle.planes.resize(2); }
};

struct MeshManifolds {
  Manifold list[kMaxMeshManifolds];  // nearest first; of every two the normals differ by more than 2.5 degrees
  int count = 0;
};

inline bool isMeshPair(const Shape& a, const Shape& b) {
  return a.type == ShapeType::mesh || b.type == ShapeType::mesh;
}

// As collide() in collide.h; exactly one of the two is a mesh. Two meshes or a mesh and a plane: nothing. `loaded`: of all
// manifolds of the pair; only a cylinder or cone, whose cap has more points than others, asks for it.
void collideMesh(const Shape& a, const Shape& b, const Transform& bInA, double margin, MeshScratch& scratch,
                 MeshManifolds& out, std::span<const std::uint32_t> loaded = {});

// Points of one face, in the frame of the mesh, nearer than `margin`.
// A ball of `radius` around the segment from `start` to `end` (a sphere: both the same).
void collideFaceRound(const MeshFace& face, Vec3 start, Vec3 end, double radius, double margin,
                      std::vector<MeshContactPoint>& out);
struct HullView;
void collideFaceHull(const MeshFace& face, const HullView& hull, double margin, std::vector<MeshContactPoint>& out);
// A cylinder or cone.
void collideFaceFrustum(const MeshFace& face, const Shape& shape, const Transform& pose, double margin, Hull& triangle,
                        std::vector<MeshContactPoint>& out);

// Sorts points into manifolds of up to four points by their normals. Frame and sides as the points have them.
void gatherPoints(std::vector<MeshContactPoint>& points, double size, MeshManifolds& out);
// Likewise, for a cap: of the outermost points those that carry already are kept, and what it would tip onto.
void gatherCapPoints(std::vector<MeshContactPoint>& points, double size, std::span<const std::uint32_t> loaded,
                     MeshManifolds& out);

}  // namespace brickfall
