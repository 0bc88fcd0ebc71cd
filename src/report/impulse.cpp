#include "report/impulse.h"

namespace brickfall::report {

Vec3 invInertiaTimes(const ReportBody& body, Vec3 v) {
  if (!(body.mass.mass > 0)) return {};
  Quat q = body.state.rotation;
  return rotate(q, inverse(body.mass.inertia) * rotate(conjugate(q), v));
}

Vec3 relativeVelocity(const ReportBody& a, const ReportBody& b, Vec3 point) {
  auto at = [&](const ReportBody& body) {
    return body.state.velocity + cross(body.state.angularVelocity, point - body.state.position);
  };
  return at(b) - at(a);
}

double effectiveMass(const ReportBody& a, const ReportBody& b, Vec3 point, Vec3 direction) {
  auto response = [&](const ReportBody& body) {
    Vec3 arm = point - body.state.position;
    return invMass(body) + dot(direction, cross(invInertiaTimes(body, cross(arm, direction)), arm));
  };
  double sum = response(a) + response(b);
  return sum > 0 ? 1 / sum : 0;
}

void push(ReportBody& a, ReportBody& b, Vec3 point, Vec3 impulse) {
  auto give = [&](ReportBody& body, Vec3 p) {
    body.state.velocity += p * invMass(body);
    body.state.angularVelocity += invInertiaTimes(body, cross(point - body.state.position, p));
  };
  give(a, -impulse);
  give(b, impulse);
}

}  // namespace brickfall::report
