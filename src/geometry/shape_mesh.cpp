#include "brickfall/geometry/shape_mesh.h"

#include <algorithm>
#include <numbers>
#include <string>

#include "brickfall/geometry/mesh_tree.h"
#include "geometry/hull.h"

namespace brickfall {

namespace {

std::array<float, 3> toFloats(Vec3 v) { return {float(v.x), float(v.y), float(v.z)}; }

void addVertex(ShapeMesh& mesh, Vec3 position, Vec3 normal, double u, double v) {
  mesh.positions.push_back(toFloats(position));
  mesh.normals.push_back(toFloats(normal));
  mesh.uvs.push_back({float(u), float(v)});
}

// A sphere whose halves are moved apart along y by `halfHeight`: the ring at the equator then comes twice.
ShapeMesh roundMesh(double radius, double halfHeight, RoundDetail detail) {
  const int half = std::clamp(detail.rings, 2, 1024) / 2, rings = 2 * half,
            sectors = std::clamp(detail.sectors, 3, 2048);
  const bool split = halfHeight > 0;
  const int rows = rings + (split ? 1 : 0);
  // Along the surface from the top: quarter circle, side, quarter circle.
  const double meridian = std::numbers::pi * radius + 2 * halfHeight;
  ShapeMesh mesh;
  for (int row = 0; row <= rows; row++) {
    bool upper = split ? row <= half : row < half;
    int ring = split && !upper ? row - 1 : row;
    double polar = std::numbers::pi * ring / rings, ringSine, ringCosine;
    sinCos(polar, ringSine, ringCosine);
    Vec3 shift{0, split ? (upper ? halfHeight : -halfHeight) : 0, 0};
    double v = (polar * radius + (upper || !split ? 0 : 2 * halfHeight)) / meridian;
    for (int k = 0; k <= sectors; k++) {
      double sine, cosine;
      sinCos(2 * std::numbers::pi * (k % sectors) / sectors, sine, cosine);
      Vec3 normal{ringSine * cosine, ringCosine, ringSine * sine};
      if (ring == 0 || ring == rings) normal = {0, ring == 0 ? 1.0 : -1.0, 0};
      addVertex(mesh, normal * radius + shift, normal, double(k) / sectors, v);
    }
  }
  for (int row = 0; row < rows; row++) {
    for (int k = 0; k < sectors; k++) {
      std::uint32_t a = std::uint32_t(row * (sectors + 1) + k), b = a + 1, c = a + std::uint32_t(sectors) + 1,
                    d = c + 1;
      if (row > 0) mesh.indices.insert(mesh.indices.end(), {a, b, c});
      if (row < rows - 1) mesh.indices.insert(mesh.indices.end(), {b, d, c});
    }
  }
  return mesh;
}

// The side has normals of its own, also where it ends in a point; caps are flat.
ShapeMesh turnedMesh(double low, double high, double half, RoundDetail detail) {
  const int sectors = std::clamp(detail.sectors, 3, 2048);
  const double rise = 2 * half, inward = low - high, slant = std::sqrt(rise * rise + inward * inward);
  ShapeMesh mesh;
  auto around = [&](int k) {
    double sine, cosine;
    sinCos(2 * std::numbers::pi * (k % sectors) / sectors, sine, cosine);
    return Vec3{cosine, 0, sine};
  };
  for (int row = 0; row < 2; row++) {
    for (int k = 0; k <= sectors; k++) {
      const Vec3 out = around(k), normal = (out * rise + Vec3{0, inward, 0}) * (1 / slant);
      addVertex(mesh, out * (row == 0 ? high : low) + Vec3{0, row == 0 ? half : -half, 0}, normal, double(k) / sectors,
                row);
    }
  }
  for (std::uint32_t a = 0; a < std::uint32_t(sectors); a++) {
    const std::uint32_t b = a + 1, c = a + std::uint32_t(sectors) + 1, d = c + 1;
    if (high > 0) mesh.indices.insert(mesh.indices.end(), {a, b, c});
    mesh.indices.insert(mesh.indices.end(), {b, d, c});
  }
  for (const double side : {1.0, -1.0}) {
    const double radius = side > 0 ? high : low;
    if (!(radius > 0)) continue;
    const auto first = std::uint32_t(mesh.positions.size());
    for (int k = 0; k < sectors; k++) {
      const Vec3 p = around(k) * radius;
      addVertex(mesh, p + Vec3{0, side * half, 0}, {0, side, 0}, p.x, p.z);
      const std::uint32_t one = first + std::uint32_t(k) - 1, next = first + std::uint32_t(k);
      if (k >= 2 && side > 0) mesh.indices.insert(mesh.indices.end(), {first, next, one});
      if (k >= 2 && side < 0) mesh.indices.insert(mesh.indices.end(), {first, one, next});
    }
  }
  return mesh;
}

Error badLength(const char* field, double found) {
  return {ErrorCode::invalidArgument,
          std::string(field) + ": found " + std::to_string(found) + ", expected a finite length above 0"};
}

bool isLength(double value) { return value > 0 && std::isfinite(value); }

}  // namespace

ShapeMesh boxMesh(Vec3 half) {
  ShapeMesh mesh;
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

ShapeMesh sphereMesh(double radius, RoundDetail detail) { return roundMesh(radius, 0, detail); }
ShapeMesh capsuleMesh(double radius, double halfHeight, RoundDetail detail) {
  return roundMesh(radius, halfHeight, detail);
}

ShapeMesh cylinderMesh(double radius, double halfHeight, RoundDetail detail) {
  return turnedMesh(radius, radius, halfHeight, detail);
}
ShapeMesh coneMesh(double radius, double topRadius, double halfHeight, RoundDetail detail) {
  return turnedMesh(radius, topRadius, halfHeight, detail);
}

Result<ShapeMesh> hullMesh(std::span<const Vec3> vertices) {
  Result<Hull> built = buildHull(vertices);
  if (!built) return built.error();
  const Hull& hull = *built;
  ShapeMesh mesh;
  for (std::size_t f = 0; f < hull.planes.size(); f++) {
    const std::uint16_t start = hull.firstEdge[f];
    const Vec3 normal = hull.planes[f].normal, origin = hull.vertices[hull.edges[start].origin];
    const Vec3 next = hull.vertices[hull.edges[hull.edges[start].next].origin];
    // Along the first edge, and square to it in the face.
    const Vec3 v = normalized(cross(normal, next - origin)), u = cross(v, normal);
    auto first = std::uint32_t(mesh.positions.size());
    std::uint32_t corner = 0;
    std::uint16_t edge = start;
    do {
      Vec3 p = hull.vertices[hull.edges[edge].origin];
      addVertex(mesh, p, normal, dot(p - origin, u), -dot(p - origin, v));
      if (corner >= 2) mesh.indices.insert(mesh.indices.end(), {first, first + corner - 1, first + corner});
      corner++;
      edge = hull.edges[edge].next;
    } while (edge != start);
  }
  return mesh;
}

ShapeMesh planeMesh(double halfSize, double halfDepth) {
  ShapeMesh slab;
  append(slab, boxMesh({halfSize, halfDepth, halfSize}), {{0, -halfDepth, 0}, {}});
  return slab;
}

Result<ShapeMesh> makeShapeMesh(const ShapeDef& shape, RoundDetail detail) {
  switch (shape.type) {
    case ShapeType::box:
      for (int k = 0; k < 3; k++) {
        if (!isLength(shape.halfExtents[k])) return badLength("halfExtents", shape.halfExtents[k]);
      }
      return boxMesh(shape.halfExtents);
    case ShapeType::sphere:
      if (!isLength(shape.radius)) return badLength("radius", shape.radius);
      return sphereMesh(shape.radius, detail);
    case ShapeType::capsule:
      if (!isLength(shape.radius)) return badLength("radius", shape.radius);
      if (!isLength(shape.halfHeight)) return badLength("halfHeight", shape.halfHeight);
      return capsuleMesh(shape.radius, shape.halfHeight, detail);
    case ShapeType::cylinder:
    case ShapeType::cone:
      if (!isLength(shape.radius)) return badLength("radius", shape.radius);
      if (!isLength(shape.halfHeight)) return badLength("halfHeight", shape.halfHeight);
      if (shape.type == ShapeType::cylinder) return cylinderMesh(shape.radius, shape.halfHeight, detail);
      if (shape.topRadius != 0 && !isLength(shape.topRadius)) return badLength("topRadius", shape.topRadius);
      return coneMesh(shape.radius, shape.topRadius, shape.halfHeight, detail);
    case ShapeType::hull:
      return hullMesh(shape.vertices);
    case ShapeType::plane:
      return planeMesh();
    case ShapeType::mesh:
      if (!shape.mesh) return Error{ErrorCode::invalidArgument, "mesh: found none, expected a MeshTree"};
      return surfaceMesh(shape.mesh->mesh());
  }
  return Error{ErrorCode::invalidArgument,
               "type: found " + std::to_string(int(shape.type)) + ", expected a shape type"};
}

void append(ShapeMesh& mesh, const ShapeMesh& part, const Transform& pose) {
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
