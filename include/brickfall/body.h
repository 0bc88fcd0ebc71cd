// What a body is made from, and what can be read from it.
#pragma once
#include <cstdint>
#include <optional>
#include <vector>

#include "brickfall/ids.h"
#include "brickfall/math.h"
#include "brickfall/shapes.h"

namespace brickfall {

// fixed: never moves. kinematic: moves with the velocity it is given, whatever it hits. dynamic: moves by forces.
enum class BodyType : std::uint8_t { fixed, kinematic, dynamic };

// Ways of the centre of mass along the world's axes, and turns about them, that a dynamic body may not make: whatever hits it,
// it keeps these coordinates to the last bit, as if it were on rails. Who pushes against a lock pushes against the world.
// Fixed and kinematic bodies do not read it. A puppet of a plane game: AxisLocks::plane(); who never falls over: noTurns().
struct AxisLocks {
  bool wayX = false, wayY = false, wayZ = false;
  bool turnX = false, turnY = false, turnZ = false;
  bool operator==(const AxisLocks&) const = default;
  // It moves in the plane of x and y, and turns about z.
  static AxisLocks plane() {
    AxisLocks locks;
    locks.wayZ = locks.turnX = locks.turnY = true;
    return locks;
  }
  static AxisLocks noTurns() {
    AxisLocks locks;
    locks.turnX = locks.turnY = locks.turnZ = true;
    return locks;
  }
};

struct BodyDef {
  BodyType type = BodyType::dynamic;
  std::vector<ShapeDef> shapes;  // at least one; mass, centre of mass and inertia come from them and their densities
  // In the body frame, instead of what the shapes and their densities give: a mass of 1e-15 .. 1e15 kg that lies so within the
  // box around the body's shapes (else an error that names what is impossible). What fixed bodies have of it is never read.
  std::optional<MassProperties> massProperties;
  Vec3 position;              // m, origin of the body frame (not the centre of mass); |coordinate| <= 1e6
  Quat rotation;              // any non-zero length; normalised
  Vec3 linearVelocity;        // m/s, of the centre of mass
  Vec3 angularVelocity;       // rad/s, world axes
  double gravityScale = 1;    // share of the world's gravity, -1e3 .. 1e3
  double linearDamping = 0;   // 1/s, >= 0: v decays as exp(-damping t)
  double angularDamping = 0;  // 1/s, >= 0
  double dragArea = 0;        // m2, >= 0: Cd A of quadratic air drag, F = -rho/2 CdA |v| v; 0 = no drag
  // m/s, body axes: how its surface runs, as that of a conveyor does; the body itself stays. Fixed and kinematic bodies
  // only. Friction acts on what lies on it by the speed against the surface; what part of it points into a face does
  // nothing there.
  Vec3 surfaceVelocity;
  AxisLocks locks;             // none; velocities given along locked axes are dropped
  bool enabled = true;         // false: it is made switched off (World::setEnabled)
  bool allowSleep = true;      // false keeps the body's island awake
  std::uint64_t userData = 0;  // yours; never read
};

struct BodyState {
  BodyType type = BodyType::dynamic;
  Vec3 position;             // m, origin of the body frame
  Quat rotation;             // unit
  Vec3 centreOfMass;         // m, world
  Vec3 linearVelocity;       // m/s, of the centre of mass
  Vec3 angularVelocity;      // rad/s, world axes
  Vec3 linearAcceleration;   // m/s2, mean over the last step
  Vec3 angularAcceleration;  // rad/s2, mean over the last step
  Vec3 surfaceVelocity;      // m/s, body axes
  double mass = 0;           // kg; 0 for fixed and kinematic bodies
  bool awake = true;
  bool enabled = true;  // false: switched off (World::setEnabled)
  AxisLocks locks;
  bool quarantined = false;  // became non-finite or lost (limits.h); held still and out of all contacts since then
  std::uint64_t userData = 0;
};

}  // namespace brickfall
