// All bodies of a world, split by temperature:
//   motion  pose and velocity, read and written in every step by everything;
//   mass    constants of a body that the step reads;
//   data    what links a body to its shapes and what only setters and bookkeeping touch.
// A body keeps its slot for life (slot = id.index - 1); a destroyed slot is used again with the next generation. Keeping
// slots in place, rather than swapping the last one in, makes the order of bodies the order of creation, on which results
// may then depend.
#pragma once
#include <cstdint>
#include <limits>
#include <optional>
#include <vector>

#include "brickfall/body.h"
#include "brickfall/ids.h"
#include "dynamics/axis_locks.h"

namespace brickfall {

using BodyIndex = std::uint32_t;   // slot of a body
using ShapeIndex = std::uint32_t;  // slot of a shape
constexpr std::uint32_t kNoIndex = 0xffffffffu;

struct BodyMotion {
  Vec3 position;  // m, centre of mass
  Quat rotation;
  Mat3 orientation;      // matrix of rotation, kept in step with it
  Vec3 linearVelocity;   // m/s, of the centre of mass
  Vec3 angularVelocity;  // rad/s, world axes
};

struct BodyMass {
  double mass = 0, invMass = 0;                     // kg; 0 unless dynamic
  Mat3 inertia{{{0, 0, 0}, {0, 0, 0}, {0, 0, 0}}};  // kg m2, body axes, about the centre of mass; 0 unless dynamic
  Mat3 invInertia{{{0, 0, 0}, {0, 0, 0}, {0, 0, 0}}};
  Vec3 principalInvInertia;  // 1 / (kg m2); 0 unless dynamic
  Mat3 principalAxes;        // rows: principal axes of inertia in body axes
  double innerRadius = 0;    // m: smallest distance from the centre to the surface, scale of torques and margins
  double outerRadius = 0;    // m: largest, how far a turn can carry a point
  std::uint8_t locks = 0;    // axis_locks.h; 0 unless dynamic
  bool isotropic = false;    // inertia is a multiple of the unit matrix: no gyroscopic torque
  bool round = false;        // one sphere: however it turns, it looks the same
  Vec3 symmetryAxis;         // body axes: one capsule looks the same however it turns about it; else 0
  bool rims = false;         // that is the axis of a cylinder or cone
};

// m/s: of B at the end of an arm from its centre against A at the end of one from its own.
inline Vec3 velocityAgainst(const BodyMotion& a, const BodyMotion& b, Vec3 armA, Vec3 armB) {
  return b.linearVelocity + cross(b.angularVelocity, armB) - a.linearVelocity - cross(a.angularVelocity, armA);
}

enum class BodyActivity : std::uint8_t { awake, asleep, fixed };  // fixed: static bodies, and kinematic ones at rest

// How the velocities of a body alone on something fixed changed in the last step, if its contacts went on through it: what the
// next step's forces differ from.
struct SteadyChange {
  Vec3 linear, angular;  // m/s2, rad/s2
  double dt = 0;         // s, of that step; 0: they did not go on, or it was not alone
  bool swings = false;  // it flew, or hung on joints: its velocity is that of the step's end (joint/swings.h); in `dt`,
                        // half of this change is to be taken back
};

//! x | too small: a motion that begins evenly is blows | too large: a jump after a smaller one is none
constexpr double kUsualTimes = 2;  // the largest change of late, that the next one may be without being a jump
//! of it, by step | too small: shakes are blows where they turn | too large: the second of two jumps is none
constexpr double kUsualKept = 0.9;

struct BodyData {
  bool alive = false;
  BodyType type = BodyType::dynamic;
  BodyActivity activity = BodyActivity::fixed;
  bool quarantined = false;
  bool enabled = true;
  bool allowSleep = true;
  std::uint8_t locks = 0;  // as asked for, whatever the type
  std::uint16_t generation = 0;
  Vec3 localCentre;  // m, centre of mass in the body frame
  double gravityScale = 1, linearDamping = 0, angularDamping = 0, dragArea = 0;
  Vec3 surfaceVelocity;                          // m/s, body axes; 0 of a dynamic body
  Vec3 force, torque;                            // N, N m: for the next step
  Vec3 lastLinearVelocity, lastAngularVelocity;  // at the start of the last step, for accelerations
  Vec3 linearAcceleration, angularAcceleration;
  // J, its kinetic energy where that of its island last turned: above 0 the greatest since, while it grows; below 0 less
  // the least, while it falls. Infinite: not watched yet (kinetic damping).
  double turnEnergy = -std::numeric_limits<double>::infinity();
  SteadyChange steady;
  double usualChange = 0;  // m/s, of something kinematic: the most that its speed changed in a step of late (speedJump)
  double impactLoss = 0;   // J: its part of what impacts that go on have taken so far; what rebounds may give back
  std::uint64_t userData = 0;
  std::uint64_t order = 0;                  // grows with creation
  MassProperties bodyFrameMass;             // as asked for, whatever the type
  std::optional<MassProperties> givenMass;  // instead of that of the shapes
};

class BodySet {
 public:
  BodyIndex create();  // fresh slot, all fields default, alive
  void destroy(BodyIndex body);
  std::size_t slots() const { return data.size(); }
  bool alive(BodyIndex body) const { return body < data.size() && data[body].alive; }
  int count() const { return count_; }
  // Slots in order of creation.
  std::vector<BodyIndex> inOrder() const;
  const std::vector<BodyIndex>& unused() const { return free_; }
  std::uint64_t nextOrder() const { return nextOrder_; }

