#include "render/tracer.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "appearance/surface.h"
#include "render/moving_shade.h"
#include "render/parallel.h"
#include "render/sampler.h"

namespace brickfall::render {

namespace {

using appearance::brightness;
using appearance::Look;
using appearance::Surface;
using appearance::SurfacePoint;

// What the numbers of a sample are for (Sampler::pair). Each bounce takes kPerBounce more.
constexpr int kPixel = 0, kTime = 1, kFirst = 2;
constexpr int kSunDisc = 0, kOnward = 1, kPerBounce = 2;

constexpr int kBlurredTimes =
    4;  // more samples of a pixel in which something moves: fewer leave steps instead of a blur
// The same of one at the edge of a shadow that stands: sunlight is not filtered, fewer show as grains.
constexpr int kShadeTimes = 2;
constexpr float kBrightest = 12;  // of light that comes by way of other things: more makes lone bright pixels
constexpr float kMatt = 0.78f;    // roughness from which on no shine is seen
// m, footprint on surfaces that are only seen by way of others; less costs time for what nobody sees.
constexpr float kPlainAfter = 0.08f;
// Of the way that a surface moves: what of its pattern is finer is smeared anyway. More blurs too much, less shows as grains.
constexpr float kSmear = 0.06f;

// Directions about an axis (Duff et al. 2017: without a root, without a branch that a ray would guess wrong).
struct Frame {
  Vec3f side, up, axis;
  explicit Frame(Vec3f n) : axis(n) {
    const float sign = std::copysign(1.0f, n.z), a = -1 / (sign + n.z), b = n.x * n.y * a;
    side = {1 + sign * n.x * n.x * a, sign * b, -sign * n.x};
    up = {b, sign + n.y * n.y * a, -n.y};
  }
  Vec3f out(float x, float y, float z) const { return side * x + up * y + axis * z; }
};

// A point of the unit circle, by its share of a turn: x the cosine, y the sine. The same everywhere, unlike those of the C library.
Pair onCircle(float turn) {
  // Sine of a quarter turn either way by its series, then put into place.
  const float t = turn * 4;
  const int quarter = int(t);  // turn >= 0: without SSE 4, std::floor is a call
  const float s = (t - float(quarter) - 0.5f) * (std::numbers::pi_v<float> / 2), s2 = s * s;
  const float sine = s * (1 - s2 * (1 / 6.0f - s2 * (1 / 120.0f - s2 * (1 / 5040.0f))));
  const float cosine = 1 - s2 * (0.5f - s2 * (1 / 24.0f - s2 * (1 / 720.0f - s2 * (1 / 40320.0f))));
  constexpr float kHalf = 0.70710678f;  // the middle of the quarter lies at an eighth of a turn
  const float x = kHalf * (cosine - sine), y = kHalf * (cosine + sine);
  // Turned by whole quarters, without a branch: which it is cannot be guessed.
  constexpr float kCosine[4] = {1, 0, -1, 0}, kSine[4] = {0, 1, 0, -1};
  const int turns = quarter & 3;
  return {x * kCosine[turns] - y * kSine[turns], x * kSine[turns] + y * kCosine[turns]};
}

// As much towards each direction as its light counts on a matt surface.
Vec3f mattDirection(Vec3f normal, Pair u) {
  const float flat = std::sqrt(u.x);
  const Pair circle = onCircle(u.y);
  return Frame(normal).out(flat * circle.x, flat * circle.y, std::sqrt(1 - u.x));
}

// Share of small mirrors of a rough surface that are turned so (the law of Trowbridge and Reitz).
float mirrors(float cosine, float alpha) {
  const float a2 = alpha * alpha, t = cosine * cosine * (a2 - 1) + 1;
  return a2 / (std::numbers::pi_v<float> * t * t);
}

float fresnel(float cosine) {
  const float m = 1 - std::clamp(cosine, 0.0f, 1.0f), m2 = m * m;
  return m2 * m2 * m;
}

// A place that light comes from, or goes to the camera from.
struct Place {
  Vec3f position, normal, flat;  // normal with the relief; that of the triangle
  Surface surface;
  int part = -1;
  float haze = 0;  // share of the horizon's light in what is seen
  bool blurred = false;
};

// What a ray from the camera met.
struct Face {
  int part = -1;
  bool sunlit = false, blurred = false;
  float depth = 0;  // m
  Vec3f normal;     // in the shape's frame, without relief
};

// The sum of a pixel's samples.
struct Gathered {
  Rgb colour, sky, direct;
  Vec3f normal;
  float depth = 0, light = 0, squares = 0;  // light: brightness of `sky`
  int samples = 0, covered = 0;
  Face first;
  bool edge = false, shade = false,
       blurred = false;  // its samples met several faces; sun and shade; something that moves
};

// Those that every pixel takes.
int firstSamples(const TraceSettings& settings) { return (settings.samples + 1) / 2; }

class PixelTracer {
 public:
  PixelTracer(const Stage& stage, const CameraRays& rays, const Sky& sky, const TraceSettings& settings, bool anyMotion)
      : stage_(stage),
        rays_(rays),
        sky_(sky),
        settings_(settings),
        sunFrame_(sky.sun),
        anyMotion_(anyMotion),
        mean_(sky.mean()) {}

