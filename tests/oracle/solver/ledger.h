// What the engine's step and the converged one were found to differ by, summed over many steps, by how the engine's solve
// ended; and how often each regime was met.
#pragma once
#include <array>
#include <string>

#include "scenes.h"
#include "support/newton_probe.h"

namespace brickfall::oracle {

// Of all islands whose solve ended in one way, the worst of each.
struct EndingSums {
  int islands = 0, bodies = 0, cycles = 0;
  double force = 0, torque = 0, rms = 0, mean = 0;  // residual of the engine's motion, weights (Imbalance)
  double steady = 0, steadyRms = 0;                 // the same, where no new point carries force, less float's rounding
  double ofAllowed = 0;                             // the same, over what the plan of the island allows
  double noise = 0;                                 // and there: the engine's own rms against that in double
  double deviation = 0;                             // mean distance from the converged motion, g h^2
  double millimetres = 0;                           // distance of any point from where it would be
  double forceError = 0;                            // of a point's force, in mean weights of the island's bodies
  double ownBounds = 0;  // as deviation, from the solution with the bounds of new points its own
};

struct Ledger {
  std::array<EndingSums, kEndings> endings;
  int steps = 0, islands = 0;
  int sticking = 0, sliding = 0, open = 0, opening = 0, closing = 0;  // points, by the converged solution
  int wrongStates = 0;                                                // points in another state in the engine
  double oracleLeft = 0;                                              // worst residual of the oracle, weights
  int iterations = 0, failures = 0;                                   // of the oracle
  int ownBoundSolves = 0, ownBoundFailures = 0;
  double excess = 0;    // largest deviation / what strict convexity allows: at most 1
  double momentum = 0;  // islands that touch nothing fixed: momentum that the step made up, in g h m
  int floating = 0;
  int hashesDiffer = 0;

  void add(const SolvedIsland& solved);
  void add(const Ledger& other);
  void print(const std::string& title) const;
  const EndingSums& of(Ending ending) const { return endings[std::size_t(ending)]; }
};

// Lets the scene run and looks into every `every`-th step.
Ledger follow(Trial trial, double seconds, int every);
// Prints what was found, records it for the validation page and expects what scenes_test.cpp says of every scene.
void conclude(const std::string& name, double dt, const Ledger& ledger);
// Both.
Ledger look(const std::string& name, Trial trial, double seconds, int every);

}  // namespace brickfall::oracle
