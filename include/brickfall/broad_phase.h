// How a world finds out which shapes may touch.
#pragma once
#include <cstdint>
#include <string_view>

namespace brickfall {

// All give the same pairs, so the same motion, bit for bit; they differ in time only (docs/broad-phases.md).
enum class BroadPhaseMethod : std::uint8_t {
  tree,             // of boxes, kept in balance: n log n, and what rests costs nothing
  sweepAndPrune,    // boxes sorted along one axis: good where they lie in a row, slow where they are stacked across it
  boundingSpheres,  // every moved body against every other: spheres first, as in the report; n^2
  allPairs,         // every moved body against every other; n^2
};
constexpr int kBroadPhaseMethodCount = 4;
// "tree", "sweep_and_prune", "bounding_spheres", "all_pairs"
std::string_view broadPhaseName(BroadPhaseMethod method);

}  // namespace brickfall
