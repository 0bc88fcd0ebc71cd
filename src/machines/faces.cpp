#include "machines/faces.h"

#include <algorithm>

#include "brickfall/geometry/shape_mesh.h"

namespace brickfall::machines {

namespace {

constexpr RoundDetail kCoarse{6, 12};
// A ball's flat pieces are grown until they have its surface, a disc's until they have its area: cut into it, they take
// 6 % and 5 % less of a wind or a blast.
constexpr double kBallGrows = 1.0293, kDiscGrows = 1.0233;

Result<ShapeMesh> meshOf(const ShapeDef& shape) {
  const bool ball = shape.type == ShapeType::sphere || shape.type == ShapeType::capsule,
             turned = shape.type == ShapeType::cylinder || shape.type == ShapeType::cone;
  if (!ball && !turned) return makeShapeMesh(shape, kCoarse);
  ShapeDef grown = shape;
  grown.radius *= ball ? kBallGrows : kDiscGrows;
  grown.topRadius *= kDiscGrows;
  return makeShapeMesh(grown, kCoarse);
}

}  // namespace

void appendFaces(const ShapeDef& shape, const Transform& pose, std::vector<Face>& out) {
  if (shape.sensor) return;
  const Result<ShapeMesh> mesh = meshOf(shape);
  if (!mesh) return;
  const Transform all = pose * shape.local;
  const auto corner = [&](std::size_t k) {
    const auto& p = mesh->positions[mesh->indices[k]];
    return transformPoint(all, Vec3{double(p[0]), double(p[1]), double(p[2])});
  };
  for (std::size_t k = 0; k + 2 < mesh->indices.size(); k += 3)
    out.push_back({{corner(k), corner(k + 1), corner(k + 2)}});
}

// A shape that moves is convex: it never stands before its own faces, though the flat pieces of a round one lie in it.
bool meets(const World& world, ShapeId own, Vec3 origin, Vec3 direction, double farthest) {
  const auto hit = world.castRay(origin, direction, farthest);
  if (!hit || !hit->has_value()) return false;
  if ((*hit)->shape != own) return true;
  const auto all = world.castRayAll(origin, direction, farthest);
  return all && std::any_of(all->begin(), all->end(), [own](const RayHit& h) { return h.shape != own; });
}

}  // namespace brickfall::machines
