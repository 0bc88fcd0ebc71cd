// What the window holds on to: a scene run live or a take played, on a thread of its own. Calls return at once: commands wait in
// a queue until the thread is between two steps, frames are handed over by pointer.
#pragma once
#include <cstdint>
#include <functional>
#include <memory>
#include <vector>

#include "viewer_core/commands.h"
#include "viewer_core/frame.h"

namespace brickfall::viewer {

struct HistoryLimits {
  double seconds = 30;                 // how far back rewinding reaches, simulated time
  double interval = 1;                 // s, simulated, between snapshots: the longest that rewinding makes again
  std::size_t mostUndos = 50;          // changes that can be taken back
  std::size_t mostBytes = 512u << 20;  // of snapshots together: beyond it the oldest go first, the last one never
};

struct SessionOptions {
  HistoryLimits history;
  std::function<double()> clock;  // s, never going back; none: the steady clock. Called from both threads
  bool ownThread = true;          // false: nothing happens but in pump(), for tests
};

class Session {
 public:
  explicit Session(SessionOptions options = {});
  ~Session();  // finish()
  Session(const Session&) = delete;
  Session& operator=(const Session&) = delete;

  // Number of the command, found again in its result.
  std::uint64_t send(Command command);
  // Results since the last call, in the order of the commands; among them, with ticket 0, mistakes that no command answers for (a
  // recording that died, a step that could not be made).
  std::vector<CommandResult> takeResults();
  // Never null; the same object until there is a newer one.
  std::shared_ptr<const Frame> latest() const;
  // What frames are to hold besides, from the next frame on, which is made at once.
  void ask(const FrameNeeds& needs);
  double now() const;  // of its clock: for blendAt
  // Stops the thread at the end of its step; saves states that were still to be saved and makes a recording whole: the error is
  // theirs. Other commands that wait are not carried out.
  Status finish();

  // Without a thread of its own: carries out what was sent, makes the steps that are due by the clock, makes a frame if
  // anything changed. The time in s until something is due again (1e9: not before the next command).
  double pump();

 private:
  class Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace brickfall::viewer
