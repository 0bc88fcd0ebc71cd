#include "world/keep_out.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <type_traits>

#include "geometry/queries.h"
#include "narrowphase/collide.h"
#include "solver/finish/motion.h"
#include "solver/free_motion.h"
#include "world/core_sweep.h"

namespace brickfall {

namespace {

//! - | too small: sweeps | too large: what is jammed ends in one of the two alone
constexpr double kAtOnce = 0.7;  // of an overlap, parted in a sweep
//! - | too small: bodies wedged under something heavy end in it | too large: cost where there is no room
constexpr int kFitSweeps = 40;

// A body where the step ends.
struct End {
  BodyIndex body = kNoIndex;
  bool shifts = false, pays = false;                   // may be shifted; the work of that is its own
  bool asSolved = false;                               // ends as its contacts know
  double invMass = 0;                                  // 1 / kg; 0 where it may not be shifted
  Mat3 invInertia{{{0, 0, 0}, {0, 0, 0}, {0, 0, 0}}};  // 1 / (kg m2); 0 where it may not be turned
  Transform pose;
  int shifted = 0;  // the sweep in which it last was
};

// Two shapes that may end in each other.
struct Near {
  ShapeIndex a = kNoIndex, b = kNoIndex;
  std::uint32_t endA = 0, endB = 0;
  Vec3 normal;      // of their contact, if they have one
  double had = -1;  // m: the overlap that is left to them; below 0: it is not known yet
  int looked = -1;  // the sweep before the last in which they were looked at
  bool operator<(const Near& other) const { return a != other.a ? a < other.a : b < other.b; }
  bool operator==(const Near& other) const { return a == other.a && b == other.b; }
};

// Ways and turns that part two bodies.
struct Parting {
  Vec3 wayA, wayB, turnA, turnB;
};

class Fitting {
 public:
  Fitting(const Registry& registry, StepContext& context)
      : bodies_(registry.bodies),
        shapes_(registry.shapes),
        context_(context),
        tied_(context.memory),
        ends_(context.memory),
        near_(context.memory) {}

  // First the bodies that may be shifted, of all islands. If there are any, then what they may end in.
  // `all`: not only those that end aside.
  void addBodies(const Island& island, bool all);
  bool anyBodies();
  void addContacts(const Island& island);
  void addFound(const BroadPhase& tree);
  bool fit();

 private:
  bool moves(BodyIndex body) const {
    const BodyData& data = bodies_.data[body];
    return data.type == BodyType::dynamic && data.activity == BodyActivity::awake && !context_.solved[body].rest;
  }
  void findTied(const Island& island);
  bool turnsFar(BodyIndex body) const;
  bool endsAsSolved(const Island& island, std::size_t i) const;
  bool endsAside(BodyIndex body) const;
  Transform endOf(BodyIndex body) const;
  std::pmr::vector<End>::const_iterator asideAt(BodyIndex body) const;
  bool isAside(BodyIndex body) const { return asideAt(body) != ends_.begin() + std::ptrdiff_t(aside_); }
  bool isMoved(BodyIndex body) const { return isAside(body) && !asideAt(body)->asSolved; }
  std::uint32_t numberOf(BodyIndex body);

  double leastOf(const Near& n) const {
    return kNearlyClosed * lengthScale(shapes_.data[n.a].innerRadius, shapes_.data[n.b].innerRadius);
  }
  double depthAtStart(const Near& n) const;
  Manifold overlapOf(const Near& n, const Transform& poseA, const Transform& bInA) const;
  bool part(Near& n, int sweep);
  Parting partingOf(const Near& n, const Manifold& m, const Transform& poseA) const;
  bool shiftBy(End& end, Vec3 way, Vec3 turn, Vec3 frame);

