// Where to point so that a shot flies through a point.
#include <cmath>

#include "brickfall/machines.h"
#include "machines/faults.h"

namespace brickfall {

// With t the time of flight, target - from = v t + g t^2 / 2, and |v| = speed: a square equation in t^2.
Result<Vec3> aim(Vec3 from, Vec3 target, double speed, Vec3 gravity, bool flat) {
  machines::Fields check;
  check.range("speed", speed, 0, machines::kFastest);
  const Vec3 way = target - from;
  const double distance = length(way), pull = length(gravity);
  check.condition(distance > 1e-9 && distance <= machines::kFarthest, "target", std::to_string(distance) + " m away",
                  "a target some way off");
  check.condition(pull <= machines::kStrongest, "gravity", std::to_string(pull),
                  "at most " + std::to_string(machines::kStrongest) + " m/s2");
  if (!check.status()) return check.status().error();
  const double along = dot(way, gravity), half = speed * speed + along;
  const double root2 = half * half - pull * pull * distance * distance;
  // The least speed is the slow way up and down; straight down or without gravity any will do.
  const double least = std::sqrt(std::fmax(0.0, pull * distance - along));
  if (!(half > 0 && root2 >= 0 && speed > 0))
    return machines::refused("speed", std::to_string(speed) + " m/s",
                             "at least " + std::to_string(least) + " m/s to get there");
  const double root = std::sqrt(root2);
  // Of the two t^2 = 2 (half -+ root) / g^2 the smaller, written so that it holds without gravity.
  if (!flat && !(pull > 0)) return machines::refused("gravity", "0", "gravity for a high shot");
  const double t2 = flat ? 2 * distance * distance / (half + root) : 2 * (half + root) / (pull * pull);
  const double t = std::sqrt(t2);
  return way * (1 / t) - gravity * (t / 2);
}

}  // namespace brickfall
