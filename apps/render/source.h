// What is to be rendered: a take as it lies there, or a scene that is run to a take first.
#pragma once
#include <memory>
#include <string>

#include "brickfall/take.h"
#include "cli/progress.h"
#include "render/options.h"

namespace brickfall::render {

struct Source {
  bool isScene = false;
  std::string path;               // of the file
  std::string name;               // for the names of results
  std::uint64_t fingerprint = 0;  // of the file's bytes and of what changes a scene: the same source has the same
};
// What the word names: a take by its first bytes or its ending, else a scene by path or shipped name. Complains itself; the exit code is
// that of the command.
struct SourceChoice {
  int exitCode = 0;
  Source source;
};
SourceChoice chooseSource(const RenderOptions& options);

struct OpenedTake {
  int exitCode = 0;
  std::unique_ptr<TakeReader> take;  // null: why is already on standard error
};
OpenedTake openTake(const std::string& path);
// Runs the scene into `takePath`, unless there is a whole take of an earlier start. Ends early when interrupted.
OpenedTake runScene(const Source& source, const RenderOptions& options, const std::string& takePath,
                    cli::ProgressDisplay& display);

}  // namespace brickfall::render
