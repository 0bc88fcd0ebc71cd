// The fields of SolverSettings with their ranges, for code that takes all of them: the check of a caller's settings,
// snapshots.
#pragma once
#include "brickfall/solver_settings.h"

namespace brickfall {

// Calls visit(name, value, least, most) for each. `Settings`: SolverSettings, const or not.
template <class Settings, class Visitor> void eachSetting(Settings& s, Visitor&& visit) {
  // As many names as there are fields: one more in SolverSettings does not compile until it is visited here.
  auto& [restingStiffness, impactStiffness, restingApproachSpeed, contactMargin, restitutionSpeed, restSpeed,
         restTolerance, cycleTolerance, minCycles, maxCycles, maxCyclesSmall, maxHitParts] = s;
  visit("restingStiffness", restingStiffness, 10, 1e5);
  visit("impactStiffness", impactStiffness, 1, restingStiffness);
  visit("restingApproachSpeed", restingApproachSpeed, 0, 100);
  visit("restitutionSpeed", restitutionSpeed, 0, 100);
  visit("contactMargin", contactMargin, 1e-5, 1);
  visit("restSpeed", restSpeed, 0, 1);
  visit("restTolerance", restTolerance, 0, 1);
  visit("cycleTolerance", cycleTolerance, 1e-6, 10);
  visit("minCycles", minCycles, 1, 64);
  visit("maxCycles", maxCycles, minCycles, 256);
  visit("maxCyclesSmall", maxCyclesSmall, minCycles, 256);
  visit("maxHitParts", maxHitParts, 1, 64);
}

}  // namespace brickfall
