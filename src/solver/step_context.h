// The data that the stages of one step share.
#pragma once
#include <algorithm>
#include <memory_resource>
#include <vector>

#include "brickfall/integrators.h"
#include "brickfall/solver_settings.h"
#include "dynamics/body_set.h"
#include "dynamics/ties.h"
#include "solver/scale.h"

namespace brickfall {

// Constants of the method that several files share; docs/step.md explains them. Constants that users may change are in
// SolverSettings. Lengths, speeds and times are those of the reference brick: all other bodies have them in proportion
// (scale.h).
//! - | too small: gaps, drifts and joints' errors of the last step are corrected more slowly
//! | too large: oscillation from step to step
constexpr float kCorrect = 0.5f;  // 1 - alpha: share of an old gap, drift or error that a step corrects
//! not of the method: follows from kCorrect
constexpr float kMultiplierShare = 1 - kCorrect;  // of the last force, kept as multiplier: at rest fn = -k gap
//! mEff g | too small: loads build up over many steps | too large: an impact's force acts twice
constexpr float kMultiplierWeights = 5;  // by which a multiplier grows at most in a step
//! - | too small: overlap from a landing is released at once, as a rebound | too large: the overlap stays for long
constexpr float kOffsetKept = 0.9f;  // of the plastic offset, per step
//! m/s | too small: a body that lies on parted overlap rests late | too large: with kOffsetKept
constexpr double kLeastRelease = 1e-4;  // m/s: the offset shrinks at least so fast, until nothing is left of it
//! m | too small: steps run through open points | too large: short steps: late collapses
constexpr double kNearContact = 5e-3;  // m: open points nearer than this stay in the Newton matrix
//! g h | too small: overhangs of 99 % fall; slides and rolls lose half a step of way
//! | too large: float noise moves sliding bodies; bodies that land or leave get a correction that is not theirs
constexpr double kCalmShare = 0.1;  // of g dt, added to the rest speed: an island no faster settles; and so little a
                                    // velocity changes at a point that neither lands nor leaves
//! weights | too small: cost | too large: islands repeat an error for ever and do not rest
constexpr double kSmallTolerance = 5e-4;  // of a body in a small island, or on which a force acts that resists rolling
//! s | too small: a very slow start of a fall is stopped | too large: walls with points at an edge rest late
constexpr double kInPlaceTime = 0.5;  // a slow island of which no point strays by kNearlyClosed so long is at rest
//! m/s | too small: a hit wall that sways is taken for debris, and sways on for seconds: walls sag
//! | too large: rubble is treated like a standing wall, and a body that begins to fall slowly may be stopped
constexpr double kMovingSpeed = 0.03;  // of a body of a large island: faster ones move, slower ones sway at most
//! times the mass | too small: cost of debris; a body goes on through what is only a little lighter
//! | too large: bodies that a ball knocks out are gone before they can push anything aside, and hold it in the air;
//! what is slow and heavy stops at a mortared brick for nothing
constexpr double kHeavier = 10;  // a body is far heavier than another
//! rad | too small: fast spins reach contacts too weakly | too large: rebounds at high speed explode
constexpr double kLargestTurn = 0.5;  // rad per step of a body in contact: arms are frozen during a step
//! - | too small: counts residuals that nobody sees: cost; shapes of chunks that spin creep
//! | too large: bodies hang in the air, balls on loose bricks roll on; what turns in a hit breaks mortar by its turn
constexpr double kLeftOver = 0.05;  // of max(weight, load), of mortar's strength, of what resists rolling, of an
                                    // island's bodies, of the rest speed: a solve may leave so much

//! - | too small: heavily loaded bodies are solved too finely: cost | too large: heavily loaded bodies hang
constexpr double kLoadShare = 0.3;  // of a body's load: so much counts like its weight
//! - | too small: floats leave bodies under a great load out of balance: cost | too large: such bodies are solved badly
constexpr double kHeavyLoad = 0.02;  // of a body's load: this counts like its weight where islands are solved directly

//! - | too small: rounding and small changes are followed: cost; walls sway for longer
//! | too large: badly solved impacts change momentum and energy; balls that roll on a wall are stopped; floats round
//! away the balance of light blocks under a great load
constexpr double kTrifle = 0.01;  // of a force, stiffness, speed, energy, mass, size or turn: so little counts as none

//! - | too small: rounding is taken for change: islands do not settle
//! | too large: forces stop short of their end, energy may creep up
constexpr double kFloatsRound = 1e-6;  // of a sum that floats found

//! of a length; - | too small: rounding of normals leaves slides short, of places makes a blow miss what it meets head
//! on; outlines made of floats are refused
//! | too large: groups that slide in a corner are lifted out of it; a body strikes what it only passes
constexpr double kShapesRound = 1e-3;  // places and directions of shapes are no finer

//! not of the method: the last bit of a float, of its value
constexpr double kLastBit = 0x1p-23;

//! m | too small: rounding opens points in contact; bricks side by side leave each other's slides short; joints whose
//! points meet have no direction, and are as firm as walls
//! | too large: impacts at near points are let through; bodies are moved into each other; short springs have no
//! direction
constexpr double kNoGap = 1e-6;
//! m | too small: points that landed together are hit one by one; cost of bodies that hardly move
//! | too large: near points are hit before they close; slow landings are first order in the time step
constexpr double kNearlyClosed = 20e-6;  // way that an impact may leave out, in a step or to its end

//! of the speed at its start | too small: points under pressure rebound late; balls lose speed at seams
//! | too large: impacts that still go on give back too little; balls pass edges that they should glance off
constexpr double kOver = 0.1;  // an approach that has become so slow is over

// Motion of a body in this step if nothing touched it.
struct FreeMotion {
  Vec3 d;                         // m: velocity at the end x dt
  Vec3 way;                       // m: of a body without contacts
  Vec3 th;                        // rad, rotation vector
  Quat rotation;                  // at the end of the turn: exact torque-free turn
  double dt = 0;                  // s, of the whole motion
  double turnTime = 0;            // s, of the turn: less than dt if the body was stopped
  bool turnsFaster = false;       // the body turns further than th shows
  double seen = 1;                // ... which is so much of the turn
  bool held = false;              // joints hold it, or mortar in flight: they see all of its turn
  bool jointed = false;           // joints tie it
  bool asOne = false;             // one of its ties leaves it no axis to turn about by itself
  Vec3 angularMomentum;           // kg m2/s, at the end
  Vec3 startVelocity, startSpin;  // before forces
  Vec3 struckSpin;                // rad/s: of startSpin what a blow of this step gave to a body with contacts (blows.h)
  Vec3 late, lateSpin;            // m/s, rad/s: the solve starts with so much less (finish/lone_body.cpp)
};

// How a body moves in this step. Written by finish/motion.cpp alone: as solved, then as its group is finished, then as
// obstacles shorten it. The last check changes its velocities once more.
struct SolvedMotion {
  Vec3 d;                 // m
  Vec3 th;                // rad
  Vec3 velocity;          // m/s
  Vec3 angularMomentum;   // kg m2/s
  double went = 1;        // share of its way that obstacles left it
  bool foreseen = true;   // goes from where its contacts were looked for, and as it was solved
  bool freeTurn = true;   // no torque acted: take FreeMotion::rotation
  bool rest = false;      // does not move
  bool flying = false;    // no chain of forces leads to anything fixed or kinematic
  SteadyChange steady;    // BodyData::steady
  double impactLoss = 0;  // BodyData::impactLoss
};

struct SolveStatistics {
  int islands = 0, restingIslands = 0, cycles = 0;
  double solveSides = 0, lightVisits = 0;  // point visits
  double residualRms = 0;
  double worstResidual = 0;  // of max(weight, load)
  int leftOver = 0;          // bodies with more than kLeftOver
  double energyTaken = 0;    // J, by the last check

