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
      return bodies_.mass[body].invMass + dot(lever, bodies_.worldInvInertia(body) * lever);
    };
    return 1 / (inverse(a_, armA_) + inverse(b_, armB_));
  }
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
    bodies_.motion[body].linearVelocity += impulse * bodies_.mass[body].invMass;
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

}  // namespace

void ContactRows::giveBlows(const std::pmr::vector<char>& yielding, double dt, Ties& ties, BodySet& bodies,
                            const StepContext& context, Blows& blows) const {
  for (std::size_t k = 0; k < size(); k++) {
    if (!yielding[records[k].bodyA] && !yielding[records[k].bodyB]) continue;
    Contact& c = ties.contacts.contacts[contactOf[k]];
    const ContactGeometry& g = ties.contacts.geometry[contactOf[k]];
    const BodyMotion& a = bodies.motion[c.bodyA];
    const Vec3 n = a.orientation * g.normal, at = a.position + a.orientation * g.centre;
    Pair pair(bodies, c.bodyA, c.bodyB, at);
    const double speed = dot(n, pair.velocity()), unit = scaleOfPair(c, context).speed;
    if (!(-speed > context.settings.restingApproachSpeed * unit)) continue;
    const std::uint32_t points = closing(c, speed, dt);
    if (points == 0) continue;
    const bool rebounds = -speed > context.settings.restitutionSpeed * unit;
    const double impulse = -speed * (rebounds ? 1 + double(c.restitution) : 1) * pair.massAlong(n);
    pair.push(n * impulse, blows.change);
    // What rubs, at most until it slides no more.
    Vec3 slide = pair.velocity();
    slide -= n * dot(n, slide);
    double rubbed = 0;
    Vec3 along;
    if (const double fast = length(slide); fast > 0) {
      along = slide * (-1 / fast);
      rubbed = std::min(double(c.friction) * impulse, fast * pair.massAlong(along));
      pair.push(along * rubbed, blows.change);
    }
    blows.impacts.push_back({c.bodyA, c.bodyB, at, n, -speed, impulse});
    const Vec3 t1 = a.orientation * g.tangent1, t2 = cross(n, t1), friction = along * rubbed;
    double count = 0;
    for (int i = 0; i < c.count; i++) count += points >> i & 1;
    const double share = 1 / (count * context.dt);
    for (int i = 0; i < c.count; i++)
      if (points >> i & 1)
        addHit(c.points, i, float(impulse * share), float(dot(friction, t1) * share), float(dot(friction, t2) * share));
    ties.contacts.strike(contactOf[k]);
  }
}

}  // namespace brickfall
