#include "viewer_window/options.h"

#include <charconv>
#include <cmath>

namespace brickfall::viewer {
namespace {

// All of the text is the number, or it is none.
template <class Number> std::optional<Number> numberIn(const std::string& text) {
  Number value{};
  const auto [end, problem] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (problem != std::errc() || end != text.data() + text.size()) return {};
  return value;
}

Error wrong(const char* flag, const std::string& found, const std::string& expected) {
  return {ErrorCode::invalidArgument, std::string(flag) + ": found '" + found + "', expected " + expected};
}

}  // namespace

Result<WindowSize> parseSize(const std::string& text) {
  const std::size_t cross = text.find('x');
  const auto width = numberIn<int>(text.substr(0, cross));
  const auto height = cross == std::string::npos ? std::nullopt : numberIn<int>(text.substr(cross + 1));
  if (!width || !height || *width < 320 || *height < 200 || *width > 8192 || *height > 8192) {
    return wrong("--size", text, "WIDTHxHEIGHT in pixels, 320x200 to 8192x8192, such as 1280x720");
  }
  return WindowSize{*width, *height};
}

Result<ShadowChoice> parseShadows(const std::string& text) {
  for (int i = 0; i < kShadowChoiceCount; i++) {
    if (text == nameOf(ShadowChoice(i))) return ShadowChoice(i);
  }
  return wrong("--shadows", text, "depth, stencil or none" + didYouMean(text, {"depth", "stencil", "none"}));
}

Result<int> parseSamples(const std::string& text) {
  const auto samples = numberIn<int>(text);
  if (!samples || (*samples != 0 && *samples != 2 && *samples != 4 && *samples != 8)) {
    return wrong("--samples", text, "0, 2, 4 or 8");
  }
  return *samples;
}

Result<double> parseTime(const std::string& text) {
  const auto seconds = numberIn<double>(text);
  if (!seconds || !(*seconds > 0) || !(*seconds <= 1e6))
    return wrong("--time", text, "seconds above 0, at most 1000000");
  return *seconds;
}

Result<std::uint64_t> parseFrames(const std::string& text) {
  const auto frames = numberIn<std::uint64_t>(text);
  if (!frames || *frames == 0 || *frames > 1'000'000'000)
    return wrong("--frames", text, "a whole number, 1 to 1000000000");
  return *frames;
}

}  // namespace brickfall::viewer
