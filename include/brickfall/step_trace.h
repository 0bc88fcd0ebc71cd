// What a step tells about itself on request: a hash of what each stage wrote, by which the first place where two runs part
// is found, and a ledger of momentum and energy. Costs a walk over all bodies and contacts after each stage; off, nothing.
#pragma once
#include <array>
#include <cstdint>
#include <optional>
#include <string_view>
#include <vector>

#include "brickfall/ids.h"
#include "brickfall/math.h"

namespace brickfall {

// The stages of World::step in their order; docs/step.md describes each.
enum class Stage : std::uint8_t {
  pairs,      // broad phase: candidate pairs
  contacts,   // narrow phase: manifolds, matching
  islands,    // which bodies hang together
  impacts,    // small islands, up to and through the impacts of the step
  prepare,    // kinetic damping, free motion, contact records
  rest,       // rest check
  solve,      // displacements that balance all forces
  store,      // forces kept, velocities, free flight
  obstacles,  // fast bodies stop before what they would pass through
  balance,    // the last check on energy, once
  integrate,  // new poses, quarantine
  breaking,   // joints end whose force was more than they bear
  sleep,      // falling asleep
  events,
  count
};
constexpr int kStageCount = int(Stage::count);
constexpr std::array<std::string_view, kStageCount> kStageNames = {
    "pairs", "contacts",  "islands", "impacts",   "prepare",  "rest",  "solve",
    "store", "obstacles", "balance", "integrate", "breaking", "sleep", "events"};

struct TraceOptions {
  bool stages = false;  // StepReport::stageHashes
  bool items = false;   // and in them a hash of each body and contact
  bool ledger = false;  // StepReport::ledger
};

// What a stage wrote about a body, or about a contact of two.
struct ItemHash {
  BodyId bodyA;
  BodyId bodyB;  // null: about bodyA alone
  std::uint64_t hash = 0;
};

// Equal hashes mean the same bits. Settings are not part of it: two worlds with other settings part in the stage that
// reads them first.
struct StageHash {
  int substep = 0;             // from 0; each part of one that is made in several counts
  std::optional<Stage> stage;  // none: what the step was given, all bodies and what contacts remember
  std::uint64_t hash = 0;
  std::vector<ItemHash> items;  // in order of slots, bodies first
};
// "given" or the stage's name.
std::string_view nameOf(const StageHash& hash);

// Of all dynamic bodies.
struct Balance {
  Vec3 linear;           // kg m/s
  Vec3 angular;          // kg m2/s, about the world's origin
  double kinetic = 0;    // J
  double potential = 0;  // J, of gravity, as World::energy()
  double elastic = 0;    // J, >= 0: what compressed and sheared contacts can give back; not part of World::energy()
};
struct BalanceChange {
  Vec3 linear;         // kg m/s
  Vec3 angular;        // kg m2/s
  double energy = 0;   // J, kinetic and potential
  double elastic = 0;  // J
};

// What changed in a step, and by what. The causes are measured one by one; together they are after - before, to rounding.
struct StepLedger {
  Balance before, after;
  BalanceChange outside;   // calls since the last step: launches, impulses, bodies made, moved or destroyed. Not in
                           // after - before; 0 in the first step that keeps a ledger
  BalanceChange gravity;   // energy 0: it is potential energy
  BalanceChange forces;    // of applyForce and its like
  BalanceChange damping;   // damping, air drag, spins that are cut in contact
  BalanceChange stopped;   // kinetic damping of slow islands
  BalanceChange supports;  // contacts with fixed and kinematic bodies; energy: the work of kinematic ones
  BalanceChange
      contacts;         // the work of contacts on dynamic bodies, and what it did to what they hold: friction, impacts,
                        // springs. energy + elastic is a loss in every step: no contact gives what it was not given
  BalanceChange solve;  // the rest of the solve: momentum that it left unbalanced, its work, and the loss of implicit
                        // steps (half the mass times the change of velocity squared)
  BalanceChange remade;  // elastic energy of contacts that appeared, ended or were measured anew
  BalanceChange
      renewed;  // elastic energy of contacts that remember otherwise without moving: overlap left by an impact
                // begins to press (a tenth in each step), an impact ends, a sudden load is held in part
  BalanceChange impacts;  // small islands, from the start of the step through its last impact: all that acted then;
                          // and blows on what mortar holds
  BalanceChange rebound;  // restitution of the others
  double tensionFracture = 0, shearFracture = 0;  // J: part of `contacts`, spent on breaking mortar, by mode
  double crushing = 0;                            // J: part of `contacts`, spent on crushing mortar
  BalanceChange obstacles;   // bodies that stopped short of what they would pass through: they end, and turn, elsewhere
  BalanceChange balance;     // energy that a group of bodies had gained, taken back by the last check
  BalanceChange integrate;   // rounding of new poses
  BalanceChange quarantine;  // bodies that were taken out
};

}  // namespace brickfall
