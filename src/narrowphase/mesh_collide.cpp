// Finds the faces near a shape and collects what each of them says.
#include "narrowphase/mesh_collide.h"

#include "brickfall/geometry/mesh_tree.h"
#include "geometry/core.h"
#include "geometry/frustum.h"
#include "narrowphase/hull_view.h"

namespace brickfall {

namespace {

void collectPoints(const MeshTree& tree, const Shape& shape, const Transform& pose, double margin,
                   MeshScratch& scratch) {
  scratch.points.clear();
  tree.facesNear(grown(bounds(shape, pose), margin), scratch.faces);
  if (scratch.faces.empty()) return;
  if (isRound(shape.type)) {
    Vec3 tip = shape.type == ShapeType::capsule ? rotate(pose.rotation, Vec3{0, shape.halfHeight, 0}) : Vec3{};
    for (std::uint32_t f : scratch.faces)
      collideFaceRound(MeshFace(tree.mesh(), f), pose.position - tip, pose.position + tip, shape.radius, margin,
                       scratch.points);
  } else if (isFrustum(shape.type)) {
    for (std::uint32_t f : scratch.faces)
      collideFaceFrustum(MeshFace(tree.mesh(), f), shape, pose, margin, scratch.triangle, scratch.points);
  } else {
    HullStorage storage;
    HullView hull = viewOf(shape, pose, storage);
    for (std::uint32_t f : scratch.faces) collideFaceHull(MeshFace(tree.mesh(), f), hull, margin, scratch.points);
  }
}

}  // namespace

void collideMesh(const Shape& a, const Shape& b, const Transform& bInA, double margin, MeshScratch& scratch,
                 MeshManifolds& out, std::span<const std::uint32_t> loaded) {
  out.count = 0;
  bool meshFirst = a.type == ShapeType::mesh;
  const Shape &mesh = meshFirst ? a : b, &shape = meshFirst ? b : a;
  if (shape.type == ShapeType::mesh || shape.type == ShapeType::plane) return;
  collectPoints(*mesh.mesh, shape, meshFirst ? bInA : inverse(bInA), margin, scratch);
  if (isFrustum(shape.type))
    gatherCapPoints(scratch.points, innerRadius(shape), loaded, out);
  else
    gatherPoints(scratch.points, innerRadius(shape), out);
  if (meshFirst) return;
  // Found in the frame of b, from b to a: as seen from a.
  Mat3 turn = toMatrix(bInA.rotation);
  for (int n = 0; n < out.count; n++) {
    Manifold& m = out.list[n];
    m.normal = -(turn * m.normal);
    for (int i = 0; i < m.count; i++) {
      ManifoldPoint& p = m.points[i];
      Vec3 onB = turn * p.onA + bInA.position;
      p.onA = onB - m.normal * p.separation;
      p.onB = onB;
    }
  }
}

}  // namespace brickfall
