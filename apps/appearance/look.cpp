#include "appearance/look.h"

#include <algorithm>
#include <cctype>
#include <string>

#include "appearance/noise.h"

namespace brickfall::appearance {
namespace {

struct KindRow {
  std::uint32_t usualColour;
  float roughness, metalness, relief, spread;
  std::string_view words;
};
constexpr KindRow kKinds[kKindCount] = {
#define KIND(name, colour, roughness, metalness, relief, spread, words) \
  {colour, float(roughness), float(metalness), float(relief), float(spread), words},
#define NUMBER(name, value)
#include "appearance/kinds.inc"
#undef KIND
#undef NUMBER
};
#define KIND(...)
#define NUMBER(name, value) constexpr float k##name = float(value);
#include "appearance/kinds.inc"
#undef KIND
#undef NUMBER

Rgb firedColour(Rgb colour, std::uint32_t body) {
  const float grey = brightness(colour);
  colour = mix(colour, Rgb{grey, grey, grey}, kBrickDust);
  const float light = 1 + kBrickLightness * (chance(body, 1) + chance(body, 2) - 1);
  const float hue = kBrickHue * (chance(body, 3) - 0.5f);
  Rgb out{colour.x * light, colour.y * light * (1 + 1.6f * hue), colour.z * light * (1 - hue)};
  if (chance(body, 4) < kBurntShare) out = scaled(out, Rgb{kBurntLightness, kBurntLightness, kBurntBlue});
  return out;
}

Rgb variedColour(Kind kind, Rgb colour, std::uint32_t body) {
  if (kind == Kind::brick) return firedColour(colour, body);
  return colour * (1 + kKinds[int(kind)].spread * (chance(body, 1) - 0.5f));
}

// The colour of screed, so that a ground of "brick" is no red plain.
Rgb groundColour(Rgb colour, bool ofClay) {
  return (ofClay ? linearFromHex(kKinds[int(Kind::concrete)].usualColour) : colour) * kGroundLightness;
}

}  // namespace

Kind kindOf(std::string_view material, BodyRole role) {
  if (role == BodyRole::ground) return Kind::ground;
  std::string name(material);
  std::transform(name.begin(), name.end(), name.begin(), [](unsigned char c) { return char(std::tolower(c)); });
  for (int kind = 0; kind < kKindCount; kind++)
    for (std::string_view left = kKinds[kind].words; !left.empty();) {
      const std::size_t end = std::min(left.find(' '), left.size());
      if (name.find(left.substr(0, end)) != std::string::npos) return Kind(kind);
      left.remove_prefix(std::min(end + 1, left.size()));
    }
  if (role == BodyRole::brick) return Kind::brick;
  return role == BodyRole::ball && name.empty() ? Kind::steel : Kind::plain;
}

Look lookOf(const LookQuery& query) {
  Look look;
  look.kind = kindOf(query.material, query.role);
  const Rgb colour = linearFromHex(query.colour);
  look.colour = look.kind == Kind::ground ? groundColour(colour, kindOf(query.material, BodyRole::body) == Kind::brick)
                                          : variedColour(look.kind, colour, query.bodyNumber);
  const KindRow& values = kKinds[int(look.kind)];
  look.roughness = values.roughness;
  look.metalness = values.metalness;
  look.relief = values.relief;
  look.seed = hashOf(query.bodyNumber + 1000003ull);
  return look;
}

Look lookOf(const TakeBody& body, std::size_t shape, std::uint32_t bodyNumber) {
  const std::string& material = shape < body.shapeMaterials.size() ? body.shapeMaterials[shape] : body.material;
  const bool own = material == body.material || body.material.empty();
  const std::uint32_t colour = shape < body.shapeColours.size() ? body.shapeColours[shape]
                               : own                            ? body.colour
                                                                : kKinds[int(kindOf(material, body.role))].usualColour;
  return lookOf({material, body.role, colour, body.look.value_or(bodyNumber)});
}

}  // namespace brickfall::appearance
