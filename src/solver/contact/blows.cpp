// Contacts that close within the step on a body that mortar holds (solver/blows.h).
#include <algorithm>
#include <cmath>

#include "solver/contact/stiffness.h"

namespace brickfall {

namespace {

// Two bodies at a point, and what an impulse does to them.
class Pair {
 public:
  Pair(BodySet& bodies, BodyIndex a, BodyIndex b, Vec3 at) : bodies_(bodies), a_(a), b_(b), at_(at) {}

  // m/s, of B against A at the point.
  Vec3 velocity() const { return velocityAgainst(bodies_.motion[a_], bodies_.motion[b_], armA_, armB_); }
  // kg: an impulse along `axis` changes the velocity along it by impulse / mass.
  double massAlong(Vec3 axis) const {
    const double both = inverse(a_, armA_, axis) + inverse(b_, armB_, axis);
    return both > 0 ? 1 / both : 0;  // 0: locks let neither give way
  }
  // 1/kg, of A or B: an impulse along `axis` changes its velocity along it by impulse x this.
  double inverse(bool ofB, Vec3 axis) const { return ofB ? inverse(b_, armB_, axis) : inverse(a_, armA_, axis); }
  // J: of their motions along an axis, as far as an impulse there can stop them.
  double energyAlong(Vec3 axis) const {
    auto of = [&](BodyIndex body, Vec3 arm) {
      const double inverse = this->inverse(body, arm, axis);
      const double speed =
          dot(axis, bodies_.motion[body].linearVelocity + cross(bodies_.motion[body].angularVelocity, arm));
      return inverse > 0 ? 0.5 * speed * speed / inverse : 0.0;
    };
    return of(a_, armA_) + of(b_, armB_);
  }
  Vec3 at() const { return at_; }
  void push(Vec3 impulse, BalanceChange& change) {
    const double before = energy();
    pushOne(a_, armA_, -impulse, change);
    pushOne(b_, armB_, impulse, change);
    change.energy += energy() - before;
  }

 private:
  double inverse(BodyIndex body, Vec3 arm, Vec3 axis) const {
    const Vec3 lever = cross(arm, axis);
    const BodyMass& mass = bodies_.mass[body];
    const double gives = mass.locks == 0 ? 1 : dot(axis, bodies_.freeWay(body, axis));
    return mass.invMass * gives + dot(lever, bodies_.worldInvInertia(body) * lever);
  }
  double energy() const { return energyOf(a_) + energyOf(b_); }
  double energyOf(BodyIndex body) const { return bodies_.mass[body].invMass > 0 ? bodies_.kineticEnergy(body) : 0.0; }
  void pushOne(BodyIndex body, Vec3 arm, Vec3 impulse, BalanceChange& change) {
    if (!(bodies_.mass[body].invMass > 0)) return;
    bodies_.motion[body].linearVelocity += bodies_.freeWay(body, impulse * bodies_.mass[body].invMass);
    bodies_.motion[body].angularVelocity += bodies_.worldInvInertia(body) * cross(arm, impulse);
    change.linear += impulse;
    change.angular += cross(at_, impulse);
  }

