// Programs of their own that the command starts by a word: `brickfall render ...` is `brickfall-render ...`. They need packages
// that the command does without, so they may be missing.
#pragma once
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace brickfall::cli {

struct Companion {
  const char* word;      // of the command line
  const char* program;   // the file beside the command
  const char* purpose;   // for the list of commands
  const char* packages;  // of Debian, without which it is not built
};
std::span<const Companion> companions();
// Null for a word that starts none.
const Companion* findCompanion(std::string_view word);

// The folder of the running program; empty if that cannot be told.
std::string programFolder();
// Becomes the companion in `folder`, with these arguments, so that its exit code and signals are the process's own. Returns the
// exit code only where it could not be started, which is then on standard error.
int startCompanion(const Companion& companion, const std::string& folder, const std::vector<std::string>& arguments);

}  // namespace brickfall::cli
