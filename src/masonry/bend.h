// Lintels of round walls: what of them is straight enough for a box, and the straight pieces of one that is bent.
#pragma once
#include <vector>

#include "brickfall/masonry.h"

namespace brickfall::masonry {

// m along the middle of a round wall: a straight piece so long lies beside the circle by a tenth of the wall's thickness.
double straightTo(double radius, double thickness);
// The boxes that a brick is nearly made of, as bricks in the world: itself, unless it is bent.
std::vector<BrickPlacement> piecesOf(const BrickPlacement& brick);

}  // namespace brickfall::masonry
