// What lists and cameras ask of a body's shapes, the same of live runs and takes.
#pragma once
#include <vector>

#include "brickfall/shapes.h"

namespace brickfall::viewer {

constexpr double kNoGround = -1e30;  // m

// m, about the body's origin: of a ball around all but planes.
double radiusOf(const std::vector<ShapeDef>& shapes);
// m: height of what planes that face up and boxes have on top; kNoGround without any (a mesh has no one height).
double topOf(const std::vector<ShapeDef>& shapes, const Transform& body);

}  // namespace brickfall::viewer
