// Hits, as listeners are told of them.
#pragma once
#include <memory_resource>
#include <vector>

#include "brickfall/world.h"
#include "solver/island.h"
#include "world/registry.h"

namespace brickfall {

// Hits of an island's impacts, as far as the world asks to hear of them.
void tellHits(const WorldDef& def, const Registry& registry, const Island& island,
              const std::pmr::vector<ContactImpact>& impacts, const StepContext& context, std::vector<HitEvent>& out);

}  // namespace brickfall
