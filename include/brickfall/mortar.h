// Mortar: glues a face of one body to a face of another. It holds them against pull, shear and bending up to its
// strength, cracks by what the cracking costs, and broken it is gone: what it glued then touches as any two bodies do.
#pragma once
#include <cstdint>
#include <limits>
#include <optional>
#include <vector>

#include "brickfall/ids.h"
#include "brickfall/math.h"

namespace brickfall {

// What mortar withstands, by area of its face. The defaults are a common cement mortar between clay bricks.
struct MortarStrength {
  double tension = 0.25e6;       // Pa, 1 .. 1e9: flexural bond strength, at the edge of the face
  double cohesion = 0.35e6;      // Pa, 1 .. 1e9: shear strength without pressure; more than tension x friction
  double friction = 0.75;        // 0 .. 10: what pressure adds to it
  double tensionEnergy = 18;     // J/m2, 1e-6 .. 1e6: that opening the face takes
  double shearEnergy = 125;      // J/m2, 1e-6 .. 1e6: that shearing it off takes
  double compression = 10e6;     // Pa, 1 .. 1e10: crushing strength, at the edge of the face
  double crushingEnergy = 16e3;  // J/m2, 1e-6 .. 1e9: that crushing the face takes
  double stiffness = 62e9;       // N/m3, 1e6 .. 1e13: of the mortar with what gives in the two bodies
};

// What a mortar joint is made from. Places are those of the world at the moment in which it is made; the mortar then
// keeps them in the frames of its bodies, and holds these as they are.
struct MortarDef {
  // Two different bodies, at least one of them dynamic. Their shapes do not collide with each other while it holds.
  BodyId bodyA, bodyB;
  // m, world: the glued face, 3 .. 16 corners of a convex polygon in one plane, anticlockwise as seen from B.
  // World::sharedFace finds it for bodies that touch.
  std::vector<Vec3> outline;
  MortarStrength strength;
  std::uint64_t userData = 0;  // yours; never read
};

// How a face broke: pulled open, sheared off, or crushed.
enum class MortarMode : std::uint8_t { none, tension, shear, crushing };

// A mortar joint as the last step left it.
struct MortarState {
  BodyId bodyA, bodyB;
  Vec3 centre;             // m, world: of the face, on A
  Vec3 normal;             // unit, world: from A to B
  double area = 0;         // m2
  Vec3 along1, along2;     // m, world: half edges of the rectangle that bends as the face does
  Vec3 force;              // N, from A on B: in the last part of the last step
  Vec3 torque;             // N m, from A on B, about the face's centre
  double tension = 0;      // Pa, largest pull at the edge of the face; below 0: all of it is pressed
  double shear = 0;        // Pa, largest
  double utilisation = 0;  // 0 .. 1: of what the face as it is withstands
  double damage = 0;       // 0 .. 1: share of the energy that breaks it which is spent
  double tensionWork = 0, shearWork = 0, crushingWork = 0;  // J, spent so far
  MortarMode mode = MortarMode::none;                       // that took more of it
  bool broken = false;
  bool awake = true;  // a body of it is
  std::uint64_t userData = 0;
};

// A tie of one of a joint's bodies that bears more since the joint opened.
struct LoadTaker {
  MortarId mortar;      // null: contacts of the two bodies
  BodyId bodyA, bodyB;  // one of them is a body of the joint
  double before = 0,
         after = 0;  // N: in the step before it opened; the mean over a moment after it broke (.05 s of a brick)
};

// How a mortar joint opened. Kept with the joint from the step in which it cracks.
struct MortarPast {
  MortarId mortar;
  BodyId bodyA, bodyB;
  double crackTime = 0;  // s: the first of its energy was spent
  double openTime = 0;   // s: its last opening began (after a pause: docs/mortar.md)
  double breakTime = std::numeric_limits<double>::infinity();  // s; infinite: it holds
  MortarMode mode = MortarMode::none;                          // that took more of its energy
  double tensionShare = 0, shearShare = 0, crushingShare = 0;  // of the energy that breaks it, by mode
  Vec3 force;                                                  // N, from A on B, in the step before it opened
  bool settled = false;                                        // `takers` is complete
  std::vector<LoadTaker> takers;                               // up to 4, who gained most first; once it is broken
};

// Why a body fell, as far as mortar tells it. A body that fell with others fell for the same reason as they did.
struct FallStory {
  bool carried = false;  // it reaches something fixed (World::carried); what lies on the ground does, too
  // Of the joints that held the body up, or that held up what it hangs together with, or what carried these until then:
  // the first that broke. None: no such joint broke.
  std::optional<MortarPast> first;
  bool own = false;                // `first` is a joint of the body itself
  std::vector<MortarPast> opened;  // the body's own joints that broke, in the order of time
};

}  // namespace brickfall
