// What the command says: results to standard output, mistakes to standard error, one line each.
#pragma once
#include <fmt/core.h>

#include <cstdio>
#include <string>
#include <string_view>
#include <utility>

namespace brickfall::cli {

// Output that nobody reads any more (a closed pipe) is no reason to end a run; a full disk is found out by
// flushOutput at the end.
void say(std::string_view line);
template <class... Args> void sayf(fmt::format_string<Args...> text, Args&&... args) {
  say(fmt::format(text, std::forward<Args>(args)...));
}

// A process may be started with standard input, output or error closed. Without this the first file that it opens gets the
// number of that stream, and what is said goes into that file.
void openMissingStreams();

// "brickfall: <message>" to standard error. Control characters of the message (file names may hold any) are shown as '?'.
void complain(std::string_view message);
template <class... Args> void complainf(fmt::format_string<Args...> text, Args&&... args) {
  complain(fmt::format(text, std::forward<Args>(args)...));
}

// False if standard output could not take everything, other than for a reader that left.
bool flushOutput();

std::string printable(std::string_view text);

}  // namespace brickfall::cli
