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
constexpr double kAtOnce = 0.7;  // of an overlap, parted at a look
//! - | too small: bodies wedged under something heavy end in it | too large: cost where there is no room
constexpr int kFitLooks = 16;  // at a pair

// A body where the step ends.
struct End {
  BodyIndex body = kNoIndex;
  bool may = false, shifts = false;  // may be shifted; is, where it ends in something
  bool asSolved = true;              // ends as its contacts know, as far as it is not shifted
  bool flies = false, free = false;  // nothing fixed is behind what presses on it; nor behind its island
  double invMass = 0;                // 1 / kg; 0 where it may not be shifted
  Mat3 invInertia{{{0, 0, 0}, {0, 0, 0}, {0, 0, 0}}};  // 1 / (kg m2); 0 where it may not be turned
  Transform pose, solved;                              // now, and before anything was shifted
  std::uint32_t near = kNoIndex;                       // the last of its pairs that were found
  bool known = false;                                  // all of them are
};

// Two shapes that may end in each other.
struct Near {
  ShapeIndex a = kNoIndex, b = kNoIndex;
  std::uint32_t endA = 0, endB = 0;
  Vec3 normal;       // of their contact; else where B came from
  double told = -1;  // m: the overlap of which their contact knows; below 0: they have none
  double had = -1;   // m: the overlap that is left to them; below 0: it is not known yet
  std::uint32_t beforeA = kNoIndex, beforeB = kNoIndex;  // the pair of its ends that was found before it
  int looks = 0;                                         // at it, so far
  double room = 0;                                       // m: as far they may come nearer until it is looked at again
  bool waits = false;                                    // to be looked at
  bool operator<(const Near& other) const { return a != other.a ? a < other.a : b < other.b; }
};

// A contact of a body, and the place of the one before it.
struct TouchAt {
  ContactIndex contact;
  std::uint32_t before;
};

// Ways and turns that part two bodies.
struct Parting {
  Vec3 wayA, wayB, turnA, turnB;
};

class Fitting {
 public:
  // Of all awake islands, or of one alone.
  Fitting(const Registry& registry, const Activity* activity, const Island* island, StepContext& context)
      : bodies_(registry.bodies),
        shapes_(registry.shapes),
        activity_(activity),
        island_(island),
        context_(context),
        tied_(context.memory),
        ends_(context.memory),
        endOfBody_(context.memory),
        near_(context.memory),
        touches_(context.memory),
        touchOfBody_(context.memory),
        waiting_(context.memory) {}

  // First those bodies that end aside, or all; if there are any, what they may end in.
  void addBodies(const Island& island, bool all);
  void addSingle(BodyIndex single) {
    if (endsAside(single) && mayShift(single)) addEnd(single, true, true, false);
  }
  bool anyBodies();
  void addContacts(const Island& island);
  // What bodies without a contact end in, is looked for in `proximity`.
  bool fit(const Proximity* proximity);
  // How much deeper a pair ends than it began, at most: in cores of the smaller body.
  double overlapLeft() const;

 private:
  bool moves(BodyIndex body) const {
    const BodyData& data = bodies_.data[body];
    return data.type == BodyType::dynamic && data.activity == BodyActivity::awake && !context_.solved[body].rest;
  }
  void findTied(const Island& island);
  bool mayShift(BodyIndex body) const;
  void addEnd(BodyIndex body, bool may, bool shifts, bool asSolved);
  bool endsAsSolved(BodyIndex body) const;
  bool endsAside(BodyIndex body) const;
  Transform endOf(BodyIndex body) const;
  std::uint32_t numberOf(BodyIndex body);
  Vec3 wayOf(std::uint32_t end) const { return ends_[end].solved.position - bodies_.motion[ends_[end].body].position; }
  void findNear(std::uint32_t end);
  Aabb boundsOf(ShapeIndex shape) const;
  void addFound(std::uint32_t end);
  void addNear(Near n);
  void awaken(std::uint32_t end, double way);
  template <class Visit> void eachNear(std::uint32_t end, Visit&& visit) {
    for (std::uint32_t i = ends_[end].near; i != kNoIndex;
         i = near_[i].endA == end ? near_[i].beforeA : near_[i].beforeB)
      visit(i);
  }

