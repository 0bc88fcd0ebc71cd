// Pictures to a film, by the program ffmpeg through a pipe.
#pragma once
#include <functional>
#include <string>

#include "brickfall/result.h"
#include "render/picture.h"

namespace brickfall::render {

// The program's path, from the folders of PATH; empty if there is none.
std::string findProgram(const std::string& name);

struct FilmSettings {
  std::string program;  // ffmpeg
  std::string path;     // of the film, which appears whole or not at all
  int width = 0, height = 0;
  double framesPerSecond = 30;
  std::size_t frames = 0;
};
// `frame` gives each picture; `progress` is asked after each and ends it by false (nothing is then left, and the status is good).
Status makeFilm(const FilmSettings& settings, const std::function<Result<Image>(std::size_t)>& frame,
                const std::function<bool(std::size_t done)>& progress);

}  // namespace brickfall::render
