// Debug drawing: the engine calls these for each thing it wants shown; empty callbacks are skipped. Nothing in the engine
// knows a window.
#pragma once
#include <cstdint>
#include <functional>

#include "brickfall/ids.h"
#include "brickfall/math.h"
#include "brickfall/shapes.h"

namespace brickfall {

struct DebugDraw {
  // A shape at its world pose. colour is 0xRRGGBB by state (awake, asleep, fixed, quarantined).
  std::function<void(BodyId, const ShapeDef&, const Transform& world, std::uint32_t colour)> shape;
  // A contact point with its normal (from A to B) and normal force in newtons (0 = near, not pressing).
  std::function<void(Vec3 pointWorld, Vec3 normalWorld, double force)> contact;
  // Bounds kept by the broad phase (grown by the margin).
  std::function<void(const Aabb&)> bounds;
  // A line: velocities, also those of surfaces that run; a joint, from a body's centre to its anchor, to the other anchor, to the other centre.
  std::function<void(Vec3 from, Vec3 to, std::uint32_t colour)> line;
};

}  // namespace brickfall
