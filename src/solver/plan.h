// How an island is treated in a step: its facts, found once before anyone reads them; a plan made of the facts by one
// table; an ending.
//
// The table (plan.cpp) is the only place that decides by an island's size or speed. docs/step.md prints it, and a test
// compares the two.
#pragma once
#include <cstddef>
#include <span>
#include <string_view>

#include "brickfall/island_ending.h"
#include "brickfall/solver_settings.h"
#include "solver/scale.h"

namespace brickfall {

class BodySet;
struct Island;
struct StepContext;

// Facts at the start of a step.
struct IslandFacts {
  std::size_t bodies = 0;
  bool grounded = false;  // touches something fixed or kinematic
  std::size_t joints = 0, ties = 0;
  bool jointed = false;       // has ties that stay, and on which bodies swing
  bool swung = false;         // ... and they have lately (joint/swings.h): where they turn back is no rest
  bool mortared = false;      // has ties that break, and give no impulse in no time
  bool locked = false;        // a body has locked axes
  bool firm = false;          // has ties so firm that the rounding of ways is a force
  bool partnersGo = false;    // a kinematic partner moves
  bool partnersMove = false;  // ... or a partner's surface runs
  // Of islands that may go on (not asked of slow ones): what is fixed or kinematic carries force, and pins a body.
  bool pressed = false, pinned = false;
  Scale scale;               // of its typical body
  double fastest = 0;        // m/s at the reference's scale, largest |v| + |w| outer radius of a body
  double fastestCentre = 0;  // m/s at the reference's scale, largest |v|
  double heaviest = 0;       // kg
  double energy = 0;         // J, kinetic

  bool jointsAlone() const { return jointed && joints == ties; }
  // Hardly more ties than bodies, nearly all of them joints: a direct solve costs as much for each body as in a small
  // island.
  bool inLine() const { return 8 * ties <= 9 * bodies && 8 * joints >= 7 * bodies; }
};

// One row of the table: the first row that an island fits decides.
struct PlanRow {
  std::string_view islands;  // in words
  std::size_t mostBodies;
  bool jointed;          // has joints
  bool inLine;           // IslandFacts::inLine
  bool onlySlow;         // grounded, and no centre of mass faster than kDebrisSpeed
  bool exactSteps;       // open points are left out of the matrix and searched for instead
  float calmStiffening;  // x restingStiffness while the island is calm
  bool direct;           // Newton on all bodies at once, after the first cycles
  bool large;            // never solved to the end: residuals are judged by each body's load, not by its weight alone
};
std::span<const PlanRow> planRows();

struct SolvePlan {
  bool endVelocities = false;  // jointed, nothing locked: velocities are those of the step's end (joint/swings.h), and
                               // joints know that the ends of their arms go along arcs
  bool holds = false;          // ... and joints are nearly all that ties its bodies: velocities are held, too
  bool swings = false;         // ... and nothing else holds its bodies, nor drives them
  bool alone = false;          // one body
  bool slow = false;           // grounded, partners still, no body faster than restSpeed: it may be put to rest
  bool mayBeStopped = false;   // supported, and so slow that its motion is a vibration's
  bool exactSteps = false;     // see PlanRow
  bool direct = false;         // see PlanRow
  bool large = false;          // see PlanRow
  bool startsFree = true;      // from free motion; else with as much of its fall as each body had
  bool goesOn = false;         // large, not slow, supported by what rolls or slides alone: it goes on as it did
  bool softDebris = false;     // contacts of moving bodies in it have impactStiffness
  double calmStiffening = 1;   // x restingStiffness
  bool calm = false;           // supported, and nothing is faster than what settles
  double leastMass = 0;        // kg: contacts that bear a load are as firm as between bodies of this effective mass
  double tolerance = 0;        // weights: residual under which a body is left alone
  int minCycles = 0, maxCycles = 0;
  std::size_t together = 1;  // level of the hierarchy whose clusters are moved at once; 0: the bodies themselves
  int rounds = 0;            // sweeps over the bodies in a cycle, forwards and backwards in turn
  int renewAfter = 0;        // cycles: after so many what is frozen in the solve is set anew; 0: only where they end
  int mostCycles = 0;        // while many of its bodies are out of balance
};

IslandFacts findFacts(const Island& island, const StepContext& context);
SolvePlan planFor(const IslandFacts& facts, const SolverSettings& settings, double dt);

}  // namespace brickfall