  double leastOf(const Near& n) const {
    return kNearlyClosed * lengthScale(shapes_.data[n.a].innerRadius, shapes_.data[n.b].innerRadius);
  }
  // Of the two shapes.
  bool anyMesh(const Near& n) const {
    return shapes_.data[n.a].geometry.type == ShapeType::mesh || shapes_.data[n.b].geometry.type == ShapeType::mesh;
  }
  Transform poseOf(ShapeIndex shape, std::uint32_t end) const {
    return ends_[end].pose * shapes_.data[shape].inCentreFrame;
  }
  double openingOf(ContactIndex contact, int point) const;
  double depthLeft(const Near& n) const;
  Manifold overlapOf(const Near& n, const Transform& poseA, const Transform& bInA) const;
  bool part(std::uint32_t number);
  Parting partingOf(const Near& n, const Manifold& m, const Transform& poseA) const;
  Parting partingInFlight(const Near& n, Vec3 normal, double depth) const;
  bool shiftBy(End& end, Vec3 way, Vec3 turn, Vec3 frame, bool pays);

  const BodySet& bodies_;
  const ShapeSet& shapes_;
  const Activity* activity_;
  const Island* island_;
  StepContext& context_;
  const Proximity* proximity_ = nullptr;
  std::pmr::vector<char> tied_;                // by body: by firm ties; empty: none is
  std::pmr::vector<End> ends_;                 // bodies that end aside, ascending; then others as they are met
  std::pmr::vector<std::uint32_t> endOfBody_;  // by body
  std::pmr::vector<Near> near_;
  std::pmr::vector<TouchAt> touches_;
  std::pmr::vector<std::uint32_t> touchOfBody_;  // by body: its last one
  std::pmr::vector<std::uint32_t> waiting_;      // pairs that are to be looked at, in this order
};

void Fitting::findTied(const Island& island) {
  if (!island.facts.firm) return;
  tied_.resize(bodies_.motion.size(), 0);
  island.rows.each([&]<class Kind>(const Kind& kind, std::size_t k) {
    if (!std::remove_cvref_t<Kind>::kFirm) return;
    const auto [a, b] = kind.bodies(k, *context_.ties);
    tied_[a] = tied_[b] = 1;
  });
}

// A shift tears no firm tie.
bool Fitting::mayShift(BodyIndex body) const {
  const SolvedMotion& s = context_.solved[body];
  return moves(body) && isFinite(s.d) && isFinite(s.th) && (tied_.empty() || !tied_[body]);
}

void Fitting::addBodies(const Island& island, bool all) {
  findTied(island);
  for (BodyIndex body : island.bodies)
    if ((all || endsAside(body)) && mayShift(body)) addEnd(body, true, true, !all && endsAsSolved(body));
}

void Fitting::addEnd(BodyIndex body, bool may, bool shifts, bool asSolved) {
  const SolvedMotion& s = context_.solved[body];
  End end{body, may, shifts, asSolved};
  end.pose = end.solved = endOf(body);
  if (may) {
    const std::uint32_t number = island_ ? 0 : activity_->islandOf[body];
    const Island* island = island_ ? island_ : number == kNoIndex ? nullptr : activity_->islands.awake[number].get();
    end.flies = s.flying, end.free = !island || !island->grounded();
    end.invMass = bodies_.mass[body].invMass;
    if (!s.freeTurn && !s.flying) end.invInertia = bodies_.worldInvInertia(body);
  }
  ends_.push_back(end);
}

