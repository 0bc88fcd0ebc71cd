// What the checked calls about moving boxes have in common.
#pragma once
#include <string>

#include "brickfall/geometry/obb_motion.h"

namespace brickfall {

inline Error badNumber(const char* field, double found, const char* expected) {
  return {ErrorCode::invalidArgument,
          std::string(field) + ": found " + std::to_string(found) + ", expected " + expected};
}

template <class T> Status checkMotion(const ObbMotionT<T>& motion) {
  if (Status good = checkObb(motion.a, "a"); !good) return good;
  if (Status good = checkObb(motion.b, "b"); !good) return good;
  const Vec3T<T> vectors[] = {motion.velocityA, motion.velocityB, motion.spinA, motion.spinB};
  const char* names[] = {"velocityA", "velocityB", "spinA", "spinB"};
  for (int k = 0; k < 4; k++) {
    if (!isFinite(vectors[k])) {
      return Error{ErrorCode::invalidArgument, std::string(names[k]) +
                                                   ": found a component that is not finite, expected "
                                                   "finite numbers"};
    }
  }
  return {};
}

}  // namespace brickfall
