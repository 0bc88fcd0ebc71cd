// One shot: something small thrown at something that it must not pass through.
#pragma once
#include <string>
#include <vector>

#include "brickfall/brickfall.h"
#include "math/random.h"

namespace brickfall::oracle {

enum class Target { plate, twoPlates, fixedWall, movingPlate, loosePlate, thrownPlate, brickWall };
enum class Missile { ball, brick, capsule, hull };
enum class Aim { straight, oblique, grazing, edgeOn, corner };
constexpr int kTargets = 7, kMissiles = 4, kAims = 5;
const char* nameOf(Target target);
const char* nameOf(Missile missile);
const char* nameOf(Aim aim);

struct Shot {
  Target target = Target::plate;
  Missile missile = Missile::ball;
  Aim aim = Aim::straight;
  double thickness = 0.02;  // m, of plates; walls are one brick wide
  double speed = 10;        // m/s
  double spin = 0;          // rad/s
  double dt = 1.0 / 60;     // s
  std::uint64_t seed = 0;   // of everything else: size, place, direction, density
};
Shot randomShot(std::uint64_t seed);
std::string describe(const Shot& shot);

struct Flight {
  bool fired = false;                        // false: drawn so that it starts inside the target
  bool hit = false;                          // touched something
  bool through = false;                      // its centre passed from one side of an obstacle to the other, through it
  bool within = false;                       // its centre is inside an obstacle at the end, and half a second after
  bool wedged = false;                       // it is inside at the end, and was pushed out again in that time
  double overlap = 0;                        // m: deepest at the end, as the exact query has it
  double missileSize = 0, obstacleSize = 0;  // inner radii, m
  int steps = 0;
};
Flight fly(const Shot& shot);

}  // namespace brickfall::oracle
