// Speeds of the points of contacts, and how fast an impact must be to count as one.
#pragma once
#include "solver/island.h"

namespace brickfall {

// m/s: the normal speed of B against A at each point, for velocities of the two bodies, or its change, for theirs:
// negative = closing.
inline void speedsOf(const FaceRecord& r, int count, const EndChanges& by, double* out) {
  const Vec3 n = toDouble(r.n), t1 = toDouble(r.t1), t2 = cross(n, t1), w = by.b.turn - by.a.turn;
  const Vec3 u = by.b.move + cross(by.b.turn, toDouble(r.armB)) - by.a.move - cross(by.a.turn, toDouble(r.armA));
  for (int i = 0; i < count; i++) out[i] = dot(n, u) + dot(t1, w) * double(r.s2[i]) - dot(t2, w) * double(r.s1[i]);
}
inline VelocityChange velocityOf(const BodyMotion& m) { return {m.linearVelocity, m.angularVelocity}; }

// m/s: slower impacts of the contact are left to the step.
double slowestImpact(const Contact& contact, const Island& island, const StepContext& context);
// m/s: slower impacts do not rebound within a step. In a heap every body would chatter with its neighbours. A body
// alone on something fixed bounces on, down to a trifle of what gravity gives it in one.
double slowestRebound(const Island& island, const StepContext& context);

}  // namespace brickfall