  void add(Gathered& pixel, int x, int y, int from, int to);

 private:
  struct Sample {
    Rgb colour{1, 1, 1}, sky, direct;
    Vec3f normal;
    float depth = 0;
    bool covered = false;
    Face face;
  };
  Sample sample(const Sampler& numbers, int index, int x, int y);
  Place placeAt(const Ray& ray, const Hit& hit, float pixelAngle);
  void shadeMetal(const Sampler& numbers, int index, const Ray& ray, const Place& place, Sample& out) const;
  Rgb sunOn(const Place& place, Vec3f towardsEye, float time, Pair u) const;
  Rgb comingFrom(Ray ray, const Sampler& numbers, int index, int bounce) const;
  Ray from(const Place& place, Vec3f direction, float time) const {
    return {place.position + place.flat * (1e-4f * (1 + 0.02f * length(place.position))), direction, time, 1e30f};
  }

  const Stage& stage_;
  const CameraRays& rays_;
  const Sky& sky_;
  const TraceSettings& settings_;
  Frame sunFrame_;
  bool anyMotion_;
  Rgb mean_;
  // The last surface that was looked at, of the pixel at hand: its samples mostly meet the same one.
  Surface last_;
  Vec3f lastLocalNormal_;
  int lastPart_ = -1;
};

// Patterns are faded to the width of a pixel, so that one look is enough for all samples of a pixel that meet the same face at rest.
Place PixelTracer::placeAt(const Ray& ray, const Hit& hit, float pixelAngle) {
  const Part& part = stage_.parts()[std::size_t(hit.part)];
  Place place;
  place.part = hit.part;
  place.position = ray.origin + ray.direction * hit.distance;
  place.flat = hit.normal;
  const float slant = std::max(-dot(ray.direction, hit.normal), 0.08f);
  place.blurred = part.sweep > 1.5f * hit.distance * pixelAngle;
  const bool same = !place.blurred && lastPart_ == hit.part && dot(lastLocalNormal_, hit.localNormal) > 0.9999f;
  if (!same) {
    float footprint = hit.distance * pixelAngle / std::sqrt(slant);
    if (place.blurred) footprint = std::max(footprint, kSmear * part.sweep);
    const SurfacePoint point{hit.local, hit.localNormal, part.halfExtents, footprint};
    last_ = appearance::surfaceAt(part.look, point);
    lastPart_ = hit.part;
    lastLocalNormal_ = hit.localNormal;
  }
  place.surface = last_;
  // Its joints are finer than what differs within a pixel, and seen flat a pixel is far longer than wide.
  if (part.isFloor()) {
    const Vec3f width = rays_.footprint(ray, hit.distance, hit.normal, transpose(part.open));
    place.surface.colour = place.surface.colour * appearance::floorShade(hit.local, width);
  }
  place.normal = part.toWorld(last_.normal, ray.time);
  // Seen flat, a bump may turn away from the eye: then it is as if it stood on edge.
  const float facing = -dot(place.normal, ray.direction);
  if (facing < 0.02f) place.normal = normalized(place.normal + ray.direction * (facing - 0.02f));
  if (part.look.kind == appearance::Kind::ground) place.haze = appearance::hazeShare(hit.distance);
  return place;
}

// Light of the sun that a matt or shiny surface sends to the eye.
Rgb PixelTracer::sunOn(const Place& place, Vec3f towardsEye, float time, Pair u) const {
  const float wide = sky_.sunRadius * std::sqrt(u.x);
  const Pair circle = onCircle(u.y);
  const Vec3f sun = normalized(sunFrame_.out(wide * circle.x, wide * circle.y, 1));
  const float cosine = dot(place.normal, sun);
  if (cosine <= 0 || dot(place.flat, sun) <= 0 || stage_.isBlocked(from(place, sun, time))) return {};
  const Surface& s = place.surface;
  const Rgb matt = s.colour * ((1 - s.metalness) / std::numbers::pi_v<float>);
  if (s.roughness > kMatt) return scaled(matt, sky_.sunLight) * cosine;
  const Vec3f half = normalized(sun + towardsEye);
  const float alpha = std::max(s.roughness * s.roughness, 0.02f), edge = fresnel(dot(half, sun));
  const Rgb mirrored = appearance::mix(Rgb{0.04f, 0.04f, 0.04f}, s.colour, s.metalness);
  const float view = std::max(dot(place.normal, towardsEye), 0.1f);
  const Rgb shine = (mirrored + (Rgb{1, 1, 1} - mirrored) * edge) *
                    std::min(mirrors(dot(half, place.normal), alpha) / (4 * view * std::max(cosine, 0.1f)), 40.0f);
  return scaled(matt + shine, sky_.sunLight) * cosine;
}

// The light that comes along a ray from what it meets, or from the sky.
Rgb PixelTracer::comingFrom(Ray ray, const Sampler& numbers, int index, int bounce) const {
  Rgb light, share{1, 1, 1};
  for (;; bounce++) {
    const Hit hit = stage_.firstHit(ray);
    if (hit.part < 0) {
      light += scaled(share, sky_.radiance(ray.direction));
      break;
    }
    const Part& part = stage_.parts()[std::size_t(hit.part)];
    Place place;
    place.position = ray.origin + ray.direction * hit.distance;
    place.flat = hit.normal;
    place.normal = part.toWorld(hit.localNormal, ray.time);
    place.surface = appearance::paintAt(part.look, {hit.local, hit.localNormal, part.halfExtents, kPlainAfter});
    place.surface.roughness = 1;
    const int purposes = kFirst + bounce * kPerBounce;
    light += scaled(share, sunOn(place, -ray.direction, ray.time, numbers.pair(index, purposes + kSunDisc)));
    share = scaled(share, place.surface.colour);
    if (bounce >= settings_.bounces) {
      // What is still to come, as if half of the sky were hidden.
      light += scaled(share, mean_ * (0.3f + 0.2f * place.normal.y));
      break;
    }
    ray = from(place, mattDirection(place.normal, numbers.pair(index, purposes + kOnward)), ray.time);
  }
  return min(light, Rgb{kBrightest, kBrightest, kBrightest});
}

// Metal shows its surroundings, blurred by its roughness.
void PixelTracer::shadeMetal(const Sampler& numbers, int index, const Ray& ray, const Place& place, Sample& out) const {
  const Surface& s = place.surface;
  const Pair u = numbers.pair(index, kFirst + kOnward);
  const float alpha = std::max(s.roughness * s.roughness, 1e-3f);
  const float cosine = std::sqrt((1 - u.x) / (1 + (alpha * alpha - 1) * u.x)), flat = std::sqrt(1 - cosine * cosine);
  const Pair circle = onCircle(u.y);
  const Vec3f mirror = Frame(place.normal).out(flat * circle.x, flat * circle.y, cosine);
  Vec3f direction = ray.direction - mirror * (2 * dot(ray.direction, mirror));
  const float below = dot(direction, place.flat);
  if (below < 0.01f) direction = normalized(direction + place.flat * (0.01f - below));
  const Rgb reflected = s.colour + (Rgb{1, 1, 1} - s.colour) * fresnel(-dot(ray.direction, mirror));
  out.direct += scaled(reflected, comingFrom(from(place, direction, ray.time), numbers, index, 1)) +
                sunOn(place, -ray.direction, ray.time, numbers.pair(index, kFirst + kSunDisc));
}

PixelTracer::Sample PixelTracer::sample(const Sampler& numbers, int index, int x, int y) {
  const Pair at = numbers.pair(index, kPixel);
  const float moment = anyMotion_ ? numbers.pair(index, kTime).x : 0;
  const Ray ray = rays_.through(float(x) + at.x, float(y) + at.y, moment);
  const Hit hit = stage_.firstHit(ray);
  Sample out;
  if (hit.part < 0) {
    out.direct = sky_.radiance(ray.direction);
    out.depth = 1e4f;
    return out;
  }
  const Place place = placeAt(ray, hit, rays_.pixelAngle());
  const float clear = 1 - place.haze;
  out.normal = place.normal;
  out.depth = hit.distance;
  out.face = {hit.part, false, place.blurred, hit.distance, hit.localNormal};
  if (place.surface.metalness > 0.5f) {
    shadeMetal(numbers, index, ray, place, out);
    return out;
  }
  out.covered = true;
  out.colour = place.surface.colour * clear;
  out.direct = sunOn(place, -ray.direction, ray.time, numbers.pair(index, kFirst + kSunDisc)) * clear;
  out.face.sunlit = out.direct.x > 0;
  if (place.haze > 0) out.direct += appearance::hazeLight(ray.direction, sky_.sun) * place.haze;
  Vec3f onward = mattDirection(place.normal, numbers.pair(index, kFirst + kOnward));
  if (const float below = dot(onward, place.flat); below < 0)
    onward = onward - place.flat * (2 * below);  // a bump's far side
  out.sky = comingFrom(from(place, onward, ray.time), numbers, index, 1);
  return out;
}

// Takes the samples of a pixel from the one to before the other.
void PixelTracer::add(Gathered& pixel, int x, int y, int from, int to) {
  const Sampler numbers(x, y, firstSamples(settings_), settings_.samples * kBlurredTimes);
  lastPart_ = -1;
  for (int index = from; index < to; index++) {
    const Sample one = sample(numbers, index, x, y);
    if (index == 0) pixel.first = one.face;
    const Face &face = one.face, &first = pixel.first;
    pixel.edge = pixel.edge || face.part != first.part || (face.part >= 0 && dot(face.normal, first.normal) < 0.999f);
    pixel.shade = pixel.shade || face.sunlit != first.sunlit;
    pixel.blurred = pixel.blurred || face.blurred;
    pixel.samples++;
    pixel.direct += one.direct;
    pixel.normal += one.normal;
    pixel.depth += one.depth;
    if (!one.covered) continue;
    pixel.covered++;
    pixel.colour += one.colour;
    pixel.sky += one.sky;
    const float b = brightness(one.sky);
    pixel.light += b;
    pixel.squares += b * b;
  }
}

Texel texelOf(const Gathered& pixel) {
  Texel texel;
  const float share = 1 / float(pixel.samples);
  texel.direct = pixel.direct * share;
  texel.normal = pixel.normal * share;
  texel.depth = pixel.depth * share;
  texel.covered = float(pixel.covered) * share;
  if (pixel.covered == 0) return texel;
  // Colour keeps the share of the pixel that it covers; light is that of what is covered.
  const float ofCovered = 1 / float(pixel.covered), mean = pixel.light * ofCovered;
  texel.colour = pixel.colour * share;
  texel.sky = pixel.sky * ofCovered;
  texel.variance =
      pixel.covered > 1 ? std::max(pixel.squares * ofCovered - mean * mean, 0.0f) / float(pixel.covered - 1) : 1.0f;
  return texel;
}

// A picture is made twice over: first every pixel takes half of its samples, then those take more that need them.
class PictureTracer {
 public:
  PictureTracer(const Stage& stage, const CameraRays& rays, const Sky& sky, int width, int height,
                const TraceSettings& settings)
      : stage_(stage),
        rays_(rays),
        sky_(sky),
        settings_(settings),
        width_(width),
        height_(height),
        half_(firstSamples(settings)),
        movingShade_(stage, sky, rays.moves()),
        pixels_(std::size_t(width) * std::size_t(height)),
        notes_(pixels_.size()) {}

