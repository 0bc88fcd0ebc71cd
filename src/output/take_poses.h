// All poses of a take at once, body by body, which is how both outputs go through them. A body has poses only for the frames in
// which it is there.
#pragma once
#include <span>
#include <vector>

#include "brickfall/output.h"
#include "record/byte_stream.h"

namespace brickfall {

struct TakePoses {
  std::size_t bodies = 0, frames = 0;
  std::vector<double> times;              // s, per frame
  std::vector<TakeLife> lives;            // of each body
  std::vector<std::size_t> start;         // of each body: where its poses begin
  std::vector<Transform> poses;           // [start[body] + frame - birth]
  std::vector<float> contactForce;        // N, likewise
  std::vector<float> speed;               // m/s, likewise
  std::vector<TakeEvent> events;          // in the order of time
  std::vector<std::uint32_t> eventFrame;  // of each event
  std::vector<TakeBreak> breaks;          // of mortar, in the order in which they became known
  // Per frame: a varint count, then for each joint that changed a varint (its number less that of the one before) and two
  // bytes, utilisation and damage in steps of 1 / 255. Before its first frame a joint has 0 and 0.
  ByteWriter mortar;

  std::span<const Transform> posesOf(std::size_t body) const { return {poses.data() + start[body], count(body)}; }
  std::span<const float> forcesOf(std::size_t body) const { return {contactForce.data() + start[body], count(body)}; }
  std::span<const double> timesOf(std::size_t body) const {
    return std::span(times).subspan(lives[body].birth, count(body));
  }
  std::size_t count(std::size_t body) const { return lives[body].end - lives[body].birth; }
  // At the frame, or at the nearest in which the body is there.
  const Transform& pose(std::size_t body, std::size_t frame) const;
};

// Reports progress from 0 to `share`.
Result<TakePoses> readPoses(const TakeReader& take, const std::string& path, const Progress& progress, double share);
Error cancelled(const std::string& path);

}  // namespace brickfall