bool Fitting::anyBodies() {
  if (ends_.empty()) return false;
  std::sort(ends_.begin(), ends_.end(), [](const End& a, const End& b) { return a.body < b.body; });
  endOfBody_.assign(bodies_.motion.size(), kNoIndex);
  touchOfBody_.assign(bodies_.motion.size(), kNoIndex);
  for (std::size_t e = 0; e < ends_.size(); e++) endOfBody_[ends_[e].body] = std::uint32_t(e);
  return true;
}

// Contacts know how it ends: by the arms and points of the start. On the arc of its turn its surface leaves these.
bool Fitting::endsAsSolved(BodyIndex body) const {
  const BodyMass& mass = bodies_.mass[body];
  const FreeMotion& free = context_.free[body];
  auto leaves = [&](Vec3 turn) {
    const Vec3 visible = visibleTurn(mass, bodies_.motion[body].orientation, turn);
    return 0.5 * lengthSquared(visible) * mass.outerRadius > kTrifle * mass.innerRadius;
  };
  if (!context_.solved[body].foreseen || free.turnsFaster) return false;
  return !leaves(context_.solved[body].th) && !leaves(free.startSpin * free.dt);
}

// So, or so far from the way along which its contacts were looked for, that they do not tell what it meets.
bool Fitting::endsAside(BodyIndex body) const {
  if (!endsAsSolved(body)) return true;
  const Vec3 way = context_.solved[body].d, led = context_.free[body].startVelocity * context_.free[body].dt;
  const double all = lengthSquared(led), share = all > 0 ? std::clamp(dot(way, led) / all, 0.0, 1.0) : 0;
  const double most = kRoom * bodies_.mass[body].innerRadius;
  return lengthSquared(way - led * share) > most * most;
}

Transform Fitting::endOf(BodyIndex body) const {
  const BodyMotion& m = bodies_.motion[body];
  if (moves(body)) return {m.position + context_.solved[body].d, rotationAtEnd(body, context_)};
  if (bodies_.data[body].type == BodyType::dynamic) return {m.position, m.rotation};
  return {m.position + m.linearVelocity * context_.dt,
          normalized(quatFromRotationVector(m.angularVelocity * context_.dt) * m.rotation)};
}

std::uint32_t Fitting::numberOf(BodyIndex body) {
  if (endOfBody_[body] == kNoIndex) {
    endOfBody_[body] = std::uint32_t(ends_.size());
    addEnd(body, mayShift(body), false, true);
  }
  return endOfBody_[body];
}

void Fitting::addContacts(const Island& island) {
  island.rows.eachManifold([&](ContactIndex contact) {
    const Contact& c = context_.ties->contacts.contacts[contact];
    for (BodyIndex body : {c.bodyA, c.bodyB}) {
      touches_.push_back({contact, touchOfBody_[body]});
      touchOfBody_[body] = std::uint32_t(touches_.size() - 1);
    }
  });
}

void Fitting::addNear(Near n) {
  n.beforeA = ends_[n.endA].near, n.beforeB = ends_[n.endB].near;
  ends_[n.endA].near = ends_[n.endB].near = std::uint32_t(near_.size());
  near_.push_back(n);
}

// m: by how much a point of a contact opens, as it was solved.
double Fitting::openingOf(ContactIndex contact, int point) const {
  const Contact& c = context_.ties->contacts.contacts[contact];
  const ContactGeometry& g = context_.ties->contacts.geometry[contact];
  auto wayOf = [&](BodyIndex body, Vec3 anchor) {
    if (!moves(body)) return endOf(body).position - bodies_.motion[body].position;
    return context_.solved[body].d + cross(context_.solved[body].th, bodies_.motion[body].orientation * anchor);
  };
  return dot(bodies_.motion[c.bodyA].orientation * g.normal,
             wayOf(c.bodyB, g.anchorB[point]) - wayOf(c.bodyA, g.anchorA[point]));
}

