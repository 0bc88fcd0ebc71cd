// The contact law of docs/step.md point by point, in world axes, its derivative and the energy of which it is the
// gradient. T: double or long double, in which forces are added up.
#pragma once
#include "support/newton_problem.h"

namespace brickfall::oracle {

// In another precision.
template <class T, class From> Vec3T<T> as(Vec3T<From> v) { return {T(v.x), T(v.y), T(v.z)}; }
template <class T> Mat3T<T> as(const Mat3& m) { return {{as<T>(m.row[0]), as<T>(m.row[1]), as<T>(m.row[2])}}; }

template <class T> struct PointForceOf {
  T n = 0, trialN = 0;  // N
  Vec3T<T> t;           // N, friction on b
  Vec3T<T> trialT;
  bool slides = false;
  bool loaded() const { return n > 0; }
};
using PointForce = PointForceOf<double>;

// Force and torque.
struct Load {
  Vec3 force, torque;
};

template <class T>
PointForceOf<T> pointForce(const Problem& problem, const ProblemPoint& p, const std::vector<MotionOf<T>>& x);
std::vector<PointForce> pointForces(const Problem& problem, const std::vector<Motion>& x);
// Derivative of the force by the relative displacement of the point, negative: symmetric, never negative definite.
template <class T> Mat3 pointStiffness(const ProblemPoint& p, const PointForceOf<T>& f);

// Inertia and contact forces of every body: zero at the solution.
template <class T> std::vector<Load> residuals(const Problem& problem, const std::vector<MotionOf<T>>& x);
// Minus its gradient are the residuals.
double stepEnergy(const Problem& problem, const std::vector<Motion>& x);

// Residuals as accelerations in g. `force`, `torque`: worst body, in its weights (torque as a force at its inner radius).
// `rmsForce`: what the engine's cycles stop by. `mean`: sqrt(sum r M^-1 r / sum m) / g, torque by the true inertia. The
// energy is strictly convex with at least M / h^2, therefore no motion is further from the solution than this:
//   sqrt(sum e M e / sum m) <= mean g h^2.
struct Imbalance {
  double force = 0, torque = 0, rmsForce = 0, mean = 0;
  double worst() const { return force > torque ? force : torque; }
};
Imbalance imbalanceOf(const Problem& problem, const std::vector<Load>& residual);
Imbalance imbalanceAt(const Problem& problem, const std::vector<Motion>& x);

// Distance of two motions: `mean` as above, in g h^2; `largest` of any point of any body, m.
struct Deviation {
  double mean = 0, largest = 0;
};
Deviation deviationOf(const Problem& problem, const std::vector<Motion>& x, const std::vector<Motion>& y);

}  // namespace brickfall::oracle
