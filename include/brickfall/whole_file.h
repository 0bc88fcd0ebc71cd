// A file that appears whole or not at all.
#pragma once
#include <string>
#include <string_view>

#include "brickfall/result.h"

namespace brickfall {

// Writes it aside ("<path>.part") and renames it into its place; on an error nothing is left behind and an older file stays.
// A device or a pipe is written to as it is.
Status writeWhole(const std::string& path, std::string_view content);

}  // namespace brickfall
