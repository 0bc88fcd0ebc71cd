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

  // The clock goes on. Then steps are made, of dt simulated seconds each, as long as one is due.
  void goOn(double now);
  bool due(double dt) const;
  void made(double dt, double now);
  // No more are made until the next time: what is still due, but for a step of dt, comes too late and is let go.
  void letGo(double now, double dt);
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
