// What undoing and rewinding need: snapshots taken every so often and before each change, and in between what the user did, by
// step. A moment is a step and how many commands were carried out before it: from the nearest snapshot before, the same steps
// with the same commands lead there bit for bit. Memory is bounded: the oldest goes first.
#pragma once
#include <cstdint>
#include <deque>
#include <future>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "brickfall/result.h"
#include "viewer_core/commands.h"
#include "viewer_core/drag_spring.h"
#include "viewer_core/session.h"

namespace brickfall::viewer {

struct Moment {
  std::uint64_t step = 0;      // steps made
  std::uint64_t commands = 0;  // carried out since the history began
  auto operator<=>(const Moment&) const = default;
};

// A snapshot, compressed on a thread of its own: that takes longer than a step may.
class PackedBytes {
 public:
  PackedBytes() = default;
  explicit PackedBytes(std::vector<std::byte> bytes);
  Result<std::vector<std::byte>> unpacked() const;
  std::size_t size() const;  // of what is held now: less once it is compressed

 private:
  std::shared_future<std::vector<std::byte>> packed_;
  std::size_t before_ = 0;
};

// A run as it was.
struct Kept {
  Moment moment;
  double time = 0;    // s
  PackedBytes bytes;  // of SceneRun::snapshot
  std::shared_ptr<const BodyList> list;
  std::optional<DragSpring> drag;
  std::string change;    // that was about to be made: what Undo takes back; empty: none
  bool regular = false;  // kept because it was time; without that and a change it only makes rewinding quicker
};

struct Logged {
  std::uint64_t step = 0;  // made when so many steps were
  Command command;
  Serial made = 0;  // of the body that it brought
};

class History {
 public:
  explicit History(const HistoryLimits& limits) : limits_(limits) {}

  // Forgets everything; begins at a step and its time.
  void begin(std::uint64_t step, double time);
  // --- As the run goes.
  bool due(double time) const;  // a snapshot, because it is time
  void keep(Kept kept);
  // The last snapshot up to a moment is of this very one: none needs to be taken.
  bool keptAt(const Moment& moment) const;
  // The last snapshot is that of a change to come.
  void nameChange(const std::string& change) { kept_.back().change = change; }
  void stepped(double time);
  void did(Command command, Serial made);
  // Forgets what lies after a moment, and that a change was to follow at it.
  void cutAfter(const Moment& moment);

  // --- Going back.
  Moment end() const;
  double earliest() const;  // s
  double latest() const;    // s
  // After the last step whose time is not later, before the commands that followed it; the end, if that is earlier.
  Moment at(double time) const;
  double timeAt(const Moment& moment) const { return times_[std::size_t(moment.step - firstStep_)]; }
  bool knows(std::uint64_t step) const { return step >= window_.step && step <= end().step; }
  // The last snapshot that is not after a moment; null if the moment is out of reach.
  const Kept* before(const Moment& moment) const;
  // The command carried out after so many others; null: not known.
  const Logged* command(std::uint64_t number) const;
  // What Undo goes back to from a moment; null: nothing.
  const Kept* lastChange(const Moment& from) const;
  std::size_t bytes() const;

 private:
  void trim();
  void dropLog();

  HistoryLimits limits_;
  std::deque<Kept> kept_;  // in order of their moments
  std::deque<Logged> log_;
  std::uint64_t firstCommand_ = 0;  // number of log_.front()
  std::deque<double> times_;        // s, after each step
  std::uint64_t firstStep_ = 0;     // of times_.front()
  Moment window_;                   // the oldest snapshot from which every step is known
};

// Bytes of a snapshot, smaller by a fifth to a half or more, and back.
std::vector<std::byte> compressed(std::span<const std::byte> bytes);
Result<std::vector<std::byte>> decompressed(std::span<const std::byte> bytes);

}  // namespace brickfall::viewer