  Picture run() {
    forPixels([&](PixelTracer& tracer, int x, int y) {
      Gathered& pixel = pixels_[index(x, y)];
      tracer.add(pixel, x, y, 0, half_);
      notes_[index(x, y)] = {pixel.first.part, pixel.first.sunlit, pixel.shade, pixel.blurred};
    });
    Picture picture{width_, height_, std::vector<Texel>(pixels_.size())};
    forPixels([&](PixelTracer& tracer, int x, int y) {
      Gathered& pixel = pixels_[index(x, y)];
      tracer.add(pixel, x, y, half_, wanted(pixel, x, y));
      if (pixel.samples > 0) picture.at(x, y) = texelOf(pixel);
    });
    return picture;
  }

 private:
  struct Note {  // what neighbours ask of a pixel
    int part = -1;
    bool sunlit = false, shade = false, blurred = false;
  };
  std::size_t index(int x, int y) const { return std::size_t(y) * std::size_t(width_) + std::size_t(x); }

  // Whether a shadow that falls where a pixel looks may move.
  bool shadeMoves(const Gathered& pixel, int x, int y) const {
    if (!movingShade_.anyMotion() || pixel.first.part < 0) return movingShade_.anyMotion();
    const Ray ray = rays_.through(float(x) + 0.5f, float(y) + 0.5f, 0.5f);
    const float depth = pixel.first.depth;
    return movingShade_.reaches(ray.origin + ray.direction * depth, depth * rays_.pixelAngle());
  }