  BodySet& bodies_;
  BodyIndex a_, b_;
  Vec3 at_, armA_ = at_ - bodies_.motion[a_].position, armB_ = at_ - bodies_.motion[b_].position;
};

// Bits of the points that would close within the step.
std::uint32_t closing(const Contact& c, double speed, double dt) {
  std::uint32_t out = 0;
  for (int i = 0; i < c.count; i++) {
    if (c.points.forceN[i] > 0) return 0;
    if (double(c.points.gap[i]) + speed * dt < 0) out |= 1u << i;
  }
  return out;
}

//! of the energy that pressing with the joints' force crushes | too small: light balls break out what they cannot
//! | too large: heavy balls do not
constexpr double kCrushed = 1.4;  // the force rises on while joints give way: by a calculation in steps of 0.2 us

// A contact that closes within the step.
struct Closing {
  double time = 0;  // s, from the start of the step
  std::size_t row = 0;
};

Pair pairAt(const Contact& c, const ContactGeometry& g, BodySet& bodies) {
  const BodyMotion& a = bodies.motion[c.bodyA];
  return {bodies, c.bodyA, c.bodyB, a.position + a.orientation * g.centre};
}
Vec3 normalOf(const Contact& c, const ContactGeometry& g, const BodySet& bodies) {
  return bodies.motion[c.bodyA].orientation * g.normal;
}

// m, world: the places of the deepest point on A and on B.
std::pair<Vec3, Vec3> nearest(const Contact& c, const ContactGeometry& g, const BodySet& bodies) {
  const BodyMotion &a = bodies.motion[c.bodyA], &b = bodies.motion[c.bodyB];
  const auto i = std::min_element(c.points.gap, c.points.gap + c.count) - c.points.gap;
  return {a.position + a.orientation * g.anchorA[i], b.position + b.orientation * g.anchorB[i]};
}

// A body that has struck what is held goes on no faster along its way than this leaves it.
struct Brake {
  BodyIndex body = kNoIndex;
  Vec3 along;       // unit
  double left = 1;  // of its velocity along
};

// Normals are those of the start of the step. Whether the body, as it moves now, comes as near to the place that it
// would strike as it is large there: the other's point nearest to it now.
bool comesTo(BodyIndex body, BodyIndex other, Vec3 own, Vec3 place, const BodySet& bodies, double dt,
             const std::pmr::vector<Brake>& brakes) {
  const BodyMotion &m = bodies.motion[body], &o = bodies.motion[other];
  const Vec3 from = m.position - place;
  Vec3 velocity = m.linearVelocity - o.linearVelocity - cross(o.angularVelocity, place - o.position);
  for (const Brake& brake : brakes)
    if (brake.body == body) velocity -= brake.along * ((1 - brake.left) * dot(brake.along, m.linearVelocity));
  const double square = lengthSquared(velocity);
  const double time = square > 0 ? std::clamp(-dot(from, velocity) / square, 0.0, dt) : 0.0;
  return length(from + velocity * time) < (1 + kShapesRound) * length(own - m.position);
}

// Stops what closes, with its rebound, and rubs at most until it slides no more.
TieImpact strikePair(Contact& c, const ContactGeometry& g, double speed, std::uint32_t points, BodySet& bodies,
                     const StepContext& context, BalanceChange& change) {
  Pair pair = pairAt(c, g, bodies);
  const Vec3 n = normalOf(c, g, bodies);
  const bool rebounds = -speed > context.settings.restitutionSpeed * scaleOfPair(c, context).speed;
  const double impulse = -speed * (rebounds ? 1 + double(c.restitution) : 1) * pair.massAlong(n);
  pair.push(n * impulse, change);
  Vec3 slide = pair.velocity(), friction;
  slide -= n * dot(n, slide);
  if (const double fast = length(slide); fast > 0) {
    const Vec3 along = slide * (-1 / fast);
    friction = along * std::min(double(c.friction) * impulse, fast * pair.massAlong(along));
    pair.push(friction, change);
  }
  const Vec3 t1 = bodies.motion[c.bodyA].orientation * g.tangent1, t2 = cross(n, t1);
  double count = 0;
  for (int i = 0; i < c.count; i++) count += points >> i & 1;
  const double share = 1 / (count * context.dt);
  for (int i = 0; i < c.count; i++)
    if (points >> i & 1)
      addHit(c.points, i, float(impulse * share), float(dot(friction, t1) * share), float(dot(friction, t2) * share));
  return {c.bodyA, c.bodyB, pair.at(), n, -speed, impulse, c.shapeA, c.shapeB};
}

// Gives the blows of an island.
class Striking {
 public:
  Striking(const Held& held, double dt, Ties& ties, BodySet& bodies, const StepContext& context, Blows& blows)
      : held_(held), dt_(dt), contacts_(ties.contacts), bodies_(bodies), context_(context), blows_(blows) {}

  bool isHeld(RowEnds ends) const { return held_.bodies[ends.a] || held_.bodies[ends.b]; }
  // What it hit at its moment, in an earlier part of the step.
  void takeStruck(ContactIndex contact, RowEnds ends) {
    Contact& c = contacts_.contacts[contact];
    if (!c.struck) return;
    crush(c, contacts_.geometry[contact], ends);
    brake(c, contacts_.geometry[contact], ends);
  }
  // s: when it closes. Below 0: not within the step.
  double closingTime(ContactIndex contact, RowEnds ends) const {
    const Contact& c = contacts_.contacts[contact];
    const double speed = speedOf(c, contacts_.geometry[contact]);
    if (closing(c, speed, dt_) == 0 || !strikes(c, contacts_.geometry[contact], speed, ends)) return -1;
    return std::max(0.0, double(*std::min_element(c.points.gap, c.points.gap + c.count))) / -speed;
  }
  void strike(ContactIndex contact, RowEnds ends) {
    Contact& c = contacts_.contacts[contact];
    const ContactGeometry& g = contacts_.geometry[contact];
    const auto [onA, onB] = nearest(c, g, bodies_);
    if (!comes(ends.a, c.bodyA, c.bodyB, onA, onB) || !comes(ends.b, c.bodyB, c.bodyA, onB, onA)) return;
    const double speed = speedOf(c, g);
    const std::uint32_t points = closing(c, speed, dt_);
    if (points == 0 || !strikes(c, g, speed, ends)) return;
    crush(c, g, ends);
    blows_.impacts.push_back(strikePair(c, g, speed, points, bodies_, context_, blows_.change));
    contacts_.strike(contact);
    brake(c, g, ends);
  }

