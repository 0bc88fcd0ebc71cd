#include "cli/arguments.h"

#include <fmt/core.h>

#include <charconv>
#include <cstddef>

namespace brickfall::cli {
namespace {

constexpr double kMaxSeconds = 100'000;
constexpr int kMaxThreads = 64;

template <class T> bool readWhole(std::string_view text, T& value) {
  const char* end = text.data() + text.size();
  const auto [stop, error] = std::from_chars(text.data(), end, value);
  return error == std::errc() && stop == end;
}

Error refused(std::string_view option, std::string_view found, const std::string& expected) {
  return {ErrorCode::invalidArgument, fmt::format("{}: found \"{}\", expected {}", option, found, expected)};
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

Result<std::uint64_t> parseStep(std::string_view text) {
  std::uint64_t value = 0;
  if (readWhole(text, value) && value >= 1) return value;
  return refused("--items", text, "the number of a step, from 1");
}

Result<std::pair<std::string, std::string>> parseOverride(std::string_view text) {
  const std::size_t equals = text.find('=');
  if (equals == std::string_view::npos || equals == 0) return refused("--set", text, "KEY=VALUE, such as world.seed=7");
  return std::pair<std::string, std::string>(text.substr(0, equals), text.substr(equals + 1));
}

}  // namespace brickfall::cli
