#include "viewer_core/camera_rig.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace brickfall::viewer {

namespace {

constexpr double kPi = std::numbers::pi;
constexpr double kEase = 10;           // 1/s: how fast what is shown follows what is wanted
constexpr double kSteepest = 1.55;     // rad: never quite upright, where right and left would change places
constexpr double kZoom = 1.15;         // of the distance, a notch
constexpr double kShortest = 0.05;     // m, of the distance
constexpr double kLongest = 1e5;       // m
constexpr double kAboveGround = 0.05;  // m: the eye stays this far over it
constexpr double kPace = 0.9;          // distances a second, of keys in orbit
constexpr double kRoom = 1.08;         // of a box that is framed, around it

double radians(double degrees) { return degrees * kPi / 180; }

}  // namespace

Vec3 View::forward() const { return rotate(rotation, Vec3{0, 0, -1}); }
Vec3 View::right() const { return rotate(rotation, Vec3{1, 0, 0}); }
Vec3 View::up() const { return rotate(rotation, Vec3{0, 1, 0}); }

Ray rayThrough(const View& view, const Viewport& port, double x, double y) {
  const double tall = std::tan(radians(view.fieldOfViewDegrees) / 2), wide = tall * port.width / port.height;
  const double right = (2 * x / port.width - 1) * wide, up = (1 - 2 * y / port.height) * tall;
  return {view.position, normalized(rotate(view.rotation, Vec3{right, up, -1}))};
}

std::optional<PixelPlace> pixelOf(const View& view, const Viewport& port, Vec3 point) {
  const Vec3 seen = rotate(conjugate(view.rotation), point - view.position);
  if (!(seen.z < -1e-6)) return {};
  const double tall = std::tan(radians(view.fieldOfViewDegrees) / 2), wide = tall * port.width / port.height;
  return PixelPlace{(seen.x / -seen.z / wide + 1) * port.width / 2, (1 - seen.y / -seen.z / tall) * port.height / 2};
}

Vec3 CameraRig::forwardOf(const Pose& pose) {
  return {-std::sin(pose.yaw) * std::cos(pose.pitch), std::sin(pose.pitch), -std::cos(pose.yaw) * std::cos(pose.pitch)};
}

Vec3 CameraRig::eyeOf(const Pose& pose) const { return pose.target - forwardOf(pose) * pose.distance; }

// By lowering the way it looks, so that what it looks at stays where it is in the picture; failing that, by lifting it.
void CameraRig::keepAboveGround(Pose& pose) const {
  const double least = ground_ + kAboveGround;
  if (!(eyeOf(pose).y < least)) return;
  if (mode_ != CameraMode::fly && pose.target.y >= least) {
    pose.pitch = -std::asin(std::clamp((least - pose.target.y) / pose.distance, -1.0, 1.0));
    return;
  }
  pose.target.y += least - eyeOf(pose).y;
}

void CameraRig::setGround(double height) {
  ground_ = height;
  keepAboveGround(wanted_);
}

// From where it stands; what is shown is carried along, so that only the rest is eased.
void CameraRig::turnTo(Vec3 target) {
  const Pose before = wanted_;
  const Vec3 way = target - eyeOf(before);
  if (!(length(way) > kShortest)) return;
  wanted_.target = target;
  wanted_.distance = length(way);
  wanted_.pitch = std::clamp(std::asin(way.y / wanted_.distance), -kSteepest, kSteepest);
  wanted_.yaw = before.yaw + std::remainder(std::atan2(-way.x, -way.z) - before.yaw, 2 * kPi);
  shown_.target += wanted_.target - before.target;
  shown_.pitch += wanted_.pitch - before.pitch;
  shown_.yaw += wanted_.yaw - before.yaw;
  shown_.distance *= wanted_.distance / before.distance;
}

void CameraRig::endWatch() {
  if (mode_ != CameraMode::watch) return;
  mode_ = CameraMode::orbit;
  followed_ = 0;
}

void CameraRig::goTo(const Camera& saved, bool atOnce, const BodyList* list) {
  Vec3 way = saved.target - saved.position;
  if (!(length(way) > kShortest)) way = {0, 0, -kShortest};
  wanted_.target = saved.target;
  wanted_.distance = length(way);
  wanted_.pitch = std::clamp(std::asin(way.y / wanted_.distance), -kSteepest, kSteepest);
  wanted_.yaw = std::atan2(-way.x, -way.z);
  wanted_.fieldOfViewDegrees = saved.fieldOfViewDegrees;
  endWatch();
  followed_ = 0;
  mode_ = mode_ == CameraMode::follow ? CameraMode::orbit : mode_;
  if (list && !saved.follow.empty()) {
    for (const ListedBody& body : list->bodies)
      if (followed_ == 0 && body.name == saved.follow) followed_ = body.serial;
    if (followed_ != 0) mode_ = CameraMode::watch;
  }
  keepAboveGround(wanted_);
  // The short way round.
  shown_.yaw = wanted_.yaw + std::remainder(shown_.yaw - wanted_.yaw, 2 * kPi);
  if (atOnce) shown_ = wanted_;
}

