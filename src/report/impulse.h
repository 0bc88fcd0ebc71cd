// Impulses between two boxes at a point.
#pragma once
#include "report/report_system.h"

namespace brickfall::report {

inline double invMass(const ReportBody& body) { return body.mass.mass > 0 ? 1 / body.mass.mass : 0; }

// Inverse inertia in world axes applied to v; zero for what does not move.
Vec3 invInertiaTimes(const ReportBody& body, Vec3 v);
// Velocity of the point of b minus that of a, m/s.
Vec3 relativeVelocity(const ReportBody& a, const ReportBody& b, Vec3 point);
// Mass that an impulse along the unit direction at the point meets, kg; 0 if neither body moves.
double effectiveMass(const ReportBody& a, const ReportBody& b, Vec3 point, Vec3 direction);
// Impulse (N s) on b at the point, its opposite on a.
void push(ReportBody& a, ReportBody& b, Vec3 point, Vec3 impulse);

}  // namespace brickfall::report
