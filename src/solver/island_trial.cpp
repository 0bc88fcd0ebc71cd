#include "solver/island_trial.h"

namespace brickfall {

TiesMemory::TiesMemory(const Island& island, Ties& ties)
    : rows_(island.rows), ties_(ties), memory_(Rows::memoryFrom(island.memory)) {
  rows_.remember(ties_, memory_);
}

void TiesMemory::restore() const { rows_.restore(ties_, memory_); }

IslandTrial::IslandTrial(Island& island, Ties& ties, BodySet& bodies)
    : island_(island), bodies_(bodies), ties_(island, ties), states_(island.memory), fields_(fieldsOf(island)) {
  for (BodyIndex body : island.bodies) states_.emplace_back(bodies.motion[body], bodies.data[body]);
}

void IslandTrial::restore() const {
  ties_.restore();
  for (std::size_t i = 0; i < states_.size(); i++)
    std::tie(bodies_.motion[island_.bodies[i]], bodies_.data[island_.bodies[i]]) = states_[i];
  fieldsOf(island_) = fields_;
}

}  // namespace brickfall
