#include "support/newton_problem.h"

#include <algorithm>
#include <map>

namespace brickfall::oracle {

namespace {

// docs/step.md, "The contact law", and docs/constants.md; written out here so that a change of the engine's shows.
constexpr double kHalf = 0.5;  // of the last force held, and of an old gap or drift corrected

ProblemBody bodyOf(BodyIndex index, const StepContext& context, double dt) {
  const BodySet& set = *context.bodies;
  const BodyMotion& m = set.motion[index];
  const BodyData& data = set.data[index];
  ProblemBody b;
  b.mass = set.mass[index].mass;
  Mat3 axes = toMatrix(m.rotation);
  b.inertia = axes * set.mass[index].inertia * transpose(axes);
  b.invInertia = axes * set.mass[index].invInertia * transpose(axes);
  b.inner = set.mass[index].innerRadius;
  b.outer = set.mass[index].outerRadius;
  Vec3 acceleration = context.gravity * data.gravityScale + data.force * (1 / b.mass);
  b.dFree =
      (m.linearVelocity - context.free[index].late) * dt + acceleration * (dt * dt * (1 - context.aheadOf(index)));
  b.thFree = context.free[index].th;
  return b;
}

// m: what the way of a point of a body alone bends by, beyond what its arm at the start says. On a round side the place of
// touch stays `round` from the middle of the curvature. Rims are left out: no scene has them.
Vec3 arcOf(BodyIndex alone, Vec3 arm, Vec3 round, const Island& island, const StepContext& context, double dt) {
  constexpr double kFarTurn = 0.5;  // rad
  const BodySet& bodies = *context.bodies;
  const Vec3 w = bodies.motion[alone].angularVelocity;
  if (length(w) * dt > kFarTurn || bodies.mass[alone].round) return {};
  const double late = island.facts.partnersMove ? 0.5 * dt : 0.5 * bodies.data[alone].steady.dt;
  const Vec3 free = bodies.worldInvInertia(alone) * cross(bodies.worldInertia(alone) * w, w);
  return cross(w, cross(w, arm - round)) * (dt * (dt - late)) + cross(free, arm) * (dt * (0.5 * dt - late));
}

// Point i of a contact, all but its bodies' numbers.
ProblemPoint pointOf(const Contact& c, const ContactGeometry& g, int i, const Island& island,
                     const StepContext& context, double dt) {
  const BodyMotion &a = context.bodies->motion[c.bodyA], &b = context.bodies->motion[c.bodyB];
  Mat3 axes = toMatrix(a.rotation);
  std::size_t lane = std::size_t(i);
  ProblemPoint p;
  p.lane = i;
  p.n = axes * g.normal;
  p.t1 = axes * g.tangent1;
  p.t2 = cross(p.n, p.t1);
  p.armA = axes * g.centre + p.t1 * double(c.points.s1[lane]) + p.t2 * double(c.points.s2[lane]);
  p.armB = p.armA + (a.position - b.position);
  p.k = c.points.stiffness[lane];
  double gap = double(c.points.gap[lane]) - double(c.points.offset[lane]);
  p.trialN = kHalf * c.points.multiplierN[lane] - p.k * (gap > 0 ? gap : kHalf * gap);
  p.trialT = p.t1 * (kHalf * c.points.multiplier1[lane] - p.k * kHalf * c.points.drift1[lane]) +
             p.t2 * (kHalf * c.points.multiplier2[lane] - p.k * kHalf * c.points.drift2[lane]);
  if (island.bodies.size() == 1) {
    const bool isB = c.bodyB == island.bodies[0];
    const double sign = isB ? 1 : -1;
    const Vec3 round = c.rolls ? p.n * (-sign * double(c.rollingRadius)) : Vec3{};
    const Vec3 bend = arcOf(island.bodies[0], isB ? p.armB : p.armA, round, island, context, dt) * sign;
    p.trialN -= p.k * dot(p.n, bend);
    p.trialT -= (p.t1 * dot(p.t1, bend) + p.t2 * dot(p.t2, bend)) * p.k;
  }
  p.friction = c.friction;
  p.limit = p.friction * std::max(0.0, double(c.points.forceN[lane]));
  p.carriedNothing = c.points.forceN[lane] == 0;
  Vec3 approach =
      b.linearVelocity + cross(b.angularVelocity, p.armB) - a.linearVelocity - cross(a.angularVelocity, p.armA);
  p.newBound = c.effectiveMass * (std::max(0.0, -dot(p.n, approach)) + kWeightUnit * dt) / dt;
  return p;
}

}  // namespace

double Problem::mass() const {
  double sum = 0;
  for (const ProblemBody& b : bodies) sum += b.mass;
  return sum;
}

Problem problemOf(const Island& island, const StepContext& context) {
  Problem out;
  const double dt = island.dt;
  out.dt = dt;
  std::map<BodyIndex, int> number;
  for (BodyIndex body : island.bodies) {
    number[body] = int(number.size());
    out.bodies.push_back(bodyOf(body, context, dt));
    out.bodies.back().position =
        context.bodies->motion[body].position - context.bodies->motion[island.bodies.front()].position;
  }
  for (BodyIndex body : island.partners) {
    number[body] = int(number.size());
    const BodyMotion& m = context.bodies->motion[body];
    out.partners.push_back({m.linearVelocity * dt, m.angularVelocity * dt});
  }
  for (ContactIndex index : island.rows.contacts.tieOf) {
    const Contact& c = context.ties->contacts.contacts[index];
    for (int i = 0; i < c.count; i++) {
      ProblemPoint p = pointOf(c, context.ties->contacts.geometry[index], i, island, context, dt);
      p.a = number.at(c.bodyA);
      p.b = number.at(c.bodyB);
      p.contact = index;
      out.points.push_back(p);
    }
  }
  return out;
}

void takeLimits(Problem& problem, const Island& island) {
  std::map<ContactIndex, const FaceRecord*> records;
  for (std::size_t k = 0; k < island.rows.contacts.tieOf.size(); k++)
    records[island.rows.contacts.tieOf[k]] = &island.rows.contacts.records[k];
  for (ProblemPoint& p : problem.points) p.limit = double(records.at(p.contact)->limit[p.lane]);
}

std::vector<Motion> engineMotion(const Island& island) {
  std::vector<Motion> out;
  for (std::size_t i = 0; i < island.bodies.size(); i++) {
    const SolveMotion& m = island.motion[i];
    // A resting island has not moved at all; its drift is that of nothing.
    out.push_back({toDouble(m.d) + (island.resting() ? Vec3{} : island.rigid.move), toDouble(m.th)});
  }
  return out;
}

}  // namespace brickfall::oracle
