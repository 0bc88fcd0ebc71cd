#include "viewer_window/silhouette.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>

namespace brickfall::viewer {

ShadowShape::ShadowShape(const DrawMesh& mesh) {
  std::map<std::array<float, 3>, std::uint32_t> known;
  std::vector<std::uint32_t> cornerOf;
  for (const auto& position : mesh.positions) {
    const auto [at, isNew] = known.try_emplace(position, std::uint32_t(corners_.size()));
    if (isNew) corners_.push_back({position[0], position[1], position[2]});
    cornerOf.push_back(at->second);
    for (int k = 0; k < 3; k++) half_[k] = std::max(half_[k], std::fabs(double(position[std::size_t(k)])));
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

void ShadowGeometry::add(const ShadowShape& shape, const Transform& pose, Vec3 scale, Vec3 towardsSun,
                         double sharpened) {
  if (!shape.closed()) return;
  if (vertices_.empty()) clear();
  const auto first = std::uint32_t(vertices_.size());
  const Vec3 half = shape.half();
  const auto drawnOut = [sharpened](double at, double most) {
    return std::copysign(std::min(std::fabs(at) + sharpened, most), at);
  };
  for (Vec3 corner : shape.corners()) {
    if (sharpened > 0) corner = {drawnOut(corner.x, half.x), drawnOut(corner.y, half.y), drawnOut(corner.z, half.z)};
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

void ShadowGeometry::addBall(Vec3 middle, double radius, Vec3 towardsSun) {
  if (vertices_.empty()) clear();
  constexpr int kSides = 32;
  constexpr double kStep = 2 * 3.14159265358979323846 / kSides;
  const Vec3 aside = std::fabs(towardsSun.y) < 0.9 ? Vec3{0, 1, 0} : Vec3{1, 0, 0};
  const Vec3 right = normalized(cross(aside, towardsSun)), up = cross(towardsSun, right);
  // Around the circle: none of the ball's far half may stick out of it.
  const double reach = radius / std::cos(kStep / 2);
  const auto first = std::uint32_t(vertices_.size());
  for (int i = 0; i < kSides; i++) {
    double sine = 0, cosine = 0;
    sinCos(kStep * i, sine, cosine);
    const Vec3 at = middle + (right * cosine + up * sine) * reach;
    vertices_.push_back({float(at.x), float(at.y), float(at.z), 1});
    const std::uint32_t here = first + std::uint32_t(i), next = first + std::uint32_t((i + 1) % kSides);
    if (i > 0 && i + 1 < kSides) caps_.insert(caps_.end(), {first, here, next});
    sides_.insert(sides_.end(), {next, here, 0u});
  }
}

}  // namespace brickfall::viewer
