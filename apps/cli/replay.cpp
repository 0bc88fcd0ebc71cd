// brickfall replay: the outputs again, from a recorded take.
#include <filesystem>

#include "brickfall/take.h"
#include "cli/commands.h"
#include "cli/console.h"
#include "cli/files.h"
#include "cli/interrupt.h"
#include "cli/outputs.h"

namespace brickfall::cli {

int replay(const std::string& takePath, const OutputOptions& options) {
  const Result<TakeReader> take = TakeReader::open(takePath);
  if (!take) {
    complain(take.error().message);
    return kFileError;
  }
  if (take->frameCount() == 0) {
    complainf("'{}': no whole frame was recorded, nothing can be made from it", takePath);
    return kFileError;
  }
  const std::string folder =
      options.folder.empty() ? std::filesystem::path(takePath).parent_path().string() : options.folder;
  if (!folder.empty()) {
    if (const Status made = makeFolder(folder); !made) {
      complain(made.error().message);
      return kFileError;
    }
  }
  if (!take->complete())
    complainf("'{}' was cut off: {} whole frames are used, there is no summary", takePath, take->frameCount());

  watchInterrupts();
  ProgressDisplay display(ProgressDisplay::modeForOutput(options.quiet));
  OutputsResult written = writeOutputs(*take, folder, options, display);
  if (!take->summaryJson().empty()) {
    const std::string path = joinPath(folder, "summary.json");
    if (const Status status = writeWhole(path, take->summaryJson())) {
      written.files.push_back({path, "the figures (docs/summary.md)"});
    } else {
      complain(status.error().message);
      written.exitCode = kFileError;
    }
  }
  if (!options.quiet) {
    sayf("{}: {} frames", printable(take->header().scene), take->frameCount());
    listFiles(written.files);
  }
  return written.exitCode;
}

}  // namespace brickfall::cli
