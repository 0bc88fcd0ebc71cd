#include "viewer_core/tools.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace brickfall::viewer {

namespace {

constexpr double kNearest = 0.05;    // m: what is dragged stays in front of the eye
constexpr double kWheel = 1.1;       // of the distance, a notch
constexpr double kTiltStep = 2;      // degrees
constexpr double kJerk = 0.5;        // m/s
constexpr double kBallAhead = 3;     // radii: where a ball starts, in front of the eye
constexpr double kLeastSpeed = 0.5;  // m/s: from where a ball gets faster by factors

// To two digits, as a slider shows it.
double rounded(double value) {
  if (!(value > 0)) return 0;
  const double unit = std::pow(10, std::floor(std::log10(value)) - 1);
  return std::round(value / unit) * unit;
}

}  // namespace

const char* nameOf(Tool tool) {
  static constexpr std::array<const char*, kToolCount> kNames = {"Select", "Shoot", "Drag", "Remove", "Blast", "Cut"};
  return kNames[std::size_t(tool)];
}

void growBall(ToolSettings& settings, double factor) {
  settings.ballRadius = std::clamp(rounded(settings.ballRadius * factor), kLeastBall, kLargestBall);
}

void hastenBall(ToolSettings& settings, double factor) {
  const double speed = rounded(std::max(settings.ballSpeed, kLeastSpeed) * factor);
  settings.ballSpeed = std::clamp(speed, 0.0, kFastestBall);
}

Command Hand::shot(const Ray& ray) const {
  ShootBall shot;
  shot.ray = ray;
  shot.ray.origin += ray.direction * (kBallAhead * settings.ballRadius);
  shot.radius = settings.ballRadius;
  shot.speed = settings.ballSpeed;
  shot.material = settings.ballMaterial;
  return shot;
}

Command Hand::tilt(const View& view, double side) const { return TiltGround{view.forward() * -1.0, side * kTiltStep}; }

Command Hand::jerk(const View& view) {
  const Vec3 velocity = view.right() * (kJerk * side_);
  side_ = -side_;
  return KickGround{{velocity.x, 0, velocity.z}};
}

std::vector<Command> Hand::press(const Ray& ray, const View& view, const std::optional<PickHit>& picked) {
  if (tool == Tool::shoot) return {shot(ray)};
  if (!picked) return tool == Tool::select ? std::vector<Command>{Select{0}} : std::vector<Command>{};
  if (tool == Tool::cut) return {CutJoints{picked->serial}};
  // A little before what was pointed at: a charge inside a body pushes nothing.
  if (tool == Tool::blast)
    return {Explode{picked->point - ray.direction * settings.ballRadius, settings.blastImpulse, settings.blastRadius}};
  if (tool == Tool::remove) return {RemoveBody{picked->serial}};
  if (tool == Tool::select) return {Select{picked->serial}};
  dragging_ = true;
  depth_ = std::max(kNearest, dot(picked->point - view.position, view.forward()));
  return {Select{picked->serial}, DragBegin{picked->serial, picked->local, settings.dragStrength},
          DragMove{picked->point}};
}

Vec3 Hand::targetOf(const Ray& ray, const View& view) const {
  const double along = std::max(1e-3, dot(ray.direction, view.forward()));
  return ray.origin + ray.direction * (depth_ / along);
}

std::vector<Command> Hand::move(const Ray& ray, const View& view) {
  if (!dragging_) return {};
  return {DragMove{targetOf(ray, view)}};
}

std::vector<Command> Hand::release() {
  if (!dragging_) return {};
  dragging_ = false;
  return {DragEnd{}};
}

std::vector<Command> Hand::wheel(double notches, const Ray& ray, const View& view) {
  if (!dragging_) return {};
  depth_ = std::max(kNearest, depth_ * std::pow(kWheel, notches));
  return {DragMove{targetOf(ray, view)}};
}

}  // namespace brickfall::viewer
