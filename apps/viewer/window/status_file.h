// What the viewer is doing, a line of JSON each second and after each action, for whoever drives it from outside: tests check
// facts by it and not only pixels.
#pragma once
#include <cstdio>
#include <memory>
#include <string>

#include "brickfall/result.h"
#include "viewer_core/frame.h"
#include "viewer_window/desk.h"

namespace brickfall::viewer {

class StatusFile {
 public:
  // An empty path: writes nowhere.
  static Result<StatusFile> open(const std::string& path);
  // `why`: "second", or what was done.
  void write(const std::string& why, const Desk& desk, const Frame& frame, std::uint64_t pictures, std::size_t lines);
  bool isOpen() const { return file_ != nullptr; }

 private:
  struct Close {
    void operator()(std::FILE* file) const { std::fclose(file); }
  };
  std::unique_ptr<std::FILE, Close> file_;
};

}  // namespace brickfall::viewer
