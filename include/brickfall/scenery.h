// What scenes and takes both speak of: the part that a body plays, and from where it is looked at.
#pragma once
#include <cstdint>
#include <string>
#include <vector>

#include "brickfall/math.h"

namespace brickfall {

enum class BodyRole : std::uint8_t { ground, brick, ball, body };
constexpr int kBodyRoleCount = 4;

// A pose that a camera passes through.
struct CameraKey {
  double time = 0;                 // s, simulated
  Vec3 position, target;           // m
  double fieldOfViewDegrees = 45;  // vertical
};

struct Camera {
  std::string name = "main";
  Vec3 position{3, 2, 5}, target{0, 0.5, 0};  // m
  double fieldOfViewDegrees = 45;             // vertical
  std::vector<CameraKey> path;                // where it is in a film, by time; empty: it stays where it is
  std::string follow;                         // a body's name: while it is there the camera turns after it; empty: none
};

// Where a camera stands that nobody has set. `side`: from the middle of the boxes to who throws something, or to the front. It looks at
// that middle from above and from a third of a right angle beside `side`, so near that the boxes fill seven tenths of the picture.
Camera fittedCamera(const std::vector<Aabb>& boxes, const Vec3& side);

// Of a path: nothing of it is wrong if this is empty. Times ascend, numbers are finite, it never stands on its target.
std::string cameraPathFault(const std::vector<CameraKey>& path);

// The camera at a moment of its path, without a path as it is. It starts and ends softly, stands still between two keys that are
// equal, and passes all others without a jerk (a cubic curve through them; beyond the ends it stands).
Camera cameraAt(const Camera& camera, double time);

}  // namespace brickfall
