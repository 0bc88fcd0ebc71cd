// What people open, made from a take.
#pragma once
#include <string>
#include <vector>

#include "brickfall/output.h"
#include "cli/commands.h"
#include "cli/progress.h"

namespace brickfall::cli {

struct WrittenFile {
  std::string path;
  std::string purpose;  // a few words for the list at the end
};

struct OutputsResult {
  int exitCode = kOk;  // complaints are already on standard error
  std::vector<WrittenFile> files;
};

// "replay.html", "wall.glb"
std::string outputFile(const OutputKind& kind, const std::string& scene);
// An interrupt while writing ends it; nothing half written stays.
OutputsResult writeOutputs(const TakeReader& take, const std::string& folder, const OutputOptions& options,
                           ProgressDisplay& display);
// A text of a run, whole or not at all. False after a complaint.
bool writeText(const std::string& path, const std::string& text, const std::string& purpose,
               std::vector<WrittenFile>& files);
// "  out/wall/replay.html   2.1 MB  open it in any browser"
void listFiles(const std::vector<WrittenFile>& files);

}  // namespace brickfall::cli
