// The answer to a collision. The report's: an impulse along the axis, as large as a factor times the speed with which the
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

void tangents(Vec3 n, Vec3& t1, Vec3& t2) {
  Vec3 across = std::fabs(n.x) < 0.6 ? Vec3{1, 0, 0} : Vec3{0, 1, 0};
  t1 = normalized(cross(n, across));
  t2 = cross(n, t1);
}

// The report: a factor x the speed at which the centres come closer along the axis. Spins don't count.
double speedImpulse(const ReportBody& a, const ReportBody& b, Vec3 normal, double factor) {
  double closing = dot(normal, a.state.velocity - b.state.velocity), inverse = invMass(a) + invMass(b);
  return closing > 0 && inverse > 0 ? factor * closing / inverse : 0;
}

}  // namespace

void ReportSystem::respond(std::vector<ReportBody>& bodies, std::vector<Collision>& collisions, double dt) const {
  // Speeds wanted along the normal: rebound, and overlap pushed out.
  std::vector<double> wanted;
  for (Collision& c : collisions) {
    const ReportBody &a = bodies[c.a], &b = bodies[c.b];
    double e = std::max(a.restitution, b.restitution);
    for (Point& p : c.points) {
      double approach = dot(c.normal, relativeVelocity(a, b, p.position));
      double rebound = settings_.restitution && approach < -kReboundSpeed ? -e * approach : 0;
      double out = settings_.manifold ? std::min(kPushSpeed, kPushShare * std::max(0.0, p.depth - kPushSlop) / dt) : 0;
      wanted.push_back(std::max(rebound, out));
    }
  }
  if (settings_.warmStarting)
    for (Collision& c : collisions) {
      Vec3 t1, t2;
      tangents(c.normal, t1, t2);
      for (Point& p : c.points)
        push(bodies[c.a], bodies[c.b], p.position, c.normal * p.normal + t1 * p.tangent1 + t2 * p.tangent2);
    }
  for (int sweep = settings_.warmStarting ? settings_.sweeps : 1; sweep > 0; sweep--) {
    std::size_t k = 0;
    for (Collision& c : collisions) {
      ReportBody &a = bodies[c.a], &b = bodies[c.b];
      Vec3 t1, t2;
      tangents(c.normal, t1, t2);
      for (Point& p : c.points) {
        Vec3 speed = relativeVelocity(a, b, p.position);
        double missing = wanted[k++] - dot(c.normal, speed);
        double before = p.normal;
        if (!settings_.restitution) {
          p.normal += speedImpulse(a, b, c.normal, settings_.impulseFactor);
        } else {
          p.normal = std::max(0.0, p.normal + missing * effectiveMass(a, b, p.position, c.normal));
        }
        push(a, b, p.position, c.normal * (p.normal - before));
        if (!settings_.friction) continue;
        double limit = std::sqrt(a.friction * b.friction) * p.normal;
        speed = relativeVelocity(a, b, p.position);
        Vec3 old = t1 * p.tangent1 + t2 * p.tangent2;
        p.tangent1 -= dot(t1, speed) * effectiveMass(a, b, p.position, t1);
        p.tangent2 -= dot(t2, speed) * effectiveMass(a, b, p.position, t2);
        double size = std::sqrt(p.tangent1 * p.tangent1 + p.tangent2 * p.tangent2);
        double share = size > limit ? limit / size : 1;
        p.tangent1 *= share;
        p.tangent2 *= share;
        push(a, b, p.position, t1 * p.tangent1 + t2 * p.tangent2 - old);
      }
    }
  }
}

}  // namespace brickfall
