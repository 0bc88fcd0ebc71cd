// Values of command line options: read strictly, and refused with what was found and what was expected.
#pragma once
#include <cstdint>
#include <string>
#include <string_view>
#include <utility>

#include "brickfall/result.h"

namespace brickfall::cli {

Result<double> parseSeconds(std::string_view text);
Result<int> parseThreads(std::string_view text);
Result<std::uint64_t> parseStep(std::string_view text);  // of --items, from 1
// "key=value"; the value may be empty or hold '='.
Result<std::pair<std::string, std::string>> parseOverride(std::string_view text);

}  // namespace brickfall::cli
