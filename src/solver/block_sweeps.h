// Sweeps over a matrix of blocks (block_rows.h), in whatever lanes the machine has: the same bits in all.
#pragma once
#include <cstdint>

#include "solver/solve_body.h"

namespace brickfall {

// Force and torque that answer each of six unit motions.
struct Block6 {
  Wrench of[6];
};

// A matrix as its sweeps read it. Of row i the earlier neighbours are list[begin[i]] .. list[begin[i + 1] - 1], with
// their blocks at the same places.
struct BlockView {
  std::uint32_t rows = 0;
  const std::uint32_t *begin = nullptr, *list = nullptr;
  const Block6 *blocks = nullptr, *inverses = nullptr;  // inverses: of the diagonal, by row
};

// Functions in lanes of one kind. By row: `right`, `x` and the last one.
struct SweepFunctions {
  // Gauss-Seidel from x = 0, first row to last. Takes what later rows change off `left`, which is 0.
  void (*forwards)(const BlockView&, const Wrench* right, Wrench* x, Wrench* left) = nullptr;
  // The same from the x given, last row to first. Takes what later rows do off `right`.
  void (*backwards)(const BlockView&, Wrench* right, Wrench* x) = nullptr;
  // Matrix x, where `backwards` made x of `from`: each row was settled against earlier ones of `from`.
  void (*multiply)(const BlockView&, const Wrench* right, const Wrench* from, const Wrench* x, Wrench* out) = nullptr;
  // Inverses of symmetric blocks. False if one is not positive definite.
  bool (*invert)(const Block6* blocks, std::uint32_t count, Block6* out) = nullptr;
};
SweepFunctions sweepsInHalves();
SweepFunctions sweepsInEight();  // for machines with AVX2; none where the compiler cannot
const SweepFunctions& sweeps();  // one of the two

}  // namespace brickfall
