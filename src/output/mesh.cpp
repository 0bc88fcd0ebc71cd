#include "output/mesh.h"

#include <numbers>

namespace brickfall {
namespace {

constexpr int kRings = 16, kSectors = 32;  // of a round shape: half of the rings above, half below

std::array<float, 3> toFloats(Vec3 v) { return {float(v.x), float(v.y), float(v.z)}; }

void addVertex(Mesh& mesh, Vec3 position, Vec3 normal, double u, double v) {
  mesh.positions.push_back(toFloats(position));
  mesh.normals.push_back(toFloats(normal));
  mesh.uvs.push_back({float(u), float(v)});
}

// A sphere whose halves are moved apart along y by `halfHeight`: the ring at the equator then comes twice.
Mesh roundMesh(double radius, double halfHeight) {
  Mesh mesh;
  bool split = halfHeight > 0;
  int rows = kRings + (split ? 1 : 0);
  for (int row = 0; row <= rows; row++) {
    bool upper = split ? row <= kRings / 2 : row < kRings / 2;
    int ring = split && !upper ? row - 1 : row;
    double polar = std::numbers::pi * ring / kRings;
    for (int k = 0; k <= kSectors; k++) {
      double around = 2 * std::numbers::pi * k / kSectors;
      Vec3 normal{std::sin(polar) * std::cos(around), std::cos(polar), std::sin(polar) * std::sin(around)};
      if (ring == 0 || ring == kRings) normal = {0, ring == 0 ? 1.0 : -1.0, 0};
      Vec3 shift{0, split ? (upper ? halfHeight : -halfHeight) : 0, 0};
      addVertex(mesh, normal * radius + shift, normal, double(k) / kSectors, double(row) / rows);
    }
  }
  for (int row = 0; row < rows; row++) {
    for (int k = 0; k < kSectors; k++) {
      std::uint32_t a = std::uint32_t(row * (kSectors + 1) + k), b = a + 1, c = a + kSectors + 1, d = c + 1;
      if (row > 0) mesh.indices.insert(mesh.indices.end(), {a, b, c});
      if (row < rows - 1) mesh.indices.insert(mesh.indices.end(), {b, d, c});
    }
  }
  return mesh;
}

}  // namespace

Mesh boxMesh(Vec3 half) {
  Mesh mesh;
  for (int axis = 0; axis < 3; axis++) {
    int u = (axis + 1) % 3, v = (axis + 2) % 3;
    for (double side : {1.0, -1.0}) {
      auto first = std::uint32_t(mesh.positions.size());
      Vec3 normal;
      normal[axis] = side;
      for (int corner = 0; corner < 4; corner++) {
        double along = corner == 1 || corner == 2 ? 1 : -1, up = corner >= 2 ? 1 : -1;
        Vec3 position = normal * half[axis];
        position[u] = along * side * half[u];  // mirrored on the far side: keeps the corners counter-clockwise
        position[v] = up * half[v];
        addVertex(mesh, position, normal, (along + 1) * half[u], (1 - up) * half[v]);
      }
      mesh.indices.insert(mesh.indices.end(), {first, first + 1, first + 2, first, first + 2, first + 3});
    }
  }
  return mesh;
}

Mesh sphereMesh(double radius) { return roundMesh(radius, 0); }
Mesh capsuleMesh(double radius, double halfHeight) { return roundMesh(radius, halfHeight); }

Mesh meshOf(const ShapeDef& shape) {
  switch (shape.type) {
    case ShapeType::box:
      return boxMesh(shape.halfExtents);
    case ShapeType::sphere:
      return sphereMesh(shape.radius);
    case ShapeType::capsule:
      return capsuleMesh(shape.radius, shape.halfHeight);
    case ShapeType::hull:
      return hullMesh(shape.vertices);
    case ShapeType::plane:
      break;
  }
  Mesh slab;
  append(slab, boxMesh({kPlaneHalfSize, kPlaneHalfDepth, kPlaneHalfSize}), {{0, -kPlaneHalfDepth, 0}, {}});
  return slab;
}

void append(Mesh& mesh, const Mesh& part, const Transform& pose) {
  auto first = std::uint32_t(mesh.positions.size());
  for (std::size_t k = 0; k < part.positions.size(); k++) {
    const auto &p = part.positions[k], &n = part.normals[k];
    mesh.positions.push_back(toFloats(transformPoint(pose, {p[0], p[1], p[2]})));
    mesh.normals.push_back(toFloats(normalized(rotate(pose.rotation, Vec3{n[0], n[1], n[2]}))));
    mesh.uvs.push_back(part.uvs[k]);
  }
  for (std::uint32_t index : part.indices) mesh.indices.push_back(first + index);
}

}  // namespace brickfall
