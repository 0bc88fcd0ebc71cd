#include "dynamics/axis_locks.h"

namespace brickfall {

// The inertia with its locked rows and columns in the place of those of the unit matrix: its inverse has them as they are.
Mat3 lockedInverse(const Mat3& inertia, std::uint8_t locks) {
  const unsigned turns = locks >> 3;
  Mat3 m = inertia;
  for (int i = 0; i < 3; i++)
    for (int j = 0; j < 3; j++)
      if (turns >> i & 1 || turns >> j & 1) m.row[i][j] = i == j ? 1 : 0;
  m = inverse(m);
  for (int i = 0; i < 3; i++)
    if (turns >> i & 1) m.row[i][i] = 0;
  return m;
}

}  // namespace brickfall
