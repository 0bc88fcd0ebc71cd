#include "viewer_window/sun.h"

namespace brickfall::viewer {
namespace {

constexpr double kAside = 0.95, kElevation = 0.80;  // rad

}  // namespace

Vec3 towardsSun(Vec3 lookFrom) {
  const Vec3 level = normalized(Vec3{lookFrom.x, 0, lookFrom.z});
  const Vec3 from = level == Vec3{} ? Vec3{0, 0, 1} : level;
  double sine = 0, cosine = 0;
  sinCos(kElevation, sine, cosine);
  return rotate(quatFromAxisAngle({0, 1, 0}, -kAside), from) * cosine + Vec3{0, sine, 0};
}

}  // namespace brickfall::viewer
