#include "solver/impact.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "solver/contact/rebound.h"
#include "solver/contact/stiffness.h"
#include "solver/cycles.h"
#include "solver/light_pass.h"
#include "solver/prepare.h"

namespace brickfall {

namespace {

//! m | too small: what landed together is hit one by one | too large: what is near is hit before it is there
constexpr double kClosedGap = 20e-6;
//! m | too small: points in contact count as open by their rounding | too large: what is near is let through
constexpr double kOpenGap = 1e-6;
//! m | too small: cost of what hardly moves | too large: slow landings are first order in the time step
constexpr double kLeastWay = 20e-6;  // in a step, at the speed of an impact: slower ones need no moment of their own
//! - | too small: impacts under a load rub too little | too large: bounds and forces chase each other
constexpr double kMostImpulse = 2;  // x mass of the heaviest x fastest approach: no point takes more
//! - | too small: impacts that are solved well are dropped | too large: momentum and energy of those that are not
constexpr double kImpactTolerance = 0.01;  // of the forces on a body
//! - | too small: sound impacts are dropped | too large: energy may creep up
constexpr double kRounding = 1e-6;  // of the energy: what the float solve may add
//! not of the method: a mark
constexpr float kNoForce = 1e30f;  // N: so far from closed is a point that does not exist

struct Velocity {
  Vec3 linear, angular;
};
Velocity startOf(const BodySet& bodies, BodyIndex body) {
  return {bodies.motion[body].linearVelocity, bodies.motion[body].angularVelocity};
}

// Normal speed of B against A at each point: negative = closing.
void speedsOf(const ContactRecord& r, int count, const Velocity& a, const Velocity& b, double* out) {
  Vec3 n = toDouble(r.n), t1 = toDouble(r.t1), t2 = cross(n, t1);
  Vec3 u = b.linear + cross(b.angular, toDouble(r.armB)) - a.linear - cross(a.angular, toDouble(r.armA));
  Vec3 w = b.angular - a.angular;
  for (int i = 0; i < count; i++) out[i] = dot(n, u) + dot(t1, w) * double(r.s2[i]) - dot(t2, w) * double(r.s1[i]);
}

// m/s: slower impacts are left to the step.
double slowest(const Island& island, const StepContext& context) {
  const Scale& scale = island.facts.scale;
  double unseen = kLeastWay * scale.length / context.dt;
  return island.bodies.size() == 1 ? unseen : std::max(unseen, context.settings.restingApproachSpeed * scale.speed);
}

// When a point at `gap` closes that parts at `speed` and is accelerated, if faster than `least`.
double closingTime(double gap, double speed, double acceleration, double least) {
  const double never = std::numeric_limits<double>::infinity();
  if (gap <= 0) return -speed > least ? 0 : never;
  double square = speed * speed - 2 * acceleration * gap;
  if (!(square > least * least)) return never;
  double closing = std::sqrt(square);
  if (speed < 0) return 2 * gap / (closing - speed);
  return acceleration < 0 ? (speed + closing) / -acceleration : never;
}

// As if no time passed: where bodies would go is where their velocities take them.
void goOnFreely(const Island& island, const BodySet& bodies, StepContext& context) {
  for (BodyIndex body : island.bodies) {
    const BodyMotion& m = bodies.motion[body];
    FreeMotion& free = context.free[body];
    free = {};
    free.turnTime = island.dt;
    free.startVelocity = m.linearVelocity;
    free.startSpin = m.angularVelocity;
    free.d = free.way = m.linearVelocity * island.dt;
    free.th = m.angularVelocity * island.dt;
    free.rotation = m.rotation;
    free.angularMomentum = bodies.worldInertia(body) * m.angularVelocity;
  }
}

// Closed points may not close further, open ones do not exist; of no point is anything remembered.
void writeRecords(Island& island, Ties ties, const StepContext& context, double blink) {
  ContactRows& rows = island.rows.contacts;
  double fastest = 0, heaviest = 0;
  for (BodyIndex body : island.bodies) heaviest = std::max(heaviest, context.bodies->mass[body].mass);
  for (std::size_t k = 0; k < rows.size(); k++) {
    const Contact& c = ties.contacts.contacts[rows.contactOf[k]];
    ContactRecord& r = rows.records[k];
    for (int i = 0; i < c.count; i++) {
      double approach = std::max(0.0, -double(rows.starts[k].approach[i]));
      bool closed = double(c.points.gap[i]) <= std::max(kClosedGap * rows.starts[k].scale.length, approach * blink);
      r.k[i] = float(context.settings.restingStiffness * double(c.effectiveMass) / (island.dt * island.dt));
      r.trialN[i] = closed ? 0 : -kNoForce;
      r.trial1[i] = r.trial2[i] = r.limit[i] = 0;
      r.newPoints |= 1u << i;
      if (closed) fastest = std::max(fastest, approach);
    }
  }
  for (ContactStart& start : rows.starts)
    for (float& most : start.stopping) most = float(kMostImpulse * heaviest * fastest / island.dt);
}

struct Forces {
  alignas(16) float n[4], t1[4], t2[4];  // N
  alignas(16) float way[4];              // m, normal
};
Forces forcesOf(const ContactRecord& r, const Island& island) {
  auto moved = kernel::pointMotion(r, kernel::frame(r), island.motion.data());
  auto f = kernel::pointForces(r, moved);
  Forces out;
  kernel::store(moved.n, out.way);
  kernel::store(f.n, out.n);
  kernel::store(f.t1, out.t1);
  kernel::store(f.t2, out.t2);
  return out;
}

// The forces found become multipliers: what springs left of the approach, a thousandth of it, becomes a millionth.
void holdForces(Island& island) {
  for (ContactRecord& r : island.rows.contacts.records) {
    Forces f = forcesOf(r, island);
    for (int i = 0; i < 4; i++) {
      if (!(f.n[i] > 0)) continue;
      r.trialN[i] += f.n[i];
      r.trial1[i] += f.t1[i];
      r.trial2[i] += f.t2[i];
    }
  }
}

// What stopped each contact; true if any gives a part of it back. Those points then press at least as hard as that.
bool findImpacts(Island& island, const StepContext& context, std::pmr::vector<ContactImpact>& impacts) {
  ContactRows& rows = island.rows.contacts;
  double least = slowestRebound(island, context);
  bool rebounds = false;
  for (std::size_t k = 0; k < rows.size(); k++) {
    const Contact& c = context.contacts->contacts[rows.contactOf[k]];
    Forces f = forcesOf(rows.records[k], island);
    ContactImpact impact{std::uint32_t(k)};
    for (int i = 0; i < c.count; i++) {
      if (!(f.n[i] > 0)) continue;
      double approach = -double(rows.starts[k].approach[i]);
      impact.speed = std::max(impact.speed, approach);
      impact.impulse += double(f.n[i]) * island.dt;
      if (c.restitution == 0 || approach <= least) continue;
      rows.records[k].tensionCap[i] = -(1 + c.restitution) * f.n[i];
      rebounds = true;
    }
    if (impact.impulse > 0) impacts.push_back(impact);
  }
  return rebounds;
}

double kineticEnergy(const Island& island, const BodySet& bodies) {
  double sum = 0;
  for (BodyIndex body : island.bodies) sum += bodies.kineticEnergy(body);
  return sum;
}

// False, and nothing is changed, if that would be no impact.
bool changeVelocities(const Island& island, BodySet& bodies) {
  std::pmr::vector<Velocity> before(island.memory);
  const double had = kineticEnergy(island, bodies), perDt = 1 / island.dt;
  bool finite = true;
  for (std::size_t i = 0; i < island.bodies.size(); i++) {
    BodyMotion& m = bodies.motion[island.bodies[i]];
    before.push_back({m.linearVelocity, m.angularVelocity});
    m.linearVelocity += (toDouble(island.motion[i].d) - toDouble(island.masses[i].dFree)) * perDt;
    m.angularVelocity += (toDouble(island.motion[i].th) - toDouble(island.masses[i].thFree)) * perDt;
    finite = finite && isFinite(m.linearVelocity) && isFinite(m.angularVelocity);
  }
  if (finite && kineticEnergy(island, bodies) <= had * (1 + kRounding)) return true;
  for (std::size_t i = 0; i < before.size(); i++) {
    bodies.motion[island.bodies[i]].linearVelocity = before[i].linear;
    bodies.motion[island.bodies[i]].angularVelocity = before[i].angular;
  }
  return false;
}

}  // namespace

bool isOpen(const Contact& c, int i, const StepContext& context) {
  const float open = float(kOpenGap * scaleOfPair(c, context).length);
  return c.points.forceN[i] == 0 && c.points.gap[i] > open && !(c.points.metMask >> i & 1);
}

void leaveOut(Island& island, Ties ties, const StepContext& context) {
  ContactRows& rows = island.rows.contacts;
  for (std::size_t k = 0; k < rows.size(); k++) {
    Contact& c = ties.contacts.contacts[rows.contactOf[k]];
    for (int i = 0; i < c.count; i++) {
      if (!isOpen(c, i, context)) continue;
      rows.records[k].trialN[i] = -kNoForce;
      clearPoint(c.points, i);
    }
  }
}

double firstClosing(const Island& island, const StepContext& context) {
  const ContactRows& rows = island.rows.contacts;
  const BodySet& bodies = *context.bodies;
  const double least = slowest(island, context);
  double lag = island.bodies.size() == 1 ? std::max(0.0, bodies.data[island.bodies[0]].lag) : 0;
  auto velocities = [&](std::uint32_t local, Velocity& start, Velocity& end) {
    BodyIndex body =
        local < island.bodies.size() ? island.bodies[local] : island.partners[local - island.bodies.size()];
    start = end = startOf(bodies, body);
    if (local >= island.bodies.size()) return;
    end = {context.solved[body].velocity, bodies.worldInvInertia(body) * context.solved[body].angularMomentum};
  };
  double first = std::numeric_limits<double>::infinity();
  for (std::size_t k = 0; k < rows.size(); k++) {
    const Contact& c = context.contacts->contacts[rows.contactOf[k]];
    const ContactRecord& r = rows.records[k];
    Velocity startA, startB, endA, endB;
    velocities(r.bodyA, startA, endA);
    velocities(r.bodyB, startB, endB);
    double start[4], end[4];
    speedsOf(r, c.count, startA, startB, start);
    speedsOf(r, c.count, endA, endB, end);
    for (int i = 0; i < c.count; i++) {
      if (c.points.forceN[i] > 0) continue;
      double acceleration = (end[i] - start[i]) / island.dt;
      double gap = c.points.gap[i] > float(kOpenGap * rows.starts[k].scale.length) ? double(c.points.gap[i]) : 0;
      first = std::min(first, closingTime(gap, start[i] + acceleration * lag, acceleration, least));
    }
  }
  return first;
}

bool solveImpact(Island& island, Ties ties, BodySet& bodies, StepContext& context, double blink,
                 SolveStatistics& statistics, std::pmr::vector<ContactImpact>& impacts) {
  ContactRows& rows = island.rows.contacts;
  std::pmr::vector<Contact> remembered(island.memory);
  for (ContactIndex contact : rows.contactOf) remembered.push_back(ties.contacts.contacts[contact]);
  island.plan = planFor(findFacts(island, context), context.settings, island.dt);
  goOnFreely(island, bodies, context);
  prepareBodies(island, context);
  prepareRows(island, ties, context);
  for (std::size_t k = 0; k < rows.size(); k++) ties.contacts.contacts[rows.contactOf[k]] = remembered[k];
  writeRecords(island, ties, context, blink);
  startCycles(island, context);
  goOn(island, context, statistics);
  holdForces(island);
  goOn(island, context, statistics);
  impacts.clear();
  if (findImpacts(island, context, impacts)) goOn(island, context, statistics);
  correctMomentum(island, context);
  bool solved = leftOver(island, bodies).worst <= kImpactTolerance && changeVelocities(island, bodies);
  for (std::size_t k = 0; k < rows.size(); k++) {
    Contact& c = ties.contacts.contacts[rows.contactOf[k]];
    Forces f = forcesOf(rows.records[k], island);
    for (float& cap : rows.records[k].tensionCap) cap = 0;
    if (!solved) continue;
    for (int i = 0; i < c.count; i++) {
      // What was hit begins anew, and so does what the impact parts: its last force must not act on.
      bool hit = f.n[i] > 0, parts = double(f.way[i]) > slowest(island, context) * island.dt;
      if (hit ? c.points.forceN[i] == 0 : parts) clearPoint(c.points, i);
      if (hit && !parts) {  // micrometres away: what is left of the step must not close that in no time
        c.points.metMask |= 1u << i;
        c.points.gap[i] = std::min(0.0f, c.points.gap[i]);
      }
      if (hit) addHit(c.points, i, f.n[i], f.t1[i], f.t2[i]);
    }
  }
  return solved;
}

}  // namespace brickfall
