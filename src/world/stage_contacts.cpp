// Narrow phase: manifolds of candidate pairs, and what their points remember.
#include <algorithm>
#include <cmath>

#include "dynamics/point_matcher.h"
#include "geometry/queries.h"
#include "narrowphase/collide.h"
#include "narrowphase/mesh_collide.h"
#include "world/world_impl.h"

namespace brickfall {

namespace {

//! m | too small: manifolds made anew for nothing | too large: frozen normals and arms are wrong
constexpr double kReusePosition = 1e-4;  // m: relative motion since the manifold was made under which it is kept,
//! rad | with kReusePosition
constexpr double kReuseTurn = 5e-4;  // rad,
//! m a step | with kReusePosition
constexpr double kReuseStep = 1e-3;  // m, and relative motion expected in the coming step

struct PairView {
  const ShapeData& a;
  const ShapeData& b;
  BodyIndex bodyA, bodyB;
};

bool canReuse(const Contact& c, const ContactGeometry& g, const Transform& relative, Vec3 relativeVelocity, double dt) {
  if (c.rolls) return false;
  Quat turned = conjugate(g.relativeRotation) * relative.rotation;
  double turned2 = 4 * (turned.x * turned.x + turned.y * turned.y + turned.z * turned.z);
  return lengthSquared(relative.position - g.relativePosition) < kReusePosition * kReusePosition &&
         turned2 < kReuseTurn * kReuseTurn && lengthSquared(relativeVelocity) * dt * dt < kReuseStep * kReuseStep;
}

Vec3 anyPerpendicular(Vec3 n) {
  return normalized(std::fabs(n.x) < 0.7 ? cross(n, Vec3{1, 0, 0}) : cross(n, Vec3{0, 1, 0}));
}

// Gaps and drifts from the anchors, in double; the points' places about their middle.
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
  g.centre = centre;
  for (int i = 0; i < c.count; i++) {
    c.points.s1[i] = float(dot(g.tangent1, middle[i] - centre));
    c.points.s2[i] = float(dot(t2, middle[i] - centre));
  }
  for (int i = c.count; i < 4; i++) c.points.s1[i] = c.points.s2[i] = 0;
}

// Points further away than the margin and the approach of the coming step can't touch: left out.
void dropFarPoints(Manifold& m, const PairView& pair, const BodySet& bodies, const Transform& poseA, double margin,
                   double dt) {
  const BodyMotion &a = bodies.motion[pair.bodyA], &b = bodies.motion[pair.bodyB];
  Vec3 n = rotate(poseA.rotation, m.normal);
  int kept = 0;
  for (int i = 0; i < m.count; i++) {
    Vec3 onA = transformPoint(poseA, m.points[i].onA), onB = transformPoint(poseA, m.points[i].onB);
    Vec3 v = b.linearVelocity + cross(b.angularVelocity, onB - b.position) - a.linearVelocity -
             cross(a.angularVelocity, onA - a.position);
    if (m.points[i].separation <= margin + std::max(0.0, -dot(n, v)) * dt) m.points[kept++] = m.points[i];
  }
  m.count = kept;
}

// To each manifold a part: the one whose normal is most like its own, the nearest manifolds first; else one without a
// contact; else one whose contact ends now. Without points: -1.
void assignParts(const ContactSet& contacts, const CandidatePair* parts, int count, const MeshManifolds& found,
                 Quat aInBody, int* partOf) {
  std::uint32_t taken = 0, had = 0;
  for (int i = 0; i < count; i++) had |= parts[i].contact != kNoIndex ? 1u << parts[i].part : 0;
  for (int m = 0; m < found.count; m++) {
    partOf[m] = -1;
    if (found.list[m].count == 0) continue;
    Vec3 normal = rotate(aInBody, found.list[m].normal);
    double most = 0.9;
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

void World::Impl::updateContacts() {
  StageTimer timer(report, Stage::contacts);
  double dt = context.dt;
  std::size_t kept = 0;
  newParts.clear();
  for (std::size_t n = 0; n < contacts.pairs.size(); n++) {
    CandidatePair pair = contacts.pairs[n];
    if (isMeshPair(shapes.data[pair.shapeA].geometry, shapes.data[pair.shapeB].geometry)) {
      std::size_t end = n + 1;
      while (end < contacts.pairs.size() && contacts.pairs[end].part > 0) end++;
      updateMeshPair(n, end, kept);
      n = end - 1;
      continue;
    }
    if (bodies.still[pair.bodyA] && bodies.still[pair.bodyB]) {
      contacts.pairs[kept++] = pair;
      report.manifoldsReused += pair.contact != kNoIndex;
      continue;
    }
    PairView view{shapes.data[pair.shapeA], shapes.data[pair.shapeB], pair.bodyA, pair.bodyB};
    if (!overlaps(broadPhase->kept(view.a.proxy), broadPhase->kept(view.b.proxy))) {
      if (pair.contact != kNoIndex) contacts.destroy(pair.contact);
      continue;
    }
    // Kept bounds depend on the history of the tree; only the swept ones may decide about a contact.
    bool near = overlaps(view.a.swept, view.b.swept);
    const BodyMotion &ma = bodies.motion[pair.bodyA], &mb = bodies.motion[pair.bodyB];
    Transform relative = inverse(bodies.pose(pair.bodyA)) * bodies.pose(pair.bodyB);
    Vec3 relativeVelocity = mb.linearVelocity - ma.linearVelocity;
    if (near && pair.contact != kNoIndex &&
        canReuse(contacts.contacts[pair.contact], contacts.geometry[pair.contact], relative, relativeVelocity, dt)) {
      contacts.pairs[kept++] = pair;
      report.manifoldsReused++;
      continue;
    }
    Manifold m;
    double margin = std::min(marginOf(pair.shapeA), marginOf(pair.shapeB));
    if (near) {
      Transform bInA = inverse(view.a.inCentreFrame) * relative * view.b.inCentreFrame;
      double spin = std::min(0.5, length(ma.angularVelocity) * dt) * bodies.mass[pair.bodyA].outerRadius +
                    std::min(0.5, length(mb.angularVelocity) * dt) * bodies.mass[pair.bodyB].outerRadius;
      double reach = margin + length(relativeVelocity) * dt + (std::isfinite(spin) ? spin : 0.0);
      collide(view.a.geometry, view.b.geometry, bInA, reach, m);
      report.manifoldsComputed++;
      if (m.count > 0) dropFarPoints(m, view, bodies, bodies.pose(pair.bodyA) * view.a.inCentreFrame, margin, dt);
    }
    makeContact(pair, m, relative);
    contacts.pairs[kept++] = pair;
  }
  contacts.pairs.resize(kept);
  contacts.insert(newParts);
  if (!contacts.asleep.empty() || !islands.asleep.empty()) wakeByNewContacts();
}

// All parts of a shape and a mesh: entries begin .. end of the list. Parts go with directions, not with faces: what rolls or
// slides from face to face keeps its contact and what that remembers.
void World::Impl::updateMeshPair(std::size_t begin, std::size_t end, std::size_t& kept) {
  CandidatePair parts[kMaxMeshManifolds];
  int count = 0;
  for (std::size_t i = begin; i < end; i++) parts[count++] = contacts.pairs[i];
  const CandidatePair& first = parts[0];
  auto keep = [&](const CandidatePair& pair) {
    contacts.pairs[kept++] = pair;
    report.manifoldsReused += pair.contact != kNoIndex;
  };
  if (bodies.still[first.bodyA] && bodies.still[first.bodyB]) {
    for (int i = 0; i < count; i++) keep(parts[i]);
    return;
  }
  PairView view{shapes.data[first.shapeA], shapes.data[first.shapeB], first.bodyA, first.bodyB};
  if (!overlaps(broadPhase->kept(view.a.proxy), broadPhase->kept(view.b.proxy))) {
    for (int i = 0; i < count; i++)
      if (parts[i].contact != kNoIndex) contacts.destroy(parts[i].contact);
    return;
  }
  const BodyMotion &ma = bodies.motion[first.bodyA], &mb = bodies.motion[first.bodyB];
  Transform relative = inverse(bodies.pose(first.bodyA)) * bodies.pose(first.bodyB);
  Vec3 relativeVelocity = mb.linearVelocity - ma.linearVelocity;
  double dt = context.dt;
  bool near = overlaps(view.a.swept, view.b.swept), any = false, reuse = near;
  for (int i = 0; i < count && reuse; i++) {
    if (parts[i].contact == kNoIndex) continue;
    any = true;
    reuse = canReuse(contacts.contacts[parts[i].contact], contacts.geometry[parts[i].contact], relative,
                     relativeVelocity, dt);
  }
  if (reuse && any) {
    for (int i = 0; i < count; i++) keep(parts[i]);
    return;
  }
  MeshManifolds found;
  if (near) {
    double margin = std::min(marginOf(first.shapeA), marginOf(first.shapeB));
    double spin = std::min(0.5, length(ma.angularVelocity) * dt) * bodies.mass[first.bodyA].outerRadius +
                  std::min(0.5, length(mb.angularVelocity) * dt) * bodies.mass[first.bodyB].outerRadius;
    double reach = margin + length(relativeVelocity) * dt + (std::isfinite(spin) ? spin : 0.0);
    collideMesh(view.a.geometry, view.b.geometry, inverse(view.a.inCentreFrame) * relative * view.b.inCentreFrame,
                reach, meshScratch, found);
    Transform poseA = bodies.pose(first.bodyA) * view.a.inCentreFrame;
    for (int i = 0; i < found.count; i++) dropFarPoints(found.list[i], view, bodies, poseA, margin, dt);
  }
  for (int m = 0; m < found.count; m++) report.manifoldsComputed += found.list[m].count > 0;
  int partOf[kMaxMeshManifolds];
  assignParts(contacts, parts, count, found, view.a.inCentreFrame.rotation, partOf);
  const Manifold none;
  std::uint32_t done = 0;
  for (int i = 0; i < count; i++) {
    const Manifold* manifold = &none;
    for (int m = 0; m < found.count; m++)
      if (partOf[m] == int(parts[i].part)) manifold = &found.list[m];
    makeContact(parts[i], *manifold, relative);
    if (parts[i].part == 0 || parts[i].contact != kNoIndex) contacts.pairs[kept++] = parts[i];
    done |= 1u << parts[i].part;
  }
  for (int m = 0; m < found.count; m++) {
    if (partOf[m] < 0 || done >> partOf[m] & 1) continue;
    CandidatePair pair{first.shapeA, first.shapeB, first.bodyA, first.bodyB, kNoIndex, std::uint32_t(partOf[m])};
    makeContact(pair, found.list[m], relative);
    newParts.push_back(pair);
  }
}

// The contact of a pair from a new manifold (shape frame of A), with the memory of the old points.
void World::Impl::makeContact(CandidatePair& pair, const Manifold& m, const Transform& relative) {
  if (m.count == 0) {
    if (pair.contact != kNoIndex) contacts.destroy(pair.contact);
    pair.contact = kNoIndex;
    return;
  }
  const ShapeData &a = shapes.data[pair.shapeA], &b = shapes.data[pair.shapeB];
  bool had = pair.contact != kNoIndex;
  if (!had) pair.contact = contacts.create();
  Contact old = contacts.contacts[pair.contact];
  ContactGeometry oldGeometry = contacts.geometry[pair.contact];
  Contact c;
  ContactGeometry g;
  c.shapeA = pair.shapeA;
  c.shapeB = pair.shapeB;
  c.bodyA = pair.bodyA;
  c.bodyB = pair.bodyB;
  c.count = m.count;
  c.rolls = isRound(a.geometry.type) || isRound(b.geometry.type);
  c.friction = float(mixFriction(a.def.material, b.def.material));
  c.restitution = float(mixRestitution(a.def.material, b.def.material));
  c.effectiveMass = float(1 / (bodies.mass[pair.bodyA].invMass + bodies.mass[pair.bodyB].invMass));
  c.born = old.born;
  if (had) {
    c.weak = old.weak;
    c.weakSteps = old.weakSteps;
    c.touching = old.touching;
  }
  g.relativePosition = relative.position;
  g.relativeRotation = relative.rotation;
  g.normal = rotate(a.inCentreFrame.rotation, m.normal);
  g.tangent1 = anyPerpendicular(g.normal);
  PointMatcher matcher(old, oldGeometry, c, g);
  Transform centreOfAInB = inverse(relative);
  for (int i = 0; i < m.count; i++) {
    c.points.feature[i] = m.points[i].feature;
    g.anchorA[i] = transformPoint(a.inCentreFrame, m.points[i].onA);
    g.anchorB[i] = transformPoint(centreOfAInB, transformPoint(a.inCentreFrame, m.points[i].onB));
    int from = had ? matcher.match(g.anchorB[i], c.points.feature[i]) : -1;
    if (from < 0) continue;
    carryOver(c.points, i, old.points, from, matcher.turn());
    if (old.points.sticks(from) && matcher.keepsAnchors()) {
      g.anchorA[i] = oldGeometry.anchorA[from];
      g.anchorB[i] = oldGeometry.anchorB[from];
    }
  }
  measurePoints(c, g, relative);
  contacts.contacts[pair.contact] = c;
  contacts.geometry[pair.contact] = g;
}

}  // namespace brickfall
