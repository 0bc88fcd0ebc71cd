// Where a scene came from, and a run saved to a file: the text of its scene, what was set otherwise for its beginning, and a
// snapshot. The file needs nothing else, but for meshes that the scene reads from files of their own.
#pragma once
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "brickfall/scene.h"

namespace brickfall::viewer {

struct SceneSource {
  std::string file;  // absolute path, for messages and meshes
  std::string text;
  Overrides overrides;
};

// Keys of settingRows() with values.
using SavedSettings = std::vector<std::pair<std::string, double>>;

struct SavedState {
  SceneSource source;
  SavedSettings
      settings;  // which a run has from its start on, where the panel can change them: the snapshot fits no others
  std::vector<std::byte> snapshot;  // of SceneRun
};

// Whole or not at all. The number of bytes.
Result<std::size_t> writeState(const std::string& path, const SavedState& state);
bool isState(std::string_view bytes);  // begins like one, of this or another version
Result<SavedState> readState(const std::string& path, const std::string& bytes);

// A file, or a pipe, which can be read only once: its beginning tells what it is. An error names it and says why.
class InputFile {
 public:
  static Result<InputFile> open(const std::string& path);
  InputFile(InputFile&&) noexcept;
  InputFile& operator=(InputFile&&) = delete;
  ~InputFile();
  // Reads on until there are so many bytes, or all.
  Status readUpTo(std::size_t bytes);
  // All of it; an error if there are more.
  Status readAll(std::size_t mostBytes);
  std::string& text() { return text_; }  // what was read

 private:
  InputFile(std::string path, int file) : path_(std::move(path)), file_(file) {}
  std::string path_, text_;
  int file_ = -1;
};

}  // namespace brickfall::viewer
