#include "output/replay_tracks.h"

#include <zstd.h>

#include <algorithm>
#include <array>
#include <cmath>

namespace brickfall {
namespace {

constexpr int kPackLevel = 15;
constexpr std::uint64_t kEscape = 255;  // in a byte plane: the number is in the list of large ones
constexpr double kMostTurn = 8;         // tan(angle / 2) in one frame; what is more, the next frames catch up

struct Planes {
  std::array<Bytes, 7> plane;  // x y z of the position, x y z of the turn, contact force
  ByteWriter large;

  void put(int which, std::int64_t value) {
    std::uint64_t code = zigzag(value);
    plane[which].push_back(std::uint8_t(std::min(code, kEscape)));
    if (code >= kEscape) large.varint(code);
  }
};

std::int64_t steps(double value, double step) { return std::llround(value / step); }

void putPositions(Planes& planes, std::span<const Transform> poses, double step, ByteWriter& start) {
  for (int axis = 0; axis < 3; axis++) {
    std::int64_t last = steps(poses[0].position[axis], step), move = 0;
    start.signedVarint(last);
    for (std::size_t f = 1; f < poses.size(); f++) {
      std::int64_t now = steps(poses[f].position[axis], step);
      planes.put(axis, now - last - move);
      move = now - last;
      last = now;
    }
  }
}

// The page turns the body on by whole steps, frame by frame; so does this loop, and each step aims at the true pose, which
// keeps rounding from adding up.
void putRotations(Planes& planes, std::span<const Transform> poses, ByteWriter& start) {
  const Quat first = poses[0].rotation;
  const std::int64_t parts[4] = {steps(first.x, 1 / 32767.0), steps(first.y, 1 / 32767.0), steps(first.z, 1 / 32767.0),
                                 steps(first.w, 1 / 32767.0)};
  for (std::int64_t part : parts) start.signedVarint(part);
  Quat shown = normalized(Quat{double(parts[0]), double(parts[1]), double(parts[2]), double(parts[3])});
  std::int64_t last[3] = {};
  for (std::size_t f = 1; f < poses.size(); f++) {
    Quat turn = poses[f].rotation * conjugate(shown);
    if (turn.w < 0) turn = {-turn.x, -turn.y, -turn.z, -turn.w};
    double w = std::max(turn.w, 1e-3);
    const double tangent[3] = {turn.x / w, turn.y / w, turn.z / w};
    Vec3 done;
    for (int axis = 0; axis < 3; axis++) {
      std::int64_t now = steps(std::clamp(tangent[axis], -kMostTurn, kMostTurn), kReplayTurnStep);
      planes.put(3 + axis, now - last[axis]);
      last[axis] = now;
      done[axis] = double(now) * kReplayTurnStep;
    }
    shown = normalized(Quat{done.x, done.y, done.z, 1} * shown);
  }
}

std::int64_t forceCode(float force) {
  double code = kReplayForceSteps * std::log2(1 + std::max(0.0, double(force)));
  return std::int64_t(std::clamp(std::round(code), 0.0, 255.0));
}

// A force that only flickers by one step keeps its number.
void putForces(Planes& planes, std::span<const float> forces) {
  std::int64_t last = 0;
  for (float force : forces) {
    std::int64_t now = forceCode(force);
    if (std::abs(now - last) == 1 && now != 0) now = last;
    planes.put(6, now - last);
    last = now;
  }
}

// The strongest hits, in the order of time.
std::vector<std::size_t> hitsToKeep(const TakePoses& poses) {
  std::vector<std::size_t> hits;
  for (std::size_t k = 0; k < poses.events.size(); k++) {
    if (poses.events[k].type == TakeEventType::hit) hits.push_back(k);
  }
  if (hits.size() > kReplayMostHits) {
    auto stronger = [&](std::size_t a, std::size_t b) {
      float x = poses.events[a].impulse, y = poses.events[b].impulse;
      return x != y ? x > y : a < b;
    };
    std::nth_element(hits.begin(), hits.begin() + kReplayMostHits, hits.end(), stronger);
    hits.resize(kReplayMostHits);
    std::sort(hits.begin(), hits.end());
  }
  return hits;
}

void putHits(ByteWriter& out, const TakePoses& poses) {
  std::vector<std::size_t> hits = hitsToKeep(poses);
  out.varint(hits.size());
  std::uint32_t last = 0;
  for (std::size_t k : hits) {
    out.varint(poses.eventFrame[k] - last);
    last = poses.eventFrame[k];
  }
  for (std::size_t k : hits) out.varint(poses.events[k].bodyA);
  for (std::size_t k : hits) out.varint(poses.events[k].bodyB);
  for (int axis = 0; axis < 3; axis++) {
    for (std::size_t k : hits) {
      const TakeEvent& hit = poses.events[k];
      // From the first body's place, in mm: small numbers. One that went in this very frame: from its last.
      out.signedVarint(steps(hit.pointWorld[axis] - poses.pose(hit.bodyA, poses.eventFrame[k]).position[axis], 1e-3));
    }
  }
  for (std::size_t k : hits) out.f32(poses.events[k].impulse);
}

}  // namespace

double replayPositionStep(const TakePoses& poses) {
  double most = 0;
  for (const Transform& pose : poses.poses) {
    for (int axis = 0; axis < 3; axis++) most = std::max(most, std::fabs(pose.position[axis]));
  }
  return std::max(1e-4, most / double(1 << 29));
}

Bytes replayTracks(const TakePoses& poses, double positionStep) {
  Planes planes;
  ByteWriter start, hits;
  for (std::size_t body = 0; body < poses.bodies; body++) {
    if (poses.count(body) == 0) continue;  // of a take without frames
    putPositions(planes, poses.posesOf(body), positionStep, start);
    putRotations(planes, poses.posesOf(body), start);
    putForces(planes, poses.forcesOf(body));
  }
  putHits(hits, poses);

  ByteWriter raw;
  for (double time : poses.times) raw.f64(time);
  for (const Bytes& part :
       {start.bytes(), planes.plane[0], planes.plane[1], planes.plane[2], planes.plane[3], planes.plane[4],
        planes.plane[5], planes.plane[6], planes.large.bytes(), hits.bytes(), poses.mortar.bytes()}) {
    raw.u32(std::uint32_t(part.size()));
    raw.append(part);
  }
  Bytes packed(ZSTD_compressBound(raw.bytes().size()));
  std::size_t size = ZSTD_compress(packed.data(), packed.size(), raw.bytes().data(), raw.bytes().size(), kPackLevel);
  packed.resize(ZSTD_isError(size) ? 0 : size);
  return packed;
}

}  // namespace brickfall
