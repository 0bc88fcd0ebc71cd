// Looks into a step of a world: the same step, stage by stage, on a copy, held against the converged solution island by
// island.
#pragma once
#include <cstdint>
#include <functional>

#include "brickfall/world.h"
#include "support/newton_oracle.h"

namespace brickfall::oracle {

// How the engine's solve of an island ended.
enum class Ending { rested, exact, slow, moving, exhausted };
constexpr int kEndings = 5;
constexpr const char* kEndingNames[kEndings] = {"rested", "exact", "slow", "moving", "exhausted"};

// An island after its solve, before forces are stored; `look` sees it when they are.
struct SolvedIsland {
  Problem problem;             // friction bounds as the engine's cycles left them
  Problem posed;               // as posed: points that carried nothing have no bound yet
  std::vector<Motion> motion;  // the engine's
  std::vector<Motion> kept;    // as far as its linear and angular momenta go, when the finish has put them right
  Ending ending = Ending::rested;
  bool grounded = false;
  bool slow = false;
  int cycles = 0;
  double residualRms = 0;  // the engine's own figure
  double allowed = 0;      // weights: the most that any body of it may be left with, by its plan and what it carries
  double solveVisits = 0;  // point sides
};

// Makes the world's next step on a copy of it and hands out every awake island that was not passed over. Returns the
// state hash of the copy afterwards: that of the world itself after `world.step(dt)`. Forces that act for one step only
// are not part of a copy: `prepareCopy` applies them.
std::uint64_t probeStep(const World& world, double dt, const std::function<void(const SolvedIsland&)>& look,
                        const std::function<void(World&)>& prepareCopy = {});

// A step of the world itself in which every island that does not rest gets the converged motion instead of the engine's.
struct ConvergedStep {
  int islands = 0, failed = 0, iterations = 0;
  double worst = 0;  // residual left, weights
};
ConvergedStep stepConverged(World& world, double dt, double tolerance = 1e-8);

}  // namespace brickfall::oracle
