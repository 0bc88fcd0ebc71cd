// Where the sun stands: one place for the light, the sky and both kinds of shadow.
#pragma once
#include "brickfall/math.h"

namespace brickfall::viewer {

// Unit, towards the sun. `lookFrom`: from what is looked at to the first camera of a scene. The sun stands to the left of that,
// so that what is seen first is lit aslant and shows its joints.
Vec3 towardsSun(Vec3 lookFrom);

}  // namespace brickfall::viewer
