#include "machines/faces.h"

#include "brickfall/geometry/shape_mesh.h"

namespace brickfall::machines {

void appendFaces(const ShapeDef& shape, const Transform& pose, std::vector<Face>& out) {
  const Result<ShapeMesh> mesh = makeShapeMesh(shape, {6, 12});
  if (!mesh) return;
  const Transform all = pose * shape.local;
  const auto corner = [&](std::size_t k) {
    const auto& p = mesh->positions[mesh->indices[k]];
    return transformPoint(all, Vec3{double(p[0]), double(p[1]), double(p[2])});
  };
  for (std::size_t k = 0; k + 2 < mesh->indices.size(); k += 3)
    out.push_back({{corner(k), corner(k + 1), corner(k + 2)}});
}

bool meets(const World& world, Vec3 origin, Vec3 direction, double farthest) {
  const auto hit = world.castRay(origin, direction, farthest);
  return hit && hit->has_value();
}

}  // namespace brickfall::machines
