// The end of a solve for the contacts of an island: the memory of their points.
#include <algorithm>
#include <cmath>

#include "dynamics/point_matcher.h"
#include "solver/face/point_forces.h"
#include "solver/island.h"

namespace brickfall {

namespace {

// A rebound gives more than the spring of the point: this force is told, but not remembered, so that the smallest
// restitution changes the least. An impact that goes on remembers the impulse that it took.
void keepImpact(Contact& c, int i, ContactStart& start, PointForces& f) {
  float taken = start.back[i] > 0 ? 0 : start.taken[i];
  c.points.impulse[i] = taken > 0 ? c.points.impulse[i] + taken : 0;
  if (!(taken > 0))
    c.points.impactSpeed[i] = 0;
  else if (c.points.impactSpeed[i] == 0)
    c.points.impactSpeed[i] = -start.approach[i];
  if (!(start.back[i] > 0)) return;
  float given = 1 - std::max(0.0f, f.trialN[i]) / f.n[i];
  start.back[i] = f.n[i] * given;
  start.back1[i] = f.t1[i] * given;
  start.back2[i] = f.t2[i] * given;
  addHit(c.points, i, start.back[i], start.back1[i], start.back2[i]);
  f.n[i] -= start.back[i];
  f.t1[i] -= start.back1[i];
  f.t2[i] -= start.back2[i];
}

// Multiplier for the next step: the force, but an impact's force must not act again, explicitly.
void holdForce(Contact& c, int i, const PointForces& f, double gravity) {
  float cap = c.points.multiplierN[i] + kMultiplierWeights * float(gravity) * c.effectiveMass;
  float share = f.n[i] > cap ? cap / f.n[i] : 1;
  c.points.forceN[i] = f.n[i];
  c.points.force1[i] = f.t1[i];
  c.points.force2[i] = f.t2[i];
  c.points.multiplierN[i] = f.n[i] > cap ? cap : f.n[i];
  c.points.multiplier1[i] = f.t1[i] * share;
  c.points.multiplier2[i] = f.t2[i] * share;
}

// Where the anchor of a point that slides or rolls must be for its spring to carry the force that it has.
void placeSlip(Contact& c, int i, float largest) {
  c.points.slip1[i] = c.points.slip2[i] = 0;
  if (c.keepsAnchor(i) || !(c.points.forceN[i] > 0)) return;
  const float scale = -(1 - kMultiplierShare) / (c.points.stiffness[i] * kCorrect);
  const bool rolls = c.points.sticks(i);  // an impact's force must not act again
  c.points.slip1[i] = (rolls ? c.points.multiplier1 : c.points.force1)[i] * scale;
  c.points.slip2[i] = (rolls ? c.points.multiplier2 : c.points.force2)[i] * scale;
  float drift = std::sqrt(c.points.slip1[i] * c.points.slip1[i] + c.points.slip2[i] * c.points.slip2[i]);
  if (drift > largest) {
    c.points.slip1[i] *= largest / drift;
    c.points.slip2[i] *= largest / drift;
  }
}

// Anchors on a surface that runs go with it; `ofA`: that of A.
void runAnchors(ContactGeometry& g, float run1, float run2, bool ofA) {
  if (run1 == 0 && run2 == 0) return;
  const Vec3 run = g.tangent1 * double(run1) + cross(g.normal, g.tangent1) * double(run2);
  for (int i = 0; i < 4; i++)
    (ofA ? g.anchorA[i] : g.anchorB[i]) += ofA ? -run : rotate(conjugate(g.relativeRotation), run);
}

bool sameForces(const PointMemory& was, const PointMemory& now, int count) {
  for (int i = 0; i < count; i++) {
    auto same = [most = float(kFloatsRound) * now.forceN[i], i](const float(&a)[4], const float(&b)[4]) {
      return std::fabs(a[i] - b[i]) <= most;
    };
    if (!(same(was.forceN, now.forceN) && same(was.force1, now.force1) && same(was.force2, now.force2) &&
          same(was.multiplierN, now.multiplierN) && was.impulse[i] == now.impulse[i]))
      return false;
  }
  return true;
}

}  // namespace

bool ContactRows::store(Island& island, Ties& ties, StepContext& context) {
  const bool compare = island.resting(), mortar = ties.mortar.any();
  bool changed = !compare;
  PointMemory before;
  for (std::size_t k = 0; k < size(); k++) {
    Contact& c = at(k, ties);
    c.points.impactMask = records[k].newPoints & ~starts[k].falling;
    if (!changed) before = c.points;
    if (mortar) c.earlierForce = forceOf(c);
    const bool touched = c.touching;
    PointForces f = pointForcesAt(records[k], island.motion.data());
    bool touches = false;
    c.points.stickingMask = 0;
    for (int i = 0; i < c.count; i++) {
      bool sliding = f.slides >> i & 1;
      touches = touches || f.n[i] > 0;
      bool rebounds = starts[k].back[i] > 0;
      keepImpact(c, i, starts[k], f);
      if (rebounds) ties.contacts.strike(tieOf[k]);
      records[k].leastN[i] = 0;
      holdForce(c, i, f, context.judgingGravity);
      if (f.n[i] > 0 && !sliding) c.points.stickingMask |= 1u << i;
      placeSlip(c, i, float(kSamePlace * starts[k].scale.size));
    }
    if (records[k].rolls) {
      c.points.force1[kRollingLane] = touches ? f.t1[kRollingLane] : 0;
      c.points.force2[kRollingLane] = touches ? f.t2[kRollingLane] : 0;
    }
    c.touching = touches;
    if (c.touching != touched) ties.contacts.touchingChanged = true;
    if (!changed && c.touching == touched && sameForces(before, c.points, c.count))
      c.points = before;
    else
      changed = true;
  }
  return changed;
}

void ContactRows::tellShare(Ties& ties, float share) const {
  for (ContactIndex contact : tieOf) {
    PointMemory& m = ties.contacts.contacts[contact].points;
    for (int i = 0; i < ties.contacts.contacts[contact].count; i++) {
      if (m.forceN[i] == 0) continue;
      addHit(m, i, m.forceN[i] * share, m.force1[i] * share, m.force2[i] * share);
      ties.contacts.strike(contact);
    }
  }
}

void ContactRows::advance(const Island& island, Ties& ties, const StepContext&) const {
  for (std::size_t k = 0; k < size(); k++) {
    Contact& c = at(k, ties);
    const FaceRecord& r = records[k];
    const PointWays m = pointWaysAt(r, island.motion.data());
    const Vec3f run = inFace(r, starts[k].run);
    runAnchors(ties.contacts.geometry[tieOf[k]], run.y, run.z, r.bodyA >= island.bodies.size());
    for (int i = 0; i < c.count; i++) {
      const Vec3f carried = starts[k].carried(i);
      c.points.gap[i] += m.way[i] + carried.x;
      c.points.drift1[i] += m.way1[i] + carried.y;
      c.points.drift2[i] += m.way2[i] + carried.z;
    }
  }
}

}  // namespace brickfall
