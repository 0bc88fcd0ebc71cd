// The answer to collisions. The report's: an impulse along the axis, as large as a factor times the speed with which the
// two meet. The parts that it left out: the impulse that masses and inertia ask for, friction, many points, memory.
#include <algorithm>
#include <cmath>

#include "report/impulse.h"

namespace brickfall {

namespace {

using namespace report;

constexpr double kReboundSpeed = 1;   // m/s: slower impacts do not rebound
constexpr double kPushShare = 0.2;    // of the overlap beyond the slop, per step
constexpr double kPushSlop = 0.5e-3;  // m
constexpr double kPushSpeed = 1;      // m/s: no faster

// The report: a factor x the speed at which the centres come closer along the axis. Spins don't count.
double speedImpulse(const ReportBody& a, const ReportBody& b, Vec3 normal, double factor) {
  double closing = dot(normal, a.state.velocity - b.state.velocity), inverse = invMass(a) + invMass(b);
  return closing > 0 && inverse > 0 ? factor * closing / inverse : 0;
}

}  // namespace

void ReportSystem::respond(std::vector<ReportBody>& bodies, std::vector<Collision>& collisions, double dt) const {
  for (Collision& c : collisions) chooseSpeeds(bodies[c.a], bodies[c.b], c, dt);
  if (settings_.warmStarting)
    for (Collision& c : collisions)
      for (Point& p : c.points)
        push(bodies[c.a], bodies[c.b], p.position,
             c.normal * p.normal + c.tangent1 * p.tangent1 + c.tangent2 * p.tangent2);
  for (int sweep = settings_.warmStarting ? settings_.sweeps : 1; sweep > 0; sweep--)
    for (Collision& c : collisions)
      for (Point& p : c.points) {
        pushApart(bodies[c.a], bodies[c.b], c, p);
        if (settings_.friction) holdBack(bodies[c.a], bodies[c.b], c, p);
      }
}

// With which speed each point is to open: rebound, and overlap pushed out. Points that are still apart may close.
void ReportSystem::chooseSpeeds(const ReportBody& a, const ReportBody& b, Collision& c, double dt) const {
  double e = std::max(a.restitution, b.restitution);
  for (Point& p : c.points) {
    double approach = dot(c.normal, relativeVelocity(a, b, p.position));
    double rebound = settings_.restitution && approach < -kReboundSpeed ? -e * approach : 0;
    double out = std::min(kPushSpeed, kPushShare * std::max(0.0, p.depth - kPushSlop) / dt);
    if (!settings_.manifold) out = 0;
    p.wantedSpeed = p.depth < 0 && rebound <= 0 ? p.depth / dt : std::max(rebound, out);
  }
}

void ReportSystem::pushApart(ReportBody& a, ReportBody& b, const Collision& c, Point& p) const {
  double before = p.normal;
  if (settings_.restitution) {
    double missing = p.wantedSpeed - dot(c.normal, relativeVelocity(a, b, p.position));
    p.normal = std::max(0.0, p.normal + missing * effectiveMass(a, b, p.position, c.normal));
  } else {
    p.normal += speedImpulse(a, b, c.normal, settings_.impulseFactor);
  }
  push(a, b, p.position, c.normal * (p.normal - before));
}

// Coulomb's law: what stops the sliding, but no more than the normal impulse allows.
void ReportSystem::holdBack(ReportBody& a, ReportBody& b, const Collision& c, Point& p) const {
  double limit = std::sqrt(a.friction * b.friction) * p.normal;
  Vec3 speed = relativeVelocity(a, b, p.position), before = c.tangent1 * p.tangent1 + c.tangent2 * p.tangent2;
  p.tangent1 -= dot(c.tangent1, speed) * effectiveMass(a, b, p.position, c.tangent1);
  p.tangent2 -= dot(c.tangent2, speed) * effectiveMass(a, b, p.position, c.tangent2);
  double size = std::sqrt(p.tangent1 * p.tangent1 + p.tangent2 * p.tangent2);
  double share = size > limit ? limit / size : 1;
  p.tangent1 *= share;
  p.tangent2 *= share;
  push(a, b, p.position, c.tangent1 * p.tangent1 + c.tangent2 * p.tangent2 - before);
}

}  // namespace brickfall
