#include "viewer_window/near_plane.h"

#include <algorithm>

namespace brickfall::viewer {
namespace {

constexpr double kFarthest = 100;  // m
constexpr double kShare = 0.3;     // of the clear distance: at the edge of the picture the plane is that much nearer

double distanceTo(const Aabb& box, Vec3 point) {
  return length(max(max(box.lower - point, point - box.upper), Vec3{0, 0, 0}));
}

// What does not move may be large, so its own box counts instead of a ball around it.
double distanceTo(const ShapeDef& shape, const Transform& body, Vec3 point) {
  if (shape.type != ShapeType::plane) return distanceTo(bounds(shape, body), point);
  const Transform pose = body * shape.local;
  return std::max(0.0, dot(point - pose.position, rotate(pose.rotation, Vec3{0, 1, 0})));
}

}  // namespace

double nearPlaneOf(const Frame& frame, double blend, Vec3 eye) {
  double clear = kFarthest / kShare;
  for (std::size_t i = 0; i < frame.bodies.size() && clear * kShare > kLeastNear; i++) {
    const ListedBody& listed = frame.list->bodies[i];
    const FrameBody& body = frame.bodies[i];
    if (body.activity == Activity::fixed) {
      for (const ShapeDef& shape : listed.shapes) clear = std::min(clear, distanceTo(shape, body.pose, eye));
      continue;
    }
    const Vec3 at = body.before.position * (1 - blend) + body.pose.position * blend;
    clear = std::min(clear, length(at - eye) - listed.radius);
  }
  return std::max(kLeastNear, clear * kShare);
}

}  // namespace brickfall::viewer
