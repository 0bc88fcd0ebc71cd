#include "appearance/surface.h"

#include <algorithm>
#include <cmath>

#include "appearance/light.h"
#include "appearance/noise.h"

namespace brickfall::appearance {

namespace {

// Odd and large: what is far apart in space must not be near in the hash.
constexpr std::uint64_t kAlongX = 0x9e3779b97f4a7c15ull, kAlongY = 0xc2b2ae3d27d4eb4full,
                        kAlongZ = 0x165667b19e3779f9ull;

inline float cornerValue(std::uint64_t key) {
  key = (key ^ key >> 32) * 0xd6e8feb86659fd93ull;
  return float(std::int32_t((key ^ key >> 32) >> 8 & 0xffffff) - 0x800000) * 0x1p-23f;
}

inline std::int32_t floorOf(float v) {
  const std::int32_t whole = std::int32_t(v);
  return whole - (v < float(whole) ? 1 : 0);
}

}  // namespace

float valueNoise(Vec3f p, std::uint32_t seed) {
  const std::int32_t x = floorOf(p.x), y = floorOf(p.y), z = floorOf(p.z);
  const auto smooth = [](float t) { return t * t * (3 - 2 * t); };
  const float u = smooth(p.x - float(x)), v = smooth(p.y - float(y)), w = smooth(p.z - float(z));
  const std::uint64_t key = std::uint64_t(x) * kAlongX + std::uint64_t(y) * kAlongY + std::uint64_t(z) * kAlongZ +
                            std::uint64_t(seed) * 0x2545f4914f6cdd1dull;
  const auto row = [&](std::uint64_t from) { return mix(cornerValue(from), cornerValue(from + kAlongX), u); };
  return mix(mix(row(key), row(key + kAlongY), v), mix(row(key + kAlongZ), row(key + kAlongY + kAlongZ), v), w);
}

namespace {

// Of a box: how far a point is from the nearest edge of the face it lies on, m; large for other shapes.
float edgeDistance(const SurfacePoint& point) {
  const Vec3f& h = point.halfExtents;
  if (!(h.x > 0)) return 1;
  float d[3] = {h.x - std::fabs(point.position.x), h.y - std::fabs(point.position.y),
                h.z - std::fabs(point.position.z)};
  std::sort(d, d + 3);
  return d[1];
}

// The bumps of the noise lie in rows; turned like this no row lies along a face.
Vec3f slanted(Vec3f p) {
  return {0.36f * p.x + 0.48f * p.y - 0.80f * p.z, -0.80f * p.x + 0.60f * p.y, 0.48f * p.x + 0.64f * p.y + 0.60f * p.z};
}

int mainAxis(Vec3f n) {
  const Vec3f a = abs(n);
  return a.x >= a.y && a.x >= a.z ? 0 : a.y >= a.z ? 1 : 2;
}

// 0 .. 1: holes where the noise is highest. The fewer, the larger `from` (0 .. 1).
float pits(Vec3f p, float wavelength, std::uint32_t seed, float footprint, float from) {
  const float seen = seenShare(wavelength, footprint);
  return seen > 0 ? seen * ramp(from, from + 0.15f, valueNoise(p * (1 / wavelength), seed)) : 0;
}

// Where a brick's edges are rubbed off: 0 .. 1.
float wearAt(const SurfacePoint& point, std::uint32_t seed) {
  const float d = edgeDistance(point);
  if (d > 0.012f) return 0;
  const float width = 0.0035f + 0.003f * valueNoise(point.position * 45.0f, seed + 11);
  return ramp(width, 0, d) * seenShare(0.006f, point.footprint);
}

constexpr float kPoreSize = 0.0042f, kPoreFrom = 0.5f;

Surface paintBrick(const Look& look, const SurfacePoint& point) {
  const Vec3f p = slanted(point.position);
  const float f = point.footprint;
  const std::uint32_t s = look.seed;
  Surface out{look.colour, look.roughness, 0, point.normal};
  const int axis = mainAxis(point.normal);
  // Fire: clouds over the whole brick, darker towards the ends that lay in the flame.
  const float cloud = grain(p, 0.07f, s, f), patch = grain(p, 0.024f, s + 1, f);
  float light = 1 + 0.16f * cloud + 0.11f * patch;
  out.colour = scaled(out.colour, Rgb{1 - 0.04f * cloud, 1 + 0.05f * cloud, 1 + 0.12f * cloud});
  if (axis == 0) light *= 0.88f + 0.08f * cloud;
  // The long sides were cut by a wire: lines along the brick.
  if (axis == 2) light *= 1 + 0.06f * grain(scaled(point.position, Vec3f{0.05f, 1, 1}), 0.004f, s + 2, f);
  light *= 1 + 0.10f * grain(p, 0.008f, s + 3, f) + 0.09f * grain(p, 0.0024f, s + 4, f) +
           0.08f * grain(p, 0.0009f, s + 5, f);
  out.colour = out.colour * std::max(light, 0.2f);
  // Grains of sand, and lime that rose or stuck: thick on beds, a veil on faces.
  out.colour = mix(out.colour, Rgb{0.47f, 0.34f, 0.24f}, 0.35f * pits(p, 0.0026f, s + 6, f, 0.5f));
  const float from = axis == 1 ? -0.2f : 0.3f;
  const float lime = ramp(from, from + 0.8f, grain(p, 0.05f, s + 7, f) + 0.4f * patch);
  if (lime > 0) out.colour = mix(out.colour, Rgb{0.50f, 0.44f, 0.38f}, (axis == 1 ? 0.3f : 0.15f) * lime);
  out.colour = out.colour * (1 - 0.45f * pits(p, kPoreSize, s + 9, f, kPoreFrom));
  out.colour = out.colour * edgeShade(edgeDistance(point), f);
  const float wear = wearAt(point, s);
  if (wear > 0) out.colour = mix(out.colour, mix(look.colour * 1.2f, Rgb{0.5f, 0.38f, 0.30f}, 0.35f), 0.5f * wear);
  return out;
}

Surface paintConcrete(const Look& look, const SurfacePoint& point) {
  const Vec3f p = slanted(point.position);
  const float f = point.footprint;
  const std::uint32_t s = look.seed;
  Surface out{look.colour, look.roughness, 0, point.normal};
  float light = 1 + 0.10f * grain(p, 0.16f, s, f) + 0.07f * grain(p, 0.035f, s + 1, f) +
                0.06f * grain(p, 0.005f, s + 2, f) + 0.05f * grain(p, 0.0015f, s + 3, f);
  light *= 1 - 0.55f * pits(p, 0.013f, s + 4, f, 0.62f);
  out.colour = mix(out.colour * light, Rgb{0.5f, 0.48f, 0.44f}, 0.3f * wearAt(point, s));
  return out;
}

Surface paintStone(const Look& look, const SurfacePoint& point) {
  const Vec3f p = slanted(point.position);
  const float f = point.footprint;
  const std::uint32_t s = look.seed;
  Surface out{look.colour, look.roughness, 0, point.normal};
  const float warp = grain(p, 0.12f, s, f);
  const float vein = 1 - std::fabs(grain(p + Vec3f{warp, warp, warp} * 0.05f, 0.06f, s + 1, f));
  const float light = 1 + 0.15f * warp + 0.12f * grain(p, 0.02f, s + 2, f) + 0.12f * grain(p, 0.004f, s + 3, f) -
                      0.15f * ramp(0.9f, 1, vein) * seenShare(0.06f, f);
  out.colour = out.colour * std::max(light, 0.2f);
  return out;
}

// Rings about an axis that lies beside the piece: boards are not cut through the heart.
Surface paintWood(const Look& look, const SurfacePoint& point) {
  const Vec3f h = point.halfExtents, p = point.position;
  const float f = point.footprint;
  const std::uint32_t s = look.seed;
  const int along = h.y > h.x && h.y >= h.z ? 1 : h.z > h.x ? 2 : 0;
  const Vec3f q = along == 0 ? p : along == 1 ? Vec3f{p.y, p.z, p.x} : Vec3f{p.z, p.x, p.y};
  Vec3f stretched{q.x * 0.08f, q.y, q.z};
  const float sway = 0.010f * valueNoise(stretched * 12.0f, s);
  const float radius = std::hypot(q.y + 0.10f + 0.1f * chance(s, 5), q.z + 0.05f * (chance(s, 6) - 0.5f)) + sway;
  const float ring = radius / 0.008f - std::floor(radius / 0.008f);
  const float late =
      ramp(0.3f, 0.9f, ring) * (1 - ramp(0.92f, 1, ring)) * seenShare(0.008f, f) + 0.4f * (1 - seenShare(0.008f, f));
  const float fibre = grain({q.x * 0.05f, q.y, q.z}, 0.0022f, s + 1, f);
  Surface out{look.colour, look.roughness, 0, point.normal};
  out.colour = scaled(out.colour, mix(Rgb{1.12f, 1.1f, 1.08f}, Rgb{0.62f, 0.55f, 0.48f}, late)) * (1 + 0.12f * fibre);
  return out;
}

Surface paintSteel(const Look& look, const SurfacePoint& point) {
  const float f = point.footprint;
  const float smear = grain(point.position, 0.05f, look.seed, f),
              fine = grain(point.position, 0.004f, look.seed + 1, f);
  Surface out{look.colour, clampUnit(look.roughness + 0.06f * smear + 0.03f * fine), look.metalness, point.normal};
  // Bare steel reflects more than a painter's colour for it says.
  out.colour = mix(out.colour, Rgb{0.56f, 0.55f, 0.53f}, 0.6f) * (1 + 0.05f * smear);
  return out;
}

// A floor of fine gravel and dust: clouds, then grains, light and dark.
Surface paintGround(const Look& look, const SurfacePoint& point) {
  const Vec3f p = slanted(point.position);
  const float f = point.footprint;
  const std::uint32_t s = look.seed;
  Surface out{look.colour, look.roughness, 0, point.normal};
  const float light = 1 + 0.07f * grain(p, 1.9f, s, f) + 0.05f * grain(p, 0.35f, s + 1, f) +
                      0.05f * grain(p, 0.06f, s + 2, f) + 0.06f * grain(p, 0.013f, s + 3, f) +
                      0.08f * grain(p, 0.0035f, s + 4, f) + 0.07f * grain(p, 0.0012f, s + 5, f);
  out.colour = out.colour * std::max(light, 0.2f);
  // Lone bits of gravel.
  out.colour = mix(out.colour, Rgb{0.42f, 0.40f, 0.37f}, 0.35f * pits(p, 0.012f, s + 7, f, 0.7f));
  return out;
}

Surface paintPlain(const Look& look, const SurfacePoint& point) {
  Surface out{look.colour, look.roughness, look.metalness, point.normal};
  out.colour = out.colour * (1 + 0.04f * grain(point.position, 0.03f, look.seed, point.footprint));
  return out;
}

}  // namespace

Surface paintAt(const Look& look, const SurfacePoint& point) {
  switch (look.kind) {
    case Kind::brick:
      return paintBrick(look, point);
    case Kind::concrete:
      return paintConcrete(look, point);
    case Kind::stone:
      return paintStone(look, point);
    case Kind::wood:
      return paintWood(look, point);
    case Kind::steel:
      return paintSteel(look, point);
    case Kind::ground:
      return paintGround(look, point);
    case Kind::rubber:
    case Kind::plain:
      break;
  }
  return paintPlain(look, point);
}

float heightAt(const Look& look, const SurfacePoint& point) {
  if (look.relief <= 0) return 0;
  const Vec3f p = slanted(point.position);
  const float f = point.footprint;
  const std::uint32_t s = look.seed;
  float height = look.relief * (0.8f * grain(p, 0.018f, s + 21, f) + 0.55f * grain(p, 0.006f, s + 22, f) +
                                0.3f * grain(p, 0.0022f, s + 23, f));
  if (look.kind == Kind::brick) height -= 2 * look.relief * pits(p, kPoreSize, s + 9, f, kPoreFrom);
  if (look.kind == Kind::concrete) height -= 3 * look.relief * pits(p, 0.013f, s + 4, f, 0.62f);
  return height;
}

constexpr float kReliefEnd = 0.006f;  // m, footprint from which on bumps are too small to be seen

Surface surfaceAt(const Look& look, const SurfacePoint& point) {
  Surface out = paintAt(look, point);
  if (look.relief <= 0 || point.footprint >= kReliefEnd) return out;
  const Vec3f n = point.normal;
  const Vec3f side = normalized(std::fabs(n.y) < 0.9f ? cross(Vec3f{0, 1, 0}, n) : cross(Vec3f{1, 0, 0}, n));
  const Vec3f up = cross(n, side);
  const float step = std::max(0.0003f, 0.5f * point.footprint);
  SurfacePoint beside = point, above = point;
  beside.position += side * step;
  above.position += up * step;
  const float here = heightAt(look, point);
  const float seen = (1 - ramp(0.5f * kReliefEnd, kReliefEnd, point.footprint)) / step;
  const float slopeSide = (heightAt(look, beside) - here) * seen, slopeUp = (heightAt(look, above) - here) * seen;
  out.normal = normalized(n - side * slopeSide - up * slopeUp);
  return out;
}

}  // namespace brickfall::appearance
