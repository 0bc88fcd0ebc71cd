#include "viewer_window/view_options.h"

#include <algorithm>
#include <cmath>
#include <iterator>

namespace brickfall::viewer {
namespace {

constexpr std::uint32_t kRed = 0xE0261C, kAsleepBlue = 0x4F7CC4, kHeldAmber = 0xE0A030, kLostViolet = 0xC040E0,
                        kBehindMortar = 0xC9C6C0;
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
  constexpr const char* kNames[kShadowChoiceCount] = {"depth", "stencil", "none"};
  return kNames[int(choice)];
}

const char* nameOf(MortarView view) {
  constexpr const char* kNames[kMortarViewCount] = {"none", "utilisation", "damage"};
  return kNames[int(view)];
}

std::uint32_t scaleColour(double share) {
  constexpr std::uint32_t kScale[] = {0x3C4F96, 0x5D52AB, 0x8F52A5, 0xC0548A, 0xE0655C, 0xF29348, 0xF8C862, 0xFDF5C0};
  constexpr int kSteps = int(std::size(kScale)) - 1;
  const double x = std::clamp(share, 0.0, 1.0) * kSteps;
  const int k = std::min(kSteps - 1, int(x));
  std::uint32_t out = 0;
  for (int shift : {16, 8, 0}) {
    const double low = kScale[k] >> shift & 255, high = kScale[k + 1] >> shift & 255;
    out |= std::uint32_t(std::lround(low + (high - low) * (x - k))) << shift;
  }
  return out;
}

FrameNeeds ViewOptions::needs(bool plots) const {
  FrameNeeds needs;
  needs.contacts = contacts;
  needs.collisions = collisions;
  needs.islands = islands;
  needs.bounds = bounds;
  needs.plots = plots;
  needs.mortar = mortar != MortarView::none;
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
  if (options.mortar != MortarView::none && listed.role != BodyRole::ground) return {kBehindMortar, 0.9f};
  return {};
}

}  // namespace brickfall::viewer
