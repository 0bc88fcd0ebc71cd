// How near to the eye the picture may begin.
#pragma once
#include "viewer_core/frame.h"

namespace brickfall::viewer {

constexpr double kLeastNear = 0.05;  // m

// m from the eye: as far as nothing is in the way. Depth is kept in steps that grow with the square of the distance and shrink with
// this one: from 5 cm on, a wall 80 m away has steps of 7 mm, in which the edges of stencil shadows get lost.
double nearPlaneOf(const Frame& frame, double blend, Vec3 eye);

}  // namespace brickfall::viewer
