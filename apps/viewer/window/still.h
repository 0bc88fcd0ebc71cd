// A picture as a PNG file, whole or not at all.
#pragma once
#include <string>

#include "brickfall/result.h"
#include "viewer_window/renderer.h"

namespace brickfall::viewer {

Status saveStill(const Picture& picture, const std::string& path);
// "<folder>/wall-001.png": the first number that is free.
std::string freeStillName(const std::string& scene);

}  // namespace brickfall::viewer
