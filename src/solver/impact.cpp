#include "solver/impact.h"

#include <algorithm>
#include <limits>

#include "solver/cycles.h"
#include "solver/island_trial.h"
#include "solver/light_pass.h"
#include "solver/prepare.h"
#include "solver/rigid_sum.h"

namespace brickfall {

namespace {

// Free motion as if no time passed: velocities alone say where bodies would go.
void goOnFreely(const Island& island, const BodySet& bodies, StepContext& context) {
  for (BodyIndex body : island.bodies) {
    const BodyMotion& m = bodies.motion[body];
    FreeMotion& free = context.free[body];
    free = {};
    free.dt = free.turnTime = island.dt;
    free.startVelocity = m.linearVelocity;
    free.startSpin = m.angularVelocity;
    free.d = free.way = m.linearVelocity * island.dt;
    free.th = m.angularVelocity * island.dt;
    free.rotation = m.rotation;
    free.angularMomentum = bodies.worldInertia(body) * m.angularVelocity;
  }
}

double kineticEnergy(const Island& island, const BodySet& bodies) {
  double sum = 0;
  for (BodyIndex body : island.bodies) sum += bodies.kineticEnergy(body);
  return sum;
}

struct Velocities {
  Vec3 linear, angular;
};

// Where no fixed body was hit, the momenta of the struck bodies are those before the impact: a solve leaves them off by
// its residual.
void keepMomenta(const Island& island, const std::pmr::vector<Velocities>& before, BodySet& bodies) {
  if (island.grounded() || island.facts.locked) return;
  auto eachHit = [&](auto&& act) {
    for (std::size_t i = 0; i < before.size(); i++) {
      BodyMotion& m = bodies.motion[island.bodies[i]];
      const Vec3 push = before[i].linear - m.linearVelocity, turn = before[i].angular - m.angularVelocity;
      if (push != Vec3{} || turn != Vec3{}) act(island.bodies[i], m, push, turn);
    }
  };
  RigidSum missing(island.origin);
  eachHit([&](BodyIndex body, const BodyMotion& m, Vec3 push, Vec3 turn) {
    const Mat3 inertia = bodies.worldInertia(body);
    missing.add(bodies.mass[body].mass, m.position, inertia, push * bodies.mass[body].mass, inertia * turn);
  });
  if (!(missing.mass() > 0)) return;
  const RigidMotion kept = missing.motion();
  eachHit([&](BodyIndex, BodyMotion& m, Vec3, Vec3) {
    m.linearVelocity += kept.at(m.position);
    m.angularVelocity += kept.spin;
  });
}

// With a share x of their change since `before` the bodies gain x (gain + (x - 1) energy of the change).
double shareThatGainsNothing(const Island& island, const std::pmr::vector<Velocities>& before, double gain,
                             const BodySet& bodies) {
  if (!(gain > 0)) return 1;
  double ofChange = 0;  // J
  for (std::size_t i = 0; i < before.size(); i++) {
    const BodyIndex body = island.bodies[i];
    const BodyMotion& m = bodies.motion[body];
    const Vec3 push = m.linearVelocity - before[i].linear, turn = m.angularVelocity - before[i].angular;
    ofChange += 0.5 * bodies.mass[body].mass * lengthSquared(push) + 0.5 * dot(turn, bodies.worldInertia(body) * turn);
  }
  return 1 - gain / ofChange;
}

// Returns false, and changes nothing, if the result would be no impact. Where nothing is lost, the rounding of a sound
// solve may be a gain: all velocities change less by as much.
bool changeVelocities(const Island& island, BodySet& bodies) {
  std::pmr::vector<Velocities> before(island.memory);
  const double had = kineticEnergy(island, bodies), perDt = 1 / island.dt;
  bool finite = true;
  for (std::size_t i = 0; i < island.bodies.size(); i++) {
    BodyMotion& m = bodies.motion[island.bodies[i]];
    before.push_back({m.linearVelocity, m.angularVelocity});
    m.linearVelocity += (toDouble(island.motion[i].d) - toDouble(island.masses[i].dFree)) * perDt;
    m.angularVelocity += (toDouble(island.motion[i].th) - toDouble(island.masses[i].thFree)) * perDt;
    finite = finite && isFinite(m.linearVelocity) && isFinite(m.angularVelocity);
  }
  if (finite) keepMomenta(island, before, bodies);
  const double share = finite ? shareThatGainsNothing(island, before, kineticEnergy(island, bodies) - had, bodies) : 0;
  const bool sound = share >= 1 - kTrifle;
  if (sound && share == 1) return true;
  for (std::size_t i = 0; i < before.size(); i++) {
    BodyMotion& m = bodies.motion[island.bodies[i]];
    const Velocities& was = before[i];
    m.linearVelocity = sound ? was.linear + (m.linearVelocity - was.linear) * share : was.linear;
    m.angularVelocity = sound ? was.angular + (m.angularVelocity - was.angular) * share : was.angular;
  }
  return sound;
}

}  // namespace

bool mayClose(const Island& island, const StepContext& context, double ahead) {
  bool any = false;
  island.rows.eachKind([&](const auto& kind) { any = any || kind.mayClose(context, ahead); });
  return any;
}

bool touchesNothing(const Island& island, const StepContext& context) {
  bool none = true;
  island.rows.eachKind([&](const auto& kind) { none = none && kind.touchNothing(context); });
  return none;
}

double firstClosing(Island& island, double dt, const StepContext& context) {
  double first = std::numeric_limits<double>::infinity();
  island.rows.eachKind([&](auto& kind) { first = std::min(first, kind.firstClosing(island, dt, context)); });
  return first;
}

bool solveImpact(Island& island, Ties& ties, BodySet& bodies, StepContext& context, double blink,
                 SolveStatistics& statistics, std::pmr::vector<TieImpact>& impacts) {
  TiesMemory remembered(island, ties);
  const IslandFacts facts = findFacts(island, context);
  island.facts.locked = facts.locked;
  island.plan = planFor(facts, context.settings, island.dt);
  goOnFreely(island, bodies, context);
  prepareBodies(island, context);
  prepareRows(island, ties, context);
  remembered.restore();
  island.rows.eachKind([&](auto& kind) { kind.startImpact(island, context, blink); });
  startCycles(island, context);
  goOn(island, context, statistics);
  island.rows.eachKind([&](auto& kind) { kind.keepImpactForces(island); });
  goOn(island, context, statistics);
  impacts.clear();
  bool rebounds = false;
  island.rows.eachKind([&](auto& kind) { rebounds = kind.reboundImpact(island, context, impacts) || rebounds; });
  if (rebounds) goOn(island, context, statistics);
  bool solved = leftOver(island, bodies).worst <= kTrifle && changeVelocities(island, bodies);
  island.rows.eachKind([&](auto& kind) { kind.endImpact(island, ties, context, solved); });
  return solved;
}

}  // namespace brickfall
