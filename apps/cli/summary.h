// summary.json: the figures of a run for people and scripts. docs/summary.md explains each key.
#pragma once
#include <cstdint>
#include <string>

#include "cli/metrics.h"

namespace brickfall::cli {

struct Summary {
  std::string scene;
  std::uint64_t seed = 0;
  std::uint64_t stateHash = 0;
  double timeStep = 0;  // s
  int threads = 1;
  double wallClockSeconds = 0;
  RunFigures figures;
  std::string file;  // the scene file, absolute; "-": standard input
};

// Ends with a line break.
std::string toJson(const Summary& summary);

}  // namespace brickfall::cli
