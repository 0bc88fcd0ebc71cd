#include "output/take_poses.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace brickfall {

const Transform& TakePoses::pose(std::size_t body, std::size_t frame) const {
  const TakeLife& life = lives[body];
  return poses[start[body] + std::clamp(frame, life.birth, life.end - 1) - life.birth];
}

Error cancelled(const std::string& path) { return {ErrorCode::wrongState, path + ": cancelled, nothing was written"}; }

namespace {

// Changes of mortar with each frame.
class MortarTrack {
 public:
  void add(const TakeReader& take, std::size_t index, const TakeFrame& frame, ByteWriter& out) {
    codes_.resize(take.mortar().size());
    ByteWriter changed;
    std::size_t count = 0, place = 0;
    std::uint32_t last = 0;
    for (std::uint32_t joint : take.mortarAt(index)) {
      const TakeMortarState& state = frame.mortar[place++];
      const Code now{codeOf(state.utilisation), codeOf(state.damage)};
      if (now == codes_[joint]) continue;
      codes_[joint] = now;
      changed.varint(joint - last);
      changed.u8(now[0]);
      changed.u8(now[1]);
      last = joint;
      count++;
    }
    out.varint(count);
    out.append(changed.bytes());
  }

 private:
  using Code = std::array<std::uint8_t, 2>;
  static std::uint8_t codeOf(float share) { return std::uint8_t(std::lround(share * 255)); }
  std::vector<Code> codes_;
};

}  // namespace

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
  MortarTrack mortar;
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
    if (!take.mortar().empty()) mortar.add(take, f, *frame, out.mortar);
    out.breaks.insert(out.breaks.end(), frame->breaks.begin(), frame->breaks.end());
  }
  return out;
}

}  // namespace brickfall
