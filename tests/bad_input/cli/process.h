// Runs the command as a process of its own: arguments in, exit code and what it said out.
#pragma once
#include <sys/types.h>

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

namespace brickfall::test {

struct Finished {
  int exitCode = -1;  // -1: ended by a signal
  int signal = 0;
  std::string output;  // standard output
  std::string errors;  // standard error
};

// Where standard output goes: into Finished, or to a file such as /dev/full, or to a pipe that nobody reads.
struct ProcessOptions {
  std::string outputPath;
  std::string inputPath;  // standard input; empty: that of the tests
  bool closedPipe = false;
  bool closedErrorPipe = false;  // the same for standard error
  std::vector<int> closed;       // streams that the process is started without
  bool noTerminal = false;       // in a session of its own
  bool emptyEnvironment = false;
  std::vector<std::string> environment;  // more "NAME=value"
  std::uint64_t largestFile = 0;         // bytes that a file may have, as if the disk were full then; 0: any
  bool asNobody = false;  // gives up root first; the exit code is 126 or 127 where the command cannot be run so
};

class Process {
 public:
  // A fresh folder is the process's working directory.
  Process(const std::filesystem::path& folder, const std::vector<std::string>& arguments,
          const ProcessOptions& options = {});
  Process(const Process&) = delete;
  Process& operator=(const Process&) = delete;
  ~Process();
  void send(int signal);
  // Seconds of processor time used so far; what it had used at its end is not told.
  double processorSeconds() const;
  bool running();
  // Waits for the end.
  Finished finish();

 private:
  std::filesystem::path folder_;
  pid_t child_ = -1;
  bool ended_ = false;
  int status_ = 0;
};

Finished runCommand(const std::filesystem::path& folder, const std::vector<std::string>& arguments,
                    const ProcessOptions& options = {});

}  // namespace brickfall::test
