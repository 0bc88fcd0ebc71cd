#include "solver/store.h"

#include <algorithm>
#include <cmath>

#include "solver/restitution.h"

namespace brickfall {

bool storeRows(Island& island, Ties ties, StepContext& context) {
  bool changed = false;
  island.rows.eachKind([&](auto& kind) { changed = kind.store(island, ties, context) || changed; });
  return changed;
}

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

}  // namespace

void storeMotion(const Island& island, StepContext& context) {
  const BodySet& bodies = *context.bodies;
  double perDt = 1 / context.dt;
  bool cut = false;
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
    bool untouched = m.d == island.masses[i].dFree && m.th == island.masses[i].thFree;
    out.freeTurn = m.th == island.masses[i].thFree;
    out.d = untouched ? free.d : island.drift + toDouble(m.d);
    out.th = out.freeTurn ? free.th : toDouble(m.th);
    out.velocity = out.d * perDt;
    // Torque impulses are added to the angular momentum, so that it is kept to rounding.
    Vec3 turned = toDouble(m.th) - toDouble(island.masses[i].thFree);
    if (free.turnsFaster) {
      Vec3 whole = turned;
      turned = effectiveTurn(turned, toDouble(m.th), free, bodies.worldInvInertia(body), context.dt);
      cut = cut || !(turned == whole);
    }
    out.angularMomentum = free.angularMomentum + bodies.worldInertia(body) * turned * perDt;
  }
  if (cut) restoreSpin(island, context);
}

bool solvedWell(const Island& island, const StepContext& context) {
  for (BodyIndex body : island.bodies) {
    const SolvedMotion& s = context.solved[body];
    if (!isFinite(s.d) || !isFinite(s.th) || !isFinite(s.velocity) || !isFinite(s.angularMomentum)) return false;
  }
  return true;
}

void advanceRows(Island& island, Ties ties, const StepContext& context) {
  if (island.resting()) return;
  for (std::size_t i = 0; i < island.bodies.size(); i++) {
    const SolvedMotion& s = context.solved[island.bodies[i]];
    island.motion[i].d = toFloat(s.d - island.drift);
    island.motion[i].th = toFloat(s.th);
  }
  island.rows.eachKind([&](const auto& kind) { kind.advance(island, ties); });
}

void storeFreeBody(BodyIndex body, StepContext& context) {
  const FreeMotion& free = context.free[body];
  SolvedMotion& out = context.solved[body];
  out.velocity = free.d * (1 / context.dt);
  out.d = free.way;
  out.th = free.th;
  out.angularMomentum = free.angularMomentum;
  out.freeTurn = true;
  out.rest = false;
  out.flying = true;
}

namespace {

// Marks the bodies from which a chain of ties leads to something fixed.
void findHeld(const Island& island, const StepContext& context, float reach, std::pmr::vector<char>& held) {
  std::size_t bodies = island.bodies.size();
  held.assign(bodies + island.partners.size(), 0);
  std::fill(held.begin() + std::ptrdiff_t(bodies), held.end(), 1);
  std::pmr::vector<std::pair<std::uint32_t, std::uint32_t>> links(island.memory);
  links.reserve(island.rows.size());
  island.rows.each([&](const auto& kind, std::size_t k) {
    RowEnds ends = kind.ends(k);
    if (kind.holds(k, reach, island.motion.data(), context)) links.push_back({ends.a, ends.b});
  });
  for (bool grew = true, forwards = true; grew; forwards = !forwards) {
    grew = false;
    auto join = [&](std::pair<std::uint32_t, std::uint32_t> l) {
      if (held[l.first] == held[l.second]) return;
      held[l.first] = held[l.second] = 1;
      grew = true;
    };
    if (forwards)
      for (std::size_t i = 0; i < links.size(); i++) join(links[i]);
    else
      for (std::size_t i = links.size(); i-- > 0;) join(links[i]);
  }
}

}  // namespace

void correctFlight(Island& island, StepContext& context) {
  if (island.resting()) {
    for (BodyIndex body : island.bodies) context.solved[body].flying = false;
    return;
  }
  Vec3 correction = context.gravity * (-0.5 * context.dt * context.dt);
  std::pmr::vector<char> held(island.memory), near(island.memory);
  findHeld(island, context, 0, held);
  findHeld(island, context, float(length(correction)), near);
  for (std::size_t i = 0; i < island.bodies.size(); i++) {
    SolvedMotion& s = context.solved[island.bodies[i]];
    s.flying = !held[i];
    if (!near[i]) s.d += correction * context.bodies->data[island.bodies[i]].gravityScale;
  }
}

}  // namespace brickfall
