#include "cli/interrupt.h"

#include <csignal>
#include <initializer_list>

namespace brickfall::cli {
namespace {

volatile std::sig_atomic_t count = 0;
volatile std::sig_atomic_t firstSignal = SIGINT;

extern "C" void onSignal(int signal) {
  if (count == 0) firstSignal = signal;
  count = count + 1;
  if (count >= 2) std::signal(signal, SIG_DFL);
}

}  // namespace

void watchInterrupts() {
  struct sigaction action {};
  action.sa_handler = onSignal;
  action.sa_flags = SA_RESTART;
  for (int signal : {SIGINT, SIGTERM, SIGHUP}) {
    // Who started us with a signal switched off (nohup, a shell's background job) wants it to stay so.
    struct sigaction before {};
    if (sigaction(signal, nullptr, &before) == 0 && before.sa_handler != SIG_IGN) sigaction(signal, &action, nullptr);
  }
}

void makeFailedWritesErrors() {
  std::signal(SIGPIPE, SIG_IGN);
  std::signal(SIGXFSZ, SIG_IGN);
}

void restoreFailedWrites() {
  std::signal(SIGPIPE, SIG_DFL);
  std::signal(SIGXFSZ, SIG_DFL);
}

int interruptCount() { return count; }
int interruptExitCode() { return 128 + firstSignal; }

}  // namespace brickfall::cli
