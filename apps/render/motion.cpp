#include "render/motion.h"

#include <algorithm>
#include <cmath>

namespace brickfall::render {

namespace {

constexpr std::size_t kKeptFrames = 4;

// The shorter way round; frames are so near each other that the chord serves as the arc.
Quat blended(Quat a, Quat b, double share) {
  const double sign = a.x * b.x + a.y * b.y + a.z * b.z + a.w * b.w < 0 ? -1 : 1;
  const auto part = [&](double from, double to) { return from + (sign * to - from) * share; };
  return normalized(Quat{part(a.x, b.x), part(a.y, b.y), part(a.z, b.z), part(a.w, b.w)});
}

}  // namespace

Result<double> Motion::timeOf(std::size_t index) {
  Result<const Known*> known = frame(index);
  if (!known) return known.error();
  return (*known)->poses.time;
}

// The last frame that is not after the moment. Frames come at the take's rate, but each at the end of a time step; the first may be
// late, where recording began in the middle of a run.
Result<std::size_t> Motion::frameBefore(double time) {
  if (!start_) {
    Result<double> start = timeOf(0);
    if (!start) return start.error();
    start_ = *start;
  }
  const double guess = std::floor((time - *start_) * take_->header().framesPerSecond + 1e-6);
  std::size_t index = std::size_t(std::clamp(guess, 0.0, double(take_->frameCount() - 1)));
  for (;;) {
    Result<double> here = timeOf(index);
    if (!here) return here.error();
    if (*here > time + 1e-9 && index > 0) {
      index--;
      continue;
    }
    if (index + 1 == take_->frameCount()) return index;
    Result<double> next = timeOf(index + 1);
    if (!next) return next.error();
    if (*next > time + 1e-9) return index;
    index++;
  }
}

Result<const Motion::Known*> Motion::frame(std::size_t index) {
  const auto known = std::find_if(known_.begin(), known_.end(), [&](const Known& k) { return k.frame == index; });
  if (known != known_.end()) {
    known_.splice(known_.end(), known_, known);
    return &known_.back();
  }
  Result<TakeFrame> read = take_->frame(index);
  if (!read) return read.error();
  if (known_.size() >= kKeptFrames) known_.pop_front();
  known_.push_back({index, std::move(read).value(), take_->bodiesAt(index)});
  return &known_.back();
}

Result<Instant> Motion::at(double time) {
  Result<std::size_t> found = frameBefore(time);
  if (!found) return found.error();
  const std::size_t first = *found;
  Instant out;
  out.poses.resize(take_->bodies().size());
  out.there.resize(take_->bodies().size());
  Result<const Known*> from = frame(first);
  if (!from) return from.error();
  const TakeFrame& before = (*from)->poses;
  const std::vector<std::uint32_t>& bodies = (*from)->bodies;
  for (std::size_t k = 0; k < bodies.size(); k++) {
    out.there[bodies[k]] = true;
    out.poses[bodies[k]] = {before.poses[k].position, before.poses[k].rotation};
  }
  const double since = time - before.time;
  if (since < 1e-7 || first + 1 >= take_->frameCount()) return out;
  Result<const Known*> to = frame(first + 1);
  if (!to) return to.error();
  const double share = since / ((*to)->poses.time - (time - since));
  for (std::size_t k = 0; k < (*to)->bodies.size(); k++) {
    const std::uint32_t body = (*to)->bodies[k];
    if (!out.there[body]) continue;
    Transform& pose = out.poses[body];
    const TakePose& next = (*to)->poses.poses[k];
    pose.position = pose.position + (next.position - pose.position) * share;
    pose.rotation = blended(pose.rotation, next.rotation, share);
  }
  return out;
}

Result<Motion::Shutter> Motion::between(double open, double close) {
  Result<Instant> first = at(open);
  if (!first) return first.error();
  Result<Instant> last = at(close);
  if (!last) return last.error();
  Shutter shutter{std::move(first).value(), std::move(last).value()};
  for (std::size_t k = 0; k < shutter.open.there.size(); k++)  // one that goes meanwhile stays to the end
    if (!shutter.close.there[k]) shutter.close.poses[k] = shutter.open.poses[k];
  shutter.close.there = shutter.open.there;
  return shutter;
}

}  // namespace brickfall::render