// What the body may end in, of which not yet all is known.
void Fitting::findNear(std::uint32_t end) {
  if (ends_[end].known) return;
  const BodyIndex body = ends_[end].body;
  for (std::uint32_t t = touchOfBody_[body]; t != kNoIndex; t = touches_[t].before) {
    const ContactIndex contact = touches_[t].contact;
    const Contact& c = context_.ties->contacts.contacts[contact];
    Near n{c.shapeA, c.shapeB, numberOf(c.bodyA), numberOf(c.bodyB)};
    if (ends_[n.endA].known || ends_[n.endB].known) continue;
    n.normal = bodies_.motion[c.bodyA].orientation * context_.ties->contacts.geometry[contact].normal;
    n.told = leastOf(n);
    // Where the contact knew both ways, the solve has said how far its springs give.
    const bool asSolved = ends_[n.endA].asSolved && ends_[n.endB].asSolved;
    for (int i = 0; i < c.count; i++)
      n.told = std::max(n.told, -double(c.points.gap[i]) - (asSolved ? std::min(0.0, openingOf(contact, i)) : 0));
    addNear(n);
  }
  ends_[end].known = true;
  if (proximity_) addFound(end);
}

// Bounds in which the tree keeps the shape, whatever else these hold: those depend on the history of the tree.
Aabb Fitting::boundsOf(ShapeIndex shape) const {
  if (!bodies_.still[shapes_.data[shape].body]) return proximity_->around[shape].swept;
  return bounds(shapes_.data[shape].geometry, shapes_.worldPose(shape, bodies_));
}

// What it ends in without a contact. The order in which the tree finds it must not matter.
void Fitting::addFound(std::uint32_t end) {
  std::pmr::vector<Near> found(context_.memory);
  for (ShapeIndex shape : bodies_.shapes[ends_[end].body]) {
    const ShapeData& s = shapes_.data[shape];
    const Aabb own = bounds(s.geometry, ends_[end].pose * s.inCentreFrame);
    proximity_->broadPhase->query(own, [&](std::uint32_t other) {
      const BodyIndex body = shapes_.data[other].body;
      if (!overlaps(own, boundsOf(other))) return true;
      if (body == s.body || !shapes_.mayTouch(shape, other) || !context_.ties->mayCollide(s.body, body)) return true;
      const Near n{std::min(shape, other), std::max(shape, other)};
      bool known = false;
      eachNear(end, [&](std::uint32_t i) { known = known || (near_[i].a == n.a && near_[i].b == n.b); });
      if (!known) found.push_back(n);
      return true;
    });
  }
  std::sort(found.begin(), found.end());
  for (Near& n : found) {
    n.endA = numberOf(shapes_.data[n.a].body), n.endB = numberOf(shapes_.data[n.b].body);
    const Vec3 came = wayOf(n.endA) - wayOf(n.endB);
    // Bodies whose mortar has just broken began side by side, whichever way they went. So did those that came no
    // further than the thinner one is thick: none has come through.
    const double thick = anyMesh(n) ? 0 : std::min(shapes_.data[n.a].innerRadius, shapes_.data[n.b].innerRadius);
    if (lengthSquared(came) > thick * thick && context_.ties->mortar.strangers(ends_[n.endA].body, ends_[n.endB].body))
      n.normal = normalized(came);  // where it was, nothing was in the way
    addNear(n);
  }
}

// No point of the body was moved by more than `way` (m).
void Fitting::awaken(std::uint32_t end, double way) {
  eachNear(end, [&](std::uint32_t i) {
    near_[i].room -= way;
    if (near_[i].room >= 0 || near_[i].waits || near_[i].looks == kFitLooks) return;
    near_[i].waits = true;
    waiting_.push_back(i);
  });
}

