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
#include "record/take_record.h"

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

// Whom a frame may name.
struct FrameCast {
  std::vector<std::uint32_t> bodies, mortar;     // numbers of those that are there, ascending
  std::size_t knownBodies = 0, knownMortar = 0;  // how many are or were there
};

// Contents that a frame may not hold (not finite, wrong count); the message names body and field. `names`: of all bodies that ever
// were there.
Status checkFrame(const TakeFrame& frame, const FrameCast& cast, std::span<const std::string> names);

class FrameCodec {
 public:
  explicit FrameCodec(std::uint32_t version = kTakeVersion) : version_(version) {}

  // Only before a key frame.
  void start(FrameCast cast);
  // Who goes (all of them there, ascending) and how many come with the next frame.
  void change(std::span<const std::uint32_t> ends, std::size_t births, std::span<const std::uint32_t> mortarEnds = {},
              std::size_t mortarBirths = 0);
  const FrameCast& cast() const { return cast_; }

  // Frames must come in order; `key` starts a group. Only after checkFrame().
  Bytes encode(const TakeFrame& frame, bool key);
  // Frames of a group must come in order from its key frame on.
  Result<TakeFrame> decode(std::span<const std::uint8_t> bytes, bool key);

 private:
  struct CodedMortar {
    std::uint8_t utilisation = 0, damage = 0;  // in steps of 1 / 255
  };
  void reset();
  void encodeMortar(const TakeFrame& frame, ByteWriter& out);
  std::string decodeMortar(ByteReader& in, TakeFrame& frame);  // empty: fine
  std::uint32_t version_;
  FrameCast cast_;
  std::vector<CodedPose> poses_;     // of the bodies that are there
  std::vector<CodedMortar> mortar_;  // of the joints
};

}  // namespace brickfall
