// Implicit Euler moves a body by its velocity at the end of the step: it slides v dt / 2 less far, and a block that starts
// to topple is dt / 2 ahead ever after. Where forces do not depend on the pose (sliding, rolling), the mean of old and new
// velocity is right to second order. Where they do (rocking, toppling), that would feed energy in; there the first step
// from rest gets half its change, which makes the steps after it a leapfrog: positions and times of second order, energy
// kept, velocities half a step late. Bodies that push each other are left alone: what one gains, the other would have to
// give.
#include "solver/finish/lone_body.h"

#include <cmath>

#include "solver/free_motion.h"

namespace brickfall {

namespace {

//! g h | too small: slides and rolls lose half a step of way
//! | too large: bodies that land or leave get a correction that is not theirs
constexpr double kSteadyShare = 0.2;  // of g dt: change of a normal velocity that still counts as none
//! of the way | with kSteadyShare
constexpr double kTurnShare = 1e-3;  // of the way: how far a slide may turn the surface out of its plane

// All points that carry force neither land nor leave in this step, and there is one.
bool steadyContacts(const Island& island, const StepContext& context, Vec3 moveChange, Vec3 turnChange) {
  double most = kSteadyShare * kReferenceGravity * context.dt;
  bool carried = false;
  for (std::size_t k = 0; k < island.rows.contacts.records.size(); k++) {
    const ContactRecord& r = island.rows.contacts.records[k];
    const Contact& c = context.contacts->contacts[island.rows.contacts.contactOf[k]];
    bool isA = r.bodyA == 0;
    Vec3 n = toDouble(r.n), t1 = toDouble(r.t1), t2 = cross(n, t1), arm = toDouble(isA ? r.armA : r.armB);
    double along = dot(n, moveChange + cross(turnChange, arm)), tilt1 = dot(t1, turnChange),
           tilt2 = dot(t2, turnChange);
    for (int i = 0; i < c.count; i++) {
      if (!(c.points.forceN[i] > 0)) continue;
      carried = true;
      double change = along + tilt1 * double(r.s2[i]) - tilt2 * double(r.s1[i]);
      if (!(std::fabs(change) <= most && std::fabs(island.rows.contacts.starts[k].approach[i]) <= most)) return false;
    }
  }
  return carried;
}

// Turns only within the plane of its contacts, or looks the same however it turns.
bool keepsItsForces(const Island& island, const StepContext& context, const SolvedMotion& s) {
  BodyIndex body = island.bodies[0];
  const BodyMass& mass = context.bodies->mass[body];
  Vec3 turn = visibleTurn(mass, context.bodies->motion[body].orientation, s.th);
  for (const ContactRecord& r : island.rows.contacts.records) {
    Vec3 n = toDouble(r.n);
    Vec3 tilt = turn - n * dot(n, turn);
    if (!(length(tilt) * mass.outerRadius <= kTurnShare * length(s.d))) return false;
  }
  return true;
}

}  // namespace

void correctLoneBody(const Island& island, StepContext& context) {
  if (island.resting() || island.facts.partnersMove || island.bodies.size() != 1) return;
  BodyIndex body = island.bodies[0];
  const FreeMotion& free = context.free[body];
  SolvedMotion& s = context.solved[body];
  bool fromRest = free.startVelocity == Vec3{} && free.startSpin == Vec3{};
  bool steadyForces = keepsItsForces(island, context, s);
  if (!fromRest && !steadyForces) return;
  Vec3 moveChange = s.velocity - free.startVelocity;
  Vec3 turnChange = context.bodies->worldInvInertia(body) * s.angularMomentum - free.startSpin;
  if (!steadyContacts(island, context, moveChange, turnChange)) return;
  s.d -= moveChange * (0.5 * context.dt);
  if (!s.freeTurn) s.th -= turnChange * (0.5 * context.dt);
  if (steadyForces) return;
  s.velocity *= 0.5;
  s.angularMomentum *= 0.5;
}

}  // namespace brickfall
