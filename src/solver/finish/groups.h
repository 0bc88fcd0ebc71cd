// Groups of an island, found once a step when its forces are known: bodies that rows tie to each other, directly or
// through others. A contact ties while it carries force. All bodies that something fixed or kinematic supports are one
// group: they act on each other through it.
#pragma once
#include <cstdint>
#include <memory_resource>
#include <span>
#include <vector>

#include "dynamics/body_set.h"

namespace brickfall {

struct Island;
struct StepContext;

class Groups {
 public:
  explicit Groups(std::pmr::memory_resource* memory)
      : of_(memory), pieceOf_(memory), bodies_(memory), begin_(memory), partner_(memory) {}

  // By the forces that the island's ties carry. An island that rests has no groups.
  void find(const Island& island, const StepContext& context);

  std::size_t count() const { return partner_.size(); }
  // Numbers in the island, ascending.
  std::span<const std::uint32_t> bodies(std::size_t group) const {
    return {bodies_.data() + begin_[group], bodies_.data() + begin_[group + 1]};
  }
  std::uint32_t groupOf(std::size_t body) const { return of_[body]; }
  // The lowest of those bodies that ties join it to without anything fixed or kinematic.
  std::uint32_t pieceOf(std::size_t body) const { return pieceOf_[body]; }
  // No tie that carries force leads from the group to anything fixed or kinematic.
  bool flies(std::size_t group) const { return partner_[group] == kNoIndex; }
  // One of the fixed or kinematic bodies that the group presses on, as numbered in Island::motion.
  std::uint32_t partner(std::size_t group) const { return partner_[group]; }

 private:
  std::pmr::vector<std::uint32_t> of_;       // body -> group
  std::pmr::vector<std::uint32_t> pieceOf_;  // body -> its piece of the group
  std::pmr::vector<std::uint32_t> bodies_;   // by group
  std::pmr::vector<std::uint32_t> begin_;    // group -> its first place in bodies_; one more at the end
  std::pmr::vector<std::uint32_t> partner_;  // group -> the body that it presses on
};

}  // namespace brickfall
