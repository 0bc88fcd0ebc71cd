// How the solve of an island ended in a step.
#pragma once
#include <array>
#include <cstdint>
#include <string_view>

namespace brickfall {

enum class IslandEnding : std::uint8_t {
  unsolved,    // made, woken or salvaged since the last solve
  unbalanced,  // its cycles and steps are used up, some residual is left
  balanced,    // every residual under the tolerance of its plan
  rested,      // balanced without any motion (rest check): stays where it is
  inPlace,     // slow, and no point of it strayed for a while: stopped where it is
  settled,     // rested, and no force changed by more than rounding: passed over until something disturbs it
  count
};
constexpr int kIslandEndingCount = int(IslandEnding::count);
constexpr std::array<std::string_view, kIslandEndingCount> kIslandEndingNames = {"unsolved", "unbalanced", "balanced",
                                                                                 "rested",   "in place",   "settled"};

}  // namespace brickfall
