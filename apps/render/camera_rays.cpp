#include "render/camera_rays.h"

#include <cmath>
#include <numbers>

namespace brickfall::render {

namespace {

Vec3f toFloat(Vec3 v) { return {float(v.x), float(v.y), float(v.z)}; }

}  // namespace

bool samePose(const Camera& a, const Camera& b) {
  return a.position == b.position && a.target == b.target && a.fieldOfViewDegrees == b.fieldOfViewDegrees;
}

View viewOf(const Camera& camera) {
  const Vec3 forward = normalized(camera.target - camera.position);
  Vec3 right = cross(forward, Vec3{0, 1, 0});
  if (lengthSquared(right) < 1e-12) right = {1, 0, 0};  // straight up or down
  right = normalized(right);
  const double reach = std::tan(camera.fieldOfViewDegrees * std::numbers::pi / 360);
  return {toFloat(camera.position), toFloat(right * reach), toFloat(cross(right, forward) * reach), toFloat(forward)};
}

CameraRays::CameraRays(const Camera& open, const Camera& close, int width, int height)
    : open_(viewOf(open)),
      close_(viewOf(close)),
      moves_(!samePose(open, close)),
      width_(float(width)),
      height_(float(height)),
      pixelAngle_(2 * length(open_.up) / float(height)) {}

Ray CameraRays::through(float x, float y, float time) const {
  View view = open_;
  if (moves_) {
    view.position = appearance::mix(open_.position, close_.position, time);
    view.right = appearance::mix(open_.right, close_.right, time);
    view.up = appearance::mix(open_.up, close_.up, time);
    view.forward = appearance::mix(open_.forward, close_.forward, time);
  }
  const float across = (2 * x - width_) / height_, high = 1 - 2 * y / height_;
  Ray ray;
  ray.origin = view.position;
  ray.direction = normalized(view.forward + view.right * across + view.up * high);
  ray.time = time;
  return ray;
}

Vec3f CameraRays::footprint(const Ray& ray, float distance, Vec3f normal, const Mat3f& toFrame) const {
  const float forward = dot(ray.direction, open_.forward), against = dot(ray.direction, normal);
  const float scale = 2 / height_ * distance * forward;
  Vec3f sum;
  for (const Vec3f side : {open_.right, open_.up}) {
    // To the next pixel, and back to the plane along the ray.
    const Vec3f step = toFrame * ((side - ray.direction * (dot(side, normal) / against)) * scale);
    for (int k = 0; k < 3; k++) sum[k] += std::fabs(step[k]);
  }
  return sum;
}

}  // namespace brickfall::render
