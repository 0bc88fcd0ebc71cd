// Checks of oriented boxes.
#include "brickfall/geometry/obb.h"

#include <string>
#include <type_traits>

namespace brickfall {

namespace {

// How far axes may be from unit, orthogonal and right-handed: well above what normalising leaves, well below what would
// change an answer visibly.
template <class T> constexpr T kAxisTolerance = std::is_same_v<T, float> ? T(1e-4) : T(1e-6);

Error invalid(const char* name, const char* field, const std::string& found, const char* expected) {
  return {ErrorCode::invalidArgument, std::string(name) + "." + field + ": found " + found + ", expected " + expected};
}

template <class T> std::string text(Vec3T<T> v) {
  return "(" + std::to_string(v.x) + ", " + std::to_string(v.y) + ", " + std::to_string(v.z) + ")";
}

}  // namespace

template <class T> Status checkObb(const ObbT<T>& box, const char* name) {
  if (!isFinite(box.centre)) return invalid(name, "centre", text(box.centre), "finite numbers");
  Vec3T<T> half = box.halfExtents;
  if (!isFinite(half) || !(half.x >= 0 && half.y >= 0 && half.z >= 0)) {
    return invalid(name, "halfExtents", text(half), "finite numbers, none negative");
  }
  const T tolerance = kAxisTolerance<T>;
  const Mat3T<T>& m = box.axes;
  for (int i = 0; i < 3; i++) {
    if (!(std::fabs(lengthSquared(m.row[i]) - 1) <= 2 * tolerance)) {
      return invalid(name, "axes", text(m.row[i]) + " in row " + std::to_string(i), "a unit vector");
    }
    if (!(std::fabs(dot(m.row[i], m.row[(i + 1) % 3])) <= tolerance)) {
      return invalid(name, "axes", "rows that are not at right angles", "orthogonal axes");
    }
  }
  if (!(determinant(m) > 0)) return invalid(name, "axes", "left-handed axes", "axes[0] x axes[1] = axes[2]");
  return {};
}

template Status checkObb(const ObbT<float>&, const char*);
template Status checkObb(const ObbT<double>&, const char*);

}  // namespace brickfall
