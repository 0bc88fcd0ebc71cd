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
  bool may = false, shifts = false;  // may be shifted; is, where it ends in something
  bool asSolved = true;              // ends as its contacts know, as far as it is not shifted
  bool flies = false, free = false;  // nothing fixed is behind what presses on it; nor behind its island
  bool single = false;               // of no island
  double invMass = 0;                // 1 / kg; 0 where it may not be shifted
  Mat3 invInertia{{{0, 0, 0}, {0, 0, 0}, {0, 0, 0}}};  // 1 / (kg m2); 0 where it may not be turned
  Transform pose, solved;                              // now, and before anything was shifted
  int shifted = 0;                                     // the sweep in which it last was
};

// Two shapes that may end in each other.
struct Near {
  ShapeIndex a = kNoIndex, b = kNoIndex;
  std::uint32_t endA = 0, endB = 0;
  Vec3 normal;        // of their contact; else where B came from
  double began = -1;  // m: the overlap at the start of the step; below 0: it is not known yet
  double had = -1;    // m: the overlap that is left to them; likewise
  int looked = -1;    // the sweep before the last in which they were looked at
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

  bool anyAside(const Island& island);
  bool stopped(BodyIndex single) const {
    return moves(single) && context_.solved[single].d != context_.free[single].way;
  }
  // First all bodies, then what they may end in. `all`: not only those are shifted that end aside.
  void addBodies(const Island& island, bool all);
  void addSingle(BodyIndex single);
  void sortBodies();
  void addContacts(const Island& island);
  // What bodies without a contact end in, is looked for in `tree`.
  bool fit(const BroadPhase* tree);

 private:
  bool moves(BodyIndex body) const {
    const BodyData& data = bodies_.data[body];
    return data.type == BodyType::dynamic && data.activity == BodyActivity::awake && !context_.solved[body].rest;
  }
  void findTied(const Island& island);
  bool mayShift(BodyIndex body) const;
  End& addBody(BodyIndex body, bool free, bool shifts, bool asSolved);
  bool turnsFar(BodyIndex body) const;
  bool endsAsSolved(const Island& island, std::size_t i) const;
  bool endsAside(BodyIndex body) const;
  Transform endOf(BodyIndex body) const;
  std::uint32_t numberOf(BodyIndex body);
  Vec3 wayOf(std::uint32_t end) const { return ends_[end].solved.position - bodies_.motion[ends_[end].body].position; }
  void addFound(std::size_t first, std::size_t last);
  void giveWay(std::uint32_t end);

  double leastOf(const Near& n) const {
    return kNearlyClosed * lengthScale(shapes_.data[n.a].innerRadius, shapes_.data[n.b].innerRadius);
  }
  double depthAt(const Near& n, const Transform& poseA, const Transform& poseB) const;
  double depthLeft(const Near& n) const;
  Manifold overlapOf(const Near& n, const Transform& poseA, const Transform& bInA) const;
  bool part(std::size_t number, int sweep);
  Parting partingOf(const Near& n, const Manifold& m, const Transform& poseA) const;
  Parting partingInFlight(const Near& n, Vec3 normal, double depth) const;
  bool shiftBy(End& end, Vec3 way, Vec3 turn, Vec3 frame, bool pays);

