#include "cli/outputs.h"

#include <algorithm>
#include <functional>

#include "brickfall/whole_file.h"
#include "cli/console.h"
#include "cli/files.h"
#include "cli/interrupt.h"

namespace brickfall::cli {

std::string outputFile(const OutputKind& kind, const std::string& scene) {
  std::string name = kind.file;
  if (const std::size_t star = name.find('*'); star != std::string::npos) name.replace(star, 1, scene);
  return name;
}

OutputsResult writeOutputs(const TakeReader& take, const std::string& folder, const OutputOptions& options,
                           ProgressDisplay& display) {
  OutputsResult result;
  const int interruptsBefore = interruptCount();
  const auto interrupted = [&] { return interruptCount() > interruptsBefore; };
  const std::string scene = safeFileName(take.header().scene);
  for (const OutputKind& kind : outputKinds()) {
    const bool wanted = std::find(options.leftOut.begin(), options.leftOut.end(), kind.name) == options.leftOut.end();
    if (!wanted || interrupted()) continue;
    const std::string path = joinPath(folder, outputFile(kind, scene));
    const auto tell = [&](double share) {
      display.update("writing " + printable(path), share);
      return !interrupted();
    };
    const bool isPage = kind.name == std::string_view("html");
    const Status written = isPage ? writeReplayHtml(take, path, tell, options.page) : kind.write(take, path, tell);
    display.finish();
    if (written) {
      result.files.push_back({path, kind.purpose});
    } else if (!interrupted()) {
      complain(written.error().message);
      result.exitCode = written.error().code == ErrorCode::invalidArgument ? kBadInput : kFileError;
    }
  }
  if (interrupted()) {
    complain("interrupted while writing: the recording is kept, 'brickfall replay' makes the rest from it");
    result.exitCode = interruptExitCode();
  }
  return result;
}

bool writeText(const std::string& path, const std::string& text, const std::string& purpose,
               std::vector<WrittenFile>& files) {
  const Status status = writeWhole(path, text);
  if (status)
    files.push_back({path, purpose});
  else
    complain(status.error().message);
  return status.ok();
}

void listFiles(const std::vector<WrittenFile>& files) {
  std::size_t widest = 0;
  for (const WrittenFile& file : files) widest = std::max(widest, file.path.size());
  for (const WrittenFile& file : files)
    sayf("  {:<{}}  {:>8}  {}", printable(file.path), widest, sizeText(file.path), file.purpose);
}

}  // namespace brickfall::cli
