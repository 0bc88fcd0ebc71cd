#include "output/take_poses.h"

#include <algorithm>

namespace brickfall {

const Transform& TakePoses::pose(std::size_t body, std::size_t frame) const {
  const TakeLife& life = lives[body];
  return poses[start[body] + std::clamp(frame, life.birth, life.end - 1) - life.birth];
}

Error cancelled(const std::string& path) { return {ErrorCode::wrongState, path + ": cancelled, nothing was written"}; }

Result<TakePoses> readPoses(const TakeReader& take, const std::string& path, const Progress& progress, double share) {
  TakePoses out;
  out.bodies = take.bodies().size();
  out.frames = take.frameCount();
  out.lives = take.lives();
  std::size_t total = 0;
  for (std::size_t k = 0; k < out.bodies; k++) {
    out.start.push_back(total);
    total += out.count(k);
  }
  out.poses.resize(total);
  out.contactForce.resize(total);
  out.speed.resize(total);
  for (std::size_t f = 0; f < out.frames; f++) {
    if (progress && f % 32 == 0 && !progress(share * double(f) / double(out.frames))) return cancelled(path);
    Result<TakeFrame> frame = take.frame(f);
    if (!frame) return frame.error();
    out.times.push_back(frame->time);
    std::size_t k = 0;
    for (std::uint32_t body : take.bodiesAt(f)) {
      const TakePose& pose = frame->poses[k++];
      const std::size_t at = out.start[body] + f - out.lives[body].birth;
      out.poses[at] = {pose.position, pose.rotation};
      out.contactForce[at] = pose.contactForce;
      out.speed[at] = pose.speed;
    }
    out.events.insert(out.events.end(), frame->events.begin(), frame->events.end());
    out.eventFrame.resize(out.events.size(), std::uint32_t(f));
  }
  return out;
}

}  // namespace brickfall
