// What the replay page must know beside the motion: bodies, shapes, cameras, as JSON that is safe inside a script element.
#pragma once
#include <string>

#include "brickfall/take.h"

namespace brickfall {

std::string replayMeta(const TakeReader& take, const std::vector<TakeBreak>& breaks, double positionStep);

}  // namespace brickfall
