#include "world/ledger.h"

#include "solver/rows.h"

namespace brickfall {

BalanceChange operator-(const Balance& a, const Balance& b) {
  return {a.linear - b.linear, a.angular - b.angular, a.kinetic + a.potential - b.kinetic - b.potential,
          a.elastic - b.elastic};
}
BalanceChange operator-(const BalanceChange& a, const BalanceChange& b) {
  return {a.linear - b.linear, a.angular - b.angular, a.energy - b.energy, a.elastic - b.elastic};
}
void operator+=(BalanceChange& a, const BalanceChange& b) {
  a.linear += b.linear;
  a.angular += b.angular;
  a.energy += b.energy;
  a.elastic += b.elastic;
}

void addBody(Balance& sum, const BodyMass& mass, Vec3 position, Vec3 velocity, Vec3 spin, Vec3 spinMomentum) {
  Vec3 momentum = velocity * mass.mass;
  sum.linear += momentum;
  sum.angular += cross(position, momentum) + spinMomentum;
  sum.kinetic += 0.5 * dot(velocity, momentum) + 0.5 * dot(spin, spinMomentum);
}

double elasticAsleep(const StepContext& context) {
  double sum = 0;
  context.ties->eachAsleep([&](const Link& link) { sum += Rows::elasticEnergy(link, context); });
  return sum;
}

Balance balanceNow(const BodySet& bodies, const StepContext& context) {
  Balance sum;
  context.ties->eachAwake([&](const Link& link) { sum.elastic += Rows::elasticEnergy(link, context); });
  sum.elastic += elasticAsleep(context);
  for (BodyIndex i = 0; i < bodies.slots(); i++) {
    if (!bodies.alive(i) || bodies.data[i].type != BodyType::dynamic || !bodies.data[i].enabled) continue;
    const BodyMotion& m = bodies.motion[i];
    addBody(sum, bodies.mass[i], m.position, m.linearVelocity, m.angularVelocity,
            bodies.worldInertia(i) * m.angularVelocity);
    sum.potential -= bodies.mass[i].mass * bodies.data[i].gravityScale * dot(context.gravity, m.position);
  }
  return sum;
}

Balance solvedBalance(const std::vector<BodyIndex>& awake, const BodySet& bodies, const StepContext& context) {
  Balance sum;
  for (BodyIndex body : awake) {
    const SolvedMotion& s = context.solved[body];
    if (s.rest) continue;
    addBody(sum, bodies.mass[body], bodies.motion[body].position + s.d, s.velocity,
            bodies.worldInvInertia(body) * s.angularMomentum, s.angularMomentum);
  }
  return sum;
}

void bookSolved(BalanceChange& cause, const BodySet& bodies, const std::vector<BodyIndex>& awake,
                const StepContext& context, LedgerState& state) {
  state.book(cause, state.moving(solvedBalance(awake, bodies, context)));
}

void LedgerState::book(BalanceChange& cause, const Balance& after) {
  cause += after - now;
  now = after;
}
void LedgerState::bookElastic(BalanceChange& cause, double after) {
  cause.elastic += after - now.elastic;
  now.elastic = after;
}
Balance LedgerState::moving(Balance sum) const {
  sum.potential = now.potential;
  sum.elastic = now.elastic;
  return sum;
}

}  // namespace brickfall
