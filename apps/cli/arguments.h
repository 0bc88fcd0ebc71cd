// Values of command line options: read strictly, and refused with what was found and what was expected.
#pragma once
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "brickfall/result.h"

namespace brickfall::cli {

Result<double> parseSeconds(std::string_view text);
Result<int> parseThreads(std::string_view text);
// "key=value"; the value may be empty or hold '='.
Result<std::pair<std::string, std::string>> parseOverride(std::string_view text);
// The name that is nearest in spelling, empty if none is near.
std::string nearestName(std::string_view name, const std::vector<std::string>& names);

}  // namespace brickfall::cli
