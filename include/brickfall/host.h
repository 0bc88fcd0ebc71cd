// Where a world takes its threads from, if not from its own: the task system of the program that it is part of.
#pragma once
#include <functional>

namespace brickfall {

class TaskSystem {
 public:
  virtual ~TaskSystem() = default;
  // 1 .. 64: how many pieces it can run at once; 1: no loop is cut up.
  virtual int threads() const = 0;
  // Calls body(begin, end) for pieces of [0, count) of at most `grain`, on any threads and in any order, each index once, and
  // returns when all are done. count >= 1, grain >= 1. What a loop computes does not depend on how it is cut up.
  virtual void forRange(int count, int grain, const std::function<void(int begin, int end)>& body) = 0;
};

}  // namespace brickfall
