// Which bodies hang together: islands from contacts, kept from step to step where nothing changed.
#pragma once
#include <memory>
#include <vector>

#include "solver/island.h"

namespace brickfall {

struct IslandSet {
  std::vector<std::unique_ptr<Island>> awake;  // by lowest body
  std::vector<std::unique_ptr<Island>> asleep;
  std::vector<BodyIndex> single;  // awake dynamic bodies without contacts, ascending
};

// Joins awake bodies by the contacts of ContactSet::pairs that have points. An island whose bodies and contacts are those
// of an old one is that old one, with its hierarchies.
void buildIslands(IslandSet& islands, const StepContext& context, const std::vector<BodyIndex>& awakeBodies);

// Hierarchies of an island, as far as they are out of date: by strength when its contacts changed, by mechanism also when
// a weak flag did.
void updateHierarchies(Island& island, const ContactSet& contacts);

}  // namespace brickfall
