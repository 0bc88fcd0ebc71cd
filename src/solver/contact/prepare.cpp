// The start of a step for the contacts of an island. They remember forces, plastic offsets and friction anchors. Here
// this memory becomes the trial force of each point at zero motion.
//
// Normal return map: a point is born with all its overlap plastic (it causes no force). An impact is soft in its first
// step. Then the point becomes stiff, and its offset is chosen so that it goes on with the force it has. Otherwise the
// soft overlap would come back as a rebound. Every step a tenth of the offset becomes real overlap again, which parts
// the bodies slowly.
//
// Friction return map: a sticking point keeps its anchor. A point that slid, or that rolls and so touches elsewhere in
// each step, gets an anchor at which its spring carries just the force it had: no jump, no creep.
#include <algorithm>
#include <cmath>
#include <optional>

#include "dynamics/point_matcher.h"
#include "solver/contact/energy.h"
#include "solver/contact/speeds.h"
#include "solver/contact/stiffness.h"

namespace brickfall {

namespace {

void updateFrame(FaceRecord& r, const Contact& c, const ContactGeometry& g, const BodySet& bodies) {
  const BodyMotion &a = bodies.motion[c.bodyA], &b = bodies.motion[c.bodyB];
  Vec3 armA = a.orientation * g.centre;
  r.n = toFloat(a.orientation * g.normal);
  r.t1 = toFloat(a.orientation * g.tangent1);
  r.armA = toFloat(armA);
  r.armB = toFloat(armA + (a.position - b.position));
  for (int i = 0; i < 4; i++) {
    r.s1[i] = c.points.s1[i];
    r.s2[i] = c.points.s2[i];
  }
}

void findApproach(const FaceRecord& r, const Contact& c, const BodySet& bodies, ContactStart& start) {
  double speeds[4] = {};
  speedsOf(r, c.count, {velocityOf(bodies.motion[c.bodyA]), velocityOf(bodies.motion[c.bodyB])}, speeds);
  for (int i = 0; i < 4; i++) {
    start.approach[i] = float(speeds[i]);
    start.gap[i] = c.points.gap[i];
  }
}

// m/s: the lowest place of a rim moves along it, as the turn makes it slope. Rolling on a side has no arc by that.
Vec3 alongRim(Vec3 w, Vec3 axis, Vec3 arm, Vec3 n, double dt) {
  const Vec3 rim = cross(axis, arm);
  const double slope = dot(n, cross(w, rim)), curved = dot(n, arm - axis * dot(axis, arm));
  return std::fabs(slope) * dt < kLargestTurn * std::fabs(curved) ? rim * (slope / curved) : Vec3{};
}

// A partner's surface goes on turning while the body goes along with it: over a step its way is an arc. For a touching
// body the way is th x arm + th x (way of the body) / 2. The solve knows the first part.
Vec3f partnersArc(const Island& island, const FaceRecord& r, const Contact& c, const BodySet& bodies) {
  auto half = [&](BodyIndex partner, BodyIndex body) {
    if (bodies.mass[partner].invMass > 0) return Vec3{};
    const double dt = island.dt;
    return cross(bodies.motion[partner].angularVelocity, bodies.motion[body].linearVelocity) * (0.5 * dt * dt);
  };
  const std::size_t own = island.bodies.size();
  return r.bodyA < own && r.bodyB < own ? Vec3f{} : toFloat(half(c.bodyB, c.bodyA) - half(c.bodyA, c.bodyB));
}

// A body alone turns about its points itself: its arms stay those of the start of the step. Each point's way is to end
// on its arc, and its velocity, once it is up to date (finish/lone_body.cpp), along the end of the arc. The place of
// touch goes on as the body rolls, another way at each end of a line. Where a rim rolls on to open points of its face
// nothing brings velocities up to date: then it is the arc of the way.
class OwnArc {
 public:
  OwnArc(const Island& island, const FaceRecord& r, const Contact& c, const BodySet& bodies, const Scale& scale)
      : ofB_(r.bodyB < island.bodies.size()), dt_(island.dt), n_(toDouble(r.n)) {
    const BodyIndex body = ofB_ ? c.bodyB : c.bodyA, partner = ofB_ ? c.bodyA : c.bodyB;
    const BodyMass& mass = bodies.mass[body];
    const Vec3 w = bodies.motion[body].angularVelocity;
    there_ = mass.invMass > 0 && !(lengthSquared(w) * dt_ * dt_ > kLargestTurn * kLargestTurn) && !mass.round;
    if (!there_) return;
    partnerSpin_ = bodies.motion[partner].angularVelocity;
    spin_ = w - partnerSpin_;
    arm_ = toDouble(ofB_ ? r.armB : r.armA);
    rim_ = c.rolls && mass.rims;
    axis_ = bodies.motion[body].orientation * mass.symmetryAxis;
    if (c.rolls && !rim_) round_ = n_ * ((ofB_ ? -1.0 : 1.0) * double(c.rollingRadius));
    if (!mass.isotropic && mass.locks == 0)
      free_ = bodies.worldInvInertia(body) * cross(bodies.worldInertia(body) * w, w);
    const SteadyChange& steady = bodies.data[body].steady;
    late_ = island.facts.partnersGo || rollsOn(c, scale) ? 0.5 : steady.swings ? 0 : 0.5 * steady.dt / dt_;
  }
  bool isThere() const { return there_; }
  // Of point i: adds its arc, and writes what that asks of forces.
  void write(const FaceRecord& r, int i, ContactStart& start) const {
    const Vec3 t1 = toDouble(r.t1), place = t1 * double(r.s1[i]) + cross(n_, t1) * double(r.s2[i]);
    const Vec3 arm = arm_ + place;
    Vec3 goes = cross(partnerSpin_, arm) + cross(spin_, arm - round_);  // m/s: of the place, against the centre of mass
    if (rim_) goes += alongRim(spin_, axis_, arm, n_, dt_);
    const double sign = ofB_ ? 1 : -1;
    const Vec3 bends = cross(spin_, goes) * sign, turns = cross(free_, arm) * sign;  // m/s2
    const Vec3f arc = inFace(r, toFloat((bends * (1 - late_) + turns * (0.5 - late_)) * (dt_ * dt_)));
    start.arc[i] += arc.x, start.arc1[i] += arc.y, start.arc2[i] += arc.z;
    start.curves[i] = float(-dot(n_, bends + turns) * dt_);
  }

