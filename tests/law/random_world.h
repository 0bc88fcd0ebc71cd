// Worlds drawn at random, for laws that hold in all of them: one to six bodies of any shape (half of them cylinders and cones
// where these are asked for, else none), 1 mm to 30 m, thrown at each other or
// at something that does not give way, at any speed, spin, time step, restitution and friction.
#pragma once
#include <optional>
#include <string>
#include <vector>

#include "law/draw.h"

namespace brickfall::law {

// What the bodies of a random world are thrown at.
enum class RandomKind { space, plate, wall, ground, belt, terrain };
constexpr int kRandomKinds = 6;
const char* nameOf(RandomKind kind);

struct RandomWorld : DrawnWorld {
  std::vector<double> sizes;     // m: inner radius of each body
  std::optional<BodyId> target;  // what they are thrown at; none in space
  Vec3 halfExtents;              // m, of a target that is a box or hills
  Vec3 drive;                    // m/s, of a belt
  bool hilly = false;            // the target: its upper side goes up and down by halfExtents.y
};
RandomWorld drawWorld(RandomKind kind, int seed, bool turned = false);

struct RandomOutcome {
  double gain = 0;     // highest energy / that of the start - 1, in the frame of what is driven
  double linear = 0;   // change of linear momentum / the largest momentum of a body; in space
  double angular = 0;  // likewise, angular; of the momenta about the centre of mass of all
  int through = 0;     // bodies whose centre passed the middle of the target
  double deep = 0;     // deepest overlap at the end / what is allowed: 5 mm or a twentieth of the size
  bool finite = true;
};
// Runs the world to its end.
RandomOutcome runWorld(RandomWorld& random);
// Runs it, and expects that nothing gains energy, goes through, is lost or is left deep in anything; in space, that momenta
// stay.
void expectNothingFromNothing(RandomKind kind, int seed);

}  // namespace brickfall::law
