#include "viewer_window/view_options.h"

#include <algorithm>
#include <cmath>

namespace brickfall::viewer {
namespace {

constexpr std::uint32_t kRed = 0xE0261C, kAsleepBlue = 0x4F7CC4, kHeldAmber = 0xE0A030, kLostViolet = 0xC040E0;
constexpr float kRedSeconds = 0.6f;  // simulated: a hit fades over it

std::uint32_t fromHue(double hue, double saturation, double value) {
  const auto part = [&](double shift) {
    const double k = std::fmod(shift + hue * 6, 6.0);
    const double level = value * (1 - saturation * std::max(0.0, std::min({k, 4 - k, 1.0})));
    return std::uint32_t(std::lround(level * 255));
  };
  return part(5) << 16 | part(3) << 8 | part(1);
}

}  // namespace

const char* nameOf(ShadowChoice choice) {
  constexpr const char* kNames[kShadowChoiceCount] = {"automatic", "stencil", "depth", "none"};
  return kNames[int(choice)];
}

FrameNeeds ViewOptions::needs(bool plots) const {
  FrameNeeds needs;
  needs.contacts = contacts;
  needs.collisions = collisions;
  needs.islands = islands;
  needs.bounds = bounds;
  needs.plots = plots;
  return needs;
}

std::uint32_t islandColour(int island) {
  // Steps of the golden section go round the hues without ever coming near an earlier one soon.
  const double turn = island * 0.61803398875;
  return fromHue(turn - std::floor(turn), 0.62, island % 2 == 0 ? 0.95 : 0.78);
}

BodyTint tintOf(const ListedBody& listed, const FrameBody& body, const ViewOptions& options) {
  const bool moves = body.activity != Activity::fixed;
  if (options.collisions && moves) {
    // Hits are bright and fade; what merely touches is paler, so that a wall that stands is told from one that is struck.
    const float hit = std::max(0.0f, 1 - body.sinceHit / kRedSeconds);
    const float strength = std::max(hit, body.touching ? 0.45f : 0.0f);
    if (strength > 0) return {kRed, strength};
  }
  if (body.activity == Activity::quarantined) return {kLostViolet, 0.9f};
  if (options.asleep && listed.role != BodyRole::ground) {
    if (body.activity == Activity::asleep) return {kAsleepBlue, 0.8f};
    if (body.activity == Activity::held) return {kHeldAmber, 0.8f};
  }
  if (options.islands && body.island >= 0) return {islandColour(body.island), 0.85f};
  return {};
}

}  // namespace brickfall::viewer
