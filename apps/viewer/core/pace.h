// When steps are due: simulated time against the clock. Slow motion and fast forward change how often a step is made, never the
// step. What can't be kept up with is let go, so that a slow scene runs slowly instead of falling behind ever further.
#pragma once
#include <deque>
#include <utility>

namespace brickfall::viewer {

class Pace {
 public:
  // Of the clock, s.
  void run(double now);
  void pause();
  bool running() const { return running_; }
  void setSpeed(double factor) { speed_ = factor; }
  double speed() const { return speed_; }

  // Steps of dt simulated seconds that are due.
  int due(double now, double dt);
  // Steps that were made, of dt each, until now. Those that are still due then are let go if they come too late.
  void made(int steps, double now, double dt);
  // s until the next step is due; 1e9 when paused.
  double wait(double now, double dt) const;
  // Simulated seconds a second over the last second.
  double reached(double now) const;

 private:
  bool running_ = false;
  double speed_ = 1;
  double last_ = 0;                             // s of the clock, when `owed_` was right
  double owed_ = 0;                             // s, simulated, not made yet
  std::deque<std::pair<double, double>> made_;  // clock, s; simulated s
};

}  // namespace brickfall::viewer
