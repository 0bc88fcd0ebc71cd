#include "render/options.h"

#include <fmt/core.h>

#include <charconv>
#include <filesystem>

namespace brickfall::render {
namespace {

template <class T> bool readWhole(std::string_view text, T& value) {
  const char* end = text.data() + text.size();
  const auto [stop, error] = std::from_chars(text.data(), end, value);
  return error == std::errc() && stop == end;
}

Error refused(const char* flag, std::string_view found, const std::string& expected) {
  return {ErrorCode::invalidArgument, fmt::format("{}: found \"{}\", expected {}", flag, found, expected)};
}

constexpr int kLeastSide = 16, kMostSide = 4096;

}  // namespace

Result<double> parseNumber(const char* flag, std::string_view text, double least, double most) {
  double value = 0;
  if (readWhole(text, value) && value >= least && value <= most) return value;
  return refused(flag, text, fmt::format("a number {:g} .. {:g}", least, most));
}

Result<int> parseCount(const char* flag, std::string_view text, int least, int most) {
  int value = 0;
  if (readWhole(text, value) && value >= least && value <= most) return value;
  return refused(flag, text, fmt::format("a whole number {} .. {}", least, most));
}

Result<std::pair<int, int>> parseSize(std::string_view text) {
  const std::size_t by = text.find('x');
  int width = 0, height = 0;
  if (by != std::string_view::npos && readWhole(text.substr(0, by), width) && readWhole(text.substr(by + 1), height) &&
      width >= kLeastSide && width <= kMostSide && height >= kLeastSide && height <= kMostSide)
    return std::pair(width, height);
  return refused("--size", text,
                 fmt::format("WIDTHxHEIGHT in pixels, each {} .. {}, such as 960x540", kLeastSide, kMostSide));
}

Result<Sun> parseSun(std::string_view text) {
  const std::size_t comma = text.find(',');
  Sun sun;
  if (comma != std::string_view::npos && readWhole(text.substr(0, comma), sun.azimuthDegrees) &&
      readWhole(text.substr(comma + 1), sun.elevationDegrees) && sun.azimuthDegrees >= -360 &&
      sun.azimuthDegrees <= 360 && sun.elevationDegrees >= 1 && sun.elevationDegrees <= 90)
    return sun;
  return refused("--sun", text, "AZIMUTH,ELEVATION in degrees (-360 .. 360, 1 .. 90), such as 40,35");
}

Result<OutputKind> outputKindOf(const std::string& output) {
  std::error_code ignored;
  if (output.ends_with('/') || std::filesystem::is_directory(output, ignored)) return OutputKind::folder;
  if (output.ends_with(".mp4")) return OutputKind::film;
  if (output.ends_with(".png")) return OutputKind::still;
  return refused("--output", output,
                 "a name that ends with .mp4 (a film), .png (a picture) or / (a folder of pictures)");
}

Status checkTogether(const RenderOptions& options, OutputKind kind) {
  if (kind == OutputKind::film && (options.width % 2 != 0 || options.height % 2 != 0))
    return refused("--size", fmt::format("{}x{}", options.width, options.height), "even numbers for a film");
  if (options.frame && kind != OutputKind::still)
    return refused("--output", options.output, "a .png file, since --frame asks for one picture");
  if (options.frame && (options.from || options.to))
    return refused(options.from ? "--from" : "--to", fmt::format("{:g}", options.from ? *options.from : *options.to),
                   "it left out, since --frame says which picture");
  if (options.to && kind == OutputKind::still)
    return refused("--to", fmt::format("{:g}", *options.to),
                   "it left out for a single picture, which is taken at --from");
  const double from = options.from.value_or(0);
  if (options.to && !(*options.to > from))
    return refused("--to", fmt::format("{:g}", *options.to), fmt::format("a time after --from, {:g} s", from));
  return {};
}

}  // namespace brickfall::render
