// Rebound by Poisson's hypothesis: an impact gives back e times the impulse that it took to stop it. The solve finds
// this impulse, with friction and with all bodies that stand behind. Where the impact is over at the end of the step,
// the point then gives at least its impulse of this step and e times all of its impulse. The solve goes on from the
// motion that it found. So the smallest restitution changes the least, and rebounds are borne, and rubbed against, like
// any force.
#include <algorithm>

#include "solver/contact/speeds.h"
#include "solver/face/point_forces.h"
#include "solver/support.h"

namespace brickfall {

namespace {

// Normal ways as if this impact did not act: a body that others support does not fall with the body that lands on it.
PointForces pointsWithout(const Island& island, const FaceRecord& record, const std::pmr::vector<char>& supported,
                          const StepContext& context) {
  SolveMotion pair[2];
  auto take = [&](std::uint32_t body, SolveMotion& out) {
    out = island.motion[body];
    if (body >= island.masses.size()) return;
    const Vec3 velocity = context.bodies->motion[island.bodies[body]].linearVelocity;
    out.d = supported[body] ? toFloat(velocity * island.dt - island.rigid.move) : island.masses[body].dFree;
    out.th = island.masses[body].thFree;
  };
  take(record.bodyA, pair[0]);
  take(record.bodyB, pair[1]);
  FaceRecord r = record;
  r.bodyA = 0;
  r.bodyB = 1;
  return pointForcesAt(r, pair);
}

// Bodies that chains of contacts supported in the last step; impacts support nothing.
void findSupportedBefore(const Island& island, const StepContext& context, std::pmr::vector<char>& supported) {
  findSupported(island, supported, [&](const auto& kind, std::size_t k) { return kind.holds(k, context); });
}

// Share of a contact force that belongs to the impact. The point approached at `approach` when the step began; it would
// close at `without` if this contact were absent and closes at `closing` under the force. The rest of the force bears
// weight. If the impact is over, all the rest of its approach counts.
float impactShare(float approach, float without, float closing, bool over) {
  if (!(approach > 0)) return 0;
  float all = std::max(without, approach);
  return approach / (over ? std::max(all - closing, (1 - float(kOver)) * approach) : all);
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
  double wanted = context.settings.restitutionSpeed * island.facts.scale.speed;
  return island.plan.alone ? std::min(wanted, kTrifle * length(context.gravity) * context.dt) : wanted;
}

bool ContactRows::startRebounds(const Island& island, const StepContext& context) {
  const double slowest = slowestRebound(island, context);
  const float dt = float(island.dt);
  std::pmr::vector<char> supported(island.memory);  // bodies; found where there is an impact
  bool any = false;
  for (std::size_t k = 0; k < size(); k++) {
    const Contact& c = at(k, *context.ties);
    if (c.restitution == 0) continue;
    ContactStart& start = starts[k];
    FaceRecord& r = records[k];
    const std::uint32_t impacts = impactsOf(c, start, slowest);
    if (impacts == 0) continue;
    if (supported.empty()) findSupportedBefore(island, context, supported);
    const PointForces now = pointForcesAt(r, island.motion.data()),
                      without = pointsWithout(island, r, supported, context);
    for (int i = 0; i < c.count; i++) {
      if (!(impacts >> i & 1) || !(now.n[i] > 0)) continue;
      float approach = std::max(0.0f, -start.approach[i]), closing = -now.way[i] / dt;
      bool wentOn = c.points.impulse[i] > 0;
      float born = wentOn ? c.points.impactSpeed[i] : approach;
      bool over = closing <= float(kOver) * born;
      start.taken[i] = impactShare(approach, -without.way[i] / dt, closing, over) * now.n[i] * dt;
      if (!over) continue;
      // Closing speed that is left is stopped, too, as far as it rebounds.
      const float found = std::min(start.taken[i], now.n[i] * dt), left = start.taken[i] - found;
      start.back[i] = c.restitution * (c.points.impulse[i] + start.taken[i] + left) / dt;
      if (!(start.back[i] > 0)) continue;
      r.leastN[i] = found / dt + start.back[i];
      if (r.newPoints >> i & 1)
        start.stopping[i] += start.back[i];
      else
        r.limit[i] += start.friction * start.back[i];
      any = true;
    }
  }
  return any;
}

}  // namespace brickfall
