#include "render/camera_move.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace brickfall::render {

Camera cameraAt(const CameraMove& move, double time, const Instant& instant) {
  Camera camera = cameraAt(move.camera, time);
  if (move.follow && *move.follow < instant.there.size() && instant.there[*move.follow])
    camera.target = instant.poses[*move.follow].position;
  const double share = move.to > move.from ? std::clamp((time - move.from) / (move.to - move.from), 0.0, 1.0) : 1;
  const double angle = share * move.orbitDegrees * (std::numbers::pi / 180);
  if (angle == 0) return camera;
  const Quat turn = quatFromAxisAngle({0, 1, 0}, angle);
  camera.position = camera.target + rotate(turn, camera.position - camera.target);
  return camera;
}

}  // namespace brickfall::render
