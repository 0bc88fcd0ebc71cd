// The vectors of tests/support/obb_vectors.json with everything they hold: boxes as axes, exactly as written, and the
// answers, found by methods that share nothing with separating axes. The tolerances are those of their own description.
#pragma once
#include <optional>
#include <string>
#include <vector>

#include "brickfall/geometry/obb_motion.h"

namespace brickfall::test {

struct ObbCase {
  int id = 0;
  std::string category;
  bool degenerate = false, float32Ok = false;
  ObbMotion motion;
  double maxTime = 0;

  double size = 0;
  bool overlap = false, touching = false, borderline = false, illConditioned = false;
  std::optional<int> separatingRow, penetrationRow, contactRow;
  std::vector<int> separatingRows, penetrationRows, contactRows, contactRowsNear;
  std::optional<double> gap, distance, depth, time, timeUnbounded;
  std::optional<Vec3> penetrationNormal, contactNormal;
  std::optional<Vec3> contactPoint;  // the unique one
  bool contactNotUnique = false;
  std::vector<Vec3> contactHull;

  // Length that an answer may be off by, at a relative error of `rel`.
  double tolerance(double rel) const;
};
std::vector<ObbCase> obbCases();

template <class T> Vec3T<T> as(Vec3 v) { return {T(v.x), T(v.y), T(v.z)}; }
template <class T> ObbT<T> as(const Obb& box) {
  return {as<T>(box.centre),
          {{as<T>(box.axes.row[0]), as<T>(box.axes.row[1]), as<T>(box.axes.row[2])}},
          as<T>(box.halfExtents)};
}
template <class T> ObbMotionT<T> as(const ObbMotion& m) {
  return {as<T>(m.a), as<T>(m.b), as<T>(m.velocityA), as<T>(m.velocityB), as<T>(m.spinA), as<T>(m.spinB)};
}
inline Vec3 exactly(Vec3T<double> v) { return v; }
inline Vec3 exactly(Vec3T<float> v) { return {v.x, v.y, v.z}; }

}  // namespace brickfall::test
