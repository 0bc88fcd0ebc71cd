// Hits, as listeners are told of them.
#pragma once
#include <vector>

#include "brickfall/world.h"
#include "dynamics/contact.h"
#include "solver/contact/record.h"
#include "world/registry.h"

namespace brickfall {

// A contact was hit at this speed (m/s) by this impulse (N s): told if the world asks to hear of so much.
void tellHit(const WorldDef& def, const Registry& registry, const Contact& contact, const ContactRecord& record,
             double speed, double impulse, std::vector<HitEvent>& out);

}  // namespace brickfall
