// Shows how far a run is: one line that is drawn again and again on a terminal, a plain line about every tenth elsewhere.
// Knows no clock: the caller says how much time went by.
#pragma once
#include <cstdint>
#include <string>

namespace brickfall::cli {

struct ProgressState {
  double simulatedSeconds = 0;
  double totalSeconds = 0;
  std::uint64_t steps = 0;
  double wallSeconds = 0;
};

// Work that is counted: pictures of a film.
struct WorkState {
  std::string unit;  // "picture"
  std::uint64_t done = 0, total = 0;
  std::uint64_t doneBefore = 0;  // of those, not in this run: they tell nothing of its speed
  double wallSeconds = 0;
};

// "0.4 s", "12 s", "3 min 5 s", "2 h 10 min"
std::string durationText(double seconds);
// "  3.20 of 10 s  412 steps/s  6.9 x real time  1.0 s left"
std::string progressText(const ProgressState& state);
// "picture 12 of 300  0.51 s each  2 min 27 s left"
std::string workText(const WorkState& state);
// The same with a bar where there is room for one, at most `columns` long.
std::string progressLine(const ProgressState& state, int columns);
std::string workLine(const WorkState& state, int columns);

class ProgressDisplay {
 public:
  enum class Mode { silent, plain, live };
  // live on a terminal that can move its cursor, plain elsewhere.
  static Mode modeForOutput(bool quiet);

  explicit ProgressDisplay(Mode mode) : mode_(mode) {}
  void update(const ProgressState& state);
  void updateWork(const WorkState& state);
  // One word for what follows the simulation ("writing replay.html"), with its share done.
  void update(const std::string& what, double share);
  // Leaves a clean line.
  void finish();

 private:
  template <class State> void show(const State& state, bool end);
  void draw(const std::string& line);
  Mode mode_;
  double lastDraw_ = -1;  // s, wall clock of the run
  int nextTenth_ = 1;
  bool drawn_ = false;
  std::string lastLine_;
};

}  // namespace brickfall::cli
