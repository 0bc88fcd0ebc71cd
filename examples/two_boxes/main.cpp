// Two boxes: are they apart and which axis says so, how far, and when and where do they meet if one flies at the other.
#include <cstdio>

#include "brickfall/geometry/obb_motion.h"

using namespace brickfall;

int main() {
  ObbMotion motion;
  motion.a = makeObb(Transform{}, Vec3{1, 0.5, 0.5});
  motion.b = makeObb(Transform{{4, 0.3, 0.2}, quatFromAxisAngle(normalized(Vec3{1, 2, 3}), 0.8)}, Vec3{0.5, 0.5, 0.5});
  motion.velocityB = {-2, 0, 0};

  Result<ObbPairT<double>> pair = examine(motion.a, motion.b);
  Result<ObbImpact> impact = firstContact(motion, 10.0);
  if (!pair || !impact) {
    std::printf("%s\n", (pair ? impact.error() : pair.error()).message.c_str());
    return 1;
  }
  if (!pair->overlap) {
    std::printf("apart: test %d (%s) separates them; distance %.3f m\n", pair->firstSeparating + 1,
                obbRowName(pair->firstSeparating), pair->closest.distance);
  }
  if (impact->hit == ObbHit::contact) {
    const ObbContactSetT<double>& contact = impact->contact;
    std::printf("they meet after %.3f s; test %d (%s) was the last to separate them\n", impact->time, impact->row + 1,
                obbRowName(impact->row));
    std::printf("%s (%.3f, %.3f, %.3f), normal (%.3f, %.3f, %.3f)\n",
                contact.unique ? "at the point" : "in several points around", contact.point.x, contact.point.y,
                contact.point.z, contact.normal.x, contact.normal.y, contact.normal.z);
  }
}
