#include "viewer_window/silhouette.h"

#include <array>
#include <map>

namespace brickfall::viewer {

ShadowShape::ShadowShape(const DrawMesh& mesh) {
  std::map<std::array<float, 3>, std::uint32_t> known;
  std::vector<std::uint32_t> cornerOf;
  for (const auto& position : mesh.positions) {
    const auto [at, isNew] = known.try_emplace(position, std::uint32_t(corners_.size()));
    if (isNew) corners_.push_back({position[0], position[1], position[2]});
    cornerOf.push_back(at->second);
  }
  addFaces(mesh, cornerOf);
  findEdges();
}

void ShadowShape::addFaces(const DrawMesh& mesh, const std::vector<std::uint32_t>& cornerOf) {
  for (std::size_t i = 0; i + 2 < mesh.indices.size(); i += 3) {
    Face face;
    for (int k = 0; k < 3; k++) face.corners[k] = cornerOf[mesh.indices[i + k]];
    const Vec3 a = corners_[face.corners[0]];
    face.normal = cross(corners_[face.corners[1]] - a, corners_[face.corners[2]] - a);
    // At the poles of round shapes triangles shrink to lines: their neighbours touch without them.
    if (face.corners[0] == face.corners[1] || face.corners[1] == face.corners[2] ||
        face.corners[2] == face.corners[0]) {
      continue;
    }
    faces_.push_back(face);
  }
}

void ShadowShape::findEdges() {
  std::map<std::pair<std::uint32_t, std::uint32_t>, std::uint32_t> open;  // by its ends as the first face runs
  for (std::uint32_t f = 0; f < faces_.size(); f++) {
    for (int k = 0; k < 3; k++) {
      const std::uint32_t from = faces_[f].corners[k], to = faces_[f].corners[(k + 1) % 3];
      const auto partner = open.find({to, from});
      if (partner != open.end()) {
        edges_.push_back({to, from, partner->second, f});
        open.erase(partner);
      } else if (!open.try_emplace({from, to}, f).second) {
        closed_ = false;  // three faces at one edge
      }
    }
  }
  closed_ = closed_ && open.empty();
}

void ShadowGeometry::clear() {
  vertices_.assign(1, VolumeVertex{0, 0, 0, 0});
  sides_.clear();
  caps_.clear();
}

void ShadowGeometry::add(const ShadowShape& shape, const Transform& pose, Vec3 scale, Vec3 towardsSun) {
  if (!shape.closed()) return;
  if (vertices_.empty()) clear();
  const auto first = std::uint32_t(vertices_.size());
  for (const Vec3 corner : shape.corners()) {
    const Vec3 at = transformPoint(pose, scaled(corner, scale));
    vertices_.push_back({float(at.x), float(at.y), float(at.z), 1});
  }
  // Normals go by the inverse scale: so does the direction that they are compared with.
  const Vec3 sun = rotate(conjugate(pose.rotation), towardsSun);
  const Vec3 local{sun.x / scale.x, sun.y / scale.y, sun.z / scale.z};
  lit_.resize(shape.faces().size());
  for (std::size_t f = 0; f < lit_.size(); f++) {
    const ShadowShape::Face& face = shape.faces()[f];
    lit_[f] = dot(face.normal, local) > 0;
    if (!lit_[f]) continue;
    for (const std::uint32_t corner : face.corners) caps_.push_back(first + corner);
  }
  for (const ShadowShape::Edge& edge : shape.edges()) {
    if (lit_[edge.faceA] == lit_[edge.faceB]) continue;
    const std::uint32_t from = lit_[edge.faceA] ? edge.from : edge.to, to = lit_[edge.faceA] ? edge.to : edge.from;
    sides_.insert(sides_.end(), {first + to, first + from, 0u});
  }
}

}  // namespace brickfall::viewer
