// Hits, as listeners are told of them.
#pragma once
#include <vector>

#include "brickfall/world.h"
#include "solver/contact/rows.h"
#include "world/registry.h"

namespace brickfall {

// Told if the world asks to hear of so much.
void tellHit(const WorldDef& def, const Registry& registry, const ContactRows& rows, const ContactImpact& impact,
             const StepContext& context, std::vector<HitEvent>& out);

}  // namespace brickfall
