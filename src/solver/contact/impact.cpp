// Impacts of contacts: the impulses that stopped them in a step; and the solve of an impact at its moment
// (solver/impact.h).
#include <algorithm>

#include "solver/contact/speeds.h"
#include "solver/face/point_forces.h"

namespace brickfall {

namespace {

// Read before the contact is, since in a wall that only sways no point closes so fast.
bool comesOn(const ContactStart& start, double least) {
  for (int i = 0; i < start.points; i++)
    if (double(-start.approach[i]) >= least) return true;
  return !(least > 0);
}

TieImpact impactAt(const Contact& c, const FaceRecord& r, const StepContext& context) {
  const Vec3 point = context.bodies->motion[c.bodyA].position + toDouble(r.armA);
  return {c.bodyA, c.bodyB, point, toDouble(r.n), 0, 0, c.shapeA, c.shapeB};
}

}  // namespace

void ContactRows::findHits(const Island& island, const StepContext& context, double least,
                           std::pmr::vector<TieImpact>& out) const {
  if (double(fastestApproach) < least) return;
  for (std::size_t k = 0; k < size(); k++) {
    const Contact& c = at(k, *context.ties);
    if (!comesOn(starts[k], least) || !c.touching) continue;
    TieImpact impact = impactAt(c, records[k], context);
    for (int i = 0; i < c.count; i++) {
      if (!(c.points.forceN[i] > 0)) continue;
      impact.speed = std::max(impact.speed, double(-starts[k].approach[i]));
      impact.impulse += double(c.points.forceN[i]) * island.dt;
    }
    out.push_back(impact);
  }
}

void ContactRows::startImpact(const Island& island, const StepContext& context, double blink) {
  for (std::size_t k = 0; k < size(); k++) {
    const Contact& c = at(k, *context.ties);
    FaceRecord& r = records[k];
    for (int i = 0; i < c.count; i++) {
      double approach = std::max(0.0, -double(starts[k].approach[i]));
      bool closed = double(c.points.gap[i]) <= std::max(kNearlyClosed * starts[k].scale.length, approach * blink);
      r.k[i] = float(context.settings.restingStiffness * double(c.effectiveMass) / (island.dt * island.dt));
      r.trialN[i] = closed ? 0 : -kLargestPointForce;
      r.trial1[i] = r.trial2[i] = r.limit[i] = 0;
      r.newPoints |= 1u << i;
      starts[k].stopping[i] = kLargestPointForce;  // friction limits follow the force, whatever it is
    }
    if (r.rolls) r.trial1[kRollingLane] = r.trial2[kRollingLane] = r.limit[kRollingLane] = 0;
  }
}

void ContactRows::keepImpactForces(const Island& island) {
  for (FaceRecord& r : records) {
    PointForces f = pointForcesAt(r, island.motion.data());
    for (int i = 0; i < 4; i++) {
      if (!(f.n[i] > 0)) continue;
      r.trialN[i] += f.n[i];
      r.trial1[i] += f.t1[i];
      r.trial2[i] += f.t2[i];
    }
  }
}

bool ContactRows::reboundImpact(const Island& island, const StepContext& context,
                                std::pmr::vector<TieImpact>& impacts) {
  bool rebounds = false;
  for (std::size_t k = 0; k < size(); k++) {
    const Contact& c = at(k, *context.ties);
    PointForces f = pointForcesAt(records[k], island.motion.data());
    TieImpact impact = impactAt(c, records[k], context);
    // Few bodies rebound as long as their impacts count as such.
    const double least = std::min(slowestRebound(island, context), slowestImpact(c, island, context));
    for (int i = 0; i < c.count; i++) {
      if (!(f.n[i] > 0)) continue;
      double approach = -double(starts[k].approach[i]);
      impact.speed = std::max(impact.speed, approach);
      impact.impulse += double(f.n[i]) * island.dt;
      if (c.restitution == 0 || approach <= least) continue;
      records[k].leastN[i] = (1 + c.restitution) * f.n[i];
      rebounds = true;
    }
    if (impact.impulse > 0) impacts.push_back(impact);
  }
  return rebounds;
}

void ContactRows::endImpact(const Island& island, Ties& ties, const StepContext& context, bool solved) {
  for (std::size_t k = 0; k < size(); k++) {
    Contact& c = at(k, ties);
    PointForces f = pointForcesAt(records[k], island.motion.data());
    const double slowest = slowestImpact(c, island, context);
    for (float& least : records[k].leastN) least = 0;
    if (!solved) continue;
    for (int i = 0; i < c.count; i++) {
      // A point that was hit begins anew, and so does a point that the impact parts: its last force must not act on.
      bool hit = f.n[i] > 0, parts = double(f.way[i]) > slowest * island.dt;
      if (hit ? c.points.forceN[i] == 0 : parts) clearPoint(c.points, i);
      if (hit && !parts) {  // micrometres away: the rest of the step must not close that in no time
        c.points.metMask |= 1u << i;
        c.points.gap[i] = std::min(0.0f, c.points.gap[i]);
      }
      if (!hit) continue;
      addHit(c.points, i, f.n[i], f.t1[i], f.t2[i]);
      ties.contacts.strike(tieOf[k]);
    }
  }
}

}  // namespace brickfall
