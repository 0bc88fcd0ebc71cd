// The round of a direct solve that left joints nearest to closed. What turns far in a jam may have no place that its
// joints could reach: each round then leads it further away, by larger forces, until it is thrown.
#pragma once
#include <limits>
#include <memory_resource>
#include <vector>

#include "solver/island.h"

namespace brickfall {

// So much (J) is left to gain in a round: little beside what joints would still do in the next ones.
bool endsRound(double gain, const Island& island);

class JointRound {
 public:
  explicit JointRound(std::pmr::memory_resource* memory)
      : motion_(memory), masses_(memory), records_(memory), starts_(memory) {}
  // Keeps what ended in balance, if it is the nearest. False if another is much nearer: rounds lead away from it.
  bool offer(const Island& island);
  // It is much nearer than the present one.
  bool isLeft(const Island& island) const;
  void restore(Island& island) const;

 private:
  double apart_ = std::numeric_limits<double>::infinity();  // J
  std::pmr::vector<SolveMotion> motion_;
  std::pmr::vector<SolveMass> masses_;
  std::pmr::vector<JointRecord> records_;
  std::pmr::vector<JointStart> starts_;
};

}  // namespace brickfall
