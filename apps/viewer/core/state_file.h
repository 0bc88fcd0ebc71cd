// Where a scene came from, and a run saved to a file: the text of its scene and a snapshot. The file needs nothing else, but for
// meshes that the scene reads from files of their own.
#pragma once
#include <string>
#include <vector>

#include "brickfall/scene.h"

namespace brickfall::viewer {

struct SceneSource {
  std::string file;  // absolute path, for messages and meshes
  std::string text;
  Overrides overrides;
};

struct SavedState {
  SceneSource source;
  std::vector<std::byte> snapshot;  // of SceneRun
};

// Whole or not at all. The number of bytes.
Result<std::size_t> writeState(const std::string& path, const SavedState& state);
bool isState(const std::string& bytes);  // begins like one
Result<SavedState> readState(const std::string& path, const std::string& bytes);

// The whole file; an error names it and says why.
Result<std::string> readFile(const std::string& path, std::size_t mostBytes);
// The first bytes of a file.
Result<std::string> readStart(const std::string& path, std::size_t bytes);

}  // namespace brickfall::viewer
