// The tools of a step's solve: the context that its stages share, the memory that islands lie in, and the workers.
#pragma once
#include <memory>

#include "base/pool.h"
#include "parallel/worker_pool.h"
#include "solver/step_context.h"

namespace brickfall {

struct SolveState {
  Pool memory;  // of islands and of a stage's scratch; outlives both
  StepContext context;
  std::unique_ptr<WorkerPool> workers;  // never null in a world

  void keepRoom(std::size_t dynamicBodies, std::size_t slots);
};

}  // namespace brickfall
