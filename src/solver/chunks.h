// Chunks: bodies of an island that mortar or fixed joints join, directly or through others. A chunk moves as one body,
// both in flight (Chunks) and, in mortar, on the ground (finish/rigid_groups.cpp).
#pragma once
#include <memory_resource>
#include <vector>

#include "dynamics/body_set.h"
#include "dynamics/ties.h"
#include "solver/rigid_sum.h"

namespace brickfall {

struct Island;
struct StepContext;

// By body: the lowest of its chunk; kNoIndex: it is in none.
std::pmr::vector<std::uint32_t> chunksOf(const Island& island, const Ties& ties);

// In flight.
class Chunks {
 public:
  explicit Chunks(std::pmr::memory_resource* memory) : ways_(memory), chunkOf_(memory) {}

  // Of this step, by free motion. None where anything holds the island, or joints do not make it one.
  void find(const Island& island, const StepContext& context);
  // The motion of the chunk that is all of the island; null if it is not one chunk.
  const RigidWay* ofAll() const { return all_ ? &ways_[0] : nullptr; }
  bool any() const { return !chunkOf_.empty(); }
  // The motion of the chunk that a body of the island is in; null for a body in none.
  const RigidWay* of(std::uint32_t body) const {
    return any() && chunkOf_[body] != kNoIndex ? &ways_[chunkOf_[body]] : nullptr;
  }
  // Starts the solve of each chunk from its motion. Its bodies' velocities are the ways of the last step, chords of
  // their arcs: from these, firm ties would begin with forces a thousandfold theirs.
  void start(Island& island, const StepContext& context) const;

 private:
  bool all_ = false;
  std::pmr::vector<RigidWay> ways_;          // by the lowest body of a chunk
  std::pmr::vector<std::uint32_t> chunkOf_;  // by body; empty: there are no chunks
};

}  // namespace brickfall
