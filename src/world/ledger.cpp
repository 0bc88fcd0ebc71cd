// The ledger of momentum and energy: what the dynamic bodies have is summed up between the stages, and what a stage
// changed is booked on the cause that acts in it.
//
// Angular momentum is that about the world's origin. Until the solve it is taken where bodies are, from then on where they
// will be: a contact's impulse acts at the start of the step, velocities hold at its end. What lies between the two is
// the way times the momentum, d x m v: zero where d = v h; where a body moves by the mean of two velocities it is what
// its impulses give for acting midway, booked on gravity in flight and on what holds the body otherwise.
#include "world/ledger.h"

#include "solver/contact/energy.h"
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
    Vec3 impulse =
        (n * double(c.points.forceN[i]) + t1 * double(c.points.force1[i]) + t2 * double(c.points.force2[i])) * sign;
    Vec3 point = centre + t1 * double(r.s1[i]) + t2 * double(r.s2[i]);
    Vec3 velocity = partner.linearVelocity + cross(partner.angularVelocity, point - partner.position);
    out += {impulse, cross(point, impulse), dot(impulse, velocity)};
  }
  return out;
}

BalanceChange heldImpulses(const Island& island, const BodySet& bodies, const ContactSet& contacts, double dt) {
  BalanceChange sum;
  for (std::size_t k = 0; k < island.rows.contacts.records.size(); k++) {
    const ContactRecord& r = island.rows.contacts.records[k];
    bool partnerA = r.bodyA >= island.bodies.size(), partnerB = r.bodyB >= island.bodies.size();
    if (partnerA || partnerB)
      sum += impulseOf(contacts.contacts[island.rows.contacts.contactOf[k]], r, bodies, partnerA, dt);
  }
  return sum;
}

// Of the bodies for which free motion was predicted: what they had before damping and drag.
template <class Visit> void forEachPrepared(const IslandSet& islands, Visit visit) {
  for (BodyIndex body : islands.single) visit(body);
  for (const auto& island : islands.awake)
    if (!island->settled())
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

void World::Impl::bookStage(std::optional<Stage> stage) {
  if (!stage) return bookStart();
  switch (*stage) {
    case Stage::islands:
      return bookContacts();
    case Stage::prepare:
      return bookFreeMotion();
    case Stage::store:
      return bookSolve();
    case Stage::restitution:
      return ledgerState.book(report.ledger->rebound, ledgerState.moving(solvedBalance(awake, context)));
    case Stage::integrate:
      return bookPoses();
    default:
      return;
  }
}

void World::Impl::bookStart() {
  LedgerState& s = ledgerState;
  s.now = balanceNow();
  s.quarantined = report.quarantined.size();
  if (substep > 0) return;
  StepLedger fresh;
  fresh.before = s.now;
  if (s.begun) fresh.outside = s.now - s.last;
  report.ledger = fresh;
}

void World::Impl::bookContacts() {
  Balance now = balanceNow();
  ledgerState.bookElastic(report.ledger->remade, now.elastic);
  ledgerState.book(report.ledger->quarantine, now);
}

void World::Impl::bookFreeMotion() {
  LedgerState& s = ledgerState;
  StepLedger& ledger = *report.ledger;
  s.book(ledger.stopped, s.moving(atStart(islands, context)));
  Balance start = balanceNow();
  s.bookElastic(ledger.renewed, start.elastic);
  s.book(ledger.damping, start);
  BalanceChange gravity, forces;
  double dt = context.dt;
  for (BodyIndex body : awake) {
    const BodyData& data = bodies.data[body];
    Vec3 at = bodies.motion[body].position;
    Vec3 weight = def.gravity * (bodies.mass[body].mass * data.gravityScale * dt), force = data.force * dt;
    gravity += {weight, cross(at, weight), 0};
    forces += {force, cross(at, force) + data.torque * dt, 0};
  }
  ledger.gravity += gravity;
  ledger.forces += forces;
  s.push = gravity;
  s.push += forces;
}

BalanceChange World::Impl::jointsNow() const {
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

void World::Impl::bookSolve() {
  LedgerState& s = ledgerState;
  StepLedger& ledger = *report.ledger;
  BalanceChange held;
  for (const auto& island : islands.awake) held += heldImpulses(*island, bodies, contacts, context.dt);
  Vec3 inFlight, inContact;
  for (BodyIndex body : awake) {
    const SolvedMotion& m = context.solved[body];
    (m.flying ? inFlight : inContact) += cross(m.d, m.velocity * bodies.mass[body].mass);
  }
  held.angular += inContact;
  ledger.held += held;
  ledger.gravity.angular += inFlight;
  Balance now = s.moving(solvedBalance(awake, context));
  BalanceChange joints = jointsNow();
  ledger.solve += now - s.now - s.push - held - BalanceChange{{}, inFlight, joints.energy};
  s.now = now;
  s.now.elastic += joints.elastic;
  ledger.contacts += joints;
}

void World::Impl::bookPoses() {
  LedgerState& s = ledgerState;
  StepLedger& ledger = *report.ledger;
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
  s.bookElastic(quarantined ? ledger.quarantine : ledger.renewed, now.elastic);
  s.book(quarantined ? ledger.quarantine : ledger.integrate, now);
  ledger.after = s.last = now;
  s.begun = true;
}

}  // namespace brickfall