  // Half will do where a pixel and those around it see one face at rest, equally lit. Where something moves, or the edge of a shadow
  // may move, it takes many, or the eye sees grains.
  int wanted(const Gathered& pixel, int x, int y) const {
    bool edge = pixel.edge, shade = pixel.shade, blurred = pixel.blurred;
    for (int j = std::max(y - 1, 0); j <= std::min(y + 1, height_ - 1); j++)
      for (int i = std::max(x - 1, 0); i <= std::min(x + 1, width_ - 1); i++) {
        const Note& note = notes_[index(i, j)];
        edge = edge || note.part != pixel.first.part;
        shade = shade || note.shade || (note.part == pixel.first.part && note.sunlit != pixel.first.sunlit);
        blurred = blurred || note.blurred;
      }
    if (blurred || (shade && shadeMoves(pixel, x, y))) return settings_.samples * kBlurredTimes;
    return shade ? settings_.samples * kShadeTimes : edge ? settings_.samples : half_;
  }

  // In squares of pixels, so that rays near each other follow each other.
  template <class Work> void forPixels(const Work& work) {
    constexpr int kTile = 16;
    const int columns = (width_ + kTile - 1) / kTile, tiles = columns * ((height_ + kTile - 1) / kTile);
    forRows(tiles, settings_.threads, [&](int tile) {
      if (settings_.stop && settings_.stop()) return;
      PixelTracer tracer(stage_, rays_, sky_, settings_, movingShade_.anyMotion());
      const int left = tile % columns * kTile, top = tile / columns * kTile;
      for (int y = top; y < std::min(top + kTile, height_); y++)
        for (int x = left; x < std::min(left + kTile, width_); x++) work(tracer, x, y);
    });
  }

  const Stage& stage_;
  const CameraRays& rays_;
  const Sky& sky_;
  const TraceSettings& settings_;
  int width_, height_, half_;
  MovingShade movingShade_;
  std::vector<Gathered> pixels_;
  std::vector<Note> notes_;
};

}  // namespace

Picture trace(const Stage& stage, const CameraRays& rays, const Sky& sky, int width, int height,
              const TraceSettings& settings) {
  return PictureTracer(stage, rays, sky, width, height, settings).run();
}

}  // namespace brickfall::render
