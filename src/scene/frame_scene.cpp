// A camera for scenes without one: in front, a little to the right and from above, far enough to see all of it.
#include <algorithm>

#include "scene/body_bounds.h"
#include "scene/scene_build.h"

namespace brickfall::scene {

namespace {

Aabb wallBounds(const WallDef& wall) {
  ShapeDef shape;
  double height = wall.courses * (wall.brick.size.y + wall.bedJoint);
  shape.halfExtents = Vec3{wallLength(wall), height, wallThickness(wall)} * 0.5;
  shape.local.position = {shape.halfExtents.x, shape.halfExtents.y, 0};
  return bounds(shape, {wall.position, rotationFromDegrees({0, wall.yawDegrees, 0})});
}

// Of one that is no plain box: where its bricks lie.
Aabb boundsOf(const WallDef& wall, std::uint64_t seed) {
  const bool plain = wall.path.empty() && wall.radius == 0 && wall.piers.empty() && !(wall.gableDegrees > 0);
  const Result<std::vector<BrickPlacement>> bricks =
      plain ? Result<std::vector<BrickPlacement>>(std::vector<BrickPlacement>{}) : layBricks(wall, seed);
  if (!bricks || bricks->empty()) return wallBounds(wall);
  Aabb all{bricks->front().centre, bricks->front().centre};
  for (const BrickPlacement& brick : *bricks) {
    const double reach = 0.5 * length(brick.size);
    all = merged(all, {brick.centre - Vec3{reach, reach, reach}, brick.centre + Vec3{reach, reach, reach}});
  }
  return all;
}

// A plane has no end.
bool hasPlane(const BodyDef& def) {
  return std::any_of(def.shapes.begin(), def.shapes.end(),
                     [](const ShapeDef& shape) { return shape.type == ShapeType::plane; });
}

}  // namespace

void frameScene(SceneDescription& scene) {
  std::vector<Aabb> boxes;
  for (const SceneWall& wall : scene.walls) boxes.push_back(boundsOf(wall.wall, scene.seed));
  for (const SceneBody& body : scene.bodies)
    if (body.role != BodyRole::ground && !hasPlane(body.def)) boxes.push_back(bodyBounds(body.def));
  Camera camera;
  if (!boxes.empty()) {
    Aabb all = boxes[0];
    for (const Aabb& box : boxes) all = merged(all, box);
    double reach = std::max(0.5 * length(all.upper - all.lower), 0.2);
    camera.target = (all.lower + all.upper) * 0.5;
    camera.position = camera.target + normalized(Vec3{0.45, 0.4, 0.8}) * (2.8 * reach);
  }
  scene.cameras.push_back(camera);
}

}  // namespace brickfall::scene