bool Fitting::fit(const Proximity* proximity) {
  proximity_ = proximity;
  const std::size_t aside = ends_.size();
  for (std::size_t e = 0; e < aside; e++) findNear(std::uint32_t(e));
  for (std::size_t i = 0; i < near_.size(); i++)
    if (near_[i].told < 0 || !ends_[near_[i].endA].asSolved || !ends_[near_[i].endB].asSolved) {
      near_[i].waits = true;
      waiting_.push_back(std::uint32_t(i));
    }
  bool any = false;
  for (std::size_t i = 0; i < waiting_.size(); i++) any = part(waiting_[i]) || any;
  return any;
}

double Fitting::overlapLeft() const {
  double most = 0;
  auto sizeOf = [&](ShapeIndex shape) {
    const ShapeData& s = shapes_.data[shape];
    return bodies_.data[s.body].type == BodyType::dynamic ? s.innerRadius : std::numeric_limits<double>::infinity();
  };
  // What something kinematic jams has no room in any part: shorter ones would only press harder.
  auto isJammed = [&](std::uint32_t end) {
    const std::uint32_t island = activity_->islandOf[ends_[end].body];
    return island != kNoIndex && activity_->islands.awake[island]->facts.partnersGo;
  };
  for (const Near& n : near_) {
    const double core = kCoreShare * std::min(sizeOf(n.a), sizeOf(n.b));
    const bool mayBe = n.room < -core * most;  // it was last seen with more than that, or has been moved since
    if (!mayBe || isJammed(n.endA) || isJammed(n.endB)) continue;
    const double depth = penetrationDepth(shapes_.data[n.a].geometry, shapes_.data[n.b].geometry,
                                          inverse(poseOf(n.a, n.endA)) * poseOf(n.b, n.endB));
    most = std::max(most, (depth - std::max({n.had, n.told, leastOf(n)})) / core);
  }
  return most;
}

// As deep as they began, or as springs gave. What had no contact began apart: where an impact has moved it since, its
// place tells nothing of that.
double Fitting::depthLeft(const Near& n) const {
  if (n.told < 0 && (context_.hasMoved(ends_[n.endA].body) || context_.hasMoved(ends_[n.endB].body))) return leastOf(n);
  const double began = penetrationDepth(shapes_.data[n.a].geometry, shapes_.data[n.b].geometry,
                                        inverse(shapes_.worldPose(n.a, bodies_)) * shapes_.worldPose(n.b, bodies_));
  return std::max({leastOf(n), n.told, began});
}

