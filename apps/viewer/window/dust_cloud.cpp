#include "viewer_window/dust_cloud.h"

#include <algorithm>

#include "appearance/look.h"
#include "appearance/noise.h"

namespace brickfall::viewer {
namespace {

constexpr double kSlack = 1e-6;  // s: frames tell how long ago a hit was as a float
constexpr appearance::Rgb kPale{0.56f, 0.50f, 0.44f};
constexpr float kPaleness = 0.5f;
constexpr float kFullSpeed = 6;  // m/s: from here on it gets no denser by speed

}  // namespace

void DustCloud::clear() {
  puffs_.clear();
  lastOf_.clear();
}

void DustCloud::puff(const Frame& frame, std::size_t body, double born, std::uint32_t salt) {
  const ListedBody& listed = frame.list->bodies[body];
  const FrameBody& state = frame.bodies[body];
  const auto any = [&](std::uint32_t which) {
    return double(appearance::chance(listed.serial * 31 + which, salt)) * 2 - 1;
  };
  Puff made;
  made.born = born;
  made.colour = appearance::mix(appearance::lookOf({listed.material, listed.role, listed.colour, listed.number}).colour,
                                kPale, kPaleness);
  const double size = std::min(listed.radius, 0.25), ago = frame.status.time - born;
  made.place = state.pose.position - state.linearVelocity * ago + Vec3{any(1), any(2), any(3)} * (0.7 * size);
  made.drift = state.linearVelocity * 0.12 + Vec3{any(4), 0.6 + 0.5 * any(5), any(6)} * 0.25;
  made.radius = float(size * (0.45 + 0.2 * any(7)));
  made.strength = std::clamp(state.hitSpeed / kFullSpeed, 0.15f, 0.8f);
  puffs_.push_back(made);
}

void DustCloud::findHits(const Frame& frame) {
  for (std::size_t i = 0; i < frame.bodies.size(); i++) {
    const FrameBody& body = frame.bodies[i];
    const ListedBody& listed = frame.list->bodies[i];
    if (listed.role != BodyRole::brick || body.activity == Activity::fixed || body.hitSpeed < kLeastSpeed) continue;
    const double hit = frame.status.time - body.sinceHit;
    if (hit <= lastTime_ + kSlack || body.sinceHit > kLife) continue;
    const auto [last, isFirst] = lastOf_.try_emplace(listed.serial, hit);
    if (!isFirst && hit < last->second + kLeastRest) continue;
    last->second = hit;
    for (std::uint32_t k = 0; k < 2; k++) puff(frame, i, hit, std::uint32_t(frame.number) * 2 + k);
  }
  // The oldest go where there are too many.
  if (puffs_.size() > kMostPuffs) puffs_.erase(puffs_.begin(), puffs_.end() - std::ptrdiff_t(kMostPuffs));
}

void DustCloud::update(const Frame& frame) {
  const double time = frame.status.time;
  if (frame.info != run_) {
    clear();
    run_ = frame.info;
    lastTime_ = -kLife;
  }
  if (time < lastTime_) std::erase_if(lastOf_, [&](const auto& last) { return last.second > time; });
  if (time > lastTime_) findHits(frame);
  lastTime_ = time;
  std::erase_if(puffs_, [&](const Puff& puff) { return time < puff.born || time > puff.born + kLife; });
}

}  // namespace brickfall::viewer