  void addCost(const SolveStatistics& s) {
    cycles += s.cycles;
    solveSides += s.solveSides;
    lightVisits += s.lightVisits;
  }
  void add(const SolveStatistics& s) {
    addCost(s);
    residualRms = std::max(residualRms, s.residualRms);
    worstResidual = std::max(worstResidual, s.worstResidual);
    leftOver += s.leftOver;
  }
};

// What a body has gone of its step before its island is solved for the rest.
struct FlownAhead {
  double share = 0;    // of the step: flown to near what it meets, seen from what drives its island (world/fly_ahead.h)
  Vec3 frame;          // m/s: of what drives its island
  double left = 1;     // of the step: what its way is still to be gone in
  bool moved = false;  // by such a way, or by an impact within the step
};

struct StepContext {
  double dt = 0;
  double part = 1;     // dt / dt of the substep that this step is a part of (heavy_hits.h)
  double stretch = 1;  // the substep's dt / the time step that the stiffness of resting contacts is made for
  Vec3 gravity;
  double judgingGravity = kReferenceGravity;  // m/s2: weights are judged by it (scale.h)
  double airDensity = 0;                      // kg/m3
  SolverSettings settings;
  Integrator integrator = Integrator::splitting;  // of bodies without contacts
  const BodySet* bodies = nullptr;                // code that changes bodies is handed them besides
  const Ties* ties = nullptr;                     // code that changes what ties remember, likewise
  std::pmr::memory_resource* memory = std::pmr::get_default_resource();  // for all scratch of a step
  std::vector<FreeMotion> free;                                          // by body slot
  std::vector<SolvedMotion> solved;                                      // by body slot
  std::vector<FlownAhead> ahead;                                         // by body slot
  // Bodies that no step has solved yet do not move: in a restored world some rest at once.
  void makeRoom(std::size_t slots) {
    free.resize(slots);
    solved.resize(slots, {.rest = true});
  }
  SolveStatistics statistics;
  double overlap = 0;  // that the step adds to a pair, at most, in cores of the smaller body (world/keep_out.h)
  bool freed = false;  // the last check let a group go freely

  double aheadOf(BodyIndex body) const { return body < ahead.size() ? ahead[body].share : 0; }
  bool hasMoved(BodyIndex body) const { return body < ahead.size() && ahead[body].moved; }
};

}  // namespace brickfall
