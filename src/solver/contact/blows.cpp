// Contacts that close within the step on a body that mortar holds (solver/blows.h).
#include <algorithm>

#include "solver/contact/stiffness.h"
#include "solver/island.h"

namespace brickfall {

namespace {

// Two bodies at a point, and what an impulse does to them.
class Pair {
 public:
  Pair(BodySet& bodies, BodyIndex a, BodyIndex b, Vec3 at)
      : bodies_(bodies),
        a_(a),
        b_(b),
        at_(at),
        armA_(at - bodies.motion[a].position),
        armB_(at - bodies.motion[b].position) {}

  // m/s, of B against A at the point.
  Vec3 velocity() const {
    const BodyMotion &a = bodies_.motion[a_], &b = bodies_.motion[b_];
    return b.linearVelocity + cross(b.angularVelocity, armB_) - a.linearVelocity - cross(a.angularVelocity, armA_);
  }
  // kg: an impulse along `axis` changes the velocity along it by impulse / mass.
  double massAlong(Vec3 axis) const {
    auto inverse = [&](BodyIndex body, Vec3 arm) {
      const Vec3 lever = cross(arm, axis);
      const BodyMass& mass = bodies_.mass[body];
      const double gives = mass.locks == 0 ? 1 : dot(axis, bodies_.freeWay(body, axis));
      return mass.invMass * gives + dot(lever, bodies_.worldInvInertia(body) * lever);
    };
    const double both = inverse(a_, armA_) + inverse(b_, armB_);
    return both > 0 ? 1 / both : 0;  // 0: locks let neither give way
  }
  Vec3 at() const { return at_; }
  void push(Vec3 impulse, BalanceChange& change) {
    const double before = energy();
    pushOne(a_, armA_, -impulse, change);
    pushOne(b_, armB_, impulse, change);
    change.energy += energy() - before;
  }

 private:
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
  Vec3 at_, armA_, armB_;
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

//! of the way from its centre to where it touches | too small: rounding makes it miss what it meets head on
//! | too large: a body strikes what it only passes
constexpr double kPassing = 1e-3;

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

// Normals are those of the start of the step. Whether the body, as it moves now, comes as near to the place that it
// would strike as it is large there: the other's point nearest to it now.
bool comesTo(BodyIndex body, BodyIndex other, Vec3 own, Vec3 place, const BodySet& bodies, double dt) {
  const BodyMotion &m = bodies.motion[body], &o = bodies.motion[other];
  const Vec3 from = m.position - place;
  const Vec3 velocity = m.linearVelocity - o.linearVelocity - cross(o.angularVelocity, place - o.position);
  const double square = lengthSquared(velocity);
  const double time = square > 0 ? std::clamp(-dot(from, velocity) / square, 0.0, dt) : 0.0;
  return length(from + velocity * time) < (1 + kPassing) * length(own - m.position);
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

}  // namespace

// In the order of their times: what a first blow has turned aside or slowed down may strike nothing else.
void ContactRows::giveBlows(const std::pmr::vector<char>& yielding, double dt, Ties& ties, BodySet& bodies,
                            const StepContext& context, Blows& blows) const {
  const auto memory = yielding.get_allocator();
  std::pmr::vector<Closing> order(memory);
  auto speedOf = [&](const Contact& c, const ContactGeometry& g) {
    return dot(normalOf(c, g, bodies), pairAt(c, g, bodies).velocity());
  };
  // A place is crushed once.
  auto crush = [&](std::size_t k, Contact& c, Vec3 along) {
    if (c.crushed) return;
    c.crushed = true;
    for (std::uint32_t body : {records[k].bodyA, records[k].bodyB})
      if (yielding[body] && c.crushing > 0) blows.crushes.push_back({body, along, double(c.crushing)});
  };
  for (std::size_t k = 0; k < size(); k++) {
    if (!yielding[records[k].bodyA] && !yielding[records[k].bodyB]) continue;
    Contact& c = ties.contacts.contacts[contactOf[k]];
    const ContactGeometry& g = ties.contacts.geometry[contactOf[k]];
    if (c.struck) crush(k, c, normalOf(c, g, bodies));  // at its moment, in an earlier part of the step
    if (!(dt > 0)) continue;
    const double speed = speedOf(c, g);
    if (!(-speed > context.settings.restingApproachSpeed * scaleOfPair(c, context).speed)) continue;
    if (closing(c, speed, dt) == 0) continue;
    const double gap = *std::min_element(c.points.gap, c.points.gap + c.count);
    order.push_back({std::max(0.0, gap) / -speed, k});
  }
  std::sort(order.begin(), order.end(),
            [](const Closing& a, const Closing& b) { return a.time != b.time ? a.time < b.time : a.row < b.row; });
  for (const Closing& at : order) {
    Contact& c = ties.contacts.contacts[contactOf[at.row]];
    const ContactGeometry& g = ties.contacts.geometry[contactOf[at.row]];
    const RowEnds ends = RowEnds{records[at.row].bodyA, records[at.row].bodyB};
    auto comes = [&](std::uint32_t local, BodyIndex body, BodyIndex other, Vec3 own, Vec3 place) {
      return yielding[local] || comesTo(body, other, own, place, bodies, dt);
    };
    const auto [onA, onB] = nearest(c, g, bodies);
    if (!comes(ends.a, c.bodyA, c.bodyB, onA, onB) || !comes(ends.b, c.bodyB, c.bodyA, onB, onA)) continue;
    const double speed = speedOf(c, g);
    const std::uint32_t points = closing(c, speed, dt);
    if (points == 0 || !(-speed > context.settings.restingApproachSpeed * scaleOfPair(c, context).speed)) continue;
    crush(at.row, c, normalOf(c, g, bodies));
    blows.impacts.push_back(strikePair(c, g, speed, points, bodies, context, blows.change));
    ties.contacts.strike(contactOf[at.row]);
  }
}

}  // namespace brickfall
