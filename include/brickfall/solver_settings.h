// What tunes the contact solver.
#pragma once

namespace brickfall {

// Everything that tunes the contact solver. The defaults are those under which all figures in docs were measured; each
// trades honesty, stiffness and cost (docs/step.md). Stiffness unit u = mEff / dt^2, mEff = 1 / (1/mA + 1/mB).
// Lengths and speeds hold for a brick of 32.5 mm inner radius under 9.81 m/s2. For an inner radius r under gravity g lengths are in
// proportion to r, speeds to sqrt(g r): what is larger or heavier looks the same.
struct SolverSettings {
  //! u | too small: walls sag (40 courses: 0.6 mm, proportional to 1 / this)
  //! | too large: disturbed walls converge later: more visits
  double restingStiffness = 1000;  // u, 10 .. 1e5: elastic sag ~ 1/this; stiffer converges later when disturbed.
                                   // Islands of 25 bodies and more that are not solved directly take a part of it at
                                   // steps under 1/60 s
  //! u | too small: deep overlap in hits | too large: a hit is one hard blow; more of the wall is shaken
  double impactStiffness = 30;  // u, 1 .. restingStiffness: of a point born in an impact
  //! m/s | too small: settling bricks count as impacts: soft, plastic
  //! | too large: real impacts are stiff from the start
  double restingApproachSpeed = 0.3;  // m/s, 0 .. 100: contacts born slower are resting, not impacts
  //! m | too small: points come too late: fast bodies overlap first | too large: more points that carry nothing
  double contactMargin = 0.010;  // m, 1e-5 .. 1: contacts are made this early (and approach x dt more), between
      // dynamic bodies plus the way of the faster one in the step; at most 0.3 inner radii of the
      // thinner shape
  //! m/s | too small: heaps chatter | too large: bounces end early (few bodies go on to g h / 100)
  double restitutionSpeed = 1;  // m/s, 0 .. 100: slower impacts do not rebound; of few bodies (docs/step.md, impacts at
                                // their moment) at most a hundredth of gravity x dt. Smaller: heaps chatter longer
  //! m/s | too small: walls sway for seconds after a hit | too large: a body that begins to fall slowly may be stopped
  double restSpeed = 1e-2;  // m/s, 0 .. 1: only islands slower than this may be stopped or put to rest; large ones of
                            // up to 30 mm/s are stopped too, where a swing ends
  //! weights | too small: float noise keeps walls awake | too large: slow topples are stopped
  double restTolerance = 1e-3;  // 0 .. 1: residual / max(weight, 0.02 load) accepted as "nothing moves"
  //! of load | too small: more cycles | too large: the left-over error moves bodies
  double cycleTolerance = 2e-2;  // 1e-6 .. 10: residual / max(weight, 0.3 load) under which a body of a large moving
                                 // island is left alone; load: half the sum of the forces on it
  //! - | too small: 2 hang bodies in the air (`topple` stays up) | too large: cost
  int minCycles = 4;  // 1 .. 64: fewer glue bodies in place (they hang in the air). Before a direct solve of 2 to 24
                      // bodies there is one
  //! - | too small: slow collapses come late | too large: cost of hits
  int maxCycles = 10;  // minCycles .. 256, islands of 25 bodies and more. Three times as many while a twentieth of
                       // the bodies is out of balance
  //! - | too small: bodies alone whose points open and close stay unbalanced | too large: its cost
  int maxCyclesSmall = 64;  // minCycles .. 256: the same for a body alone
  //! - | too small: at long time steps heavy balls punch clean holes into walls that they should push apart
  //! | too large: cost of fast hits
  int maxHitParts = 8;  // 1 .. 64: a step in which something heavy goes far into what it hits is made in up to so many
                        // parts, equal but where mortar holds that; up to twice as
                        // many where a part is taken again in halves; 1: never
};

}  // namespace brickfall