  Transform pose(BodyIndex body) const {
    return {motion[body].position, motion[body].rotation};
  }  // of the centre of mass
  Vec3 origin(BodyIndex body) const {
    return motion[body].position - motion[body].orientation * data[body].localCentre;
  }
  // The step knows it: it is neither switched off nor quarantined.
  bool takesPart(BodyIndex body) const { return data[body].enabled && !data[body].quarantined; }
  // Less what its locks forbid.
  Vec3 freeWay(BodyIndex body, Vec3 v) const { return without(v, mass[body].locks & kAllWays); }
  Vec3 freeTurn(BodyIndex body, Vec3 v) const { return without(v, mass[body].locks >> 3); }
  bool turnsLocked(BodyIndex body) const { return mass[body].locks > kAllWays; }
  // A kinematic body with a velocity: whatever sleeps, it moves.
  bool isDriven(BodyIndex body) const {
    const BodyMotion& m = motion[body];
    return data[body].type == BodyType::kinematic &&
           (lengthSquared(m.linearVelocity) > 0 || lengthSquared(m.angularVelocity) > 0);
  }
  // m/s: by which something kinematic, or its rim, goes otherwise than in the last step.
  double speedChange(BodyIndex body) const {
    const BodyMotion& m = motion[body];
    const BodyData& d = data[body];
    return length(m.linearVelocity - d.lastLinearVelocity) +
           mass[body].outerRadius * length(m.angularVelocity - d.lastAngularVelocity);
  }
  // The share of that which is a jump, a blow to what hangs on it. It is an acceleration as far as its speed changed of
  // late: what a program moves evenly changes from step to step, more or less.
  double speedJump(BodyIndex body) const {
    const double change = speedChange(body), usual = kUsualTimes * data[body].usualChange;
    return change > usual ? 1 - usual / change : 0;
  }
  // m/s, world axes: of the body's surface against the body.
  Vec3 surfaceVelocity(BodyIndex body) const { return motion[body].orientation * data[body].surfaceVelocity; }
  // What lies on the body may be carried along, though nothing pushes it: the body is driven, or its surface runs.
  bool carries(BodyIndex body) const { return isDriven(body) || data[body].surfaceVelocity != Vec3{}; }
  void setRotation(BodyIndex body, Quat unit) {
    motion[body].rotation = unit;
    motion[body].orientation = toMatrix(unit);
  }
  Mat3 worldInertia(BodyIndex body) const {
    const Mat3& R = motion[body].orientation;
    return R * mass[body].inertia * transpose(R);
  }
  // What a torque does to it; locked axes turn by nothing.
  Mat3 invInertiaAt(BodyIndex body, const Mat3& R) const {
    if (turnsLocked(body)) return lockedInverse(R * mass[body].inertia * transpose(R), mass[body].locks);
    return R * mass[body].invInertia * transpose(R);
  }
  Mat3 worldInvInertia(BodyIndex body) const { return invInertiaAt(body, motion[body].orientation); }
  // rad/s: of an angular momentum, where the body points so.
  Vec3 spinAt(BodyIndex body, const Mat3& R, Vec3 angularMomentum) const {
    if (turnsLocked(body)) return invInertiaAt(body, R) * angularMomentum;
    return R * (mass[body].invInertia * transposeTimes(R, angularMomentum));
  }
  double kineticEnergy(BodyIndex body) const {
    const BodyMotion& m = motion[body];
    Vec3 w = transposeTimes(m.orientation, m.angularVelocity);
    return 0.5 * mass[body].mass * lengthSquared(m.linearVelocity) + 0.5 * dot(w, mass[body].inertia * w);
  }

  std::vector<BodyMotion> motion;
  std::vector<BodyMass> mass;
  std::vector<BodyData> data;
  std::vector<std::vector<ShapeIndex>> shapes;
  std::vector<std::uint8_t> still;  // 1: did not move at all in the last step

 private:
  friend class SnapshotArchive;
  std::vector<BodyIndex> free_;
  int count_ = 0;
  std::uint64_t nextOrder_ = 1;
};

}  // namespace brickfall
