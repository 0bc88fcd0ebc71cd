#include "appearance/light.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace brickfall::appearance {
namespace {

// As much of the shaders' language as light.glsl needs.
namespace shader {

using std::exp, std::abs, std::max, std::min;

struct vec2 {
  float x, y;
  constexpr vec2(float x_, float y_) : x(x_), y(y_) {}
};
struct vec3 {
  float x, y, z;
  constexpr vec3(float x_, float y_, float z_) : x(x_), y(y_), z(z_) {}
  constexpr vec3(Vec3f v) : x(v.x), y(v.y), z(v.z) {}
  constexpr operator Vec3f() const { return {x, y, z}; }
};
constexpr vec3 operator+(vec3 a, vec3 b) { return {a.x + b.x, a.y + b.y, a.z + b.z}; }
constexpr vec3 operator*(vec3 a, float s) { return {a.x * s, a.y * s, a.z * s}; }
constexpr float dot(vec3 a, vec3 b) { return a.x * b.x + a.y * b.y + a.z * b.z; }
constexpr vec3 max(vec3 a, vec3 b) { return {max(a.x, b.x), max(a.y, b.y), max(a.z, b.z)}; }
constexpr vec3 mix(vec3 a, vec3 b, float share) { return a * (1 - share) + b * share; }
vec3 normalize(vec3 a) { return a * (1 / std::sqrt(dot(a, a))); }
float clamp(float v, float low, float high) { return std::clamp(v, low, high); }
float fract(float v) { return v - std::floor(v); }
float smoothstep(float from, float to, float v) { return ramp(from, to, v); }

#include "appearance/light.glsl"

}  // namespace shader
}  // namespace

Rgb sunLight() { return shader::kSunLight; }

Vec3f sunOver(Vec3f back) {
  const Vec3f level = normalized(Vec3f{back.x, 0, back.z});
  return shader::sunFrom(level == Vec3f{} ? Vec3f{0, 0, 1} : level);
}

Vec3f sunDirection(double azimuthDegrees, double elevationDegrees) {
  const double azimuth = azimuthDegrees * std::numbers::pi / 180, elevation = elevationDegrees * std::numbers::pi / 180;
  return {float(std::cos(elevation) * std::sin(azimuth)), float(std::sin(elevation)),
          float(std::cos(elevation) * std::cos(azimuth))};
}

Rgb skyLight(Vec3f towards, Vec3f sun) { return shader::skyLight(towards, sun); }
Rgb ambientLight(Vec3f normal, Vec3f sun) { return shader::ambientLight(normal, sun); }
float hazeShare(float away) { return shader::hazeShare(away); }
Rgb hazeLight(Vec3f towards, Vec3f sun) { return shader::hazeLight(towards, sun); }
float floorShade(Vec3f place, Vec3f width) { return shader::floorShade({place.x, place.z}, {width.x, width.z}); }
float edgeShade(float toEdge, float pixel) { return shader::edgeShade(toEdge, pixel); }
Rgb toneMapped(Rgb light, float exposure) { return shader::toneMapped(light * exposure); }
float usualExposure() { return shader::kExposure; }
Rgb shownAs(Rgb light) { return shader::shownAs(light); }

}  // namespace brickfall::appearance
