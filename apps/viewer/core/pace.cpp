#include "viewer_core/pace.h"

#include <algorithm>
#include <cmath>

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

int Pace::due(double now, double dt) {
  if (!running_) return 0;
  owed_ += std::clamp(now - last_, 0.0, kLongestGap) * speed_;
  last_ = now;
  return int(std::floor(owed_ / dt + kSlack));
}

void Pace::made(int steps, double now, double dt) {
  owed_ = std::max(0.0, owed_ - steps * dt);
  // One is made at once, so that a scene that is too slow is made step after step.
  owed_ = std::min(owed_, dt);
  if (steps > 0) made_.push_back({now, steps * dt});
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
