// A triangle mesh as drawn: vertices share a normal where the surface is smooth, and have one for each face at sharp edges.
#include "brickfall/geometry/mesh_tree.h"
#include "brickfall/geometry/shape_mesh.h"

namespace brickfall {

namespace {

constexpr double kSharp = 0.766;  // cosine of 40 degrees between a face and the mean around its corner

// The two coordinates across the axis along which the normal is longest.
std::array<float, 2> textureOf(Vec3 p, Vec3 n) {
  Vec3 size = abs(n);
  if (size.y >= size.x && size.y >= size.z) return {float(p.x), float(p.z)};
  return size.x >= size.z ? std::array<float, 2>{float(p.z), float(-p.y)}
                          : std::array<float, 2>{float(p.x), float(-p.y)};
}

}  // namespace

ShapeMesh surfaceMesh(const TriangleMesh& mesh) {
  ShapeMesh out;
  std::vector<Vec3> mean(mesh.vertices().size());
  for (std::uint32_t f = 0; f < mesh.count(); f++) {
    Triangle t = mesh.triangle(f);
    Vec3 weighted = cross(t.corner[1] - t.corner[0], t.corner[2] - t.corner[0]);
    for (std::uint32_t v : mesh.faces()[f].vertex) mean[v] += weighted;
  }
  auto add = [&](Vec3 p, Vec3 n) {
    out.positions.push_back({float(p.x), float(p.y), float(p.z)});
    out.normals.push_back({float(n.x), float(n.y), float(n.z)});
    out.uvs.push_back(textureOf(p, n));
    return std::uint32_t(out.positions.size() - 1);
  };
  constexpr std::uint32_t kNone = 0xffffffffu;
  std::vector<std::uint32_t> shared(mean.size(), kNone);
  for (std::uint32_t f = 0; f < mesh.count(); f++) {
    Vec3 normal = mesh.normal(f);
    for (std::uint32_t v : mesh.faces()[f].vertex) {
      Vec3 smooth = normalized(mean[v]);
      if (!(dot(smooth, normal) > kSharp)) {
        out.indices.push_back(add(mesh.vertices()[v], normal));
        continue;
      }
      if (shared[v] == kNone) shared[v] = add(mesh.vertices()[v], smooth);
      out.indices.push_back(shared[v]);
    }
  }
  return out;
}

}  // namespace brickfall
