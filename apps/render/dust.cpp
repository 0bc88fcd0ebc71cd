#include "render/dust.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "appearance/look.h"
#include "appearance/noise.h"
#include "render/parallel.h"

namespace brickfall::render {
namespace {

using appearance::chance;
using appearance::mix;

// Those of dust.ts.
constexpr double kSeconds = 1.3;
constexpr std::size_t kMostSources = 160;  // the latest
constexpr std::uint32_t kParticles = 7;
constexpr std::size_t kUsual = 30;    // the hit that has full force, counted from the strongest
constexpr float kLeastForce = 0.08f;  // of it
constexpr Rgb kPale{0.56f, 0.50f, 0.44f};
constexpr float kPaleness = 0.5f;

// Which of two bodies breaks rather than the other.
int rankOf(BodyRole role) {
  switch (role) {
    case BodyRole::brick:
      return 0;
    case BodyRole::body:
      return 1;
    case BodyRole::ground:
      return 2;
    case BodyRole::ball:
      return 3;
  }
  return 3;
}

Rgb colourOf(const TakeReader& take, const TakeEvent& hit) {
  const auto& bodies = take.bodies();
  const bool second = rankOf(bodies[hit.bodyB].role) < rankOf(bodies[hit.bodyA].role);
  const std::uint32_t body = second ? hit.bodyB : hit.bodyA;
  if (bodies[body].shapes.empty()) return kPale;
  return mix(appearance::lookOf(bodies[body], 0, bodies[body].look.value_or(body)).colour, kPale, kPaleness);
}

float fractOf(float x) { return x - std::floor(x); }

float hashAt(float x, float y) {
  float a = fractOf(x * 0.1031f), b = fractOf(y * 0.1031f), c = a;
  const float along = a * (b + 33.33f) + b * (c + 33.33f) + c * (a + 33.33f);
  a += along, b += along, c += along;
  return fractOf((a + b) * c);
}

float noiseAt(float x, float y) {
  const float i = std::floor(x), k = std::floor(y);
  float u = x - i, v = y - k;
  u = u * u * (3 - 2 * u), v = v * v * (3 - 2 * v);
  const float low = hashAt(i, k) * (1 - u) + hashAt(i + 1, k) * u;
  const float high = hashAt(i, k + 1) * (1 - u) + hashAt(i + 1, k + 1) * u;
  return low * (1 - v) + high * v;
}

float smoothstep(float low, float high, float x) {
  const float t = std::clamp((x - low) / (high - low), 0.0f, 1.0f);
  return t * t * (3 - 2 * t);
}

// Where a puff is in a picture.
struct Spot {
  const Puff* puff = nullptr;
  float x = 0, y = 0, radius = 0, distance = 0;  // pixels; m
};

std::vector<Spot> spotsOf(const Picture& picture, const View& view, std::span<const Puff> puffs) {
  std::vector<Spot> out;
  const float half = 0.5f * float(picture.height), reach = length(view.up);
  for (const Puff& puff : puffs) {
    const Vec3f seen = puff.place - view.position;
    const float depth = dot(seen, view.forward);
    if (!(depth > 0.02f)) continue;
    const float scale = half / (reach * reach * depth);
    const Spot spot{&puff, 0.5f * float(picture.width) + dot(seen, view.right) * scale,
                    half - dot(seen, view.up) * scale, 0.5f * puff.size * half / (reach * depth), length(seen)};
    if (spot.radius > 0.3f) out.push_back(spot);
  }
  return out;
}

void blend(Rgb& light, float depth, const Spot& spot, float x, float y) {
  const float dx = (x - spot.x) / spot.radius, dy = (y - spot.y) / spot.radius;
  float a = 1 - dx * dx - dy * dy;
  if (!(a > 0)) return;
  const float s = spot.puff->seed;
  const float billow =
      noiseAt(dx * 2.3f + s * 17, dy * 2.3f + s * 17) * 0.65f + noiseAt(dx * 5.1f + s * 31, dy * 5.1f + s * 31) * 0.35f;
  a = a * a * smoothstep(0.25f, 0.85f, billow + 0.25f * a);
  // It has no edge where it goes into what stands there.
  a *= spot.puff->opacity * std::clamp((depth - spot.distance) / (0.5f * spot.puff->size) + 0.5f, 0.0f, 1.0f);
  const float top = std::clamp(0.5f - 0.45f * dy + 0.2f * billow, 0.0f, 1.0f);  // lit from above
  light = mix(light, scaled(spot.puff->colour, mix(Rgb{0.75f, 0.76f, 0.78f}, Rgb{1.55f, 1.45f, 1.3f}, top)), a);
}

}  // namespace

Dust::Dust(const TakeReader& take) {
  std::vector<std::pair<double, TakeEvent>> hits;
  std::vector<float> impulses;
  for (std::size_t k = 0; k < take.frameCount(); k++) {
    const Result<TakeFrame> frame = take.frame(k);
    if (!frame) continue;  // whoever draws it says so
    for (const TakeEvent& event : frame->events) {
      if (event.type != TakeEventType::hit) continue;
      hits.push_back({frame->time, event});
      impulses.push_back(event.impulse);
    }
  }
  if (hits.empty()) return;
  std::sort(impulses.begin(), impulses.end(), std::greater<>());
  const float usual = impulses[std::min(kUsual, impulses.size() - 1)];
  for (const auto& [time, hit] : hits)
    if (hit.impulse > kLeastForce * usual)
      sources_.push_back({time,
                          {float(hit.pointWorld.x), float(hit.pointWorld.y), float(hit.pointWorld.z)},
                          std::min(1.0f, std::sqrt(hit.impulse / usual)),
                          colourOf(take, hit)});
}

std::vector<Puff> Dust::at(double time) const {
  std::vector<Puff> out;
  std::size_t k = sources_.size(), taken = 0;
  while (k > 0 && sources_[k - 1].time > time) k--;
  for (; k > 0 && taken < kMostSources && time - sources_[k - 1].time <= kSeconds; k--, taken++) {
    const Source& source = sources_[k - 1];
    const float share = float((time - source.time) / kSeconds), left = 1 - share;
    const float spread = 1 - left * left * left, force = source.force;
    for (std::uint32_t n = 0; n < kParticles; n++) {
      const auto any = [&](std::uint32_t salt) { return chance(std::uint32_t(k - 1), n + salt); };
      const float reach = (0.05f + 0.26f * any(20)) * spread * force;
      double sine, cosine;
      sinCos(double(any(0)) * 2 * std::numbers::pi, sine, cosine);
      Puff puff;
      puff.place =
          source.place + Vec3f{float(cosine) * reach, (0.03f + 0.2f * any(40)) * spread * force, float(sine) * reach};
      puff.size = (0.12f + 0.34f * spread) * (0.5f + 0.7f * any(60)) * (0.4f + 0.6f * force);
      puff.opacity = 0.24f * left * std::sqrt(left) * std::min(1.0f, share * float(kSeconds) * 14 + 0.1f) *
                     (0.35f + 0.65f * force);
      puff.seed = any(80);
      puff.colour = source.colour;
      out.push_back(puff);
    }
  }
  return out;
}

void addDust(std::vector<Rgb>& light, const Picture& picture, const View& view, std::span<const Puff> puffs,
             int threads) {
  const std::vector<Spot> spots = spotsOf(picture, view, puffs);
  if (spots.empty()) return;
  forRows(picture.height, threads, [&](int y) {
    const float middle = float(y) + 0.5f;
    for (const Spot& spot : spots) {
      if (std::fabs(middle - spot.y) > spot.radius) continue;
      const int from = std::max(0, int(spot.x - spot.radius));
      const int to = std::min(picture.width - 1, int(spot.x + spot.radius));
      for (int x = from; x <= to; x++)
        blend(light[std::size_t(y) * std::size_t(picture.width) + std::size_t(x)], picture.at(x, y).depth, spot,
              float(x) + 0.5f, middle);
    }
  });
}

}  // namespace brickfall::render
