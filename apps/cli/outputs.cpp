#include "cli/outputs.h"

#include <algorithm>
#include <functional>

#include "brickfall/output.h"
#include "cli/console.h"
#include "cli/files.h"
#include "cli/interrupt.h"

namespace brickfall::cli {

OutputsResult writeOutputs(const TakeReader& take, const std::string& folder, const OutputOptions& options,
                           ProgressDisplay& display) {
  using Write = Status (*)(const TakeReader&, const std::string&, const Progress&);
  struct Job {
    bool wanted;
    Write write;
    std::string name, purpose;
  };
  const Job jobs[] = {
      {options.html, writeReplayHtml, "replay.html", "to watch: opens in any browser"},
      {options.glb, writeGlb, safeFileName(take.header().scene) + ".glb", "for Blender and other tools"},
  };
  OutputsResult result;
  const int interruptsBefore = interruptCount();
  const auto interrupted = [&] { return interruptCount() > interruptsBefore; };
  for (const Job& job : jobs) {
    if (!job.wanted || interrupted()) continue;
    const std::string path = joinPath(folder, job.name);
    const Status written = job.write(take, path, [&](double share) {
      display.update("writing " + printable(path), share);
      return !interrupted();
    });
    display.finish();
    if (written) {
      result.files.push_back({path, job.purpose});
    } else if (!interrupted()) {
      complain(written.error().message);
      result.exitCode = kFileError;
    }
  }
  if (interrupted()) {
    complain("interrupted while writing: the recording is kept, 'brickfall replay' makes the rest from it");
    result.exitCode = interruptExitCode();
  }
  return result;
}

void listFiles(const std::vector<WrittenFile>& files) {
  std::size_t widest = 0;
  for (const WrittenFile& file : files) widest = std::max(widest, file.path.size());
  for (const WrittenFile& file : files)
    sayf("  {:<{}}  {:>8}  {}", printable(file.path), widest, sizeText(file.path), file.purpose);
}

}  // namespace brickfall::cli
