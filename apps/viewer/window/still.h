// A picture as a PNG file, whole or not at all.
#pragma once
#include <string>

#include "brickfall/result.h"
#include "viewer_window/renderer.h"

namespace brickfall::viewer {

Status saveStill(const Picture& picture, const std::string& path);
// "wall-001.png" in the folder that the program runs in: the first number that is free.
std::string freeStillName(const std::string& scene);

}  // namespace brickfall::viewer
