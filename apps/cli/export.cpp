// brickfall export: a take as numbers for other programs.
#include <algorithm>
#include <filesystem>

#include "brickfall/export.h"
#include "brickfall/scene.h"
#include "brickfall/take.h"
#include "cli/commands.h"
#include "cli/console.h"
#include "cli/files.h"
#include "cli/interrupt.h"
#include "cli/outputs.h"

namespace brickfall::cli {
namespace {

const ExportKind* findKind(const std::string& name) {
  const auto kinds = exportKinds();
  const auto at = std::find_if(kinds.begin(), kinds.end(), [&](const ExportKind& kind) { return kind.name == name; });
  return at == kinds.end() ? nullptr : &*at;
}

// "csv, json, npz"
std::string knownKinds() {
  std::string out;
  for (const ExportKind& kind : exportKinds()) out += (out.empty() ? "" : ", ") + std::string(kind.name);
  return out;
}

int complainOfKind(const std::string& name) {
  std::vector<std::string> known;
  for (const ExportKind& kind : exportKinds()) known.emplace_back(kind.name);
  complainf("--to: found \"{}\", expected one of: {}{}", name, knownKinds(), didYouMean(name, known));
  return kBadInput;
}

}  // namespace

int exportTake(const ExportCommand& command) {
  for (const std::string& name : command.kinds)
    if (!findKind(name)) return complainOfKind(name);
  const Result<TakeReader> take = TakeReader::open(command.take);
  if (!take) return complain(take.error().message), kFileError;
  if (take->frameCount() == 0) {
    complainf("'{}': no whole frame was recorded, nothing can be made from it", command.take);
    return kFileError;
  }
  const std::string folder =
      command.folder.empty() ? std::filesystem::path(command.take).parent_path().string() : command.folder;
  if (!folder.empty())
    if (const Status made = makeFolder(folder); !made) return complain(made.error().message), kFileError;
  if (!take->complete())
    complainf("'{}' was cut off: its {} whole frames are used, there is no series", command.take, take->frameCount());

  watchInterrupts();
  ProgressDisplay display(ProgressDisplay::modeForOutput(command.quiet));
  std::vector<WrittenFile> written;
  int exitCode = kOk;
  for (const std::string& name : command.kinds) {
    const ExportKind& kind = *findKind(name);
    std::vector<std::string> files;
    const Status status = kind.write(
        *take, joinPath(folder, safeFileName(take->header().scene)), {command.every},
        [&](double share) {
          display.update(std::string("writing ") + kind.name, share);
          return interruptCount() == 0;
        },
        files);
    display.finish();
    for (const std::string& file : files) written.push_back({file, kind.purpose});
    if (status) continue;
    if (interruptCount() > 0) {
      complain("interrupted while writing: the take stays as it is");
      exitCode = interruptExitCode();
      break;
    }
    complain(status.error().message);
    exitCode = kFileError;
  }
  if (!command.quiet) listFiles(written);
  return exitCode;
}

}  // namespace brickfall::cli
