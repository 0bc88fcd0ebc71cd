#include "record/frame_codec.h"

#include <bit>
#include <cmath>

namespace brickfall {
namespace {

// Which parts of a pose differ from what was expected: one byte a body.
constexpr std::uint8_t kMoved = 1, kTurned = 2, kSpeedChanged = 4, kForceChanged = 8;
constexpr std::size_t kLeastEventBytes = 1 + 1 + 1 + 3 + 4;

// Two's complement wrap-around: damaged bytes must not run into undefined behaviour.
std::int64_t wrapAdd(std::int64_t a, std::int64_t b) { return std::int64_t(std::uint64_t(a) + std::uint64_t(b)); }
std::int64_t wrapSub(std::int64_t a, std::int64_t b) { return std::int64_t(std::uint64_t(a) - std::uint64_t(b)); }

bool within(Vec3 v, double most) { return std::fabs(v.x) <= most && std::fabs(v.y) <= most && std::fabs(v.z) <= most; }
std::int64_t stepsOf(double value, double step) { return std::llround(value / step); }

std::int64_t forceCode(float force) { return std::int64_t(std::bit_cast<std::uint32_t>(force) >> 16); }
float forceOf(std::int64_t code) {
  // The middle of what the dropped bits may have been; exactly 0 stays 0.
  return code == 0 ? 0.0f : std::bit_cast<float>((std::uint32_t(code) << 16) | 0x8000u);
}

// `most` components: writes what differs from "as last time, moved on as last time". True if anything does.
template <int N>
bool difference(const std::int64_t (&now)[N], std::int64_t (&last)[N], std::int64_t (&move)[N], bool fresh,
                std::int64_t (&out)[N]) {
  bool any = false;
  for (int k = 0; k < N; k++) {
    out[k] = now[k] - last[k] - move[k];
    any = any || out[k] != 0;
    move[k] = fresh ? 0 : now[k] - last[k];
    last[k] = now[k];
  }
  return any;
}

template <int N>
void advance(std::int64_t (&last)[N], std::int64_t (&move)[N], bool fresh, const std::int64_t (&residual)[N]) {
  for (int k = 0; k < N; k++) {
    std::int64_t now = wrapAdd(wrapAdd(last[k], move[k]), residual[k]);
    move[k] = fresh ? 0 : wrapSub(now, last[k]);
    last[k] = now;
  }
}

template <int N> void put(ByteWriter& out, const std::int64_t (&values)[N]) {
  for (std::int64_t v : values) out.signedVarint(v);
}

// The sign that lies closer to the last frame's: a quaternion and its negative are the same rotation.
void rotationSteps(Quat q, const CodedPose& last, std::int64_t (&out)[4]) {
  const double s = 1 / kRotationStep;
  double side = q.x * double(last.rotation[0]) + q.y * double(last.rotation[1]) + q.z * double(last.rotation[2]) +
                q.w * double(last.rotation[3]);
  double sign = side < 0 ? -s : s;
  out[0] = std::llround(q.x * sign);
  out[1] = std::llround(q.y * sign);
  out[2] = std::llround(q.z * sign);
  out[3] = std::llround(q.w * sign);
}

Error bad(std::string message) { return {ErrorCode::badFormat, std::move(message)}; }

// Empty: fine.
std::string toPose(const CodedPose& coded, TakePose& pose) {
  pose.position = Vec3{double(coded.position[0]), double(coded.position[1]), double(coded.position[2])} * kPositionStep;
  if (!within(pose.position, kMostPosition * 1.001)) return "position out of range";
  double sum = 0;
  for (std::int64_t r : coded.rotation) {
    if (r > 70000 || r < -70000) return "rotation out of range";
    sum += double(r) * double(r);
  }
  if (!(sum > 0)) return "rotation is zero";
  const double s = 1 / std::sqrt(sum);
  pose.rotation = {double(coded.rotation[0]) * s, double(coded.rotation[1]) * s, double(coded.rotation[2]) * s,
                   double(coded.rotation[3]) * s};
  if (coded.speed < 0 || double(coded.speed) > kMostSpeed / kSpeedStep) return "speed out of range";
  pose.speed = float(double(coded.speed) * kSpeedStep);
  if (coded.force < 0 || coded.force > std::int64_t(kMostForceCode)) return "contact force out of range";
  pose.contactForce = forceOf(coded.force);
  return {};
}

std::string readEvents(ByteReader& in, std::size_t bodies, std::vector<TakeEvent>& events) {
  std::uint64_t count = in.varint();
  if (!in.canHold(count, kLeastEventBytes)) return std::to_string(count) + " events announced, which cannot fit";
  events.reserve(std::size_t(count));
  for (std::uint64_t k = 0; k < count; k++) {
    TakeEvent event;
    std::uint8_t type = in.u8();
    std::uint64_t a = in.varint(), b = in.varint();
    for (int axis = 0; axis < 3; axis++) event.pointWorld[axis] = double(in.signedVarint()) * kEventPointStep;
    event.impulse = in.f32();
    if (in.failed()) return "the events end early";
    if (type > std::uint8_t(TakeEventType::quarantined)) return "unknown event type " + std::to_string(type);
    if (a >= bodies || b >= bodies) return "an event names body " + std::to_string(std::max(a, b));
    if (!within(event.pointWorld, kMostPosition * 1.001) || !std::isfinite(event.impulse)) {
      return "an event's point or impulse is out of range";
    }
    event.type = TakeEventType(type);
    event.bodyA = std::uint32_t(a);
    event.bodyB = std::uint32_t(b);
    events.push_back(event);
  }
  return {};
}

}  // namespace

Status checkFrame(const TakeFrame& frame, std::span<const std::uint32_t> there, std::span<const std::string> names) {
  auto wrong = [](std::string message) { return Status(Error{ErrorCode::invalidArgument, std::move(message)}); };
  if (!std::isfinite(frame.time)) return wrong("time is not finite");
  if (frame.poses.size() != there.size()) {
    return wrong(std::to_string(frame.poses.size()) + " poses, expected one for each of the " +
                 std::to_string(there.size()) + " bodies that are there");
  }
  for (std::size_t k = 0; k < frame.poses.size(); k++) {
    const TakePose& pose = frame.poses[k];
    const Quat q = pose.rotation;
    double norm = q.x * q.x + q.y * q.y + q.z * q.z + q.w * q.w;
    const char* fault = nullptr;
    if (!within(pose.position, kMostPosition))
      fault = "position is not within 1e9 m";
    else if (!(norm >= 0.99 && norm <= 1.01))
      fault = "rotation is not a unit quaternion";
    else if (!(pose.speed >= 0 && pose.speed <= kMostSpeed))
      fault = "speed is not 0 .. 1e9 m/s";
    else if (!(pose.contactForce >= 0 && std::isfinite(pose.contactForce)))
      fault = "contactForce is not 0 or a positive number";
    if (fault) return wrong("body " + std::to_string(there[k]) + " \"" + names[there[k]] + "\": " + fault);
  }
  for (const TakeEvent& event : frame.events) {
    if (std::uint8_t(event.type) > std::uint8_t(TakeEventType::quarantined)) return wrong("unknown event type");
    if (event.bodyA >= names.size() || event.bodyB >= names.size()) {
      return wrong("an event names body " + std::to_string(std::max(event.bodyA, event.bodyB)) + ", expected below " +
                   std::to_string(names.size()));
    }
    if (!within(event.pointWorld, kMostPosition)) return wrong("an event's point is not within 1e9 m");
    if (!std::isfinite(event.impulse)) return wrong("an event's impulse is not finite");
  }
  return {};
}

void FrameCodec::start(std::vector<std::uint32_t> there, std::size_t known) {
  there_ = std::move(there);
  poses_.assign(there_.size(), {});
  known_ = known;
}

void FrameCodec::change(std::span<const std::uint32_t> ends, std::size_t births) {
  std::size_t kept = 0, next = 0;
  for (std::size_t k = 0; k < there_.size(); k++) {
    if (next < ends.size() && ends[next] == there_[k]) {
      next++;
      continue;
    }
    there_[kept] = there_[k];
    poses_[kept++] = poses_[k];
  }
  there_.resize(kept);
  for (std::size_t k = 0; k < births; k++) there_.push_back(std::uint32_t(known_++));
  poses_.resize(kept);
  poses_.resize(there_.size());
}

Bytes FrameCodec::encode(const TakeFrame& frame, bool key) {
  if (key) reset();
  ByteWriter masks, moves, turns, rest;
  for (std::size_t k = 0; k < poses_.size(); k++) {
    const TakePose& pose = frame.poses[k];
    CodedPose& last = poses_[k];
    std::int64_t position[3], rotation[4], moved[3], turned[4];
    for (int axis = 0; axis < 3; axis++) position[axis] = stepsOf(pose.position[axis], kPositionStep);
    rotationSteps(normalized(pose.rotation), last, rotation);
    std::uint8_t mask = 0;
    if (difference(position, last.position, last.move, last.fresh, moved)) mask |= kMoved, put(moves, moved);
    if (difference(rotation, last.rotation, last.turn, last.fresh, turned)) mask |= kTurned, put(turns, turned);
    if (std::int64_t speed = stepsOf(pose.speed, kSpeedStep); speed != last.speed) {
      mask |= kSpeedChanged;
      rest.signedVarint(speed - last.speed);
      last.speed = speed;
    }
    if (std::int64_t force = forceCode(pose.contactForce); force != last.force) {
      mask |= kForceChanged;
      rest.signedVarint(force - last.force);
      last.force = force;
    }
    masks.u8(mask);
    last.fresh = false;
  }
  ByteWriter out;
  out.f64(frame.time);
  out.append(masks.bytes());
  out.append(moves.bytes());
  out.append(turns.bytes());
  out.append(rest.bytes());
  out.varint(frame.events.size());
  for (const TakeEvent& event : frame.events) {
    out.u8(std::uint8_t(event.type));
    out.varint(event.bodyA);
    out.varint(event.bodyB);
    for (int axis = 0; axis < 3; axis++) out.signedVarint(stepsOf(event.pointWorld[axis], kEventPointStep));
    out.f32(event.impulse);
  }
  return out.bytes();
}

Result<TakeFrame> FrameCodec::decode(std::span<const std::uint8_t> bytes, bool key) {
  if (key) reset();
  ByteReader in(bytes);
  TakeFrame frame;
  frame.time = in.f64();
  if (!std::isfinite(frame.time)) return bad("time is not finite");
  std::span<const std::uint8_t> masks = in.take(poses_.size());
  if (in.failed()) return bad("it ends before the poses of its " + std::to_string(poses_.size()) + " bodies");
  for (std::size_t k = 0; k < masks.size(); k++) {
    if (masks[k] > (kMoved | kTurned | kSpeedChanged | kForceChanged)) return bad("unknown bits in a body's mask");
    std::int64_t residual[3] = {};
    if (masks[k] & kMoved) {
      for (std::int64_t& r : residual) r = in.signedVarint();
    }
    advance(poses_[k].position, poses_[k].move, poses_[k].fresh, residual);
  }
  for (std::size_t k = 0; k < masks.size(); k++) {
    std::int64_t residual[4] = {};
    if (masks[k] & kTurned) {
      for (std::int64_t& r : residual) r = in.signedVarint();
    }
    advance(poses_[k].rotation, poses_[k].turn, poses_[k].fresh, residual);
    poses_[k].fresh = false;
  }
  frame.poses.resize(poses_.size());
  for (std::size_t k = 0; k < masks.size(); k++) {
    if (masks[k] & kSpeedChanged) poses_[k].speed = wrapAdd(poses_[k].speed, in.signedVarint());
    if (masks[k] & kForceChanged) poses_[k].force = wrapAdd(poses_[k].force, in.signedVarint());
    if (std::string fault = toPose(poses_[k], frame.poses[k]); !fault.empty()) {
      return bad("body " + std::to_string(there_[k]) + ": " + fault);
    }
  }
  if (std::string fault = readEvents(in, known_, frame.events); !fault.empty()) return bad(fault);
  if (in.failed() || in.left() != 0) return bad("its lengths do not add up");
  return frame;
}

}  // namespace brickfall
