// brickfall replay: the outputs again, from a recorded take.
#include <cerrno>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <system_error>

#include "brickfall/take.h"
#include "cli/commands.h"
#include "cli/console.h"
#include "cli/files.h"
#include "cli/interrupt.h"
#include "cli/outputs.h"
#include "cli/summary.h"

namespace brickfall::cli {

namespace {

bool exists(const std::string& path, bool empty) {
  std::error_code error;
  const auto bytes = std::filesystem::file_size(path, error);
  return !error && (bytes == 0) == empty;
}

// Whether the figures in the folder are those of the same run with its cost: they stay. An error if they cannot be read.
Result<bool> hasOwnSummary(const std::string& path, const std::string& summary) {
  if (!std::filesystem::exists(path)) return false;
  errno = 0;
  std::ifstream in(path, std::ios::binary);
  const std::string content{std::istreambuf_iterator<char>(in), {}};
  if (!in.is_open() || in.bad())
    return Error{ErrorCode::inputOutput, fmt::format("cannot read '{}': {}", path, std::strerror(errno))};
  return hasCostOf(content, summary);
}

// Why a take cannot be used; of a run that was killed there may be more to say than that there is no such file.
std::string problemOf(const Result<TakeReader>& take, const std::string& path) {
  if (take && take->frameCount() > 0) return "";
  if (take || exists(path, true))
    return fmt::format("'{}': no whole frame was recorded, nothing can be made from it", path);
  const std::string part = path + ".part";
  if (!std::filesystem::exists(path) && exists(part, false))
    return fmt::format("{}; a run that was cut off left '{}'", take.error().message, part);
  return take.error().message;
}

// Standard error, since it is not what was asked for.
void sayWhatIsLost(const TakeReader& take, const std::string& path) {
  const Result<TakeFrame> last = take.frame(take.frameCount() - 1);
  const std::string until = last ? fmt::format(" up to {:.2f} s", last->time) : "";
  complainf("'{}' was cut off: its {} whole frames{} are used, {} bytes of a torn one and the summary are lost", path,
            take.frameCount(), until, take.tornBytes());
}

}  // namespace

int replay(const std::string& takePath, const OutputOptions& options) {
  const Result<TakeReader> take = TakeReader::open(takePath);
  if (const std::string problem = problemOf(take, takePath); !problem.empty()) {
    complain(problem);
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
  if (!take->complete()) sayWhatIsLost(*take, takePath);

  watchInterrupts();
  ProgressDisplay display(ProgressDisplay::modeForOutput(options.quiet));
  OutputsResult written = writeOutputs(*take, folder, options, display);
  if (!take->summaryJson().empty()) {
    const TakeSummary kept = readTakeSummary(take->summaryJson());
    const std::string path = joinPath(folder, "summary.json");
    const Result<bool> stays = hasOwnSummary(path, kept.summary);
    if (!stays) complain(stays.error().message);
    const bool fine =
        stays && (*stays || writeText(path, kept.summary, "the figures (docs/summary.md)", written.files));
    if (!fine) written.exitCode = kFileError;
    if (!kept.series.empty() && !writeText(joinPath(folder, "series.csv"), toCsv(kept.series),
                                           "the figures over time (docs/series.md)", written.files))
      written.exitCode = kFileError;
  }
  if (!options.quiet) {
    sayf("{}: {} frames", printable(take->header().scene), take->frameCount());
    listFiles(written.files);
  }
  return written.exitCode;
}

}  // namespace brickfall::cli
