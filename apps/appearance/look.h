// What a body looks like as a whole: which kind of stuff, in which colour (bricks differ from one to the next, as fired clay does),
// how rough, whether metal. surface.h says how that varies over its surface.
#pragma once
#include <cstdint>
#include <string_view>

#include "appearance/colour.h"
#include "brickfall/take.h"

namespace brickfall::appearance {

enum class Kind : std::uint8_t { brick, concrete, stone, wood, steel, rubber, ground, plain };
constexpr int kKindCount = int(Kind::plain) + 1;

struct Look {
  Kind kind = Kind::plain;
  Rgb colour;              // mean over the surface
  float roughness = 1;     // 0 a mirror .. 1 chalk
  float metalness = 0;     // 1: reflects in its colour and nothing else
  float relief = 0;        // m, height of its bumps
  std::uint32_t seed = 0;  // of its own pattern
};

// From the name of a material (also a part of it: "old brick"); where it says nothing, from the role. Ground is ground, whatever
// its material is called: scenes name one for its friction.
Kind kindOf(std::string_view material, BodyRole role);

struct LookQuery {
  std::string_view material;  // may be empty
  BodyRole role = BodyRole::body;
  std::uint32_t colour = 0;      // 0xRRGGBB
  std::uint32_t bodyNumber = 0;  // the same number looks the same in every frame and every program
};
Look lookOf(const LookQuery& query);
Look lookOf(const TakeBody& body, std::size_t shape, std::uint32_t bodyNumber);

}  // namespace brickfall::appearance
