#include "solver/finish/motion.h"

#include <algorithm>

namespace brickfall {

namespace {

// Of a body that turns faster than the solve sees, friction would drive the spin on and on: a brick under a rolling ball
// would spin up without end. What the torque of this step turned it by counts as far as the spin that the solve ended with
// goes beyond the one that the body had.
Vec3 effectiveTurn(Vec3 turned, Vec3 end, const FreeMotion& free, const Mat3& invInertia, double dt) {
  double size = length(turned);
  if (!(size > 0)) return turned;
  Vec3 along = turned * (1 / size);
  double had = dot(invInertia * free.angularMomentum, along) * dt, ends = dot(end, along);
  return along * std::min(size, std::max(0.0, ends - had));
}

// Bodies that are near each other in flight: each goes its own way, whatever rounding the island's momentum had to be freed of.
bool fliesApart(const Island& island, const StepContext& context) {
  bool presses = island.grounded();
  island.rows.each([&](const auto& kind, std::size_t k) { presses = presses || kind.carriesForce(k, context); });
  return !presses;
}

}  // namespace

void storeMotion(const Island& island, StepContext& context) {
  const BodySet& bodies = *context.bodies;
  double perDt = 1 / island.dt;
  const bool apart = fliesApart(island, context);
  for (std::size_t i = 0; i < island.bodies.size(); i++) {
    BodyIndex body = island.bodies[i];
    SolvedMotion& out = context.solved[body];
    const FreeMotion& free = context.free[body];
    const SolveMotion& m = island.motion[i];
    if (island.resting()) {
      out = {};
      out.rest = true;
      out.freeTurn = false;
      continue;
    }
    out.rest = false;
    out.lost = {};
    out.freeTurn = apart || m.th == island.masses[i].thFree;
    bool untouched = apart || (m.d == island.masses[i].dFree && out.freeTurn);
    out.d = untouched ? free.d : island.travel + toDouble(m.d);
    out.th = out.freeTurn ? free.th : toDouble(m.th);
    out.velocity = out.d * perDt;
    out.lag = kUnknownLag;
    // Torque impulses are added to the angular momentum, so that it is kept to rounding.
    Vec3 turned = out.freeTurn ? Vec3{} : toDouble(m.th) - toDouble(island.masses[i].thFree);
    if (free.turnsFaster) turned = effectiveTurn(turned, toDouble(m.th), free, bodies.worldInvInertia(body), island.dt);
    out.angularMomentum = free.angularMomentum + bodies.worldInertia(body) * turned * perDt;
  }
}

bool solvedWell(const Island& island, const StepContext& context) {
  for (BodyIndex body : island.bodies) {
    const SolvedMotion& s = context.solved[body];
    if (!isFinite(s.d) || !isFinite(s.th) || !isFinite(s.velocity) || !isFinite(s.angularMomentum)) return false;
  }
  return true;
}

void storeFreeBody(BodyIndex body, double dt, StepContext& context) {
  const FreeMotion& free = context.free[body];
  SolvedMotion& out = context.solved[body];
  out.velocity = free.d * (1 / dt);
  out.d = free.way;
  out.th = free.th;
  out.angularMomentum = free.angularMomentum;
  out.freeTurn = true;
  out.rest = false;
  out.lost = {};
  out.lag = 0;
  out.flying = true;
}

}  // namespace brickfall
