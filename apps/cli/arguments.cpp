#include "cli/arguments.h"

#include <fmt/core.h>

#include <algorithm>
#include <charconv>
#include <cstddef>

namespace brickfall::cli {
namespace {

constexpr double kMaxSeconds = 100'000;
constexpr int kMaxThreads = 64;

template <class T>
bool readWhole(std::string_view text, T& value) {
  const char* end = text.data() + text.size();
  const auto [stop, error] = std::from_chars(text.data(), end, value);
  return error == std::errc() && stop == end;
}

Error refused(std::string_view option, std::string_view found, const std::string& expected) {
  return {ErrorCode::invalidArgument, fmt::format("{}: found '{}', expected {}", option, found, expected)};
}

// Letters to change, add or drop to make a into b.
std::size_t editDistance(std::string_view a, std::string_view b) {
  std::vector<std::size_t> row(b.size() + 1);
  for (std::size_t j = 0; j <= b.size(); j++) row[j] = j;
  for (std::size_t i = 1; i <= a.size(); i++) {
    std::size_t diagonal = row[0];
    row[0] = i;
    for (std::size_t j = 1; j <= b.size(); j++) {
      const std::size_t above = row[j];
      row[j] = std::min({above + 1, row[j - 1] + 1, diagonal + (a[i - 1] != b[j - 1])});
      diagonal = above;
    }
  }
  return row[b.size()];
}

}  // namespace

Result<double> parseSeconds(std::string_view text) {
  double value = 0;
  if (readWhole(text, value) && value > 0 && value <= kMaxSeconds) return value;
  return refused("--seconds", text, fmt::format("a number of seconds above 0, at most {}", kMaxSeconds));
}

Result<int> parseThreads(std::string_view text) {
  int value = 0;
  if (readWhole(text, value) && value >= 1 && value <= kMaxThreads) return value;
  return refused("--threads", text, fmt::format("a whole number from 1 to {}", kMaxThreads));
}

Result<std::pair<std::string, std::string>> parseOverride(std::string_view text) {
  const std::size_t equals = text.find('=');
  if (equals == std::string_view::npos || equals == 0)
    return refused("--set", text, "KEY=VALUE, such as world.seed=7");
  return std::pair<std::string, std::string>(text.substr(0, equals), text.substr(equals + 1));
}

std::string nearestName(std::string_view name, const std::vector<std::string>& names) {
  std::string nearest;
  std::size_t least = std::max<std::size_t>(2, name.size() / 3) + 1;
  for (const std::string& candidate : names) {
    const std::size_t distance = editDistance(name.substr(0, 100), candidate);
    if (distance < least && distance < std::max(name.size(), candidate.size())) {
      least = distance;
      nearest = candidate;
    }
  }
  return nearest;
}

}  // namespace brickfall::cli
