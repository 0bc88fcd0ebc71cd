// The ledger of momentum and energy: what the dynamic bodies have is summed up between the stages, and what a stage
// changed is booked on the cause that acts in it.
//
// Angular momentum is that about the world's origin. Until the solve it is taken where bodies are, from then on where they
// will be: a contact's impulse acts at the start of the step, velocities hold at its end. What lies between the two is
// the way times the momentum, d x m v: zero where d = v h; where a body moves by the mean of two velocities it is what
// its impulses give for acting midway, booked on gravity in flight and on what holds the body otherwise.
#include "world/ledger.h"

#include "solver/joint_energy.h"
#include "world/world_impl.h"

namespace brickfall {

namespace {

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

// Impulse of a contact with something fixed or kinematic on the island's body, about the world's origin; its work is that
// of the partner's motion.
BalanceChange impulseOf(const Contact& c, const ContactRecord& r, const BodySet& bodies, bool onB, double dt) {
  BalanceChange out;
  Vec3 n = toDouble(r.n), t1 = toDouble(r.t1), t2 = cross(n, t1);
  Vec3 centre = bodies.motion[c.bodyA].position + toDouble(r.armA);
  const BodyMotion& partner = bodies.motion[onB ? c.bodyA : c.bodyB];
  double sign = onB ? dt : -dt;
  for (int i = 0; i < c.count; i++) {
    Vec3 impulse = (n * double(c.forceN[i]) + t1 * double(c.force1[i]) + t2 * double(c.force2[i])) * sign;
    Vec3 point = centre + t1 * double(r.s1[i]) + t2 * double(r.s2[i]);
    Vec3 velocity = partner.linearVelocity + cross(partner.angularVelocity, point - partner.position);
    out += {impulse, cross(point, impulse), dot(impulse, velocity)};
  }
  return out;
}

BalanceChange heldImpulses(const Island& island, const BodySet& bodies, const ContactSet& contacts, double dt) {
  BalanceChange sum;
  for (std::size_t k = 0; k < island.records.size(); k++) {
    const ContactRecord& r = island.records[k];
    bool partnerA = r.bodyA >= island.bodies.size(), partnerB = r.bodyB >= island.bodies.size();
    if (partnerA || partnerB) sum += impulseOf(contacts.contacts[island.contacts[k]], r, bodies, partnerA, dt);
  }
  return sum;
}

// Of the bodies for which free motion was predicted: what they had before damping and drag.
template <class Visit> void forEachPrepared(const IslandSet& islands, Visit visit) {
  for (BodyIndex body : islands.single) visit(body);
  for (const auto& island : islands.awake)
    if (!island->settled)
      for (BodyIndex body : island->bodies) visit(body);
}

Balance atStart(const IslandSet& islands, const StepContext& context) {
  Balance sum;
  const BodySet& bodies = *context.bodies;
  forEachPrepared(islands, [&](BodyIndex body) {
    const FreeMotion& free = context.free[body];
    addBody(sum, bodies.mass[body], bodies.motion[body].position, free.startVelocity, free.startSpin,
            bodies.worldInertia(body) * free.startSpin);
  });
  return sum;
}

// As the solve left it, at the end of the step's ways.
template <class Bodies> Balance solvedBalance(const Bodies& awake, const StepContext& context) {
  Balance sum;
  const BodySet& bodies = *context.bodies;
  for (BodyIndex body : awake) {
    const SolvedMotion& s = context.solved[body];
    if (s.rest) continue;
    addBody(sum, bodies.mass[body], bodies.motion[body].position + s.d, s.velocity,
            bodies.worldInvInertia(body) * s.angularMomentum, s.angularMomentum);
  }
  return sum;
}

}  // namespace

double World::Impl::elasticNow() const {
  double sum = 0;
  for (const auto* pairs : {&contacts.pairs, &contacts.asleep})
    for (const CandidatePair& pair : *pairs)
      if (pair.contact != kNoIndex) sum += elasticEnergy(contacts.contacts[pair.contact], context);
  return sum;
}

Balance World::Impl::balanceNow() const {
  Balance sum;
  sum.elastic = elasticNow();
  for (BodyIndex i = 0; i < bodies.slots(); i++) {
    if (!bodies.alive(i) || bodies.data[i].type != BodyType::dynamic) continue;
    const BodyMotion& m = bodies.motion[i];
    addBody(sum, bodies.mass[i], m.position, m.linearVelocity, m.angularVelocity,
            bodies.worldInertia(i) * m.angularVelocity);
    sum.potential -= bodies.mass[i].mass * bodies.data[i].gravityScale * dot(def.gravity, m.position);
  }
  return sum;
}

BalanceChange World::Impl::bookJoints() const {
  BalanceChange out;
  double held = 0;
  for (const CandidatePair& pair : contacts.asleep)
    if (pair.contact != kNoIndex) held += elasticEnergy(contacts.contacts[pair.contact], context);
  for (const auto& island : islands.awake) {
    JointWork joints = jointWork(*island, context);
    out.energy += joints.work;
    held += joints.elastic;
  }
  out.elastic = held - ledgerState.now.elastic;
  return out;
}

void World::Impl::bookStage(std::optional<Stage> stage) {
  LedgerState& s = ledgerState;
  double dt = context.dt;
  if (!stage) {
    s.now = balanceNow();
    s.quarantined = report.quarantined.size();
    if (substep > 0) return;
    StepLedger fresh;
    fresh.before = s.now;
    if (s.begun) fresh.outside = s.now - s.last;
    report.ledger = fresh;
    return;
  }
  StepLedger& ledger = *report.ledger;
  auto book = [&](BalanceChange& cause, const Balance& now) {
    cause += now - s.now;
    s.now = now;
  };
  auto bookElastic = [&](BalanceChange& cause, double now) {
    cause.elastic += now - s.now.elastic;
    s.now.elastic = now;
  };
  auto moving = [&](Balance sum) {  // as `sum` moves, while places and joints stay as they are
    sum.potential = s.now.potential;
    sum.elastic = s.now.elastic;
    return sum;
  };
  if (*stage == Stage::islands) {
    Balance now = balanceNow();
    bookElastic(ledger.remade, now.elastic);
    book(ledger.quarantine, now);
  } else if (*stage == Stage::prepare) {
    book(ledger.stopped, moving(atStart(islands, context)));
    Balance start = balanceNow();
    bookElastic(ledger.renewed, start.elastic);
    book(ledger.damping, start);
    s.push = {};
    BalanceChange gravity, forces;
    for (BodyIndex body : awake) {
      const BodyData& data = bodies.data[body];
      Vec3 at = bodies.motion[body].position;
      Vec3 weight = def.gravity * (bodies.mass[body].mass * data.gravityScale * dt), force = data.force * dt;
      gravity += {weight, cross(at, weight), 0};
      forces += {force, cross(at, force) + data.torque * dt, 0};
    }
    ledger.gravity += gravity;
    ledger.forces += forces;
    s.push += gravity;
    s.push += forces;
  } else if (*stage == Stage::store) {
    BalanceChange held;
    for (const auto& island : islands.awake) held += heldImpulses(*island, bodies, contacts, dt);
    Vec3 inFlight, inContact;
    for (BodyIndex body : awake) {
      const SolvedMotion& m = context.solved[body];
      (m.flying ? inFlight : inContact) += cross(m.d, m.velocity * bodies.mass[body].mass);
    }
    held.angular += inContact;
    ledger.held += held;
    ledger.gravity.angular += inFlight;
    Balance now = moving(solvedBalance(awake, context));
    BalanceChange joints = bookJoints();
    ledger.solve += now - s.now - s.push - held - BalanceChange{{}, inFlight, joints.energy};
    s.now = now;
    s.now.elastic += joints.elastic;
    ledger.contacts += joints;
  } else if (*stage == Stage::restitution) {
    book(ledger.rebound, moving(solvedBalance(awake, context)));
  } else if (*stage == Stage::integrate) {
    double work = 0;
    for (BodyIndex body : pushed)
      work +=
          dot(bodies.data[body].force, context.solved[body].d) + dot(bodies.data[body].torque, context.solved[body].th);
    Balance now = balanceNow();
    double fallen = now.potential - s.now.potential;
    ledger.forces.energy += work;
    ledger.solve.energy += fallen - work;
    s.now.potential = now.potential;
    bool quarantined = report.quarantined.size() > s.quarantined;
    bookElastic(quarantined ? ledger.quarantine : ledger.renewed, now.elastic);
    book(quarantined ? ledger.quarantine : ledger.integrate, now);
    ledger.after = s.last = now;
    s.begun = true;
  }
}

}  // namespace brickfall