// In the frame of shape A. What has come through something thin goes back, and a mesh is only parted from, along the
// normal of the contact or the way there.
Manifold Fitting::overlapOf(const Near& n, const Transform& poseA, const Transform& bInA) const {
  const ShapeData &a = shapes_.data[n.a], &b = shapes_.data[n.b];
  const Vec3 normal = rotate(conjugate(poseA.rotation), n.normal);
  const bool mesh = anyMesh(n);
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
bool Fitting::part(std::uint32_t number) {
  {
    Near& n = near_[number];
    n.waits = false;
    n.looks++;
    const End &a = ends_[n.endA], &b = ends_[n.endB];
    const double reach = bodies_.mass[a.body].outerRadius + bodies_.mass[b.body].outerRadius;
    n.room = length(a.pose.position - b.pose.position) - reach;
    if (n.room > 0) return false;
  }
  const Near& found = near_[number];
  const Transform poseA = poseOf(found.a, found.endA), poseB = poseOf(found.b, found.endB);
  const Manifold m = overlapOf(found, poseA, inverse(poseA) * poseB);
  double deepest = 0;
  for (int i = 0; i < m.count; i++) deepest = std::max(deepest, -m.points[i].separation);
  near_[number].room = std::max({found.had, found.told, leastOf(found)}) - deepest;
  if (found.room >= 0) return false;
  if (found.had < 0) near_[number].had = depthLeft(found);
  near_[number].room = found.had + kTrifle * leastOf(found) - deepest;
  if (found.room >= 0) return false;
  const std::uint32_t endA = found.endA, endB = found.endB;
  for (std::uint32_t end : {endA, endB})
    if (ends_[end].may) {  // where there is no room for what ends aside, its neighbours make it
      ends_[end].shifts = true;
      findNear(end);
    }
  const Near& n = near_[number];
  End &a = ends_[n.endA], &b = ends_[n.endB];
  if (!a.free || !b.free) a.free = b.free = false;
  const bool inFlight = a.free;
  auto frameOf = [&](BodyIndex body) { return bodies_.isDriven(body) ? bodies_.motion[body].linearVelocity : Vec3{}; };
  const Vec3 frameA = frameOf(a.body), frameB = frameOf(b.body);
  const Parting by =
      inFlight ? partingInFlight(n, rotate(poseA.rotation, m.normal), deepest - n.had) : partingOf(n, m, poseA);
  const bool movedA = a.shifts && shiftBy(a, by.wayA, by.turnA, frameB, a.flies && !inFlight);
  const bool movedB = b.shifts && shiftBy(b, by.wayB, by.turnB, frameA, b.flies && !inFlight);
  if (movedA) awaken(endA, length(by.wayA) + length(by.turnA) * bodies_.mass[a.body].outerRadius);
  if (movedB) awaken(endB, length(by.wayB) + length(by.turnB) * bodies_.mass[b.body].outerRadius);
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
  const double cosine = std::max(std::fabs(dot(along, normal)), kCoreShare);
  const double way = std::copysign(kAtOnce * depth / cosine, dot(along, n.normal != Vec3{} ? n.normal : normal));
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
// what it is shifted out of: the last check asks groups alone that are supported. It is taken along the force first, as
// if the body had flown so far against it, and then from what goes across: it is slowed down, and not thrown aside.
bool Fitting::shiftBy(End& end, Vec3 way, Vec3 turn, Vec3 frame, bool pays) {
  const BodyIndex body = end.body;
  if (pays) {
    const BodyData& data = bodies_.data[body];
    const SolvedMotion& s = context_.solved[body];
    const Vec3 force = context_.gravity * (bodies_.mass[body].mass * data.gravityScale) + data.force;
    const double work = std::max(0.0, -dot(force, way));
    if (work > 0) {
      const Vec3 along = normalized(force);
      const Vec3 velocity = s.velocity - frame;
      const double speed = dot(velocity, along), left = speed * speed - 2 * work * end.invMass;
      const Vec3 across = velocity - along * speed;
      const double squared = lengthSquared(across);
      if (!(left + squared > 0)) return false;
      const Vec3 paid = left >= 0 ? along * (std::copysign(std::sqrt(left), speed) - speed)
                                  : across * (std::sqrt(1 + left / squared) - 1) - along * speed;
      accelerate(body, paid, {}, context_);
    }
  }
  const double far = length(turn);
  shift(body, way, far > kMostTurn ? turn * (kMostTurn / far) : turn, context_);
  end.pose = endOf(body);
  return true;
}

}  // namespace

void keepOut(const Activity& activity, const Registry& registry, const Proximity& proximity, StepContext& context) {
  Fitting fitting(registry, &activity, nullptr, context);
  auto each = [&](auto&& add) {
    for (const IslandPointer& island : activity.islands.awake)
      if (!island->resting()) add(*island);
  };
  each([&](const Island& island) { fitting.addBodies(island, false); });
  for (BodyIndex single : activity.islands.single) fitting.addSingle(single);
  if (!fitting.anyBodies()) return;
  each([&](const Island& island) { fitting.addContacts(island); });
  fitting.fit(&proximity);
  context.overlap = fitting.overlapLeft();
}

bool keepOut(const Island& island, bool toImpact, const Registry& registry, StepContext& context) {
  Fitting fitting(registry, nullptr, &island, context);
  fitting.addBodies(island, toImpact);
  if (!fitting.anyBodies()) return false;
  fitting.addContacts(island);
  return fitting.fit(nullptr);
}

}  // namespace brickfall
