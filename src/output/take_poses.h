// All poses of a take at once, body by body, which is how both outputs go through them.
#pragma once
#include <vector>

#include "brickfall/output.h"

namespace brickfall {

struct TakePoses {
  std::size_t bodies = 0, frames = 0;
  std::vector<double> times;              // s, per frame
  std::vector<Transform> poses;           // [body * frames + frame]
  std::vector<float> contactForce;        // N, likewise
  std::vector<TakeEvent> events;          // in the order of time
  std::vector<std::uint32_t> eventFrame;  // per event

  const Transform& pose(std::size_t body, std::size_t frame) const { return poses[body * frames + frame]; }
};

// The message of a cancelled output.
Error cancelled(const std::string& path);

// Reports 0 .. share to `progress`.
Result<TakePoses> readPoses(const TakeReader& take, const std::string& path, const Progress& progress, double share);

}  // namespace brickfall
