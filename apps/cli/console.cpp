#include "cli/console.h"

#include <fcntl.h>

#include <cerrno>
#include <cstring>

namespace brickfall::cli {
namespace {

int outputError = 0;  // errno of the first failed write to standard output

void note(bool failed) {
  if (failed && outputError == 0) outputError = errno;
}

}  // namespace

std::string printable(std::string_view text) {
  std::string shown(text);
  for (char& c : shown)
    if (static_cast<unsigned char>(c) < 0x20 || c == 0x7f) c = '?';
  return shown;
}

void openMissingStreams() {
  // The lowest free number is given out, and all below are in use.
  for (int stream = 0; stream < 3; stream++)
    if (fcntl(stream, F_GETFD) < 0 && errno == EBADF && open("/dev/null", O_RDWR) != stream) return;
}

void say(std::string_view line) {
  if (outputError != 0) return;
  note(std::fwrite(line.data(), 1, line.size(), stdout) != line.size());
  note(std::fputc('\n', stdout) == EOF);
  note(std::fflush(stdout) != 0);
}

void complain(std::string_view message) {
  const std::string line = "brickfall: " + printable(message) + "\n";
  std::fwrite(line.data(), 1, line.size(), stderr);
}

bool flushOutput() {
  if (outputError == 0) note(std::fflush(stdout) != 0);
  if (outputError == 0 || outputError == EPIPE) return true;
  complainf("cannot write to standard output: {}", std::strerror(outputError));
  return false;
}

}  // namespace brickfall::cli
