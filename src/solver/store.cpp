#include "solver/store.h"

#include <algorithm>
#include <cmath>
#include <cstring>

#include "solver/contact_kernel.h"
#include "solver/restitution.h"

namespace brickfall {

namespace {

struct StoredForces {
  alignas(16) float n[4], t1[4], t2[4];
  std::uint32_t sliding = 0;
};

StoredForces forcesAt(const ContactRecord& r, const Island& island) {
  kernel::PointForces f = kernel::pointForces(r, kernel::pointMotion(r, kernel::frame(r), island.motion.data()));
  StoredForces out;
  kernel::store(f.n, out.n);
  kernel::store(f.t1, out.t1);
  kernel::store(f.t2, out.t2);
  out.sliding = wide::bits(f.slides);
  return out;
}

// Multiplier for the next step: the force, but an impact's force must not act again, explicitly.
void holdForce(Contact& c, int i, const StoredForces& f) {
  float held = kHeldShare * c.points.heldN[i];
  float cap = kHeldGrowth * held + kHeldWeights * float(kReferenceGravity) * c.effectiveMass;
  float share = f.n[i] > cap ? cap / f.n[i] : 1;
  c.points.forceN[i] = f.n[i];
  c.points.force1[i] = f.t1[i];
  c.points.force2[i] = f.t2[i];
  c.points.heldN[i] = f.n[i] > cap ? cap : f.n[i];
  c.points.held1[i] = f.t1[i] * share;
  c.points.held2[i] = f.t2[i] * share;
}

// Where the anchor of a point that slides has to be for its spring to carry the sliding force.
void placeSlip(Contact& c, int i, bool sliding) {
  c.points.slip1[i] = c.points.slip2[i] = 0;
  if (!sliding || !(c.points.forceN[i] > 0)) return;
  float scale = -(1 - kHeldShare) / (c.points.stiffness[i] * kCorrect);
  c.points.slip1[i] = c.points.force1[i] * scale;
  c.points.slip2[i] = c.points.force2[i] * scale;
  float drift = std::sqrt(c.points.slip1[i] * c.points.slip1[i] + c.points.slip2[i] * c.points.slip2[i]);
  if (drift > kLargestDrift) {
    c.points.slip1[i] *= kLargestDrift / drift;
    c.points.slip2[i] *= kLargestDrift / drift;
  }
}

// A joint that cannot carry a moment: few loaded points, or all of them sliding.
bool updateWeak(Contact& c, int loaded, int slidingLoaded) {
  bool was = c.weak;
  if (loaded < 3 || slidingLoaded >= c.count) {
    c.weak = true;
    c.weakSteps = kWeakHold;
  } else if (--c.weakSteps <= 0) {
    c.weak = false;
    c.weakSteps = 0;
  }
  return c.weak != was;
}

}  // namespace

bool storeForces(Island& island, StepContext& context) {
  bool changed = false;
  for (std::size_t k = 0; k < island.contacts.size(); k++) {
    Contact& c = context.contacts->contacts[island.contacts[k]];
    Contact before = c;
    StoredForces f = forcesAt(island.records[k], island);
    int loaded = 0, slidingLoaded = 0;
    c.points.stickingMask = 0;
    for (int i = 0; i < c.count; i++) {
      bool sliding = f.sliding >> i & 1;
      loaded += f.n[i] > 0;
      slidingLoaded += sliding && f.n[i] > 0;
      holdForce(c, i, f);
      if (f.n[i] > 0 && !sliding) c.points.stickingMask |= 1u << i;
      placeSlip(c, i, sliding);
    }
    c.touching = loaded > 0;
    if (c.touching != before.touching) context.contacts->touchingChanged = true;
    if (updateWeak(c, loaded, slidingLoaded)) island.byMechanism.valid = false;
    changed = changed || std::memcmp(&before, &c, sizeof c) != 0;
  }
  context.statistics.lightVisits += 4.0 * double(island.contacts.size());
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

void advanceGaps(Island& island, StepContext& context) {
  if (island.resting()) return;
  for (std::size_t i = 0; i < island.bodies.size(); i++) {
    const SolvedMotion& s = context.solved[island.bodies[i]];
    island.motion[i].d = toFloat(s.d - island.drift);
    island.motion[i].th = toFloat(s.th);
  }
  for (std::size_t k = 0; k < island.contacts.size(); k++) {
    Contact& c = context.contacts->contacts[island.contacts[k]];
    const ContactRecord& r = island.records[k];
    kernel::PointMotion m = kernel::pointMotion(r, kernel::frame(r), island.motion.data());
    alignas(16) float n[4], t1[4], u2[4];
    kernel::store(m.n, n);
    kernel::store(m.t1, t1);
    kernel::store(m.t2, u2);
    for (int i = 0; i < c.count; i++) {
      c.points.gap[i] += n[i];
      c.points.drift1[i] += t1[i];
      c.points.drift2[i] += u2[i];
    }
  }
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

// Marks the bodies from which a chain of contacts leads to something fixed.
void findHeld(const Island& island, const StepContext& context, float reach, std::pmr::vector<char>& held) {
  std::size_t bodies = island.bodies.size();
  held.assign(bodies + island.partners.size(), 0);
  std::fill(held.begin() + std::ptrdiff_t(bodies), held.end(), 1);
  std::pmr::vector<std::pair<std::uint32_t, std::uint32_t>> links(island.memory);
  links.reserve(island.records.size());
  for (std::size_t k = 0; k < island.records.size(); k++) {
    const ContactRecord& r = island.records[k];
    const Contact& c = context.contacts->contacts[island.contacts[k]];
    bool touches = c.touching;
    if (!touches && reach > 0) {
      alignas(16) float n[4];
      kernel::store(kernel::pointMotion(r, kernel::frame(r), island.motion.data()).n, n);
      for (int i = 0; i < c.count; i++) touches = touches || c.points.gap[i] + n[i] < reach;
    }
    if (touches) links.push_back({r.bodyA, r.bodyB});
  }
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
