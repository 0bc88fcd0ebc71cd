// One step of one island as a problem in numbers, in double, made from what a world remembers (bodies, contacts) by the
// words of docs/step.md: independent of the records and kernels with which the engine solves it.
//
//   body    M (dFree - d) / h^2 + sum of contact forces = 0, and so for the turn
//   point   fn = max(trialN - k Cn, 0),  ft = trialT - k Ct, scaled back to the friction bound, which is frozen
//
// The left sides are minus the gradient of a convex energy, so there is exactly one solution: newton_oracle.h finds it.
#pragma once
#include <vector>

#include "solver/island.h"

namespace brickfall::oracle {

constexpr double kWeightUnit =
    9.81;  // m/s2; written out, as all constants of the law here, so that a change of the engine's shows

struct ProblemBody {
  double mass = 0;              // kg
  Mat3 inertia, invInertia;     // kg m2, world axes
  Vec3 position;                // m, centre of mass, from the first body's
  Vec3 dFree, thFree;           // m, rad: of this step if nothing touched it
  double inner = 0, outer = 0;  // m, radii
};

struct ProblemPoint {
  int a = 0, b = 0;                   // bodies; from bodies.size() on: partners
  Vec3 n, t1, t2;                     // unit, world, n from a to b
  Vec3 armA, armB;                    // m, from the centres of mass to the point
  double k = 0;                       // N/m
  double trialN = 0;                  // N, at zero motion
  Vec3 trialT;                        // N, across n
  double limit = 0;                   // N, friction bound
  bool carriedNothing = false;        // in the last step: its bound follows its normal force ...
  double friction = 0, newBound = 0;  // ... times friction, of at most so many N
  ContactIndex contact = 0;
  int lane = 0;
};

// Displacement (m) and turn (rad) of a body in the step.
template <class T> struct MotionOf { Vec3T<T> d, th; };
using Motion = MotionOf<double>;
// As the oracle keeps it: a double's last bit of a way of metres is 1e-9 weights through the stiffest springs.
using FineMotion = MotionOf<long double>;

struct Problem {
  double dt = 0;
  std::vector<ProblemBody> bodies;
  std::vector<Motion> partners;  // given
  std::vector<ProblemPoint> points;

  double mass() const;
};

// To be called between the stages prepare and solve, when contacts hold this step's stiffness, offsets and anchors.
Problem problemOf(const Island& island, const StepContext& context);

// The friction bounds as the engine's cycles left them. To be called after the solve.
void takeLimits(Problem& problem, const Island& island);
// The engine's motion, in double. To be called after the solve.
std::vector<Motion> engineMotion(const Island& island);

}  // namespace brickfall::oracle
