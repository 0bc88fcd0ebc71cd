// A camera for scenes without one: it sees what balls are thrown at, from the side that they come from.
#include <algorithm>
#include <cmath>

#include "scene/body_bounds.h"
#include "scene/scene_build.h"

namespace brickfall {
namespace scene {

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

Aabb around(const std::vector<Aabb>& boxes) {
  Aabb all = boxes[0];
  for (const Aabb& box : boxes) all = merged(all, box);
  return all;
}

Vec3 centre(const Aabb& box) { return (box.lower + box.upper) * 0.5; }

}  // namespace

void frameScene(SceneDescription& scene) {
  std::vector<Aabb> boxes, balls;
  for (const SceneWall& wall : scene.walls) boxes.push_back(boundsOf(wall.wall, scene.seed));
  for (const SceneBody& body : scene.bodies)
    if (body.role != BodyRole::ground && !hasPlane(body.def))
      (body.role == BodyRole::ball ? balls : boxes).push_back(bodyBounds(body.def));
  if (boxes.empty()) boxes.swap(balls);
  Vec3 side{0, 0, 1};
  if (!balls.empty()) side = centre(balls[0]) - centre(around(boxes));
  scene.cameras.push_back(fittedCamera(boxes, side));
}

}  // namespace scene

Camera fittedCamera(const std::vector<Aabb>& boxes, const Vec3& side) {
  using scene::around, scene::centre;
  constexpr double kFilled = 0.7, kAspect = 1.6;  // of the picture; the narrowest that is usual
  constexpr double kBeside = 0.5, kAbove = 0.4;   // sine of the angle to the right of the side; rise over way back
  Camera camera;
  if (boxes.empty()) return camera;
  camera.target = centre(around(boxes));
  Vec3 front{side.x, 0, side.z};
  if (!(length(front) > 1e-3)) front = {0, 0, 1};
  front = normalized(front);
  const double along = std::sqrt(1 - kBeside * kBeside);
  const Vec3 back = normalized(Vec3{along * front.x + kBeside * front.z, kAbove, along * front.z - kBeside * front.x});
  const Vec3 right = normalized(cross(Vec3{0, 1, 0}, back)), up = cross(back, right);
  const double slope =
      kFilled * (std::sqrt(2.0) - 1);  // tan(45 / 2 degrees): takes are the same bytes on every machine
  double away = 0.4;
  for (const Aabb& box : boxes) {
    for (int corner = 0; corner < 8; corner++) {
      const Vec3 at = Vec3{corner & 1 ? box.upper.x : box.lower.x, corner & 2 ? box.upper.y : box.lower.y,
                           corner & 4 ? box.upper.z : box.lower.z} -
                      camera.target;
      const double wide = std::fabs(dot(at, right)) / (slope * kAspect), tall = std::fabs(dot(at, up)) / slope;
      away = std::max(away, dot(at, back) + std::max(wide, tall));
    }
  }
  camera.position = camera.target + back * away;
  return camera;
}

}  // namespace brickfall
