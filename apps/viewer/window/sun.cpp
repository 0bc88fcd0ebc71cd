#include "viewer_window/sun.h"

#include "appearance/light.h"

namespace brickfall::viewer {

Vec3 towardsSun(Vec3 lookFrom) {
  const appearance::Vec3f sun = appearance::sunOver({float(lookFrom.x), float(lookFrom.y), float(lookFrom.z)});
  return normalized(Vec3{sun.x, sun.y, sun.z});
}

}  // namespace brickfall::viewer
