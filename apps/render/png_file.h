// PNG files: whole or not at all.
#pragma once
#include <string>

#include "brickfall/result.h"
#include "render/picture.h"

namespace brickfall::render {

Status writePng(const std::string& path, const Image& image);
Result<Image> readPng(const std::string& path);

}  // namespace brickfall::render
