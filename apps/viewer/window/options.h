// What brickfall-view was asked for at the command line.
#pragma once
#include <optional>
#include <string>

#include "brickfall/result.h"
#include "brickfall/scene.h"
#include "viewer_window/native_window.h"
#include "viewer_window/view_options.h"

namespace brickfall::viewer {

struct Options {
  std::string opening = "wall";       // scene, take or saved state
  Overrides overrides;                // of a scene
  bool paused = false, runs = false;  // asked for; neither: paused, unless it quits by itself
  ShadowChoice shadows = ShadowChoice::depth;
  WindowSize size;
  int samples = -1;  // of antialiasing; -1: by who draws
  bool panel = true;
  double seconds = 0;        // s of the window's clock, then it quits; 0: stays
  std::uint64_t frames = 0;  // pictures, as fast as they come, then it quits; 0: stays
  std::string screenshot;    // PNG of the last picture
  std::string log, status;   // files; empty: none
};

// Each says which flag, what was found and what was expected.
Result<WindowSize> parseSize(const std::string& text);
Result<ShadowChoice> parseShadows(const std::string& text);
Result<int> parseSamples(const std::string& text);
Result<double> parseTime(const std::string& text);
Result<std::uint64_t> parseFrames(const std::string& text);

}  // namespace brickfall::viewer
