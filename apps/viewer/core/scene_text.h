// A moment as a scene file: every body where it is, with its velocity. A scene that begins there.
#pragma once
#include <string>

#include "brickfall/scenery.h"
#include "viewer_core/frame.h"

namespace brickfall::viewer {

struct SceneText {
  std::string text;
  std::string leftOut;  // "joints and mortar"; empty: nothing
};
// Of a run and of a take. A frame knows neither joints, mortar nor machines, and no file of a mesh: these are left out.
SceneText sceneTextOf(const Frame& frame, const Camera& view);

}  // namespace brickfall::viewer
