#include "record/frame_codec.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <utility>

#include "record/body_codec.h"

namespace brickfall {
namespace {

// Which parts of a pose differ from what was expected: one byte a body.
constexpr std::uint8_t kMoved = 1, kTurned = 2, kSpeedChanged = 4, kForceChanged = 8;
constexpr std::size_t kLeastEventBytes = 1 + 1 + 1 + 3 + 4;
constexpr std::size_t kLeastBreakBytes = 1 + 8 + 8 + 1 + 5 * 4 + 1, kLeastTakerBytes = 3 + 2 * 4;
constexpr std::size_t kMostTakers = 4;
constexpr double kMostForce = 3e38;  // N, of a break

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

bool isShare(float x) { return x >= 0 && x <= 1; }

std::string breakFault(const TakeBreak& broken, const FrameCast& cast) {
  if (broken.mortar >= cast.knownMortar) return "a break names joint " + std::to_string(broken.mortar);
  if (!std::isfinite(broken.crackTime) || !std::isfinite(broken.breakTime)) return "a break's time is not finite";
  if (std::uint8_t(broken.mode) > std::uint8_t(MortarMode::crushing)) return "a break's mode is unknown";
  if (!std::isfinite(broken.tensionShare) || !std::isfinite(broken.shearShare) || !within(broken.force, kMostForce))
    return "a break's shares or force are out of range";
  if (broken.takers.size() > kMostTakers) return std::to_string(broken.takers.size()) + " bear the load of one break";
  for (const TakeLoadTaker& taker : broken.takers) {
    if (taker.mortar != TakeLoadTaker::kContacts && taker.mortar >= cast.knownMortar)
      return "a break names joint " + std::to_string(taker.mortar);
    if (taker.bodyA >= cast.knownBodies || taker.bodyB >= cast.knownBodies)
      return "a break names body " + std::to_string(std::max(taker.bodyA, taker.bodyB));
    if (!std::isfinite(taker.before) || !std::isfinite(taker.after)) return "a load is not finite";
  }
  return {};
}

void put(ByteWriter& out, const TakeBreak& broken) {
  out.varint(broken.mortar);
  out.f64(broken.crackTime);
  out.f64(broken.breakTime);
  out.u8(std::uint8_t(broken.mode));
  for (float share : {broken.tensionShare, broken.shearShare}) out.f32(share);
  for (int axis = 0; axis < 3; axis++) out.f32(float(broken.force[axis]));
  out.varint(broken.takers.size());
  for (const TakeLoadTaker& taker : broken.takers) {
    out.varint(taker.mortar == TakeLoadTaker::kContacts ? 0 : std::uint64_t(taker.mortar) + 1);
    for (std::uint32_t body : {taker.bodyA, taker.bodyB}) out.varint(body);
    for (float force : {taker.before, taker.after}) out.f32(force);
  }
}

std::uint32_t smallNumber(std::uint64_t number) { return std::uint32_t(std::min<std::uint64_t>(number, 0xfffffffeu)); }

TakeBreak getBreak(ByteReader& in, bool& sound) {
  TakeBreak broken;
  broken.mortar = smallNumber(in.varint());
  broken.crackTime = in.f64();
  broken.breakTime = in.f64();
  broken.mode = MortarMode(in.u8());
  for (float* share : {&broken.tensionShare, &broken.shearShare}) *share = in.f32();
  for (int axis = 0; axis < 3; axis++) broken.force[axis] = double(in.f32());
  const std::uint64_t takers = in.varint();
  sound = sound && takers <= kMostTakers && in.canHold(takers, kLeastTakerBytes);
  for (std::uint64_t k = 0; sound && k < takers; k++) {
    TakeLoadTaker taker;
    const std::uint64_t mortar = in.varint();
    if (mortar > 0) taker.mortar = smallNumber(mortar - 1);
    for (std::uint32_t* body : {&taker.bodyA, &taker.bodyB}) *body = smallNumber(in.varint());
    for (float* force : {&taker.before, &taker.after}) *force = in.f32();
    broken.takers.push_back(taker);
  }
  return broken;
}

std::uint8_t shareCode(float share) { return std::uint8_t(std::lround(share * 255)); }

// Those that are there and do not end; what is kept of them by place goes along.
template <class Kept>
void dropEnded(std::span<const std::uint32_t> ends, std::vector<std::uint32_t>& there, std::vector<Kept>& kept) {
  std::size_t left = 0, next = 0;
  for (std::size_t k = 0; k < there.size(); k++) {
    if (next < ends.size() && ends[next] == there[k]) {
      next++;
      continue;
    }
    there[left] = there[k];
    kept[left++] = kept[k];
  }
  there.resize(left);
  kept.resize(left);
}

}  // namespace

Status checkFrame(const TakeFrame& frame, const FrameCast& cast, std::span<const std::string> names) {
  const std::vector<std::uint32_t>& there = cast.bodies;
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
  if (frame.mortar.size() != cast.mortar.size())
    return wrong(std::to_string(frame.mortar.size()) + " states of mortar, expected one for each of the " +
                 std::to_string(cast.mortar.size()) + " joints that are there");
  for (const TakeMortarState& state : frame.mortar)
    if (!isShare(state.utilisation) || !isShare(state.damage))
      return wrong("mortar's utilisation or damage is not 0 .. 1");
  for (const TakeBreak& broken : frame.breaks)
    if (std::string fault = breakFault(broken, cast); !fault.empty()) return wrong(fault);
  return {};
}

void FrameCodec::start(FrameCast cast) {
  cast_ = std::move(cast);
  reset();
}

void FrameCodec::reset() {
  poses_.assign(cast_.bodies.size(), {});
  mortar_.assign(cast_.mortar.size(), {});
}

void FrameCodec::change(std::span<const std::uint32_t> ends, std::size_t births,
                        std::span<const std::uint32_t> mortarEnds, std::size_t mortarBirths) {
  dropEnded(ends, cast_.bodies, poses_);
  dropEnded(mortarEnds, cast_.mortar, mortar_);
  for (std::size_t k = 0; k < births; k++) cast_.bodies.push_back(std::uint32_t(cast_.knownBodies++));
  for (std::size_t k = 0; k < mortarBirths; k++) cast_.mortar.push_back(std::uint32_t(cast_.knownMortar++));
  poses_.resize(cast_.bodies.size());
  mortar_.resize(cast_.mortar.size());
}

// Joints of which something differs from the last frame, by their place less that of the one before.
void FrameCodec::encodeMortar(const TakeFrame& frame, ByteWriter& out) {
  ByteWriter changed;
  std::size_t count = 0, last = 0;
  for (std::size_t k = 0; k < mortar_.size(); k++) {
    const CodedMortar now{shareCode(frame.mortar[k].utilisation), shareCode(frame.mortar[k].damage)};
    if (now.utilisation == mortar_[k].utilisation && now.damage == mortar_[k].damage) continue;
    mortar_[k] = now;
    changed.varint(k - last);
    changed.u8(now.utilisation);
    changed.u8(now.damage);
    last = k;
    count++;
  }
  out.varint(count);
  out.append(changed.bytes());
  out.varint(frame.breaks.size());
  for (const TakeBreak& broken : frame.breaks) put(out, broken);
}

std::string FrameCodec::decodeMortar(ByteReader& in, TakeFrame& frame) {
  std::uint64_t count = in.varint(), place = 0;
  if (!in.canHold(count, 3)) return std::to_string(count) + " states of mortar announced, which cannot fit";
  for (std::uint64_t k = 0; k < count; k++) {
    const std::uint64_t step = in.varint();
    if (in.failed() || (k > 0 && step == 0) || step >= mortar_.size() || place + step >= mortar_.size())
      return "a joint changes that is not there";
    place += step;
    mortar_[std::size_t(place)].utilisation = in.u8();
    mortar_[std::size_t(place)].damage = in.u8();
  }
  for (const CodedMortar& coded : mortar_)
    frame.mortar.push_back({float(coded.utilisation) / 255, float(coded.damage) / 255});
  count = in.varint();
  if (!in.canHold(count, kLeastBreakBytes)) return std::to_string(count) + " breaks announced, which cannot fit";
  bool sound = true;
  for (std::uint64_t k = 0; sound && k < count; k++) {
    frame.breaks.push_back(getBreak(in, sound));
    if (!sound || in.failed()) return "the breaks end early";
    if (std::string fault = breakFault(frame.breaks.back(), cast_); !fault.empty()) return fault;
  }
  return {};
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
  if (version_ >= kVersion4) encodeMortar(frame, out);
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
      return bad("body " + std::to_string(cast_.bodies[k]) + ": " + fault);
    }
  }
  if (std::string fault = readEvents(in, cast_.knownBodies, frame.events); !fault.empty()) return bad(fault);
  if (version_ >= kVersion4)
    if (std::string fault = decodeMortar(in, frame); !fault.empty()) return bad(fault);
  if (in.failed() || in.left() != 0) return bad("its lengths do not add up");
  return frame;
}

}  // namespace brickfall
