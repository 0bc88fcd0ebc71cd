// One face of a mesh as the contact functions see it, and what its neighbours allow.
//
// A shape that slides over a flat floor must not feel the edges between its triangles. A triangle alone would push sideways at
// its edges; as a part of a surface it may push only along directions in which no neighbour is in the way: at a corner those
// along which the corner is the highest point of the surface around it, at an edge those along which both faces beside it
// fall away. That leaves a flat or hollow edge nothing but the faces' own normals, and a ridge the directions between them.
#pragma once
#include <cstdint>
#include <vector>

#include "brickfall/geometry/triangle_mesh.h"
#include "narrowphase/manifold.h"

namespace brickfall {

class MeshFace {
 public:
  MeshFace(const TriangleMesh& mesh, std::uint32_t face);

  Vec3 corner(int k) const { return corner_[k]; }
  Vec3 edge(int k) const { return corner_[(k + 1) % 3] - corner_[k]; }
  Vec3 normal() const { return normal_; }
  Vec3 outward(int k) const { return outward_[k]; }  // unit, in the plane, across edge k
  double height(Vec3 p) const { return dot(normal_, p - corner_[0]); }
  bool under(Vec3 p, double slack) const;  // the foot of p is on the triangle
  // Whether the surface lets something be pushed along `direction` (unit) by this corner or edge.
  bool cornerPushes(int k, Vec3 direction) const;
  bool edgePushes(int k, Vec3 direction) const;
  std::uint32_t name(int part) const { return face_ * 4 + std::uint32_t(part); }

 private:
  const TriangleMesh& mesh_;
  std::uint32_t face_;
  Vec3 corner_[3], normal_, outward_[3];
};

// A point of contact with one face. normal: unit, from the mesh to the shape; onShape - onMesh = separation * normal.
struct MeshContactPoint {
  Vec3 normal;
  Vec3 onMesh, onShape;
  double separation = 0;
  std::uint32_t feature = 0;
  bool wanders = false;  // no fixed place of a cylinder or cone
};

}  // namespace brickfall
