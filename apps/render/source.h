// What is to be rendered: a take as it lies there, or a scene that is run to a take first.
#pragma once
#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "brickfall/take.h"
#include "cli/progress.h"
#include "render/options.h"

namespace brickfall::render {

struct Source {
  bool isScene = false;
  std::string path;                                     // of the file
  std::string name;                                     // for the names of results
  std::vector<std::shared_ptr<const MeshTree>> meshes;  // of a scene: read from files of their own
};
// What the word names: a take by its first bytes or its ending, else a scene by path or shipped name. Complains itself; the exit code is
// that of the command.
struct SourceChoice {
  int exitCode = 0;
  Source source;
};
SourceChoice chooseSource(const RenderOptions& options);
// Of the file's bytes and, of a scene, of its meshes and of what the options change in it: the same source has the same.
Result<std::uint64_t> fingerprintOf(const Source& source, const RenderOptions& options);

struct OpenedTake {
  int exitCode = 0;
  std::unique_ptr<TakeReader> take;  // null: why is already on standard error
};
OpenedTake openTake(const std::string& path);
// Runs the scene into `takePath`. Ends early when interrupted.
OpenedTake runScene(const Source& source, const RenderOptions& options, const std::string& takePath,
                    cli::ProgressDisplay& display);

}  // namespace brickfall::render
