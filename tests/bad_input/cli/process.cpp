#include "bad_input/cli/process.h"

#include <fcntl.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <csignal>
#include <cstdlib>
#include <ctime>
#include <fstream>
#include <initializer_list>
#include <iterator>

namespace brickfall::test {
namespace fs = std::filesystem;
namespace {

std::string contentOf(const fs::path& path) {
  std::ifstream file(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(file), {}};
}

void redirect(int descriptor, const std::string& path) {
  const int file = open(path.c_str(), O_WRONLY | O_CREAT | O_TRUNC, 0644);
  if (file < 0 || dup2(file, descriptor) < 0) _exit(126);
  close(file);
}

void redirectToClosedPipe(int stream) {
  int ends[2];
  if (pipe(ends) != 0) _exit(126);
  close(ends[0]);
  dup2(ends[1], stream);
  close(ends[1]);
}

}  // namespace

Process::Process(const fs::path& folder, const std::vector<std::string>& arguments, const ProcessOptions& options)
    : folder_(folder) {
  std::vector<std::string> words = {BRICKFALL_COMMAND};
  words.insert(words.end(), arguments.begin(), arguments.end());
  std::vector<char*> pointers;
  for (std::string& word : words) pointers.push_back(word.data());
  pointers.push_back(nullptr);

  child_ = fork();
  if (child_ != 0) return;
  if (chdir(folder_.c_str()) != 0) _exit(126);
  if (options.closedPipe)
    redirectToClosedPipe(STDOUT_FILENO);
  else
    redirect(STDOUT_FILENO, options.outputPath.empty() ? (folder_ / "stdout.txt").string() : options.outputPath);
  if (!options.inputPath.empty()) {
    const int file = open(options.inputPath.c_str(), O_RDONLY);
    if (file < 0 || dup2(file, STDIN_FILENO) < 0) _exit(126);
    close(file);
  }
  if (options.closedErrorPipe)
    redirectToClosedPipe(STDERR_FILENO);
  else
    redirect(STDERR_FILENO, (folder_ / "stderr.txt").string());
  // Whatever the tests themselves were started with.
  for (int signal : {SIGPIPE, SIGINT, SIGTERM, SIGHUP}) std::signal(signal, SIG_DFL);
  if (options.noTerminal) setsid();
  for (int stream : options.closed) close(stream);
  if (options.emptyEnvironment) clearenv();
  for (const std::string& variable : options.environment) putenv(const_cast<char*>(variable.c_str()));
  const rlimit limit{options.largestFile, options.largestFile};
  if (options.largestFile > 0 && setrlimit(RLIMIT_FSIZE, &limit) != 0) _exit(126);
  constexpr uid_t kNobody = 65534;
  if (options.asNobody && geteuid() == 0 && setuid(kNobody) != 0) _exit(126);
  execv(pointers[0], pointers.data());
  _exit(127);
}

Process::~Process() {
  if (child_ <= 0 || ended_) return;
  kill(child_, SIGKILL);
  waitpid(child_, &status_, 0);
}

void Process::send(int signal) {
  if (child_ > 0 && running()) kill(child_, signal);
}

double Process::processorSeconds() const {
  clockid_t clock{};
  timespec used{};
  if (clock_getcpuclockid(child_, &clock) != 0 || clock_gettime(clock, &used) != 0) return 0;
  return double(used.tv_sec) + double(used.tv_nsec) * 1e-9;
}

bool Process::running() {
  if (!ended_) ended_ = waitpid(child_, &status_, WNOHANG) == child_;
  return !ended_;
}

Finished Process::finish() {
  if (!ended_) ended_ = waitpid(child_, &status_, 0) == child_;
  Finished result;
  if (WIFEXITED(status_)) result.exitCode = WEXITSTATUS(status_);
  if (WIFSIGNALED(status_)) result.signal = WTERMSIG(status_);
  result.output = contentOf(folder_ / "stdout.txt");
  result.errors = contentOf(folder_ / "stderr.txt");
  return result;
}

Finished runCommand(const fs::path& folder, const std::vector<std::string>& arguments, const ProcessOptions& options) {
  return Process(folder, arguments, options).finish();
}

}  // namespace brickfall::test
