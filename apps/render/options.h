// What brickfall-render can be told, and how the words of the command line become it. Refusals name the flag, what was found and what
// was expected.
#pragma once
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "brickfall/result.h"

namespace brickfall::render {

struct Sun {
  double azimuthDegrees = 0, elevationDegrees = 0;  // azimuth from +z towards +x
};

struct RenderOptions {
  std::string source;                // a take, or a scene, which is then run first
  std::string output;                // .mp4, .png, or a folder (ends with '/'); empty: beside the take
  std::string camera;                // name, or number from 1; empty: the first
  double orbitDegrees = 0;           // that the camera turns about what it looks at
  std::string follow;                // name of a body that it looks at; empty: none
  std::optional<double> from, to;    // s, simulated
  std::optional<std::size_t> frame;  // of the take: one picture
  double framesPerSecond = 25;       // of the film
  double speed = 1;                  // simulated seconds a second of film
  double shutter = 0.5;              // share of a frame's time that it is open
  int width = 960, height = 540;
  std::optional<int> samples;  // of a pixel (TraceSettings); default: kFilmSamples, kStillSamples
  int bounces = 1;
  int threads = 1;
  double exposure = 0;     // in powers of 2
  std::optional<Sun> sun;  // none: over the camera's left shoulder
  bool denoise = true, dust = true, keepFrames = false, quiet = false;
  // Of a scene that is run first.
  std::optional<double> seconds;
  std::vector<std::pair<std::string, std::string>> overrides;
};
constexpr int kFilmSamples = 4, kStillSamples = 64;

// "--from": a number in a range; the flag is named in the error.
Result<double> parseNumber(const char* flag, std::string_view text, double least, double most);
Result<int> parseCount(const char* flag, std::string_view text, int least, int most);
// "960x540"
Result<std::pair<int, int>> parseSize(std::string_view text);
// "AZIMUTH,ELEVATION"
Result<Sun> parseSun(std::string_view text);

enum class OutputKind { film, still, folder };
// By the end of its name; an error for one that cannot be made.
Result<OutputKind> outputKindOf(const std::string& output);
// What the options ask for together can be done: an error names the first that cannot.
Status checkTogether(const RenderOptions& options, OutputKind kind);

}  // namespace brickfall::render
