#include "cli/companion.h"

#include <unistd.h>

#include <array>
#include <cerrno>
#include <cstring>
#include <filesystem>
#include <system_error>

#include "cli/commands.h"
#include "cli/console.h"
#include "cli/files.h"
#include "cli/interrupt.h"

namespace brickfall::cli {
namespace {

constexpr std::array<Companion, 2> kCompanions = {{
    {"view", "brickfall-view", "Watch a scene live in a window, or a take, and take part",
     "libogre-1.12-dev libimgui-dev libsdl2-dev"},
    {"render", "brickfall-render", "Make pictures or a film of a take or scene, without a window",
     "libembree-dev libpng-dev"},
}};

}  // namespace

std::span<const Companion> companions() { return kCompanions; }

const Companion* findCompanion(std::string_view word) {
  for (const Companion& companion : kCompanions)
    if (word == companion.word) return &companion;
  return nullptr;
}

std::string programFolder() {
  std::error_code error;
  const std::filesystem::path program = std::filesystem::read_symlink("/proc/self/exe", error);
  return error ? std::string() : program.parent_path().string();
}

int startCompanion(const Companion& companion, const std::string& folder, const std::vector<std::string>& arguments) {
  const std::string path = joinPath(folder, companion.program);
  std::vector<std::string> words = {companion.program};
  words.insert(words.end(), arguments.begin(), arguments.end());
  std::vector<char*> pointers;
  for (std::string& word : words) pointers.push_back(word.data());
  pointers.push_back(nullptr);
  restoreFailedWrites();
  execv(path.c_str(), pointers.data());
  const int reason = errno;
  makeFailedWritesErrors();
  if (reason == ENOENT)
    complainf("{}: '{}' was not built; install the Debian packages {} and build again", companion.word, path,
              companion.packages);
  else
    complainf("{}: cannot start '{}': {}", companion.word, path, std::strerror(reason));
  return kFileError;
}

}  // namespace brickfall::cli
