#include "solver/contact/energy.h"

#include <algorithm>

#include "solver/contact/stiffness.h"
#include "solver/face/point_forces.h"

namespace brickfall {

namespace {

static_assert(kCorrect == 0.5f && kMultiplierShare == 0.5f, "the energy is that of this law");

double springEnergy(double stiffness, double way, double multiplier) {
  double decaying = multiplier + stiffness * way;
  return 0.5 * stiffness * way * way + decaying * decaying / (6 * stiffness);
}

// So far apart that it presses only after both have come nearer.
bool opened(double stiffness, double gap, double multiplier) {
  return gap > 0 && stiffness * gap >= double(kMultiplierShare) * multiplier;
}

}  // namespace

double elasticEnergy(const Contact& c, const StepContext& context) {
  double full = leastStiffness(c, context);
  double cap = kMultiplierWeights * context.judgingGravity * c.effectiveMass;
  double sum = 0;
  for (int i = 0; i < c.count; i++) {
    double gap = double(c.points.gap[i]) - double(c.points.offset[i]), k = c.points.stiffness[i];
    if (!(k > 0) || (gap >= 0 && c.points.multiplierN[i] == 0)) continue;
    if (c.points.phase[i] == PointPhase::impact) {
      double share = c.points.forceN[i] > cap ? cap / c.points.forceN[i] : 1;
      auto left = [&](double force) { return 0.5 * force * force * share * share / full; };
      sum += left(c.points.forceN[i]) + left(c.points.force1[i]) + left(c.points.force2[i]);
      continue;
    }
    if (!opened(k, gap, c.points.multiplierN[i])) sum += springEnergy(k, gap, c.points.multiplierN[i]);
    // A point that slid or rolls gets the place at which its spring carries the force; a point that opened lets go of
    // its anchor.
    const bool keeps = c.keepsAnchor(i);
    if (!keeps && c.points.forceN[i] == 0) continue;
    sum += springEnergy(k, keeps ? c.points.drift1[i] : c.points.slip1[i], c.points.multiplier1[i]);
    sum += springEnergy(k, keeps ? c.points.drift2[i] : c.points.slip2[i], c.points.multiplier2[i]);
  }
  if (resistsRolling(c) && c.points.stiffness[0] > 0) {
    const double one = c.points.force1[kRollingLane], two = c.points.force2[kRollingLane];
    sum += 0.5 * (one * one + two * two) / double(c.points.stiffness[0]);
  }
  return sum;
}

float energyToGiveBack(const Contact& c, const StepContext& context) {
  const PointMemory& m = c.points;
  double mass = 0;
  for (BodyIndex body : {c.bodyA, c.bodyB})
    if (context.bodies->mass[body].invMass > 0) mass = std::max(mass, context.bodies->mass[body].mass);
  const double weight = mass * context.judgingGravity;
  double sum = 0;
  auto add = [&sum](double stiffness, double share, double n, double t1, double t2) {
    if (stiffness > 0) sum += 0.5 * share * share * (n * n + t1 * t1 + t2 * t2) / stiffness;
  };
  for (int i = 0; i < c.count; i++) {
    const double most = std::max(double(m.multiplierN[i]), weight);
    add(m.stiffness[i], m.forceN[i] > most ? most / m.forceN[i] : 1, m.forceN[i], m.force1[i], m.force2[i]);
  }
  if (resistsRolling(c)) add(m.stiffness[0], 1, 0, m.force1[kRollingLane], m.force2[kRollingLane]);
  return float(std::min(sum, double(kLargestPointForce)));
}

double ContactRows::elasticEnergy(ContactIndex contact, const StepContext& context) {
  return brickfall::elasticEnergy(context.ties->contacts.contacts[contact], context);
}

void ContactRows::addWork(const Island& island, const StepContext& context, TieWork& sum) const {
  for (std::size_t k = 0; k < size(); k++) {
    Contact c = at(k, *context.ties);  // as if the multiplier were all of the force
    const FaceRecord& r = records[k];
    PointWays m = pointWaysAt(r, island.motion.data());
    for (int i = 0; i < c.count; i++) {
      const Vec3f carried = starts[k].carried(i);  // the law sees it as a part of the way
      m.way[i] += carried.x, m.way1[i] += carried.y, m.way2[i] += carried.z;
      auto work = [&](const float* normal, const float* along1, const float* along2) {
        return double(normal[i]) * double(m.way[i]) + double(along1[i]) * double(m.way1[i]) +
               double(along2[i]) * double(m.way2[i]);
      };
      sum.work += work(c.points.forceN, c.points.force1, c.points.force2);
      sum.rebound += work(starts[k].back, starts[k].back1, starts[k].back2);
      c.points.gap[i] += m.way[i];
      c.points.drift1[i] += m.way1[i];
      c.points.drift2[i] += m.way2[i];
    }
    if (r.rolls)
      sum.work += double(c.points.force1[kRollingLane]) * double(m.way1[kRollingLane]) +
                  double(c.points.force2[kRollingLane]) * double(m.way2[kRollingLane]);
    std::copy(c.points.forceN, c.points.forceN + 4, c.points.multiplierN);
    std::copy(c.points.force1, c.points.force1 + 4, c.points.multiplier1);
    std::copy(c.points.force2, c.points.force2 + 4, c.points.multiplier2);
    sum.elastic += brickfall::elasticEnergy(c, context);
  }
}

namespace {

// Adds the impulse of a contact with a fixed or kinematic body on the island's body, about the world's origin. Its work
// is that of the partner's motion.
void addImpulse(const Contact& c, const FaceRecord& r, const ContactStart& start, const BodySet& bodies, bool onB,
                double dt, BalanceChange& sum) {
  Vec3 n = toDouble(r.n), t1 = toDouble(r.t1), t2 = cross(n, t1);
  Vec3 centre = bodies.motion[c.bodyA].position + toDouble(r.armA);
  const BodyMotion& partner = bodies.motion[onB ? c.bodyA : c.bodyB];
  double sign = onB ? dt : -dt;
  const Vec3 surface = toDouble(start.run) * (onB ? -1 / dt : 1 / dt);
  for (int i = 0; i < c.count; i++) {
    auto force = [&](float kept, float back) { return double(kept) + double(back); };
    Vec3 impulse = (n * force(c.points.forceN[i], start.back[i]) + t1 * force(c.points.force1[i], start.back1[i]) +
                    t2 * force(c.points.force2[i], start.back2[i])) *
                   sign;
    Vec3 point = centre + t1 * double(r.s1[i]) + t2 * double(r.s2[i]);
    Vec3 velocity = partner.linearVelocity + cross(partner.angularVelocity, point - partner.position) + surface;
    sum.linear += impulse;
    sum.angular += cross(point, impulse);
    sum.energy += dot(impulse, velocity);
  }
}

}  // namespace

void ContactRows::addSupport(const Island& island, const StepContext& context, BalanceChange& sum) const {
  for (std::size_t k = 0; k < size(); k++) {
    const FaceRecord& r = records[k];
    bool partnerA = r.bodyA >= island.bodies.size(), partnerB = r.bodyB >= island.bodies.size();
    if (partnerA || partnerB) addImpulse(at(k, *context.ties), r, starts[k], *context.bodies, partnerA, island.dt, sum);
  }
}

}  // namespace brickfall
