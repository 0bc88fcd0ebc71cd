// Axis-aligned bounds of a body before it is made.
#pragma once
#include "brickfall/body.h"

namespace brickfall::scene {

Aabb bodyBounds(const BodyDef& def);

}  // namespace brickfall::scene
