#include "solver/finish/motion.h"

#include <algorithm>

#include "solver/support.h"

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

// The solve freed the momentum of the whole island of what it had left; that of what presses on each other is kept by itself, once
// all else flies on.
void keepMomentum(const Island& island, StepContext& context) {
  const BodySet& bodies = *context.bodies;
  double mass = 0;
  Vec3 missing;  // kg m
  auto each = [&](auto&& act) {
    for (BodyIndex body : island.bodies)
      if (context.solved[body].pressed) act(body, context.solved[body]);
  };
  each([&](BodyIndex body, const SolvedMotion& s) {
    mass += bodies.mass[body].mass;
    missing += (context.free[body].d - s.d) * bodies.mass[body].mass;
  });
  if (!(mass > 0)) return;
  each([&](BodyIndex, SolvedMotion& s) {
    s.d += missing * (1 / mass);
    s.velocity = s.d * (1 / island.dt);
  });
}

}  // namespace

void storeMotion(const Island& island, StepContext& context) {
  const BodySet& bodies = *context.bodies;
  double perDt = 1 / island.dt;
  // What nothing presses on goes its own way, whatever cycles left of its weight or the island's momentum had to be freed of.
  std::pmr::vector<char> pressed(island.memory);
  findTouched(island, pressed, [&](const auto& kind, std::size_t k) { return kind.carriesForce(k, context); });
  for (std::size_t i = 0; i < island.bodies.size(); i++) {
    BodyIndex body = island.bodies[i];
    SolvedMotion& out = context.solved[body];
    const FreeMotion& free = context.free[body];
    const SolveMotion& m = island.motion[i];
    if (island.resting()) {
      out = {};
      out.rest = out.pressed = true;
      out.freeTurn = false;
      continue;
    }
    out.rest = false;
    out.pressed = pressed[i] != 0;
    out.lost = {};
    out.freeTurn = !out.pressed || m.th == island.masses[i].thFree;
    out.d = out.pressed ? island.travel + toDouble(m.d) : free.d;
    out.th = out.freeTurn ? free.th : toDouble(m.th);
    out.velocity = out.d * perDt;
    out.lag = kUnknownLag;
    // Torque impulses are added to the angular momentum, so that it is kept to rounding.
    Vec3 turned = out.freeTurn ? Vec3{} : toDouble(m.th) - toDouble(island.masses[i].thFree);
    if (free.turnsFaster) turned = effectiveTurn(turned, toDouble(m.th), free, bodies.worldInvInertia(body), island.dt);
    out.angularMomentum = free.angularMomentum + bodies.worldInertia(body) * turned * perDt;
  }
  if (!island.grounded() && !island.resting()) keepMomentum(island, context);
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
  out.rest = out.pressed = false;
  out.lost = {};
  out.lag = 0;
  out.flying = true;
}

}  // namespace brickfall
