#include "world/narrow_phase.h"

#include <algorithm>
#include <cmath>

#include "dynamics/point_matcher.h"
#include "narrowphase/collide.h"
#include "narrowphase/mesh_collide.h"
#include "solver/scale.h"
#include "world/look_ahead.h"

namespace brickfall {

namespace {

//! - | too small: what lands on an edge falls through with the other | too large: points that carry nothing
constexpr double kWhip = 2;  // times the speed at which an end is hit: what the other end may gain by it

LoadedPoints loadedPoints(const Contact& c) {
  LoadedPoints out;
  for (int i = 0; i < c.count; i++)
    if (c.points.forceN[i] > 0) out.add(c.points.feature[i]);
  return out;
}

Vec3 anyPerpendicular(Vec3 n) {
  return normalized(std::fabs(n.x) < 0.7 ? cross(n, Vec3{1, 0, 0}) : cross(n, Vec3{0, 1, 0}));
}

// Points that cannot touch in the coming step are left out: they are further away than the margin and what they come
// nearer by their velocity, by a fall from rest, and by the turn that a hit on the nearest point gives.
void dropFarPoints(Manifold& m, const BodyMotion& a, const BodyMotion& b, const Transform& poseA, double margin,
                   Vec3 falls, double dt) {
  const Vec3 n = rotate(poseA.rotation, m.normal);
  const double fall = std::fabs(dot(n, falls));  // m/s
  double speeds[4], hit = 0, nearest = 1e30;     // m/s of approach
  for (int i = 0; i < m.count; i++) {
    const Vec3 onA = transformPoint(poseA, m.points[i].onA), onB = transformPoint(poseA, m.points[i].onB);
    speeds[i] = -dot(n, velocityAgainst(a, b, onA - a.position, onB - b.position));
    if (m.points[i].separation < nearest) nearest = m.points[i].separation, hit = std::max(0.0, speeds[i]);
  }
  const double whip = nearest <= margin + (hit + fall) * dt ? kWhip * (hit + fall) : 0;
  int kept = 0;
  for (int i = 0; i < m.count; i++)
    if (m.points[i].separation <= margin + (std::max(0.0, speeds[i]) + whip) * dt) m.points[kept++] = m.points[i];
  m.count = kept;
}

// Gives each manifold a part, the nearest manifolds first. It is the part whose normal is most like its own; else one
// without a contact; else one whose contact ends now. A manifold without points gets -1.
void assignParts(const ContactSet& contacts, const CandidatePair* parts, int count, const MeshManifolds& found,
                 Quat aInBody, int* partOf) {
  std::uint32_t taken = 0, had = 0;
  for (int i = 0; i < count; i++) had |= parts[i].contact != kNoIndex ? 1u << parts[i].part : 0;
  for (int m = 0; m < found.count; m++) {
    partOf[m] = -1;
    if (found.list[m].count == 0) continue;
    Vec3 normal = rotate(aInBody, found.list[m].normal);
    double most = kSameFace;
    for (int i = 0; i < count; i++) {
      if (parts[i].contact == kNoIndex || taken >> parts[i].part & 1) continue;
      double alike = dot(contacts.geometry[parts[i].contact].normal, normal);
      if (alike > most) most = alike, partOf[m] = int(parts[i].part);
    }
    if (partOf[m] >= 0) taken |= 1u << partOf[m];
  }
  for (int m = 0; m < found.count; m++) {
    if (found.list[m].count == 0 || partOf[m] >= 0) continue;
    int free = 0;
    while (free < kMaxMeshManifolds && (taken | had) >> free & 1) free++;
    if (free == kMaxMeshManifolds)
      for (free = 0; taken >> free & 1;) free++;
    partOf[m] = free;
    taken |= 1u << free;
  }
}

}  // namespace

void measurePoints(Contact& c, ContactGeometry& g, const Transform& relative) {
  Vec3 t2 = cross(g.normal, g.tangent1), middle[4], centre;
  for (int i = 0; i < c.count; i++) {
    Vec3 onB = transformPoint(relative, g.anchorB[i]), apart = onB - g.anchorA[i];
    c.points.gap[i] = float(dot(g.normal, apart));
    c.points.drift1[i] = float(dot(g.tangent1, apart));
    c.points.drift2[i] = float(dot(t2, apart));
    middle[i] = (g.anchorA[i] + onB) * 0.5;
    centre += middle[i] * (1.0 / c.count);
  }
  // All points count as lying in one plane: that of the deepest, which carries, whatever is still open above it.
  int deepest = 0;
  for (int i = 1; i < c.count; i++)
    if (c.points.gap[i] < c.points.gap[deepest]) deepest = i;
  if (c.count > 0) centre += g.normal * dot(g.normal, middle[deepest] - centre);
  g.centre = centre;
  for (int i = 0; i < c.count; i++) {
    c.points.s1[i] = float(dot(g.tangent1, middle[i] - centre));
    c.points.s2[i] = float(dot(t2, middle[i] - centre));
  }
  for (int i = c.count; i < 4; i++) c.points.s1[i] = c.points.s2[i] = 0;
}

void NarrowPhase::run() {
  std::size_t kept = 0;
  proximity_.newParts.clear();
  proximity_.passed.clear();
  findSinking(bodies_, shapes_, contacts_, proximity_.sinking);
  for (std::size_t n = 0; n < contacts_.pairs.size(); n++) {
    CandidatePair pair = contacts_.pairs[n];
    if (isStill(pair)) {  // whatever the shapes are
      reused_ += pair.contact != kNoIndex;
      contacts_.pairs[kept++] = pair;
      continue;
    }
    if (!meetsMesh(pair)) {
      const std::size_t passed = proximity_.passed.size();
      if (!updatePair(pair, Look::ahead)) continue;
      if (proximity_.passed.size() > passed) proximity_.passed.back().pair = std::uint32_t(kept);  // in the new list
      contacts_.pairs[kept++] = pair;
      continue;
    }
    CandidatePair parts[kMaxMeshManifolds] = {pair};
    int count = 1;
    while (n + 1 < contacts_.pairs.size() && contacts_.pairs[n + 1].part > 0) parts[count++] = contacts_.pairs[++n];
    int left = updateParts(parts, count);
    for (int i = 0; i < left; i++) contacts_.pairs[kept++] = parts[i];
  }
  contacts_.pairs.resize(kept);
  restorePassed();
  contacts_.insert(proximity_.newParts);
}

void NarrowPhase::meet(CandidatePair pair, std::vector<CandidatePair>& out) {
  if (isStill(pair)) return;
  if (!meetsMesh(pair)) {
    if (updatePair(pair, Look::asNow)) out.push_back(pair);
    return;
  }
  proximity_.newParts.clear();
  if (updateParts(&pair, 1) > 0) out.push_back(pair);
  out.insert(out.end(), proximity_.newParts.begin(), proximity_.newParts.end());
}

void NarrowPhase::renew(ContactIndex contact) {
  const Contact& old = contacts_.contacts[contact];
  CandidatePair pair{old.shapeA, old.shapeB, old.bodyA, old.bodyB, contact, 0};
  Approach approach = approachOf(pair);
  if (mayReuse(pair, approach)) return;
  Manifold now;
  if (meetsMesh(pair)) {
    MeshManifolds found;
    findParts(&pair, 1, approach, found);
    const Quat aInBody = shapes_.data[pair.shapeA].inCentreFrame.rotation;
    double most = kSameFace;
    for (int i = 0; i < found.count; i++) {
      double alike = dot(contacts_.geometry[contact].normal, rotate(aInBody, found.list[i].normal));
      if (found.list[i].count > 0 && alike > most) most = alike, now = found.list[i];
    }
  } else {
    collidePair(pair, approach, Look::asNow, now);
  }
  if (now.count > 0) makeContact(pair, now, approach.relative);
}

void NarrowPhase::follow(ContactIndex contact) {
  Contact& c = contacts_.contacts[contact];
  const Approach approach = approachOf({c.shapeA, c.shapeB, c.bodyA, c.bodyB, contact, 0});
  measurePoints(c, contacts_.geometry[contact], approach.relative);
  const float away = float(length(approach.velocity) * dt_);
  for (int i = 0; i < c.count; i++) c.points.gap[i] = std::max(c.points.gap[i], away);
  renew(contact);
}

bool NarrowPhase::isStill(const CandidatePair& pair) const {
  return bodies_.still[pair.bodyA] && bodies_.still[pair.bodyB];
}

bool NarrowPhase::haveParted(const CandidatePair& pair) const {
  return !overlaps(proximity_.kept(pair.shapeA), proximity_.kept(pair.shapeB));
}

// Kept bounds depend on the history of the tree: only swept bounds may decide whether a contact exists.
NarrowPhase::Approach NarrowPhase::approachOf(const CandidatePair& pair) const {
  const BodyMotion &ma = bodies_.motion[pair.bodyA], &mb = bodies_.motion[pair.bodyB];
  Approach out;
  out.near = overlaps(proximity_.around[pair.shapeA].swept, proximity_.around[pair.shapeB].swept);
  out.relative = inverse(bodies_.pose(pair.bodyA)) * bodies_.pose(pair.bodyB);
  out.velocity = mb.linearVelocity - ma.linearVelocity;
  return out;
}

double NarrowPhase::marginOf(const CandidatePair& pair) const {
  return std::min(proximity_.marginOf(shapes_.data[pair.shapeA]), proximity_.marginOf(shapes_.data[pair.shapeB]));
}

bool NarrowPhase::meetsMesh(const CandidatePair& pair) const {
  return proximity_.around[pair.shapeA].mesh || proximity_.around[pair.shapeB].mesh;
}

double NarrowPhase::reachOf(const CandidatePair& pair, const Approach& approach) const {
  auto turn = [&](BodyIndex body) {
    return std::min(0.5, length(bodies_.motion[body].angularVelocity) * dt_) * bodies_.mass[body].outerRadius;
  };
  double spin = turn(pair.bodyA) + turn(pair.bodyB);
  const double speed = (1 + kWhip) * length(approach.velocity) + kWhip * length(proximity_.fall);
  return marginOf(pair) + speed * dt_ + (std::isfinite(spin) ? spin : 0.0);
}

// A manifold is kept until a point has moved by kHardlyMoved, or soon will by kLittleWay. Of more than four points, the
// four chosen serve as long as all of them carry. Else the load may be moving to another point.
bool NarrowPhase::mayReuse(const CandidatePair& pair, const Approach& approach) const {
  const Contact& c = contacts_.contacts[pair.contact];
  if (c.rolls || (c.partial && loadedPoints(c).count < c.count)) return false;
  const ContactGeometry& g = contacts_.geometry[pair.contact];
  const Quat turned = conjugate(g.relativeRotation) * approach.relative.rotation;
  const double reach = std::min(bodies_.mass[pair.bodyA].outerRadius, bodies_.mass[pair.bodyB].outerRadius);
  const double moved =
      length(approach.relative.position - g.relativePosition) + 2 * length(Vec3{turned.x, turned.y, turned.z}) * reach;
  const double scale = lengthScale(shapes_.data[pair.shapeA].innerRadius, shapes_.data[pair.shapeB].innerRadius);
  const double mostInStep = kLittleWay * scale;
  return moved < kHardlyMoved * scale && lengthSquared(approach.velocity) * dt_ * dt_ < mostInStep * mostInStep;
}

void NarrowPhase::collidePair(const CandidatePair& pair, const Approach& approach, Look look, Manifold& m) {
  const ShapeData &a = shapes_.data[pair.shapeA], &b = shapes_.data[pair.shapeB];
  Transform bInA = inverse(a.inCentreFrame) * approach.relative * b.inCentreFrame;
  const Contact* had = pair.contact != kNoIndex ? &contacts_.contacts[pair.contact] : nullptr;
  collide(a.geometry, b.geometry, bInA, reachOf(pair, approach), m, had ? loadedPoints(*had) : LoadedPoints{});
  computed_++;
  // A rolling body that carries a load is not looked up ahead: it already touches where it is.
  const bool touches = had && had->touching && had->rolls;
  if (look == Look::ahead && !touches) lookAheadOf(pair, approach, m);
  if (m.count > 0)
    dropFarPoints(m, bodies_.motion[pair.bodyA], bodies_.motion[pair.bodyB], bodies_.pose(pair.bodyA) * a.inCentreFrame,
                  marginOf(pair), proximity_.fall, dt_);
}

void NarrowPhase::lookAheadOf(const CandidatePair& pair, const Approach& approach, Manifold& m) {
  const BodyMotion &a = bodies_.motion[pair.bodyA], &b = bodies_.motion[pair.bodyB];
  const RelativeMotion motion{approach.relative, transposeTimes(a.orientation, approach.velocity),
                              transposeTimes(a.orientation, a.angularVelocity),
                              transposeTimes(a.orientation, b.angularVelocity)};
  const double sunk = std::max(proximity_.sinking[pair.bodyA].rolling, proximity_.sinking[pair.bodyB].rolling);
  const Ahead ahead = lookAhead(shapes_.data[pair.shapeA], shapes_.data[pair.shapeB], motion, dt_,
                                {reachOf(pair, approach), marginOf(pair), sunk}, m);
  if (ahead.found != AheadFound::passes) return;
  proximity_.passed.push_back({kNoIndex, ahead.time, ahead.apart});
  m.count = 0;
}

void NarrowPhase::restorePassed() {
  if (proximity_.passed.empty()) return;
  std::vector<Course>& courses = proximity_.courses;
  findCourses(bodies_, contacts_, proximity_.passed, courses);
  for (const PassedPair& passed : proximity_.passed) {
    CandidatePair& pair = contacts_.pairs[passed.pair];
    if (staysPassed(passed, courses[pair.bodyA], courses[pair.bodyB], dt_)) continue;
    Approach approach = approachOf(pair);
    Manifold now;
    collidePair(pair, approach, Look::asNow, now);
    makeContact(pair, now, approach.relative);
  }
}

bool NarrowPhase::updatePair(CandidatePair& pair, Look look) {
  if (haveParted(pair)) {
    if (pair.contact != kNoIndex) contacts_.destroy(pair.contact);
    return false;
  }
  Approach approach = approachOf(pair);
  if (approach.near && pair.contact != kNoIndex && mayReuse(pair, approach)) {
    reused_++;
    return true;
  }
  Manifold m;
  if (approach.near) collidePair(pair, approach, look, m);
  makeContact(pair, m, approach.relative);
  return true;
}

// Parts go with directions, not with faces: a body that rolls or slides from face to face keeps its contact and the
// contact's memory.
int NarrowPhase::updateParts(CandidatePair* parts, int count) {
  const CandidatePair first = parts[0];
  auto all = [&](auto condition) {
    bool any = false, fine = true;
    for (int i = 0; i < count && fine; i++) {
      if (parts[i].contact == kNoIndex) continue;
      any = true;
      fine = condition(parts[i]);
    }
    return any && fine;
  };
  if (haveParted(first)) {
    for (int i = 0; i < count; i++)
      if (parts[i].contact != kNoIndex) contacts_.destroy(parts[i].contact);
    return 0;
  }
  Approach approach = approachOf(first);
  if (approach.near && all([&](const CandidatePair& part) { return mayReuse(part, approach); })) {
    for (int i = 0; i < count; i++) reused_ += parts[i].contact != kNoIndex;
    return count;
  }
  MeshManifolds found;
  if (approach.near) findParts(parts, count, approach, found);
  return takeParts(parts, count, found, approach.relative);
}

void NarrowPhase::findParts(const CandidatePair* parts, int count, const Approach& approach, MeshManifolds& found) {
  const CandidatePair& pair = parts[0];
  std::uint32_t loaded[kMaxMeshManifolds * kMaxManifoldPoints];
  std::size_t carrying = 0;
  for (int i = 0; i < count; i++) {
    if (parts[i].contact == kNoIndex) continue;
    const LoadedPoints points = loadedPoints(contacts_.contacts[parts[i].contact]);
    for (int k = 0; k < points.count; k++) loaded[carrying++] = points.features[k];
  }
  const ShapeData &a = shapes_.data[pair.shapeA], &b = shapes_.data[pair.shapeB];
  collideMesh(a.geometry, b.geometry, inverse(a.inCentreFrame) * approach.relative * b.inCentreFrame,
              reachOf(pair, approach), proximity_.meshScratch, found, {loaded, carrying});
  Transform poseA = bodies_.pose(pair.bodyA) * a.inCentreFrame;
  for (int i = 0; i < found.count; i++) {
    dropFarPoints(found.list[i], bodies_.motion[pair.bodyA], bodies_.motion[pair.bodyB], poseA, marginOf(pair),
                  proximity_.fall, dt_);
    computed_ += found.list[i].count > 0;
  }
}

int NarrowPhase::takeParts(CandidatePair* parts, int count, const MeshManifolds& found, const Transform& relative) {
  const CandidatePair first = parts[0];
  int partOf[kMaxMeshManifolds], left = 0;
  assignParts(contacts_, parts, count, found, shapes_.data[first.shapeA].inCentreFrame.rotation, partOf);
  const Manifold none;
  std::uint32_t done = 0;
  for (int i = 0; i < count; i++) {
    CandidatePair part = parts[i];
    const Manifold* manifold = &none;
    for (int m = 0; m < found.count; m++)
      if (partOf[m] == int(part.part)) manifold = &found.list[m];
    makeContact(part, *manifold, relative);
    if (part.part == 0 || part.contact != kNoIndex) parts[left++] = part;
    done |= 1u << part.part;
  }
  for (int m = 0; m < found.count; m++) {
    if (partOf[m] < 0 || done >> partOf[m] & 1) continue;
    CandidatePair pair{first.shapeA, first.shapeB, first.bodyA, first.bodyB, kNoIndex, std::uint32_t(partOf[m])};
    makeContact(pair, found.list[m], relative);
    proximity_.newParts.push_back(pair);
  }
  return left;
}

// The contact of a pair from a new manifold (shape frame of A), with the memory of the old points.
void NarrowPhase::makeContact(CandidatePair& pair, const Manifold& m, const Transform& relative) {
  if (m.count == 0) {
    if (pair.contact != kNoIndex) contacts_.destroy(pair.contact);
    pair.contact = kNoIndex;
    return;
  }
  const ShapeData &a = shapes_.data[pair.shapeA], &b = shapes_.data[pair.shapeB];
  bool had = pair.contact != kNoIndex;
  if (!had) pair.contact = contacts_.create();
  Contact old = contacts_.contacts[pair.contact];
  ContactGeometry oldGeometry = contacts_.geometry[pair.contact];
  Contact c;
  ContactGeometry g;
  c.shapeA = pair.shapeA;
  c.shapeB = pair.shapeB;
  c.bodyA = pair.bodyA;
  c.bodyB = pair.bodyB;
  c.count = m.count;
  c.rolls = isRound(a.geometry.type) || isRound(b.geometry.type) || m.rolls;
  c.partial = m.partial;
  takeConstants(c, shapes_, bodies_);
  c.born = old.born;
  if (had) {
    c.touching = old.touching;
    c.struck = old.struck;
  }
  g.relativePosition = relative.position;
  g.relativeRotation = relative.rotation;
  g.normal = rotate(a.inCentreFrame.rotation, m.normal);
  g.tangent1 = anyPerpendicular(g.normal);
  Transform centreOfAInB = inverse(relative);
  for (int i = 0; i < m.count; i++) {
    c.points.feature[i] = m.points[i].feature;
    g.anchorA[i] = transformPoint(a.inCentreFrame, m.points[i].onA);
    g.anchorB[i] = transformPoint(centreOfAInB, transformPoint(a.inCentreFrame, m.points[i].onB));
  }
  PointMatcher matcher(old, oldGeometry, c, g, kMatchShare * std::min(a.innerRadius, b.innerRadius));
  std::uint32_t goesOn = 0;
  int fromOf[4] = {-1, -1, -1, -1};
  for (int i = 0; had && i < m.count; i++) {
    int from = fromOf[i] = matcher.from(i);
    if (from < 0) continue;
    carryOver(c.points, i, old.points, from, matcher.turn());
    goesOn |= 1u << from;
    if (old.points.sticks(from) && matcher.keepsAnchors(i)) {
      g.anchorA[i] = oldGeometry.anchorA[from];
      g.anchorB[i] = oldGeometry.anchorB[from];
    }
  }
  // The force that resists rolling is no point's: it stays the contact's while it goes on at all.
  if (goesOn != 0 && resistsRolling(c) && old.count <= kRollingLane)
    carryOver(c.points, kRollingLane, old.points, kRollingLane, matcher.turn());
  // Hits in this step at points that are gone are still told.
  for (int j = 0; had && j < old.count; j++)
    if (!(goesOn >> j & 1)) addHit(c.points, 0, old.points.hitN[j], old.points.hit1[j], old.points.hit2[j]);
  measurePoints(c, g, relative);
  // Overlap that only shows when it is measured anew (bodies that turn go along arcs) is plastic: no work went into it,
  // so it presses no harder than what was there.
  for (int i = 0; i < c.count; i++)
    if (fromOf[i] >= 0) c.points.offset[i] += std::min(0.0f, c.points.gap[i] - old.points.gap[fromOf[i]]);
  contacts_.contacts[pair.contact] = c;
  contacts_.geometry[pair.contact] = g;
}

}  // namespace brickfall
