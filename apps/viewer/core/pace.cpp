#include "viewer_core/pace.h"

#include <algorithm>

namespace brickfall::viewer {

namespace {

constexpr double kLongestGap =
    0.1;                         // s: a longer time between two calls counts as this (the machine was busy or asleep)
constexpr double kWindow = 1;    // s, of reached()
constexpr double kSlack = 1e-9;  // steps: sums of times

}  // namespace

void Pace::run(double now) {
  if (running_) return;
  running_ = true;
  last_ = now;
  owed_ = 0;
}

void Pace::pause() {
  running_ = false;
  made_.clear();
}

void Pace::goOn(double now) {
  if (!running_) return;
  owed_ += std::clamp(now - last_, 0.0, kLongestGap) * speed_;
  last_ = now;
}

bool Pace::due(double dt) const { return running_ && owed_ >= dt * (1 - kSlack); }

void Pace::made(double dt, double now) {
  owed_ = std::max(0.0, owed_ - dt);
  made_.push_back({now, dt});
}

void Pace::letGo(double now, double dt) {
  // One is made at once, so that a scene that is too slow is made step after step.
  owed_ = std::min(owed_, dt);
  while (!made_.empty() && made_.front().first < now - kWindow) made_.pop_front();
}

double Pace::wait(double now, double dt) const {
  if (!running_) return 1e9;
  return std::max(0.0, (dt - owed_) / speed_ - (now - last_));
}

double Pace::reached(double now) const {
  double sum = 0;
  for (const auto& [at, seconds] : made_)
    if (at > now - kWindow) sum += seconds;
  return sum / kWindow;
}

}  // namespace brickfall::viewer
