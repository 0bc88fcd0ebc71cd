// One seed for a scene, different random numbers for each of its named parts.
#pragma once
#include <cstdint>
#include <string_view>

namespace brickfall::masonry {

// FNV-1a of the name, started from the seed.
inline std::uint64_t namedSeed(std::uint64_t seed, std::string_view name) {
  std::uint64_t hash = 1469598103934665603ull ^ seed;
  for (char c : name) hash = (hash ^ std::uint8_t(c)) * 1099511628211ull;
  return hash;
}

}  // namespace brickfall::masonry