// The ball around the box touches the picture's nearer edges.
void CameraRig::frame(const Aabb& box, const Viewport& port, bool atOnce) {
  const double radius = std::max(kShortest, length(box.upper - box.lower) / 2);
  const double tall = radians(wanted_.fieldOfViewDegrees) / 2;
  const double wide = std::atan(std::tan(tall) * port.width / port.height);
  wanted_.target = (box.lower + box.upper) * 0.5;
  wanted_.distance = std::clamp(kRoom * radius / std::sin(std::min(tall, wide)), kShortest, kLongest);
  endWatch();
  followed_ = 0;
  if (mode_ == CameraMode::follow) mode_ = CameraMode::orbit;
  keepAboveGround(wanted_);
  if (atOnce) shown_ = wanted_;
}

void CameraRig::setMode(CameraMode mode) {
  if (mode == CameraMode::follow || mode == CameraMode::watch || mode == mode_) return;
  mode_ = mode;
  followed_ = 0;
}

void CameraRig::follow(Serial body, double radius) {
  mode_ = CameraMode::follow;
  followed_ = body;
  followedRadius_ = radius;
  wanted_.distance = std::max(kShortest, kFirstRadii * radius);
}

double CameraRig::leastDistance() const {
  return mode_ == CameraMode::follow ? std::max(kShortest, kNearestRadii * followedRadius_) : kShortest;
}

void CameraRig::turn(double right, double up) {
  endWatch();
  const Vec3 eye = eyeOf(wanted_);
  wanted_.yaw -= right;
  wanted_.pitch = std::clamp(wanted_.pitch + up, -kSteepest, kSteepest);
  // Flying turns about the eye.
  if (mode_ == CameraMode::fly) wanted_.target = eye + forwardOf(wanted_) * wanted_.distance;
  keepAboveGround(wanted_);
}

void CameraRig::drag(double pixelsRight, double pixelsDown, const Viewport& port) {
  endWatch();
  if (mode_ == CameraMode::follow) return;
  const double metres = 2 * wanted_.distance * std::tan(radians(wanted_.fieldOfViewDegrees) / 2) / port.height;
  const View seen = view();
  wanted_.target += seen.right() * (-pixelsRight * metres) + seen.up() * (pixelsDown * metres);
  keepAboveGround(wanted_);
}

void CameraRig::zoom(double notches) {
  endWatch();
  if (mode_ == CameraMode::fly) {
    wanted_.target += forwardOf(wanted_) * (notches * 0.25 * flySpeed_);
  } else {
    wanted_.distance = std::clamp(wanted_.distance * std::pow(kZoom, -notches), leastDistance(), kLongest);
  }
  keepAboveGround(wanted_);
}

void CameraRig::move(Vec3 keys, double seconds) {
  endWatch();
  if (mode_ == CameraMode::follow) return;
  const Vec3 ahead = forwardOf(wanted_), right = normalized(cross(ahead, Vec3{0, 1, 0}));
  if (mode_ == CameraMode::fly) {
    wanted_.target += (right * keys.x + Vec3{0, keys.y, 0} + ahead * keys.z) * (flySpeed_ * seconds);
  } else {  // over the ground, whatever it looks down at
    const Vec3 level = normalized(Vec3{ahead.x, 0, ahead.z});
    wanted_.target += (right * keys.x + Vec3{0, keys.y, 0} + level * keys.z) * (kPace * wanted_.distance * seconds);
  }
  keepAboveGround(wanted_);
}

void CameraRig::setFlySpeed(double speed) { flySpeed_ = std::clamp(speed, 0.05, 200.0); }

void CameraRig::update(double seconds, const std::optional<Vec3>& target) {
  if (mode_ == CameraMode::watch && target) turnTo(*target);
  if (!target) endWatch();
  if (mode_ == CameraMode::follow) {
    if (target) {
      // The body does not run away from a camera that eases after it: both are carried along, only the rest is eased.
      const Vec3 moved = *target - wanted_.target;
      wanted_.target = *target;
      if (length(moved) < wanted_.distance) shown_.target += moved;
      wanted_.distance = std::max(wanted_.distance, leastDistance());
      keepAboveGround(wanted_);
    } else {
      mode_ = CameraMode::orbit;
      followed_ = 0;
    }
  }
  const double share = 1 - std::exp(-kEase * std::max(0.0, seconds));
  shown_.target += (wanted_.target - shown_.target) * share;
  shown_.yaw += (wanted_.yaw - shown_.yaw) * share;
  shown_.pitch += (wanted_.pitch - shown_.pitch) * share;
  shown_.distance *= std::pow(wanted_.distance / shown_.distance, share);
  shown_.fieldOfViewDegrees += (wanted_.fieldOfViewDegrees - shown_.fieldOfViewDegrees) * share;
  keepAboveGround(shown_);
}

View CameraRig::view() const {
  View view;
  view.position = eyeOf(shown_);
  view.rotation = quatFromAxisAngle(Vec3{0, 1, 0}, shown_.yaw) * quatFromAxisAngle(Vec3{1, 0, 0}, shown_.pitch);
  view.fieldOfViewDegrees = shown_.fieldOfViewDegrees;
  return view;
}

Vec3 CameraRig::target() const { return shown_.target; }
double CameraRig::distance() const { return shown_.distance; }

Camera CameraRig::asCamera() const {
  Camera camera;
  camera.name = "view";
  camera.position = eyeOf(shown_);
  camera.target = shown_.target;
  camera.fieldOfViewDegrees = shown_.fieldOfViewDegrees;
  return camera;
}

}  // namespace brickfall::viewer
