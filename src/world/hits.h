// Hits, as listeners are told of them.
#pragma once
#include <memory_resource>
#include <vector>

#include "brickfall/world.h"
#include "solver/tie_report.h"
#include "world/registry.h"

namespace brickfall {

// Hits among impacts, as far as the world asks to hear of them.
void tellHits(const WorldDef& def, const Registry& registry, const std::pmr::vector<TieImpact>& impacts,
              std::vector<HitEvent>& out);

}  // namespace brickfall
