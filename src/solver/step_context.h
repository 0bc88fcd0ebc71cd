// What the stages of one step share.
#pragma once
#include <memory_resource>
#include <vector>

#include "brickfall/integrators.h"
#include "brickfall/solver_settings.h"
#include "dynamics/body_set.h"
#include "dynamics/contact_set.h"

namespace brickfall {

// Constants of the method; solver.md's recipe in numbers. What users may change is in SolverSettings.
constexpr double kReferenceGravity = 9.81;  // m/s2: weight by which residuals are judged, whatever the scene's gravity
constexpr float kCorrect = 0.5f;            // 1 - alpha: share of an old gap or drift that a step corrects
constexpr float kHeldShare = 0.5f;          // ld: share of the last force held as multiplier
constexpr float kHeldGrowth = 2;            // a held force grows to at most this x the held one ...
constexpr float kHeldWeights = 5;           // ... plus this many effective weights per step
constexpr float kOffsetKept = 0.9f;         // of the plastic offset, per step
constexpr float kLargestDrift = 1e-3f;      // m: an anchor further away is placed anew
constexpr float kNearContact = 5e-3f;       // m: open points nearer than this stay in the Newton matrix
constexpr double kCalmShare = 0.1;      // of g dt, added to the rest speed: an island no faster settles
constexpr int kLineSearchSteps = 8;
constexpr int kLineSearchStepsExact = 16;  // in exact steps: sticking is a very narrow range of motion to find
constexpr double kSlowTolerance = 5e-4;    // worst residual / weight at which a slow island's cycles stop
constexpr int kMaxCyclesSlow = 16;
constexpr double kHeldMove = 25e-6;   // m: a slow island of which no point strays further than this from its place
constexpr double kHeldTime = 0.5;     // s: during this time counts as at rest; an acceleration of 2e-5 g goes further
constexpr int kWeakHold = 3;          // steps a joint stays weak after it last looked weak
constexpr double kLargestTurn = 0.5;  // rad per step of a body in contact: arms are frozen during a step
constexpr int kRestitutionSweeps = 200;

// Motion of a body in this step if nothing touched it.
struct FreeMotion {
  Vec3 d;                         // m: velocity at the end x dt
  Vec3 way;                       // m: of a body without contacts
  Vec3 th;                        // rad, rotation vector
  Quat rotation;                  // where it ends: exact torque-free turn
  double turnTime = 0;            // s, of it: less than dt if the body was stopped
  bool turnsFaster = false;       // than th shows
  Vec3 angularMomentum;           // kg m2/s, at the end
  Vec3 startVelocity, startSpin;  // before forces, for energy
};

// What the solve found: filled by islands, applied by integrate.
struct SolvedMotion {
  Vec3 d;                // m
  Vec3 th;               // rad
  Vec3 velocity;         // m/s
  Vec3 angularMomentum;  // kg m2/s
  bool freeTurn = true;  // no torque acted: take FreeMotion::rotation
  bool rest = false;     // does not move
  bool flying = false;   // no chain of forces leads to anything held
};

struct SolveStatistics {
  int islands = 0, restingIslands = 0, cycles = 0;
  double solveSides = 0, lightVisits = 0;  // point visits
  double residualRms = 0;
};

struct StepContext {
  double dt = 0;
  Vec3 gravity;
  SolverSettings settings;
  Integrator integrator = Integrator::splitting;  // of bodies without contacts
  BodySet* bodies = nullptr;
  ContactSet* contacts = nullptr;
  std::pmr::memory_resource* memory = std::pmr::get_default_resource();  // for all that a step needs for itself
  std::vector<FreeMotion> free;                                          // by body slot
  std::vector<SolvedMotion> solved;                                      // by body slot
  SolveStatistics statistics;
};

}  // namespace brickfall
