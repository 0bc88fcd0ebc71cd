#include "narrowphase/mesh_face.h"

namespace brickfall {

namespace {

constexpr double kFlat = 1e-5;  // sine up to which a neighbour counts as flush

bool isAbove(Vec3 direction, Vec3 along) { return dot(direction, along) > kFlat * length(along); }

}  // namespace

MeshFace::MeshFace(const TriangleMesh& mesh, std::uint32_t face) : mesh_(mesh), face_(face) {
  Triangle t = mesh.triangle(face);
  for (int k = 0; k < 3; k++) corner_[k] = t.corner[k];
  normal_ = normalized(cross(edge(0), edge(1)));
  for (int k = 0; k < 3; k++) outward_[k] = normalized(cross(edge(k), normal_));
}

bool MeshFace::under(Vec3 p, double slack) const {
  for (int k = 0; k < 3; k++)
    if (dot(outward_[k], p - corner_[k]) > slack) return false;
  return true;
}

bool MeshFace::cornerPushes(int k, Vec3 direction) const {
  if (dot(direction, normal_) < -kFlat) return false;
  for (std::uint32_t v : mesh_.around(mesh_.faces()[face_].vertex[k]))
    if (isAbove(direction, mesh_.vertices()[v] - corner_[k])) return false;
  return true;
}

bool MeshFace::edgePushes(int k, Vec3 direction) const {
  if (dot(direction, normal_) < -kFlat || dot(direction, outward_[k]) < -kFlat) return false;
  std::uint32_t other = mesh_.neighbour(face_, k);
  if (other == kNoTriangle) return true;
  // The corner of the neighbour that is not on the edge.
  const TriangleMesh::Face& face = mesh_.faces()[face_];
  for (std::uint32_t v : mesh_.faces()[other].vertex) {
    if (v == face.vertex[k] || v == face.vertex[(k + 1) % 3]) continue;
    Vec3 e = edge(k), along = mesh_.vertices()[v] - corner_[k];
    along -= e * (dot(e, along) / lengthSquared(e));
    if (isAbove(direction, along)) return false;
  }
  return true;
}

}  // namespace brickfall
