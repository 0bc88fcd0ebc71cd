// The 203 pairs of boxes in obb_vectors.json: poses, and answers found by methods that share nothing with separating axes
// (vertex enumeration, linear programs, Qhull). About a third of them are degenerate.
#pragma once
#include <optional>
#include <string>
#include <vector>

#include "brickfall/math.h"

namespace brickfall::test {

struct ObbVector {
  int id = 0;
  std::string category;
  bool degenerate = false, borderline = false, float32Ok = false;
  Vec3 halfA, halfB;
  Transform poseA, poseB;
  Vec3 relativeVelocity;  // of B seen from A
  double maxTime = 0;
  double size = 0;       // |halfA| + |halfB|
  double tolerance = 0;  // m, of a double-precision answer
  bool overlap = false, touching = false;
  std::optional<double> distance, penetration, timeOfImpact;
  std::optional<Vec3> penetrationNormal;  // from A to B
};
std::vector<ObbVector> obbVectors();

}  // namespace brickfall::test
