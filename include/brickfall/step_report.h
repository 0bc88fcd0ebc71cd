// What a step did and what it cost.
#pragma once
#include <array>
#include <cstdint>
#include <optional>
#include <vector>

#include "brickfall/ids.h"
#include "brickfall/island_ending.h"
#include "brickfall/step_trace.h"

namespace brickfall {

struct StepReport {
  std::uint64_t stepIndex = 0;  // of the step just made, from 1
  double time = 0;              // s, simulated time after the step
  std::array<double, kStageCount> stageMilliseconds{};
  double milliseconds = 0;  // whole step, wall clock
  int parts = 0;            // that it was made in: a substep in which something heavy hits takes several
  int bodies = 0;           // dynamic bodies, asleep ones included
  int awakeBodies = 0;
  int manifolds = 0;                                    // of awake bodies
  int contactPoints = 0;                                // of awake bodies
  int touchingPoints = 0;                               // points that carry force
  int islands = 0;                                      // awake
  int restingIslands = 0;                               // accepted by the rest check: they cost one light pass
  std::array<int, kIslandEndingCount> islandEndings{};  // awake islands by how their solve ended, of all parts
  int cycles = 0;                                       // and steps of direct solves, summed over islands
  double solveVisits = 0;  // two-sided visits of a point in the solve, line search included
  double lightVisits = 0;  // visits that only read forces
  double residualRms = 0;  // worst island: rms of |force residual| / weight when the solve stopped
  double worstResidual =
      0;  // of a moving island's body when the solve stopped: force (torque: at its inner radius) over
          // the larger of its weight and half the sum of the forces on it
  int unbalancedBodies = 0;  // bodies that were left with more than 0.05 of that, of all parts
  double energyTaken =
      0;  // J, that bodies had beyond all that was given to them when the step ended: the last check took it back
  int impacts = 0;  // of small islands, each met at its moment within the step
  int manifoldsReused = 0;
  int manifoldsComputed = 0;
  std::vector<BodyId> quarantined;  // bodies that became non-finite or lost (limits.h) in this step
  // Only as World::trace asked for:
  std::vector<StageHash> stageHashes;  // of every part: what it was given, then each stage
  std::optional<StepLedger> ledger;    // of all parts together
};

}  // namespace brickfall
