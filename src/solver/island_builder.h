// Which bodies their ties join: islands, kept from step to step where nothing changed.
#pragma once
#include <memory>
#include <vector>

#include "solver/island.h"

namespace brickfall {

// An island lies in the same memory that it uses.
struct IslandDeleter {
  void operator()(Island* island) const;
};
using IslandPointer = std::unique_ptr<Island, IslandDeleter>;
IslandPointer makeIsland(std::pmr::memory_resource* memory);

struct IslandSet {
  std::vector<IslandPointer> awake;  // by lowest body
  std::vector<IslandPointer> asleep;
  std::vector<BodyIndex> single;       // awake dynamic bodies without ties, ascending
  std::vector<IslandPointer> scratch;  // of buildIslands

  // Makes room ahead of a step, so that the step itself takes no memory.
  void keepRoom(std::size_t dynamicBodies);
};

// Joins awake bodies by their links. An island with the bodies and ties of an old one stays the old object, with its
// hierarchy.
void buildIslands(IslandSet& islands, Ties& ties, const StepContext& context,
                  const std::vector<BodyIndex>& awakeBodies);

// Makes the hierarchy of an island anew if its ties have changed.
void updateHierarchy(Island& island, const StepContext& context);

}  // namespace brickfall