 private:
  double speedOf(const Contact& c, const ContactGeometry& g) const {
    return dot(normalOf(c, g, bodies_), pairAt(c, g, bodies_).velocity());
  }
  // Faster than what begins to rest. What is heavy strikes slower, too, if it has the energy to break what it meets.
  bool strikes(const Contact& c, const ContactGeometry& g, double speed, RowEnds ends) const {
    if (-speed > context_.settings.restingApproachSpeed * scaleOfPair(c, context_).speed) return true;
    if (!(speed < 0) || held_.bodies[ends.a] == held_.bodies[ends.b]) return false;
    const bool strikesA = held_.bodies[ends.a];
    const Vec3 n = normalOf(c, g, bodies_);
    const Pair pair = pairAt(c, g, bodies_);
    if (!(pair.inverse(strikesA, n) * kHeavier <= pair.inverse(!strikesA, n))) return false;
    return pair.energyAlong(n) > held_.holding(strikesA ? ends.a : ends.b, n).energy;
  }
  bool comes(std::uint32_t local, BodyIndex body, BodyIndex other, Vec3 own, Vec3 place) const {
    return held_.bodies[local] || comesTo(body, other, own, place, bodies_, dt_, brakes_);
  }
  // J: crushed before the joints of the struck body give way. It stands until the blow presses with their force. What
  // that takes is the striker's, of which a blow leaves a share.
  double crushed(const Contact& c, const Pair& pair, Vec3 n, bool strikesA, const Holding& held) const {
    const double struck = pair.inverse(!strikesA, n), striker = pair.inverse(strikesA, n);
    const double goesOn = struck + striker > 0 ? struck / (struck + striker) : 1;
    return c.crushing > 0 ? kCrushed * goesOn * held.force * held.force / double(c.crushing) : 0.0;
  }
  // A place is crushed once.
  void crush(Contact& c, const ContactGeometry& g, RowEnds ends) {
    if (c.crushed) return;
    c.crushed = true;
    if (!(c.crushing > 0)) return;
    const Vec3 n = normalOf(c, g, bodies_);
    for (bool strikesA : {true, false}) {
      const std::uint32_t body = strikesA ? ends.a : ends.b;
      if (!held_.bodies[body]) continue;
      const Holding held = held_.holding(body, n);
      const double more = crushed(c, pairAt(c, g, bodies_), n, strikesA, held);
      blows_.crushes.push_back({body, held.energy > 0 ? 1 + more / held.energy : 1});
    }
  }
  // What holds the struck body takes its energy from both, before the striker comes further.
  void brake(const Contact& c, const ContactGeometry& g, RowEnds ends) {
    if (held_.bodies[ends.a] && held_.bodies[ends.b]) return;
    const bool strikesA = held_.bodies[ends.a];
    const Vec3 n = normalOf(c, g, bodies_);
    const Pair pair = pairAt(c, g, bodies_);
    const Holding held = held_.holding(strikesA ? ends.a : ends.b, n);
    const double energy = pair.energyAlong(n), taken = held.energy + crushed(c, pair, n, strikesA, held);
    brakes_.push_back({strikesA ? c.bodyB : c.bodyA, n, taken < energy ? std::sqrt(1 - taken / energy) : 0.0});
  }

  const Held& held_;
  const double dt_;
  ContactSet& contacts_;
  BodySet& bodies_;
  const StepContext& context_;
  Blows& blows_;
  std::pmr::vector<Brake> brakes_{held_.bodies.get_allocator()};
};

}  // namespace

// In the order of their times: what a first blow has turned aside or slowed down may strike nothing else.
void ContactRows::giveBlows(const Held& held, double dt, Ties& ties, BodySet& bodies, const StepContext& context,
                            Blows& blows) const {
  Striking striking(held, dt, ties, bodies, context, blows);
  std::pmr::vector<Closing> order(held.bodies.get_allocator());
  auto endsOf = [&](std::size_t k) { return RowEnds{records[k].bodyA, records[k].bodyB}; };
  for (std::size_t k = 0; k < size(); k++) {
    if (!striking.isHeld(endsOf(k))) continue;
    striking.takeStruck(tieOf[k], endsOf(k));
    if (!(dt > 0)) continue;
    if (const double time = striking.closingTime(tieOf[k], endsOf(k)); time >= 0) order.push_back({time, k});
  }
  std::sort(order.begin(), order.end(),
            [](const Closing& a, const Closing& b) { return a.time != b.time ? a.time < b.time : a.row < b.row; });
  for (const Closing& at : order) striking.strike(tieOf[at.row], endsOf(at.row));
}

}  // namespace brickfall
