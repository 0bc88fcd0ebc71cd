// What a trial of an island's step changes, as it was before: one place that puts all of it back.
//
// The lists that the solve reads (records, motion, masses, residuals) are left as the trial made them: every step makes
// them anew before it reads them. So are facts and plan, which what the trial found is judged by, and StepContext::free
// and ::solved, which are what a trial is made for.
#pragma once
#include <memory_resource>
#include <tuple>
#include <utility>
#include <vector>

#include "solver/island.h"

namespace brickfall {

// What the ties of an island remember.
class TiesMemory {
 public:
  TiesMemory(const Island& island, Ties& ties)
      : rows_(island.rows), ties_(ties), memory_(Rows::memoryFrom(island.memory)) {
    rows_.remember(ties_, memory_);
  }
  void restore() const { rows_.restore(ties_, memory_); }

 private:
  const Rows& rows_;
  Ties& ties_;
  Rows::Memory memory_;
};

class IslandTrial {
 public:
  IslandTrial(Island& island, Ties& ties, BodySet& bodies)
      : island_(island), bodies_(bodies), ties_(island, ties), states_(island.memory), fields_(fieldsOf(island)) {
    states_.reserve(island.bodies.size());
    for (BodyIndex body : island.bodies) states_.emplace_back(bodies.motion[body], bodies.data[body]);
  }
  // To be called as long as the island has the same bodies and ties.
  void restore() const {
    ties_.restore();
    for (std::size_t i = 0; i < states_.size(); i++)
      std::tie(bodies_.motion[island_.bodies[i]], bodies_.data[island_.bodies[i]]) = states_[i];
    fieldsOf(island_) = fields_;
  }

 private:
  static std::tuple<double&, IslandEnding&, double&> fieldsOf(Island& i) { return {i.dt, i.ending, i.fastestLately}; }

  Island& island_;
  BodySet& bodies_;
  TiesMemory ties_;
  std::pmr::vector<std::pair<BodyMotion, BodyData>> states_;  // by body
  std::tuple<double, IslandEnding, double> fields_;
};

}  // namespace brickfall
