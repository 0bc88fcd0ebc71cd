// Rebound by Poisson's hypothesis: an impact gives back e times the impulse that it took to stop it. What it takes is what
// the solve finds, with friction and all that stands behind; where the impact is over at the end of the step, the point then
// gives at least what it took in this step and e times all that it took, and the solve goes on from the motion it found. So
// the smallest restitution changes the least, and rebounds are borne, and rubbed against, like any force.
#include "solver/contact/rebound.h"

#include <algorithm>
#include <cmath>

namespace brickfall {

namespace {

//! - | too small: what is pressed on rebounds late | too large: impacts that still go on give back too little
constexpr float kOverShare = 0.1f;  // of the speed at which an impact began: what closes more slowly has been stopped

struct PointsNow {
  alignas(16) float force[4], way[4];  // N, m: along the normal
};
PointsNow pointsAt(const ContactRecord& r, const SolveMotion* motion) {
  auto moved = kernel::pointMotion(r, kernel::frame(r), motion);
  PointsNow out;
  kernel::store(kernel::pointForces(r, moved).n, out.force);
  kernel::store(moved.n, out.way);
  return out;
}

// Normal ways if nothing touched.
PointsNow freePoints(const Island& island, ContactRecord r) {
  SolveMotion pair[2];
  auto take = [&](std::uint32_t body, SolveMotion& out) {
    out = island.motion[body];
    if (body >= island.masses.size()) return;
    out.d = island.masses[body].dFree;
    out.th = island.masses[body].thFree;
  };
  take(r.bodyA, pair[0]);
  take(r.bodyB, pair[1]);
  r.bodyA = 0;
  r.bodyB = 1;
  return pointsAt(r, pair);
}

// Bits of the points of an impact that will rebound.
std::uint32_t impactsOf(const Contact& c, const ContactStart& start, double slowest) {
  std::uint32_t out = 0;
  for (int i = 0; i < c.count; i++) {
    bool begins = c.points.forceN[i] == 0 && double(-start.approach[i]) > slowest;
    if (begins || c.points.impulse[i] > 0) out |= 1u << i;
  }
  return out;
}

}  // namespace

double slowestRebound(const Island& island, const StepContext& context) {
  double wanted = context.settings.restitutionSpeed;
  return island.bodies.size() == 1 ? std::min(wanted, length(context.gravity) * context.dt) : wanted;
}

bool ContactRows::startRebounds(const Island& island, const StepContext& context, double& credit) {
  const double slowest = slowestRebound(island, context);
  const float dt = float(island.dt);
  bool any = false;
  for (std::size_t k = 0; k < size(); k++) {
    const Contact& c = context.contacts->contacts[contactOf[k]];
    if (c.restitution == 0) continue;
    ContactStart& start = starts[k];
    ContactRecord& r = records[k];
    const std::uint32_t impacts = impactsOf(c, start, slowest);
    if (impacts == 0) continue;
    const PointsNow now = pointsAt(r, island.motion.data()), free = freePoints(island, r);
    for (int i = 0; i < c.count; i++) {
      if (!(impacts >> i & 1) || !(now.force[i] > 0)) continue;
      float approach = std::max(0.0f, -start.approach[i]), closing = -now.way[i] / dt;
      // What weights and others add in the step is no part of the impact.
      float share = free.way[i] < -approach * dt ? approach * dt / -free.way[i] : 1;
      start.taken[i] = share * now.force[i] * dt;
      bool wentOn = c.points.impulse[i] > 0;
      float born = wentOn ? c.points.impactSpeed[i] : approach;
      if (closing > kOverShare * born) continue;
      // A soft spring leaves 1 / (1 + k) of the approach to later steps.
      float rest = c.effectiveMass / (dt * dt * r.k[i]);
      start.back[i] = c.restitution * (c.points.impulse[i] + start.taken[i] * (1 + rest)) / dt;
      if (!(start.back[i] > 0)) continue;
      r.tensionCap[i] = -(share * now.force[i] + start.back[i]);
      if (r.newPoints >> i & 1)
        start.stopping[i] += start.back[i];
      else
        r.limit[i] += start.friction * start.back[i];
      if (wentOn) credit += 0.5 * double(c.points.impulse[i]) * double(born + approach);
      any = true;
    }
  }
  return any;
}

}  // namespace brickfall
