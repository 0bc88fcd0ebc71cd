// Hits, as listeners are told of them.
#pragma once
#include <memory_resource>
#include <vector>

#include "brickfall/world.h"
#include "solver/island.h"
#include "world/registry.h"

namespace brickfall {

// Those of an island's impacts that the world asks to hear of.
void tellHits(const WorldDef& def, const Registry& registry, const Island& island,
              const std::pmr::vector<ContactImpact>& impacts, const StepContext& context, std::vector<HitEvent>& out);

}  // namespace brickfall
