// Ctrl-C ends a run in good order: it is only counted here, and asked for between steps.
#pragma once

namespace brickfall::cli {

// From here on SIGINT, SIGTERM and SIGHUP (the terminal is gone) are counted instead of ending the process; the third one does end it.
void watchInterrupts();
// A reader of standard output that leaves, or a file that may not grow, makes a write fail instead of ending the process
// in the middle of a run.
void makeFailedWritesErrors();
// The other way round, for a program that this process becomes.
void restoreFailedWrites();
int interruptCount();
// What the process answers after being interrupted: 128 + the number of the first signal.
int interruptExitCode();

}  // namespace brickfall::cli
