#include "appearance/look.h"

#include <algorithm>
#include <cctype>
#include <initializer_list>
#include <string>

#include "appearance/noise.h"

namespace brickfall::appearance {
namespace {

struct KindWords {
  Kind kind;
  std::initializer_list<std::string_view> words;
};

// The first that a name contains.
const KindWords kWords[] = {
    {Kind::brick, {"brick", "clay", "terracotta", "tile"}},
    {Kind::concrete, {"concrete", "mortar", "cement", "plaster"}},
    {Kind::stone, {"stone", "granite", "marble", "slate", "rock", "basalt"}},
    {Kind::wood, {"wood", "oak", "pine", "timber", "plank"}},
    {Kind::steel, {"steel", "iron", "metal", "lead", "copper", "brass", "chrome"}},
    {Kind::rubber, {"rubber", "tyre"}},
    {Kind::ground, {"earth", "soil", "grass", "sand", "gravel", "ground"}},
};

struct KindValues {
  float roughness, metalness, relief;
};
// Of a part that is of another stuff than its body, of which alone the colour is known.
constexpr std::uint32_t kUsualColour[kKindCount] = {0xB5543A, 0xA9A69F, 0x8F8D86, 0x9A7048,
                                                    0x6F747A, 0x2B2B2D, 0x7D7A6C, 0xA0A0A0};

constexpr KindValues kValues[kKindCount] = {
    {0.85f, 0, 0.0006f},  // brick
    {0.80f, 0, 0.0005f},  // concrete
    {0.75f, 0, 0.0010f},  // stone
    {0.60f, 0, 0.0003f},  // wood
    {0.24f, 1, 0},        // steel
    {0.55f, 0, 0.0002f},  // rubber
    {0.95f, 0, 0.0012f},  // ground
    {0.60f, 0, 0.0001f},  // plain
};

// As fired clay differs: mostly in lightness, a little in hue (towards yellow or blue-red); one in nine burnt darker.
Rgb firedColour(Rgb colour, std::uint32_t body) {
  const float grey = brightness(colour);
  colour = mix(colour, Rgb{grey, grey, grey}, 0.2f);  // dust and weather
  const float light = 1 + 0.20f * (chance(body, 1) + chance(body, 2) - 1);
  const float hue = 0.10f * (chance(body, 3) - 0.5f);
  Rgb out{colour.x * light, colour.y * light * (1 + 1.6f * hue), colour.z * light * (1 - hue)};
  if (chance(body, 4) < 0.11f) out = scaled(out, Rgb{0.60f, 0.60f, 0.70f});
  return out;
}

Rgb variedColour(Kind kind, Rgb colour, std::uint32_t body) {
  if (kind == Kind::brick) return firedColour(colour, body);
  const float spread = kind == Kind::wood ? 0.22f : kind == Kind::stone ? 0.2f : kind == Kind::concrete ? 0.1f : 0;
  return colour * (1 + spread * (chance(body, 1) - 0.5f));
}

// The colour of screed, so that a ground of "brick" is no red plain. Trodden ground is darker than its stuff freshly cast.
Rgb groundColour(Rgb colour, bool ofClay) { return (ofClay ? linearFromHex(0xA9A69F) : colour) * 0.72f; }

}  // namespace

Kind kindOf(std::string_view material, BodyRole role) {
  if (role == BodyRole::ground) return Kind::ground;
  std::string name(material);
  std::transform(name.begin(), name.end(), name.begin(), [](unsigned char c) { return char(std::tolower(c)); });
  for (const KindWords& row : kWords)
    for (std::string_view word : row.words)
      if (name.find(word) != std::string::npos) return row.kind;
  if (role == BodyRole::brick) return Kind::brick;
  return role == BodyRole::ball && name.empty() ? Kind::steel : Kind::plain;
}

Look lookOf(const LookQuery& query) {
  Look look;
  look.kind = kindOf(query.material, query.role);
  const Rgb colour = linearFromHex(query.colour);
  look.colour = look.kind == Kind::ground ? groundColour(colour, kindOf(query.material, BodyRole::body) == Kind::brick)
                                          : variedColour(look.kind, colour, query.bodyNumber);
  const KindValues& values = kValues[int(look.kind)];
  look.roughness = values.roughness;
  look.metalness = values.metalness;
  look.relief = values.relief;
  look.seed = hashOf(query.bodyNumber + 1000003ull);
  return look;
}

Look lookOf(const TakeBody& body, std::size_t shape, std::uint32_t bodyNumber) {
  const std::string& material = shape < body.shapeMaterials.size() ? body.shapeMaterials[shape] : body.material;
  const bool own = material == body.material || body.material.empty();
  return lookOf({material, body.role, own ? body.colour : kUsualColour[int(kindOf(material, body.role))], bodyNumber});
}

}  // namespace brickfall::appearance
