// The converged solution of one step, slow: Newton on the convex energy of the step with a sparse Cholesky factorisation
// (Eigen) and a line search to the minimum along each step, so that it converges from anywhere. No cluster, no cycle, no
// stop but the residual, which is read in long double: what the engine's solver is held against.
#pragma once
#include "support/newton_law.h"

namespace brickfall::oracle {

struct Solution {
  std::vector<Motion> motion;  // rounded
  Imbalance left;              // of the motion before that
  int iterations = 0;          // factorisations
  int rounds = 0;              // of friction bounds
  bool converged = false;      // left.worst() <= tolerance, and the bounds too
};

struct NewtonSettings {
  double tolerance = 1e-10;  // weights, worst body
  int iterations = 400;
};

// With the friction bounds as they stand in the problem.
Solution solveFrozen(const Problem& problem, const NewtonSettings& settings = {});
// Points that carried nothing in the last step get the bound that belongs to their normal force at the solution: solved
// over and over, each time with the bounds of the last. Leaves them in the problem.
Solution solveWithNewBounds(Problem& problem, const NewtonSettings& settings = {}, int rounds = 60);

}  // namespace brickfall::oracle
