// "did you mean": the known word nearest to a misspelt one.
#pragma once
#include <string>
#include <string_view>
#include <vector>

#include "brickfall/scene.h"  // didYouMean

namespace brickfall::scene {

// Empty if none is near. Case, '-' for '_' and swapped neighbours count little.
std::string nearest(std::string_view word, const std::vector<std::string>& known);

}  // namespace brickfall::scene