 private:
  bool rollsOn(const Contact& c, const Scale& scale) const {
    bool open = false;
    for (int i = 0; i < c.count; i++) open = open || double(c.points.gap[i]) > kNearlyClosed * scale.length;
    return rim_ && open;
  }

  bool ofB_, there_ = false, rim_ = false;
  double dt_, late_ = 0;         // s; of the step: velocities at its start
  Vec3 n_, partnerSpin_, spin_;  // rad/s, of the partner; against it
  Vec3 arm_, axis_, round_;      // m, of a round side: from the middle of its curvature to the place of touch
  Vec3 free_;                    // rad/s2: how the spin changes in a free turn
};

// The way of B's surface against A's in this step, as far as it lies along the face.
Vec3f runOf(const Contact& c, const FaceRecord& r, const BodySet& bodies, double dt) {
  const Vec3 run = bodies.surfaceVelocity(c.bodyB) - bodies.surfaceVelocity(c.bodyA);
  if (run == Vec3{}) return {};
  const Vec3 n = toDouble(r.n);
  return toFloat((run - n * dot(n, run)) * dt);
}

// Rules for the points of a contact at the start of a step.
struct PointRules {
  PairStiffness stiffness;
  float quietSpeed;  // m/s
  float cap;         // N
  float kept;        // of the plastic offset
  float release;     // m, of the plastic offset at least
  bool debris;       // the island is stirred up: what bears goes on bearing
  bool driven;       // by something kinematic: what that jams gives way, or it would be thrown out

