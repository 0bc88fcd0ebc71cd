// Hooks of the whole process: who is told before a bug ends it. Besides this and the note handler (notes.h) nothing of the
// engine is global. Without a handler a failure is a line on standard error; nothing else is printed: what happened in a
// step stands in its report and its events.
#pragma once
#include <atomic>
#include <cstdio>
#include <cstdlib>

namespace brickfall {

// An invariant of the engine that does not hold, or value() of a failed Result.
struct Failure {
  const char* file = "";  // where; empty: in the program's own call
  int line = 0;
  const char* text = "";       // in words
  const char* condition = "";  // that should hold; empty: none
};

// Called once on the thread that failed, before std::abort. It may write a log or a dump, or leave by longjmp or an
// exception of its own; the world is then lost: destroy nothing of it. Not called by two threads in order.
using FailureHandler = void (*)(const Failure&);

namespace detail {
inline std::atomic<FailureHandler> failureHandler{nullptr};
}

// null: the default, a line on standard error. Any thread, any time; returns the handler there was.
inline FailureHandler setFailureHandler(FailureHandler handler) { return detail::failureHandler.exchange(handler); }

[[noreturn]] inline void fail(const Failure& failure) {
  if (const FailureHandler handler = detail::failureHandler.load())
    handler(failure);
  else if (failure.condition[0] != '\0')
    std::fprintf(stderr, "%s:%d: assertion failed: %s (%s)\n", failure.file, failure.line, failure.text,
                 failure.condition);
  else
    std::fprintf(stderr, "brickfall: %s\n", failure.text);
  std::abort();
}

}  // namespace brickfall