  const BodySet& bodies_;
  const ShapeSet& shapes_;
  StepContext& context_;
  const BroadPhase* tree_ = nullptr;
  std::pmr::vector<BodyIndex> tied_;  // of an island, by firm ties, ascending
  std::pmr::vector<End> ends_;        // bodies that may be shifted, ascending; then others that they may meet
  std::size_t own_ = 0;               // of the former
  std::pmr::vector<Near> near_;       // contacts, ascending; then what was found without one
  std::size_t contacts_ = 0;          // of the former
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

// A shift tears no firm tie.
bool Fitting::mayShift(BodyIndex body) const {
  const SolvedMotion& s = context_.solved[body];
  return moves(body) && isFinite(s.d) && isFinite(s.th) && !std::binary_search(tied_.begin(), tied_.end(), body);
}

bool Fitting::anyAside(const Island& island) {
  findTied(island);
  return std::any_of(island.bodies.begin(), island.bodies.end(),
                     [&](BodyIndex body) { return mayShift(body) && endsAside(body); });
}

void Fitting::addBodies(const Island& island, bool all) {
  findTied(island);
  for (std::size_t i = 0; i < island.bodies.size(); i++) {
    const BodyIndex body = island.bodies[i];
    if (!mayShift(body)) continue;
    const bool aside = !all && endsAside(body);
    addBody(body, !island.grounded(), all || aside, !all && (!aside || endsAsSolved(island, i)));
  }
}

void Fitting::addSingle(BodyIndex single) {
  tied_.clear();
  if (mayShift(single)) addBody(single, true, stopped(single), false).single = true;
}

End& Fitting::addBody(BodyIndex body, bool free, bool shifts, bool asSolved) {
  const SolvedMotion& s = context_.solved[body];
  End end{body, true, shifts, asSolved, s.flying, free};
  end.invMass = bodies_.mass[body].invMass;
  if (!s.freeTurn && !s.flying) end.invInertia = bodies_.worldInvInertia(body);
  end.pose = end.solved = endOf(body);
  ends_.push_back(end);
  return ends_.back();
}

void Fitting::sortBodies() {
  std::sort(ends_.begin(), ends_.end(), [](const End& a, const End& b) { return a.body < b.body; });
  own_ = ends_.size();
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

std::uint32_t Fitting::numberOf(BodyIndex body) {
  const auto own = ends_.begin() + std::ptrdiff_t(own_);
  const auto at = std::lower_bound(ends_.begin(), own, body, [](const End& e, BodyIndex b) { return e.body < b; });
  if (at != own && at->body == body) return std::uint32_t(at - ends_.begin());
  End other;
  other.body = body;
  other.pose = other.solved = endOf(body);
  ends_.push_back(other);
  return std::uint32_t(ends_.size() - 1);
}

void Fitting::addContacts(const Island& island) {
  island.rows.eachManifold([&](ContactIndex contact) {
    const Contact& c = context_.ties->contacts.contacts[contact];
    Near n{c.shapeA, c.shapeB, numberOf(c.bodyA), numberOf(c.bodyB)};
    n.normal = bodies_.motion[c.bodyA].orientation * context_.ties->contacts.geometry[contact].normal;
    n.began = leastOf(n);
    for (int i = 0; i < c.count; i++) n.began = std::max(n.began, -double(c.points.gap[i]));
    near_.push_back(n);
  });
}

// What bodies end in without a contact. The order in which the tree finds it must not matter.
void Fitting::addFound(std::size_t first, std::size_t last) {
  const std::size_t known = near_.size();
  for (std::size_t e = first; e < last; e++) {
    if (!ends_[e].shifts) continue;
    for (ShapeIndex shape : bodies_.shapes[ends_[e].body]) {
      const ShapeData& s = shapes_.data[shape];
      tree_->query(bounds(s.geometry, ends_[e].pose * s.inCentreFrame), [&](std::uint32_t other) {
        const BodyIndex body = shapes_.data[other].body;
        if (body == s.body || !shapes_.mayTouch(shape, other) || !context_.ties->mayCollide(s.body, body)) return true;
        const Near n{std::min(shape, other), std::max(shape, other)};
        const auto contacts = near_.begin() + std::ptrdiff_t(contacts_), before = near_.begin() + std::ptrdiff_t(known);
        if (!std::binary_search(near_.begin(), contacts, n) && std::find(contacts, before, n) == before)
          near_.push_back(n);
        return true;
      });
    }
  }
  const auto found = near_.begin() + std::ptrdiff_t(known);
  std::sort(found, near_.end());
  near_.erase(std::unique(found, near_.end()), near_.end());
  for (std::size_t i = known; i < near_.size(); i++) {
    const BodyIndex a = shapes_.data[near_[i].a].body, b = shapes_.data[near_[i].b].body;
    near_[i].endA = numberOf(a), near_[i].endB = numberOf(b);
    const Vec3 came = wayOf(near_[i].endA) - wayOf(near_[i].endB);
    if (came != Vec3{}) near_[i].normal = normalized(came);  // where it was, nothing was in the way
  }
}

bool Fitting::fit(const BroadPhase* tree) {
  tree_ = tree;
  std::sort(near_.begin(), near_.end());
  contacts_ = near_.size();
  if (tree_) addFound(0, own_);
  bool any = false, shifted = true;
  for (int sweep = 1; sweep <= kFitSweeps && shifted; sweep++) {
    shifted = false;
    for (std::size_t i = 0; i < near_.size(); i++) shifted = part(i, sweep) || shifted;
    any = any || shifted;
  }
  return any;
}

// Where there is no room for what ends aside, its neighbours make it.
void Fitting::giveWay(std::uint32_t end) {
  if (ends_[end].shifts || !ends_[end].may) return;
  ends_[end].shifts = true;
  if (tree_) addFound(end, end + 1);
}

double Fitting::depthAt(const Near& n, const Transform& poseA, const Transform& poseB) const {
  const ShapeData &a = shapes_.data[n.a], &b = shapes_.data[n.b];
  return penetrationDepth(a.geometry, b.geometry, inverse(poseA * a.inCentreFrame) * (poseB * b.inCentreFrame));
}

// As deep as they began; where the contact knew both ways, the solve has said how far its springs give.
double Fitting::depthLeft(const Near& n) const {
  const End &a = ends_[n.endA], &b = ends_[n.endB];
  if (n.began < 0) return std::max(leastOf(n), depthAt(n, bodies_.pose(a.body), bodies_.pose(b.body)));
  return a.asSolved && b.asSolved ? std::max(n.began, depthAt(n, a.solved, b.solved)) : n.began;
}

// In the frame of shape A. What has come through something thin goes back, and a mesh is only parted from, along the
// normal of the contact or the way there.
Manifold Fitting::overlapOf(const Near& n, const Transform& poseA, const Transform& bInA) const {
  const ShapeData &a = shapes_.data[n.a], &b = shapes_.data[n.b];
  const Vec3 normal = rotate(conjugate(poseA.rotation), n.normal);
  const bool mesh = a.geometry.type == ShapeType::mesh || b.geometry.type == ShapeType::mesh;
  Manifold m;
  if (!mesh) collide(a.geometry, b.geometry, bInA, 0, m);
  if (n.normal != Vec3{} && (mesh || (m.count > 0 && dot(m.normal, normal) < -kAtOnce))) {
    const End& moved = ends_[a.geometry.type == ShapeType::mesh ? n.endB : n.endA];
    m.count = 1;
    m.normal = normal;
    m.points[0].onA = m.points[0].onB = transformPoint(inverse(poseA), moved.pose.position);
    m.points[0].separation = -penetrationDepth(a.geometry, b.geometry, bInA);
  }
  return m;
}

// Parts two shapes if they ended deeper in each other than they began. Returns whether it did so.
bool Fitting::part(std::size_t number, int sweep) {
  {
    Near& n = near_[number];
    const End &a = ends_[n.endA], &b = ends_[n.endB];
    if (!a.shifts && !b.shifts) return false;
    if (n.began >= 0 && a.asSolved && b.asSolved && a.shifted + b.shifted == 0) return false;
    if (n.looked >= a.shifted && n.looked >= b.shifted) return false;
    n.looked = sweep - 1;
    const double reach = bodies_.mass[a.body].outerRadius + bodies_.mass[b.body].outerRadius;
    if (!(lengthSquared(a.pose.position - b.pose.position) <= reach * reach)) return false;
  }
  const Near& found = near_[number];
  const Transform poseA = ends_[found.endA].pose * shapes_.data[found.a].inCentreFrame;
  const Transform poseB = ends_[found.endB].pose * shapes_.data[found.b].inCentreFrame;
  const Manifold m = overlapOf(found, poseA, inverse(poseA) * poseB);
  double deepest = 0;
  for (int i = 0; i < m.count; i++) deepest = std::max(deepest, -m.points[i].separation);
  if (!(deepest > std::max({found.had, found.began, leastOf(found)}))) return false;
  if (found.had < 0) near_[number].had = depthLeft(found);
  if (!(deepest > found.had)) return false;
  const std::uint32_t endA = found.endA, endB = found.endB;
  // What flies in an island may yet be sent its free way.
  if (ends_[endA].free && ends_[endB].free && !(ends_[endA].single && ends_[endB].single)) return false;
  giveWay(endA);
  giveWay(endB);
  const Near& n = near_[number];
  End &a = ends_[n.endA], &b = ends_[n.endB];
  if (!a.free || !b.free) a.free = b.free = false;
  const bool inFlight = a.free;
  const Vec3 frameA = bodies_.motion[a.body].linearVelocity, frameB = bodies_.motion[b.body].linearVelocity;
  const Parting by =
      inFlight ? partingInFlight(n, rotate(poseA.rotation, m.normal), deepest - n.had) : partingOf(n, m, poseA);
  const bool movedA = a.shifts && shiftBy(a, by.wayA, by.turnA, frameB, a.flies && !inFlight);
  const bool movedB = b.shifts && shiftBy(b, by.wayB, by.turnB, frameA, b.flies && !inFlight);
  if (movedA) a.shifted = sweep;
  if (movedB) b.shifted = sweep;
  return movedA || movedB;
}

// Along their relative velocity, and by mass: neither the centre of mass nor a momentum changes.
Parting Fitting::partingInFlight(const Near& n, Vec3 normal, double depth) const {
  const End &a = ends_[n.endA], &b = ends_[n.endB];
  Parting out;
  if (!a.shifts || !b.shifts) return out;
  const Vec3 relative = context_.solved[b.body].velocity - context_.solved[a.body].velocity;
  const double size = length(relative);
  const Vec3 along = size > 0 ? relative * (1 / size) : normal;
  const double cosine = dot(along, normal);
  const double way = kAtOnce * depth / std::copysign(std::max(std::fabs(cosine), kCoreShare), cosine);
  out.wayA = along * (-way * a.invMass / (a.invMass + b.invMass));
  out.wayB = along * (way * b.invMass / (a.invMass + b.invMass));
  return out;
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
    const double ownA = a.shifts ? a.invMass + dot(leverA, turnA) : 0;
    const double gives = ownA + (b.shifts ? b.invMass + dot(leverB, turnB) : 0);
    if (!(depth > 0) || !(gives > 0)) continue;
    const double push = kAtOnce * depth / gives;
    if (a.shifts) out.wayA -= normal * (push * a.invMass), out.turnA -= turnA * push;
    if (b.shifts) out.wayB += normal * (push * b.invMass), out.turnB += turnB * push;
  }
  return out;
}

// The work against gravity and outside forces is taken from the body's own motion if nothing presses on it, seen from
// what it is shifted out of: the last check asks groups alone that are supported. It is taken along the force, as if
// the body had flown so far against it: it is not thrown aside.
bool Fitting::shiftBy(End& end, Vec3 way, Vec3 turn, Vec3 frame, bool pays) {
  const BodyIndex body = end.body;
  if (pays) {
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
  auto any = [&](auto&& is) {
    return std::any_of(islands.awake.begin(), islands.awake.end(),
                       [&](const IslandPointer& island) { return !island->resting() && is(*island); });
  };
  if (!any([&](const Island& island) { return fitting.anyAside(island); }) &&
      std::none_of(islands.single.begin(), islands.single.end(), [&](BodyIndex b) { return fitting.stopped(b); }))
    return;
  auto each = [&](auto&& add) {
    for (const IslandPointer& island : islands.awake)
      if (!island->resting()) add(*island);
  };
  each([&](const Island& island) { fitting.addBodies(island, false); });
  for (BodyIndex single : islands.single) fitting.addSingle(single);
  fitting.sortBodies();
  each([&](const Island& island) { fitting.addContacts(island); });
  fitting.fit(proximity.broadPhase.get());
}

bool keepOut(const Island& island, bool toImpact, const Registry& registry, StepContext& context) {
  Fitting fitting(registry, context);
  if (!toImpact && !fitting.anyAside(island)) return false;
  fitting.addBodies(island, toImpact);
  fitting.sortBodies();
  fitting.addContacts(island);
  return fitting.fit(nullptr);
}

}  // namespace brickfall