  bool isQuiet(float approach) const { return approach > -quietSpeed; }
  // A point that has borne for a step is firm, unless it goes on being driven in.
  bool isFirm(const PointMemory& m, int i, float approach) const {
    return m.forceN[i] > 0 && (isQuiet(approach) || !driven);
  }
};

// Slow surfaces rest from the start; so do impacts that must be as stiff as resting points.
void startPhase(PointMemory& m, int i, float approach, const PointRules& rules) {
  m.stiffness[i] = rules.isQuiet(approach) ? rules.stiffness.full : rules.stiffness.ofImpact(approach);
  m.phase[i] = rules.stiffness.isFull(m.stiffness[i]) ? PointPhase::resting : PointPhase::impact;
}

// An impact has borne for a step, an island has calmed down, or steps have become shorter: the point is softer than one
// that rests. The soft spring of an impact is made for the inertia of its two bodies, which it stops in a step: what
// closes after that has more behind it.
bool isTooSoft(const PointMemory& m, int i, float approach, const PointRules& rules) {
  return m.phase[i] != PointPhase::fresh && rules.isFirm(m, i, approach) && !rules.stiffness.isFull(m.stiffness[i]);
}
// The point starts anew, at rest, but goes on with the force that it has. One that no longer closes keeps at most that
// of a sudden load.
void stiffen(PointMemory& m, int i, float approach, const PointRules& rules) {
  startPhase(m, i, 0, rules);
  if (rules.isQuiet(approach) && m.forceN[i] > rules.cap) scaleForces(m, i, rules.cap / m.forceN[i]);
  m.offset[i] = std::min(0.0f, m.gap[i] + m.forceN[i] / m.stiffness[i]);
}

// Here, too, a resting point goes on with the force that it has, as far as there is overlap for it. Otherwise debris
// would sink each time that it is stirred, be lifted when it lies again, and never come to rest. What is more than the
// multiplier is a blow's, most of all in a short part of a step: with that the soft point holds no more energy than the
// stiff one did.
void soften(PointMemory& m, int i, const PointRules& rules) {
  const float energy = rules.stiffness.full / m.stiffness[i];  // of one force
  const float share = rules.debris ? 1 : std::sqrt(energy);
  const float lasts = std::min(m.forceN[i], std::max(m.multiplierN[i], m.forceN[i] * share));
  m.stiffness[i] = rules.stiffness.full;
  if (m.forceN[i] > 0) m.offset[i] = std::min(0.0f, m.gap[i] + lasts / rules.stiffness.full);
}

// Returns the gap that causes force. Overlap that is let go lifts what lies on the point, which was lost when that sank
// in: adds this work to `held` (J).
float mapNormalOffset(PointMemory& m, int i, float approach, const PointRules& rules, float& held) {
  if (rules.stiffness.isFull(m.stiffness[i])) m.phase[i] = PointPhase::resting;
  // The time step has grown, the island is calm no longer, or it has become debris.
  if (rules.stiffness.isAboveFull(m.stiffness[i])) soften(m, i, rules);
  if (m.phase[i] == PointPhase::fresh) m.offset[i] = std::min(0.0f, m.gap[i]);
  if (isTooSoft(m, i, approach, rules)) stiffen(m, i, approach, rules);
  float offset = std::min(0.0f, std::max(m.offset[i], m.gap[i]));
  m.offset[i] = std::min(0.0f, std::max(rules.kept * offset, offset + rules.release));
  held += m.multiplierN[i] * (m.offset[i] - offset);
  if (m.phase[i] == PointPhase::fresh) startPhase(m, i, approach, rules);
  return m.gap[i] - m.offset[i];
}

// A jammed body overlaps by a way that no force has made. Between bodies that mortar holds, its spring would press
// harder in each step until it splits them. More overlap than the point's last force makes, or the weight of the two,
// causes none. Returns the gap that causes force.
float ease(PointMemory& m, int i, float weight) {
  const float rest = std::max(m.forceN[i], weight);
  m.offset[i] = std::min(m.offset[i], m.gap[i] + rest / m.stiffness[i]);
  return m.gap[i] - m.offset[i];
}

void mapFrictionAnchor(Contact& c, int i, ContactGeometry& g, const FaceRecord& r, double largest,
                       const BodySet& bodies) {
  const bool keeps = c.keepsAnchor(i);
  bool tooFar = c.points.drift1[i] * c.points.drift1[i] + c.points.drift2[i] * c.points.drift2[i] > largest * largest;
  if (keeps && !tooFar) return;
  c.points.drift1[i] = keeps ? 0 : c.points.slip1[i];
  c.points.drift2[i] = keeps ? 0 : c.points.slip2[i];
  const BodyMotion &a = bodies.motion[c.bodyA], &b = bodies.motion[c.bodyB];
  Vec3 n = toDouble(r.n), t1 = toDouble(r.t1), t2 = cross(n, t1);
  Vec3 onB = b.position + b.orientation * g.anchorB[i];
  Vec3 anchor = onB - n * double(c.points.gap[i]) - t1 * double(c.points.drift1[i]) - t2 * double(c.points.drift2[i]);
  g.anchorA[i] = transposeTimes(a.orientation, anchor - a.position);
}

// Whether the friction limit follows the present force. The last force of a point sets its friction limit, unless it
// was 0 or an impact's. Otherwise the force of one step would limit the friction of another, and the two would not add
// up to mu times the impulse.
bool boundFollows(const PointMemory& m, int i, float approach, const PointRules& rules, bool debris) {
  bool held = m.multiplierN[i] >= m.forceN[i];
  return m.forceN[i] == 0 || m.phase[i] == PointPhase::impact || approach < -rules.quietSpeed ||
         (!held && (debris || isTooSoft(m, i, approach, rules)));
}

// Contacts a thousand times as stiff as inertia couple flying bodies so firmly that no solve converges. So debris is
// soft, as in an impact, until it rests. A contact that bears more than a sudden load can do still stands, though it
// shakes: storeys would sink into soft ones as into rubber. So would a ball into a still body under it, and the next
// brick's edge would brake it.
bool isDebris(const Island& island, const FaceRecord& r, const Contact& c, float cap) {
  if (!island.plan.softDebris) return false;
  for (int i = 0; i < c.count; i++)
    if (c.points.multiplierN[i] > cap) return false;
  auto moves = [&](std::uint32_t body) {
    return body < island.bodies.size() && island.speeds[body] > float(kMovingSpeed);
  };
  return c.rolls ? moves(r.bodyA) && moves(r.bodyB) : moves(r.bodyA) || moves(r.bodyB);
}

// The lane that resists rolling goes on with its last force, which is all that it remembers: a spring that gives no
// more than it was given, and that a slide shortens.
void prepareRolling(const Contact& c, FaceRecord& r, ContactStart& start) {
  r.rolls = 0;
  start.rolling = 0;
  if (!resistsRolling(c)) return;
  float load = 0;
  for (int i = 0; i < c.count; i++) load += std::max(0.0f, c.points.forceN[i]);
  r.rolls = 1;
  start.rolling = c.rolling;
  r.s1[kRollingLane] = c.rollingRadius;
  r.s2[kRollingLane] = 0;
  r.trialN[kRollingLane] = -kLargestPointForce;  // never closed
  r.k[kRollingLane] = c.points.stiffness[0];
  r.trial1[kRollingLane] = c.points.force1[kRollingLane];
  r.trial2[kRollingLane] = c.points.force2[kRollingLane];
  r.limit[kRollingLane] = c.rolling * load;
}

}  // namespace

void ContactRows::prepare(const Island& island, Ties& ties, const StepContext& context) {
  const BodySet& bodies = *context.bodies;
  ContactSet& set = ties.contacts;
  const bool alone = island.bodies.size() == 1;
  fastestApproach = 0;
  rolls = false;
  for (std::size_t k = 0; k < size(); k++) {
    Contact& c = at(k, ties);
    FaceRecord& r = records[k];
    ContactStart& start = starts[k];
    bool still = bodies.still[c.bodyA] && bodies.still[c.bodyB];
    if (c.fresh || !still) updateFrame(r, c, set.geometry[tieOf[k]], bodies);
    c.fresh = false;
    findApproach(r, c, bodies, start);
    const float cap = kMultiplierWeights * float(context.judgingGravity) * c.effectiveMass;
    const bool debris = isDebris(island, r, c, cap);
    const PairStiffness stiff = stiffnessOf(c, debris, island, context);
    start.scale = stiff.scale;
    r.near = float(kNearContact * stiff.scale.length);
    const PointRules rules{stiff, float(context.settings.restingApproachSpeed * stiff.scale.speed), cap,
                           // A part of a step releases a part of the offset.
                           1 - (1 - kOffsetKept) * float(context.part * island.dt / context.dt),
                           float(kLeastRelease * stiff.scale.speed * island.dt), debris, island.facts.partnersGo};
    r.newPoints = start.falling = 0;
    start.points = c.count;
    start.slid = 0;
    start.friction = c.friction;
    start.held = energyToGiveBack(c, context);
    start.run = runOf(c, r, bodies, island.dt);
    const Vec3f arc = partnersArc(island, r, c, bodies), along = inFace(r, arc + start.run);
    const Vec3f unseen{dot(r.n, arc), along.y, along.z};
    std::optional<OwnArc> ownArc;
    if (alone) ownArc.emplace(island, r, c, bodies, stiff.scale);
    for (int i = 0; i < 4; i++) {
      start.taken[i] = start.back[i] = start.back1[i] = start.back2[i] = 0;
      start.arc[i] = start.arc1[i] = start.arc2[i] = start.curves[i] = 0;
      if (i >= c.count) {
        r.trialN[i] = r.trial1[i] = r.trial2[i] = r.k[i] = r.limit[i] = r.leastN[i] = 0;
        continue;
      }
      if (-start.approach[i] > fastestApproach) fastestApproach = -start.approach[i];
      const bool follows = boundFollows(c.points, i, start.approach[i], rules, debris);
      const bool falls = !follows && (c.points.impactMask >> i & 1);
      if (follows || falls) r.newPoints |= 1u << i;
      if (falls) start.falling |= 1u << i;
      if (c.points.forceN[i] > 0 && !c.points.sticks(i)) start.slid |= 1u << i;
      float gap = mapNormalOffset(c.points, i, start.approach[i], rules, start.held);
      mapFrictionAnchor(c, i, set.geometry[tieOf[k]], r, kSamePlace * start.scale.size, bodies);
      if (island.facts.mortared) gap = ease(c.points, i, c.effectiveMass * float(context.judgingGravity));
      float stiffness = c.points.stiffness[i];
      r.k[i] = stiffness;
      start.arc[i] = unseen.x, start.arc1[i] = unseen.y, start.arc2[i] = unseen.z;
      if (ownArc && ownArc->isThere()) ownArc->write(r, i, start);
      const Vec3f carried = start.carried(i);
      r.trialN[i] =
          kMultiplierShare * c.points.multiplierN[i] - stiffness * ((gap > 0 ? gap : kCorrect * gap) + carried.x);
      r.trial1[i] =
          kMultiplierShare * c.points.multiplier1[i] - stiffness * (kCorrect * c.points.drift1[i] + carried.y);
      r.trial2[i] =
          kMultiplierShare * c.points.multiplier2[i] - stiffness * (kCorrect * c.points.drift2[i] + carried.z);
      start.stopping[i] = c.effectiveMass *
                          (std::max(0.0f, -start.approach[i]) + float(context.judgingGravity * island.dt)) /
                          float(island.dt);
      if (falls) start.stopping[i] = std::max(0.0f, c.points.forceN[i]);
      r.limit[i] = c.friction * std::max(0.0f, c.points.forceN[i]);
      r.leastN[i] = 0;
    }
    prepareRolling(c, r, start);
    rolls = rolls || r.rolls;
  }
}

}  // namespace brickfall
