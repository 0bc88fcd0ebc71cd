#include "brickfall/world.h"

namespace brickfall {

const char* versionString() { return BRICKFALL_VERSION; }

}  // namespace brickfall
