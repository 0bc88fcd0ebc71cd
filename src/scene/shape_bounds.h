// Axis-aligned bounds of the shapes of a body, from the outside of the engine.
#pragma once
#include "brickfall/body.h"

namespace brickfall::scene {

// Exact for boxes, spheres, capsules and hulls; a plane bounds everything within 1e7 m.
Aabb shapeBounds(const ShapeDef& shape, const Transform& body);
Aabb bodyBounds(const BodyDef& def);

}  // namespace brickfall::scene
