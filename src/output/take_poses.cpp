#include "output/take_poses.h"

namespace brickfall {

Error cancelled(const std::string& path) { return {ErrorCode::wrongState, path + ": cancelled, nothing was written"}; }

Result<TakePoses> readPoses(const TakeReader& take, const std::string& path, const Progress& progress, double share) {
  TakePoses out;
  out.bodies = take.header().bodies.size();
  out.frames = take.frameCount();
  out.poses.resize(out.bodies * out.frames);
  out.contactForce.resize(out.poses.size());
  for (std::size_t f = 0; f < out.frames; f++) {
    if (progress && f % 32 == 0 && !progress(share * double(f) / double(out.frames))) return cancelled(path);
    Result<TakeFrame> frame = take.frame(f);
    if (!frame) return frame.error();
    out.times.push_back(frame->time);
    for (std::size_t k = 0; k < out.bodies; k++) {
      const TakePose& pose = frame->poses[k];
      out.poses[k * out.frames + f] = {pose.position, pose.rotation};
      out.contactForce[k * out.frames + f] = pose.contactForce;
    }
    out.events.insert(out.events.end(), frame->events.begin(), frame->events.end());
    out.eventFrame.resize(out.events.size(), std::uint32_t(f));
  }
  return out;
}

}  // namespace brickfall