  const BodySet& bodies_;
  const ShapeSet& shapes_;
  StepContext& context_;
  std::pmr::vector<BodyIndex> tied_;  // of an island, by firm ties, ascending
  std::pmr::vector<End> ends_;        // bodies that may be shifted, ascending; then others that they may meet
  std::size_t aside_ = 0;             // of the former
  std::pmr::vector<Near> near_;
};

void Fitting::findTied(const Island& island) {
  tied_.clear();
  if (!island.facts.firm) return;
  island.rows.each([&]<class Kind>(const Kind& kind, std::size_t k) {
    if (!std::remove_cvref_t<Kind>::kFirm) return;
    const auto [a, b] = kind.bodies(k, *context_.ties);
    tied_.push_back(a);
    tied_.push_back(b);
  });
  std::sort(tied_.begin(), tied_.end());
}

// A shift tears no firm tie, and changes no momentum that must stay.
void Fitting::addBodies(const Island& island, bool all) {
  findTied(island);
  for (std::size_t i = 0; i < island.bodies.size(); i++) {
    const BodyIndex body = island.bodies[i];
    const SolvedMotion& s = context_.solved[body];
    if (!moves(body) || (s.flying && !island.grounded()) || !isFinite(s.d) || !isFinite(s.th)) continue;
    if ((!all && !endsAside(body)) || std::binary_search(tied_.begin(), tied_.end(), body)) continue;
    End end{body, true, s.flying, !all && endsAsSolved(island, i), bodies_.mass[body].invMass};
    if (!s.freeTurn && !s.flying) end.invInertia = bodies_.worldInvInertia(body);
    end.pose = endOf(body);
    ends_.push_back(end);
  }
}

bool Fitting::anyBodies() {
  std::sort(ends_.begin(), ends_.end(), [](const End& a, const End& b) { return a.body < b.body; });
  aside_ = ends_.size();
  return aside_ > 0;
}

bool Fitting::turnsFar(BodyIndex body) const {
  const FreeMotion& free = context_.free[body];
  auto far = [&](Vec3 turn) {
    const Vec3 visible = visibleTurn(bodies_.mass[body], bodies_.motion[body].orientation, turn);
    return lengthSquared(visible) > 0.25 * kMostTurn * kMostTurn;
  };
  return free.turnsFaster || far(context_.solved[body].th) || far(free.startSpin * free.dt);
}

// Contacts know it where the body does not turn far, and nothing has changed its way since they were looked for.
bool Fitting::endsAsSolved(const Island& island, std::size_t i) const {
  const BodyIndex body = island.bodies[i];
  if (context_.ahead[body].hit || turnsFar(body)) return false;
  const double far = kNearlyClosed * lengthScale(bodies_.mass[body].innerRadius, bodies_.mass[body].innerRadius);
  return lengthSquared(context_.solved[body].d - toDouble(island.motion[i].d)) <= far * far;
}

// The body turned so far, or ends so far from where its contacts were looked for, that they do not tell what it meets.
bool Fitting::endsAside(BodyIndex body) const {
  if (turnsFar(body)) return true;
  const FreeMotion& free = context_.free[body];
  const SolvedMotion& s = context_.solved[body];
  // Contacts were looked for all along the way of its velocity: what stays where it was ends nowhere else.
  const FlownAhead& ahead = context_.ahead[body];
  const Vec3 led = (ahead.hit ? ahead.looked : free.startVelocity) * free.dt;
  const double all = lengthSquared(led), share = all > 0 ? std::clamp(dot(s.d, led) / all, 0.0, 1.0) : 0;
  const double most = kRoom * bodies_.mass[body].innerRadius;
  return lengthSquared(s.d - led * share) > most * most;
}

Transform Fitting::endOf(BodyIndex body) const {
  const BodyMotion& m = bodies_.motion[body];
  if (moves(body)) return {m.position + context_.solved[body].d, rotationAtEnd(body, context_)};
  if (bodies_.data[body].type == BodyType::dynamic) return {m.position, m.rotation};
  return {m.position + m.linearVelocity * context_.dt,
          normalized(quatFromRotationVector(m.angularVelocity * context_.dt) * m.rotation)};
}

std::pmr::vector<End>::const_iterator Fitting::asideAt(BodyIndex body) const {
  const auto end = ends_.begin() + std::ptrdiff_t(aside_);
  const auto at = std::lower_bound(ends_.begin(), end, body, [](const End& e, BodyIndex b) { return e.body < b; });
  return at != end && at->body == body ? at : end;
}

std::uint32_t Fitting::numberOf(BodyIndex body) {
  if (isAside(body)) return std::uint32_t(asideAt(body) - ends_.begin());
  End other;
  other.body = body;
  other.pose = endOf(body);
  ends_.push_back(other);
  return std::uint32_t(ends_.size() - 1);
}

void Fitting::addContacts(const Island& island) {
  island.rows.eachManifold([&](ContactIndex contact) {
    const Contact& c = context_.ties->contacts.contacts[contact];
    if (!isAside(c.bodyA) && !isAside(c.bodyB)) return;
    Near n{c.shapeA, c.shapeB};
    n.normal = bodies_.motion[c.bodyA].orientation * context_.ties->contacts.geometry[contact].normal;
    n.had = leastOf(n);
    for (int i = 0; i < c.count; i++) n.had = std::max(n.had, -double(c.points.gap[i]));
    // The solve has said how far its springs give.
    if (!isMoved(c.bodyA) && !isMoved(c.bodyB)) n.had = std::numeric_limits<double>::infinity();
    near_.push_back(n);
  });
}

// What the bodies end in without a contact. The order in which the tree finds it must not matter.
void Fitting::addFound(const BroadPhase& tree) {
  std::sort(near_.begin(), near_.end());
  const std::size_t known = near_.size();
  for (std::size_t e = 0; e < aside_; e++)
    for (ShapeIndex shape : bodies_.shapes[ends_[e].body]) {
      const ShapeData& s = shapes_.data[shape];
      tree.query(bounds(s.geometry, ends_[e].pose * s.inCentreFrame), [&](std::uint32_t other) {
        const BodyIndex body = shapes_.data[other].body;
        if (body == s.body || !shapes_.mayTouch(shape, other) || !context_.ties->mayCollide(s.body, body)) return true;
        const Near n{std::min(shape, other), std::max(shape, other)};
        if (!std::binary_search(near_.begin(), near_.begin() + std::ptrdiff_t(known), n)) near_.push_back(n);
        return true;
      });
    }
  const auto found = near_.begin() + std::ptrdiff_t(known);
  std::sort(found, near_.end());
  near_.erase(std::unique(found, near_.end()), near_.end());
}

bool Fitting::fit() {
  for (Near& n : near_) n.endA = numberOf(shapes_.data[n.a].body), n.endB = numberOf(shapes_.data[n.b].body);
  bool any = false, shifted = true;
  for (int sweep = 1; sweep <= kFitSweeps && shifted; sweep++) {
    shifted = false;
    for (Near& n : near_) shifted = part(n, sweep) || shifted;
    any = any || shifted;
  }
  return any;
}

double Fitting::depthAtStart(const Near& n) const {
  return penetrationDepth(shapes_.data[n.a].geometry, shapes_.data[n.b].geometry,
                          inverse(shapes_.worldPose(n.a, bodies_)) * shapes_.worldPose(n.b, bodies_));
}

// In the frame of shape A. A mesh is only parted from along the normal of the contact.
Manifold Fitting::overlapOf(const Near& n, const Transform& poseA, const Transform& bInA) const {
  const ShapeData &a = shapes_.data[n.a], &b = shapes_.data[n.b];
  Manifold m;
  if (a.geometry.type != ShapeType::mesh && b.geometry.type != ShapeType::mesh) {
    collide(a.geometry, b.geometry, bInA, 0, m);
  } else if (n.had >= 0) {
    const End& moved = ends_[ends_[n.endA].shifts ? n.endA : n.endB];
    m.count = 1;
    m.normal = rotate(conjugate(poseA.rotation), n.normal);
    m.points[0].onA = m.points[0].onB = transformPoint(inverse(poseA), moved.pose.position);
    m.points[0].separation = -penetrationDepth(a.geometry, b.geometry, bInA);
  }
  return m;
}

// Parts two shapes if they ended deeper in each other than they began. Returns whether it did so.
bool Fitting::part(Near& n, int sweep) {
  End &a = ends_[n.endA], &b = ends_[n.endB];
  if (n.looked >= a.shifted && n.looked >= b.shifted) return false;
  n.looked = sweep - 1;
  const double reach = bodies_.mass[a.body].outerRadius + bodies_.mass[b.body].outerRadius;
  if (!(lengthSquared(a.pose.position - b.pose.position) <= reach * reach)) return false;
  const Transform poseA = a.pose * shapes_.data[n.a].inCentreFrame;
  const Manifold m = overlapOf(n, poseA, inverse(poseA) * (b.pose * shapes_.data[n.b].inCentreFrame));
  double deepest = 0;
  for (int i = 0; i < m.count; i++) deepest = std::max(deepest, -m.points[i].separation);
  if (!(deepest > std::max(n.had, leastOf(n)))) return false;
  if (n.had < 0) n.had = std::max(leastOf(n), depthAtStart(n));
  if (!(deepest > n.had)) return false;
  const Parting by = partingOf(n, m, poseA);
  const Vec3 frameA = bodies_.motion[a.body].linearVelocity, frameB = bodies_.motion[b.body].linearVelocity;
  const bool movedA = a.shifts && shiftBy(a, by.wayA, by.turnA, frameB);
  const bool movedB = b.shifts && shiftBy(b, by.wayB, by.turnB, frameA);
  if (movedA) a.shifted = sweep;
  if (movedB) b.shifted = sweep;
  return movedA || movedB;
}

// Point by point, each as it is after those before. A body gives way at a point by its mass and its inertia: an end
// that is pressed in turns out, and a brick wedged under a ball comes to lie where it has room.
Parting Fitting::partingOf(const Near& n, const Manifold& m, const Transform& poseA) const {
  const End &a = ends_[n.endA], &b = ends_[n.endB];
  const Vec3 normal = rotate(poseA.rotation, m.normal);
  Parting out;
  for (int i = 0; i < m.count; i++) {
    const Vec3 at = transformPoint(poseA, (m.points[i].onA + m.points[i].onB) * 0.5);
    const Vec3 armA = at - a.pose.position, armB = at - b.pose.position;
    const Vec3 leverA = cross(armA, normal), leverB = cross(armB, normal);
    const Vec3 turnA = a.invInertia * leverA, turnB = b.invInertia * leverB;
    const double parted = dot(normal, out.wayB + cross(out.turnB, armB) - out.wayA - cross(out.turnA, armA));
    const double depth = -m.points[i].separation - n.had - parted;
    const double gives = a.invMass + b.invMass + dot(leverA, turnA) + dot(leverB, turnB);
    if (!(depth > 0) || !(gives > 0)) continue;
    const double push = kAtOnce * depth / gives;
    out.wayA -= normal * (push * a.invMass), out.turnA -= turnA * push;
    out.wayB += normal * (push * b.invMass), out.turnB += turnB * push;
  }
  return out;
}

// The work against gravity and outside forces is taken from the body's own motion if nothing presses on it, seen from
// what it is shifted out of: the last check asks groups alone that are supported. It is taken along the force, as if
// the body had flown so far against it: it is not thrown aside.
bool Fitting::shiftBy(End& end, Vec3 way, Vec3 turn, Vec3 frame) {
  const BodyIndex body = end.body;
  if (end.pays) {
    const BodyData& data = bodies_.data[body];
    const SolvedMotion& s = context_.solved[body];
    const Vec3 force = context_.gravity * (bodies_.mass[body].mass * data.gravityScale) + data.force;
    const double work = std::max(0.0, -dot(force, way));
    if (work > 0) {
      const Vec3 along = normalized(force);
      const double speed = dot(s.velocity - frame, along);
      const double left = speed * speed - 2 * work * end.invMass;
      if (!(left > 0)) return false;
      accelerate(body, along * (std::copysign(std::sqrt(left), speed) - speed), {}, context_);
    }
  }
  const double far = length(turn);
  shift(body, way, far > kMostTurn ? turn * (kMostTurn / far) : turn, context_);
  end.pose = endOf(body);
  return true;
}

}  // namespace

void keepOut(const IslandSet& islands, const Registry& registry, const Proximity& proximity, StepContext& context) {
  Fitting fitting(registry, context);
  auto each = [&](auto&& add) {
    for (const IslandPointer& island : islands.awake)
      if (!island->resting()) add(*island);
  };
  each([&](const Island& island) { fitting.addBodies(island, false); });
  if (!fitting.anyBodies()) return;
  each([&](const Island& island) { fitting.addContacts(island); });
  fitting.addFound(*proximity.broadPhase);
  fitting.fit();
}

bool keepOut(const Island& island, bool toImpact, const Registry& registry, StepContext& context) {
  Fitting fitting(registry, context);
  fitting.addBodies(island, toImpact);
  if (!fitting.anyBodies()) return false;
  fitting.addContacts(island);
  return fitting.fit();
}

}  // namespace brickfall
