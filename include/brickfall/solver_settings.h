// What tunes the contact solver.
#pragma once

namespace brickfall {

// Everything that tunes the contact solver. The defaults are those under which all figures in docs were measured; each
// trades honesty, stiffness and cost (docs/step.md). Stiffness unit u = mEff / dt^2, mEff = 1 / (1/mA + 1/mB).
struct SolverSettings {
  double restingStiffness = 1000;     // u, 10 .. 1e5: elastic sag ~ 1/this; stiffer converges later when disturbed
  double impactStiffness = 30;        // u, 1 .. restingStiffness: of a point born in an impact
  double restingApproachSpeed = 0.3;  // m/s: contacts born slower are resting, not impacts
  double contactMargin = 0.010;  // m: contacts are made this early (plus approach x dt); for small bodies 0.3 of the
                                 // smaller one's inner radius
  double restitutionSpeed = 1;  // m/s, >= 0: slower impacts do not rebound; for a body alone on something fixed at most
                                // gravity x dt. Smaller: heaps chatter longer before they rest
  double restSpeed = 1e-2;      // m/s: only islands slower than this may be stopped or put to rest
  double restTolerance = 1e-3;  // residual / weight accepted as "nothing moves"
  double cycleTolerance = 1e-2;  // rms residual / weight at which a moving island is done
  int minCycles = 4;             // 1 .. 64: fewer glue bodies in place (they hang in the air)
  int maxCycles = 8;             // minCycles .. 256, islands of 80 bodies and more
  int maxCyclesSmall = 64;       // the same for the smallest islands (640 / bodies, clamped)
};

}  // namespace brickfall
