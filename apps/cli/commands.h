// The commands and what they can be told. Each returns the exit code of the process; main.cpp only reads the arguments.
#pragma once
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "brickfall/output.h"
#include "brickfall/scene.h"

namespace brickfall::cli {

enum ExitCode {
  kOk = 0,
  kInternalError = 1,
  kParted = 1,        // brickfall trace --compare: the runs are not the same
  kBadInput = 2,      // arguments or a scene file
  kFileError = 3,     // something could not be read or written
  kQuarantined = 4,   // the run ended, but bodies became non-finite on the way
  kInterrupted = 130  // by Ctrl-C; what was simulated is kept
};

struct OutputOptions {
  std::string folder;  // empty: the command's own default
  PageWishes page;
  std::vector<std::string> leftOut;  // names of outputs
  bool quiet = false;
};

struct RunOptions {
  std::string scene;  // a file or the name of a shipped scene
  OutputOptions output;
  std::optional<double> seconds;
  std::optional<int> threads;
  Overrides overrides;
};

struct TraceCommand {
  std::string scene;
  std::string output;  // file; empty: out/<scene>/<scene>.trace
  std::optional<double> seconds;
  std::optional<int> threads;
  std::optional<std::uint64_t> itemsOfStep;  // also a hash of each body and contact, in this step
  Overrides overrides;
  bool quiet = false;
};

struct ExportCommand {
  std::string take, folder;        // folder empty: that of the take
  std::vector<std::string> kinds;  // names of exportKinds()
  std::uint64_t every = 1;         // frames
  bool quiet = false;
};

struct CheckDtCommand {
  std::string scene;
  std::optional<double> seconds;
  std::optional<int> threads;
  Overrides overrides;
  bool quiet = false;  // no progress
  bool asJson = false;
};

int run(const RunOptions& options);
int check(const std::vector<std::string>& scenes, const Overrides& overrides, bool asJson);
int checkDt(const CheckDtCommand& options);
int exportTake(const ExportCommand& command);
int listScenes(bool asJson);
// The command line as completion and the man page know it.
struct CommandWords {
  std::string name, purpose;
  std::vector<std::pair<std::string, std::string>> options;  // "--seconds", what it does
  bool takesScene = false;
};
int completion(const std::string& shell, const std::vector<CommandWords>& commands);
int manPage(const std::vector<CommandWords>& commands);
int replay(const std::string& take, const OutputOptions& options);
int trace(const TraceCommand& options);
int compareTraces(const std::string& a, const std::string& b);

}  // namespace brickfall::cli
