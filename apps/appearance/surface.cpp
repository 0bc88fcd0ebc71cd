#include "appearance/surface.h"

#include <algorithm>
#include <cmath>

#include "appearance/noise.h"

namespace brickfall::appearance {

namespace {

inline float cornerValue(std::int32_t x, std::int32_t y, std::int32_t z, std::uint64_t seed) {
  const std::uint64_t key = std::uint64_t(std::uint32_t(x)) * 0x9e3779b1ull +
                            std::uint64_t(std::uint32_t(y)) * 0x85ebca77c2b2ull +
                            std::uint64_t(std::uint32_t(z)) * 0xc2b2ae3d27d4eb4full + seed;
  return float(std::int32_t(hashOf(key))) * 0x1p-31f;
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
  const std::uint64_t s = std::uint64_t(seed) << 20;
  const auto row = [&](std::int32_t j, std::int32_t k) {
    return mix(cornerValue(x, y + j, z + k, s), cornerValue(x + 1, y + j, z + k, s), u);
  };
  return mix(mix(row(0, 0), row(1, 0), v), mix(row(0, 1), row(1, 1), v), w);
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

constexpr float kPoreSize = 0.0055f, kPoreFrom = 0.42f;

Surface paintBrick(const Look& look, const SurfacePoint& point) {
  const Vec3f p = point.position;
  const float f = point.footprint;
  const std::uint32_t s = look.seed;
  Surface out{look.colour, look.roughness, 0, point.normal};
  const int axis = mainAxis(point.normal);
  // Fire: clouds over the whole brick, darker towards the ends that lay in the flame.
  const float cloud = grain(p, 0.07f, s, f), patch = grain(p, 0.028f, s + 1, f);
  float light = 1 + 0.13f * cloud + 0.09f * patch;
  out.colour = scaled(out.colour, Rgb{1 - 0.05f * cloud, 1 + 0.04f * cloud, 1 + 0.10f * cloud});
  if (axis == 0) light *= 0.86f + 0.06f * cloud;
  // The long sides were cut by a wire: lines along the brick.
  if (axis == 2) light *= 1 + 0.07f * grain({p.x * 0.06f, p.y, p.z}, 0.0045f, s + 2, f);
  light *= 1 + 0.09f * grain(p, 0.0075f, s + 3, f) + 0.08f * grain(p, 0.0028f, s + 4, f) +
           0.06f * grain(p, 0.0011f, s + 5, f);
  out.colour = out.colour * std::max(light, 0.2f);
  // Grains of sand and lime.
  out.colour = mix(out.colour, Rgb{0.62f, 0.50f, 0.38f}, 0.55f * pits(p, 0.0042f, s + 6, f, 0.55f));
  // Lime that rose or stuck: thick on beds, a veil on faces.
  const float lime = ramp(axis == 1 ? -0.25f : 0.4f, axis == 1 ? 0.5f : 0.9f,
                          grain(p, 0.045f, s + 7, f) + 0.35f * grain(p, 0.009f, s + 8, f));
  out.colour = mix(out.colour, Rgb{0.56f, 0.50f, 0.43f}, (axis == 1 ? 0.6f : 0.35f) * lime);
  out.colour = out.colour * (1 - 0.62f * pits(p, kPoreSize, s + 9, f, kPoreFrom));
  const float wear = wearAt(point, s);
  out.colour = mix(out.colour, mix(look.colour * 1.25f, Rgb{0.55f, 0.42f, 0.33f}, 0.35f), 0.6f * wear);
  return out;
}

Surface paintConcrete(const Look& look, const SurfacePoint& point) {
  const Vec3f p = point.position;
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
  const Vec3f p = point.position;
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
  const Vec3f p = point.position;
  const float f = point.footprint;
  const std::uint32_t s = look.seed;
  Surface out{look.colour, look.roughness, 0, point.normal};
  float light = 1 + 0.07f * grain(p, 1.7f, s, f) + 0.06f * grain(p, 0.42f, s + 1, f) +
                0.05f * grain(p, 0.09f, s + 2, f) + 0.07f * grain(p, 0.021f, s + 3, f) +
                0.09f * grain(p, 0.006f, s + 4, f) + 0.08f * grain(p, 0.002f, s + 5, f);
  light *= 1 - 0.4f * pits(p, 0.011f, s + 6, f, 0.6f);
  out.colour =
      mix(out.colour * std::max(light, 0.2f), Rgb{0.55f, 0.52f, 0.48f}, 0.35f * pits(p, 0.016f, s + 7, f, 0.62f));
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
  const Vec3f p = point.position;
  const float f = point.footprint;
  const std::uint32_t s = look.seed;
  float height = look.relief * (0.8f * grain(p, 0.018f, s + 21, f) + 0.55f * grain(p, 0.006f, s + 22, f) +
                                0.3f * grain(p, 0.0022f, s + 23, f));
  if (look.kind == Kind::brick) height -= 2 * look.relief * pits(p, kPoreSize, s + 9, f, kPoreFrom);
  if (look.kind == Kind::concrete) height -= 3 * look.relief * pits(p, 0.013f, s + 4, f, 0.62f);
  return height;
}

Surface surfaceAt(const Look& look, const SurfacePoint& point) {
  Surface out = paintAt(look, point);
  if (look.relief <= 0 || point.footprint > 0.009f) return out;  // no wave of the relief is seen from there
  const Vec3f n = point.normal;
  const Vec3f side = normalized(std::fabs(n.y) < 0.9f ? cross(Vec3f{0, 1, 0}, n) : cross(Vec3f{1, 0, 0}, n));
  const Vec3f up = cross(n, side);
  const float step = std::max(0.0003f, 0.5f * point.footprint);
  SurfacePoint beside = point, above = point;
  beside.position += side * step;
  above.position += up * step;
  const float here = heightAt(look, point);
  const float slopeSide = (heightAt(look, beside) - here) / step, slopeUp = (heightAt(look, above) - here) / step;
  out.normal = normalized(n - side * slopeSide - up * slopeUp);
  return out;
}

}  // namespace brickfall::appearance
