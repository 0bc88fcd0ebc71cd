// Where the camera of a film is at a moment: on its path, turned about what it looks at, looking after a body.
#pragma once
#include <optional>

#include "brickfall/scenery.h"
#include "render/motion.h"

namespace brickfall::render {

struct CameraMove {
  Camera camera;
  double orbitDegrees = 0;              // about the vertical through its target, from the first picture to the last
  double from = 0, to = 0;              // s: of these; a single picture is the last
  std::optional<std::uint32_t> follow;  // a body's number: while it is there it is the target
};
Camera cameraAt(const CameraMove& move, double time, const Instant& instant);

}  // namespace brickfall::render
