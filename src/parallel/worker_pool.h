// A pool of workers for loops over independent pieces. What a loop computes must not depend on how it is cut up.
#pragma once
#include <functional>
#include <memory>

#include "brickfall/host.h"

namespace brickfall {

class WorkerPool {
 public:
  // threads: 1 .. 64, this thread included; 1 starts none.
  explicit WorkerPool(int threads);
  // On the threads of a host, which outlives the pool; null: on threads of its own.
  WorkerPool(int threads, TaskSystem* host);
  ~WorkerPool();
  WorkerPool(const WorkerPool&) = delete;
  WorkerPool& operator=(const WorkerPool&) = delete;
  int threads() const;
  // Calls body(begin, end) for pieces of [0, count) of at most `grain`, on all workers; returns when all are done.
  // Called from within a piece, it runs on that thread alone. Not to be called by two threads at once.
  void forRange(int count, int grain, const std::function<void(int begin, int end)>& body);

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
  TaskSystem* host_ = nullptr;
};

}  // namespace brickfall
