// TakeFrame <-> bytes. Poses become whole numbers of a small step, and of these only the difference to what the last two
// frames let expect is kept; a body at rest then costs one zero byte before packing. Frames come in groups: the first of a
// group (a key frame) refers to nothing before it, which is what makes a take seekable; nor does the first frame of a body.
#pragma once
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "brickfall/result.h"
#include "brickfall/take.h"
#include "record/byte_stream.h"

namespace brickfall {

constexpr std::uint32_t kTakeGroupFrames = 64;
constexpr double kPositionStep = 1e-5;            // m
constexpr double kRotationStep = 1.0 / 65536;     // per quaternion component: 6.1e-5 rad at most between two steps
constexpr double kSpeedStep = 1e-3;               // m/s
constexpr double kEventPointStep = 1e-4;          // m
constexpr double kMostPosition = 1e9;             // m, from the origin
constexpr double kMostSpeed = 1e9;                // m/s
constexpr std::uint32_t kMostForceCode = 0x7F7F;  // the upper half of the largest finite float

// A body's state in whole steps, and the last difference, which the next one is expected to repeat.
struct CodedPose {
  std::int64_t position[3] = {}, move[3] = {};
  std::int64_t rotation[4] = {}, turn[4] = {};
  std::int64_t speed = 0;
  std::int64_t force = 0;  // upper 16 bits of the float: 0.4 % resolution
  bool fresh = true;       // nothing is known of it: all the above is 0
};

// What a frame may not hold (not finite, wrong count); the message names body and field. `there`: numbers of the bodies
// that are there; `names` of all that ever were.
Status checkFrame(const TakeFrame& frame, std::span<const std::uint32_t> there, std::span<const std::string> names);

class FrameCodec {
 public:
  // Who is there when the next frame comes, and how many bodies ever were. Only before a key frame.
  void start(std::vector<std::uint32_t> there, std::size_t known);
  // Who goes (all of them there, ascending) and how many come with the next frame.
  void change(std::span<const std::uint32_t> ends, std::size_t births);
  const std::vector<std::uint32_t>& there() const { return there_; }  // ascending

  // Frames must come in order; `key` starts a group. Only after checkFrame().
  Bytes encode(const TakeFrame& frame, bool key);
  // Frames of a group must come in order from its key frame on.
  Result<TakeFrame> decode(std::span<const std::uint8_t> bytes, bool key);

 private:
  void reset() { poses_.assign(poses_.size(), {}); }
  std::vector<std::uint32_t> there_;
  std::vector<CodedPose> poses_;  // of those
  std::size_t known_ = 0;         // bodies that are or were there: events name no others
};

}  // namespace brickfall
