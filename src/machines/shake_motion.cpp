// Accelerations become velocities and ways, in closed form.
#include <algorithm>
#include <cmath>
#include <numbers>

#include "brickfall/machines.h"
#include "machines/faults.h"

namespace brickfall {

namespace {

constexpr double kTau = 2 * std::numbers::pi;
using State = ShakeMotion::State;

// From one sample on, the acceleration changing at `jerk`.
State onward(const State& s, double jerk, double t) {
  return {s.acceleration + jerk * t, s.velocity + s.acceleration * t + jerk * t * t / 2,
          s.displacement + s.velocity * t + s.acceleration * t * t / 2 + jerk * t * t * t / 6};
}

// Velocity and way at all samples.
std::vector<State> summed(const AccelerationRecord& record) {
  std::vector<State> states{{record.values[0], 0, 0}};
  for (std::size_t k = 1; k < record.times.size(); k++) {
    const double span = record.times[k] - record.times[k - 1];
    states.push_back(onward(states.back(), (record.values[k] - record.values[k - 1]) / span, span));
    states.back().acceleration = record.values[k];
  }
  return states;
}

// A straight line c0 + c1 t is added so that speed and way end at 0. Returns the most that it changes.
double settle(AccelerationRecord& record) {
  const State end = summed(record).back();
  const double first = record.times[0], span = record.times.back() - first;
  const double meanSpeed = end.velocity / span, meanWay = end.displacement / (span * span);
  // c0 + c1 T / 2 = -meanSpeed and c0 / 2 + c1 T / 6 = -meanWay
  const double c1 = (12 * meanWay - 6 * meanSpeed) / span, c0 = -meanSpeed - c1 * span / 2;
  for (std::size_t k = 0; k < record.times.size(); k++) record.values[k] += c0 + c1 * (record.times[k] - first);
  return std::max(std::fabs(c0), std::fabs(c0 + c1 * span));
}

// A sine that grows and dies away. The way is -A / w2 sin(wt) times the envelope, so that it ends where it began.
State rampedSine(const Shake& shake, double t) {
  const double w = kTau * shake.frequency;
  double sine, cosine;
  sinCos(std::fmod(w * t, kTau), sine, cosine);
  // The envelope e with its two derivatives: a cubic up, 1, and down again.
  double e = 1, e1 = 0, e2 = 0;
  const double edge = std::min(t, shake.seconds - t), sign = t < shake.seconds / 2 ? 1 : -1;
  if (edge < shake.ramp) {
    const double s = edge / shake.ramp;
    e = s * s * (3 - 2 * s);
    e1 = sign * 6 * s * (1 - s) / shake.ramp;
    e2 = (6 - 12 * s) / (shake.ramp * shake.ramp);
  }
  const double x = -sine / (w * w), v = -cosine / w, a = sine;
  return {shake.amplitude * (a * e + 2 * v * e1 + x * e2), shake.amplitude * (v * e + x * e1), shake.amplitude * x * e};
}

// A sine of `w` from rest.
State sinePulse(double amplitude, double w, double t) {
  double sine, cosine;
  sinCos(w * t, sine, cosine);
  return {amplitude * sine, amplitude / w * (1 - cosine), amplitude / w * (t - sine / w)};
}

Status checkRecord(const AccelerationRecord& record) {
  machines::Fields check;
  check.condition(
      record.times.size() >= 2 && record.times.size() == record.values.size(), "record",
      std::to_string(record.times.size()) + " times and " + std::to_string(record.values.size()) + " values",
      "as many of both, at least 2");
  for (std::size_t k = 0; check.status() && k < record.times.size(); k++) {
    const std::string at = "[" + std::to_string(k) + "]";
    check.condition(
        std::fabs(record.times[k]) <= machines::kLatest && (k == 0 || record.times[k] > record.times[k - 1]),
        "record.times" + at, std::to_string(record.times[k]), "times that ascend");
    check.condition(std::fabs(record.values[k]) <= machines::kStrongest, "record.values" + at,
                    std::to_string(record.values[k]), "at most " + std::to_string(machines::kStrongest) + " m/s2");
  }
  return check.status();
}

Status checkShake(const Shake& shake) {
  machines::Fields check;
  const double size = length(shake.direction);
  check.condition(size > 1e-9 && size < 1e9, "direction", "a vector of length " + std::to_string(size), "a direction");
  check.range("start", shake.start, -machines::kLatest, machines::kLatest);
  check.range("amplitude", shake.amplitude, -machines::kStrongest, machines::kStrongest);
  if (shake.signal == ShakeSignal::record) return check.status() ? checkRecord(shake.record) : check.status();
  check.range("seconds", shake.seconds, 1e-4, 1e6);
  if (shake.signal == ShakeSignal::sine) {
    check.range("frequency", shake.frequency, 1e-3, 1e3);
    check.range("ramp", shake.ramp, 0, shake.seconds / 2);
    check.condition(shake.ramp > 0, "ramp", "0", "a time above 0: a sine that starts at once starts with a blow");
  }
  return check.status();
}

}  // namespace

State ShakeMotion::inside(double t) const {
  switch (shake_.signal) {
    case ShakeSignal::record: {
      const std::vector<double>& times = shake_.record.times;
      const double time = times[0] + t;
      const auto next = std::upper_bound(times.begin() + 1, times.end() - 1, time);
      const std::size_t k = std::size_t(next - times.begin()) - 1;
      const double jerk = (shake_.record.values[k + 1] - shake_.record.values[k]) / (times[k + 1] - times[k]);
      return onward(states_[k], jerk, time - times[k]);
    }
    case ShakeSignal::sine:
      return rampedSine(shake_, t);
    case ShakeSignal::fullPulse:
      return sinePulse(shake_.amplitude, kTau / shake_.seconds, t);
    case ShakeSignal::halfPulse:
      return sinePulse(shake_.amplitude, kTau / 2 / shake_.seconds, t);
    case ShakeSignal::squarePulse:
      return onward({shake_.amplitude, 0, 0}, 0, t);
  }
  return {};
}

Result<ShakeMotion> ShakeMotion::create(const Shake& shake) {
  if (Status fine = checkShake(shake); !fine) return fine.error();
  ShakeMotion motion;
  motion.shake_ = shake;
  motion.direction_ = normalized(shake.direction);
  double length = shake.seconds;
  if (shake.signal == ShakeSignal::record) {
    AccelerationRecord& record = motion.shake_.record;
    for (double& value : record.values) value *= shake.amplitude;
    if (shake.baseline == Baseline::rest) motion.correction_ = settle(record);
    motion.states_ = summed(record);
    length = record.times.back() - record.times.front();
  }
  motion.end_ = shake.start + length;
  motion.last_ = motion.inside(length);
  // Where the sums end at rest but for rounding, they end at rest.
  const bool backAgain =
      shake.signal == ShakeSignal::sine || (shake.signal == ShakeSignal::record && shake.baseline == Baseline::rest);
  if (backAgain) motion.last_ = {};
  if (shake.signal == ShakeSignal::fullPulse) motion.last_.velocity = 0;
  motion.last_.acceleration = 0;
  return motion;
}

State ShakeMotion::at(double time) const {
  if (!(time > shake_.start)) return {};
  if (time < end_) return inside(time - shake_.start);
  return onward(last_, 0, last_.velocity == 0 ? 0 : time - end_);
}

}  // namespace brickfall
