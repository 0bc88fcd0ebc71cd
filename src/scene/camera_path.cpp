// The path of a camera: a cubic curve through its key poses, with the speeds at the keys chosen so that it looks as if somebody
// held the camera (no jerk at a key, a soft start and end, a rest where two keys are equal).
#include <algorithm>
#include <cmath>

#include "brickfall/scenery.h"

namespace brickfall {

namespace {

bool isFinite(Vec3 v) { return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z); }

struct Pose {
  Vec3 position, target;
  double fieldOfView = 0;
};

Pose poseOf(const CameraKey& key) { return {key.position, key.target, key.fieldOfViewDegrees}; }
Pose operator*(const Pose& a, double s) { return {a.position * s, a.target * s, a.fieldOfView * s}; }
Pose operator+(const Pose& a, const Pose& b) {
  return {a.position + b.position, a.target + b.target, a.fieldOfView + b.fieldOfView};
}

bool equalPoses(const CameraKey& a, const CameraKey& b) {
  return a.position == b.position && a.target == b.target && a.fieldOfViewDegrees == b.fieldOfViewDegrees;
}

// Change per second at a key: that from the key before to the key after it, none at the ends and beside a rest.
Pose speedAt(const std::vector<CameraKey>& path, std::size_t k) {
  if (k == 0 || k + 1 == path.size()) return {};
  const CameraKey &before = path[k - 1], &after = path[k + 1];
  if (equalPoses(before, path[k]) || equalPoses(path[k], after)) return {};
  return (poseOf(after) + poseOf(before) * -1) * (1 / (after.time - before.time));
}

Pose between(const std::vector<CameraKey>& path, std::size_t k, double time) {
  const CameraKey &from = path[k], &to = path[k + 1];
  const double span = to.time - from.time, s = (time - from.time) / span;
  const double s2 = s * s, s3 = s2 * s;
  // The cubic with given ends and given speeds there (Hermite).
  return poseOf(from) * (2 * s3 - 3 * s2 + 1) + poseOf(to) * (3 * s2 - 2 * s3) +
         speedAt(path, k) * ((s3 - 2 * s2 + s) * span) + speedAt(path, k + 1) * ((s3 - s2) * span);
}

}  // namespace

std::string cameraPathFault(const std::vector<CameraKey>& path) {
  for (std::size_t k = 0; k < path.size(); k++) {
    const CameraKey& key = path[k];
    if (!std::isfinite(key.time)) return "a time is not finite";
    if (k > 0 && !(key.time > path[k - 1].time)) return "its times do not ascend";
    if (!isFinite(key.position) || !isFinite(key.target)) return "a position or target is not finite";
    if (!(length(key.position - key.target) > 0)) return "a position is its own target";
    if (!(key.fieldOfViewDegrees > 0 && key.fieldOfViewDegrees < 180))
      return "a field of view is not between 0 and 180";
  }
  return {};
}

Camera cameraAt(const Camera& camera, double time) {
  const std::vector<CameraKey>& path = camera.path;
  if (path.empty()) return camera;
  const auto next = std::upper_bound(path.begin(), path.end(), time,
                                     [](double moment, const CameraKey& key) { return moment < key.time; });
  Pose pose;
  if (next == path.begin() || next == path.end())
    pose = poseOf(next == path.begin() ? path.front() : path.back());
  else
    pose = between(path, std::size_t(next - path.begin()) - 1, time);
  // Curves may swing a little past their keys; a field of view stays one.
  return {camera.name, pose.position, pose.target, std::clamp(pose.fieldOfView, 1.0, 170.0), {}, camera.follow};
}

}  // namespace brickfall
