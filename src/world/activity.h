// The awake part of a world: the bodies that a step walks, and the islands that they make up. Nothing here asks how
// heavy a body is or why it fell asleep.
#pragma once
#include <vector>

#include "base/findings.h"
#include "dynamics/body_set.h"
#include "solver/island_builder.h"

namespace brickfall {

class Activity {
 public:
  // Bodies, each list ascending.
  std::vector<BodyIndex> awake;      // dynamic ones that are not asleep
  std::vector<BodyIndex> moving;     // kinematic ones with a velocity
  std::vector<BodyIndex> unsettled;  // fixed or kinematic ones that count as moved until the next step is over
  std::vector<BodyIndex> pushed;     // bodies with a force or torque for the next step

  IslandSet islands;
  std::vector<std::uint32_t> islandOf;  // by body: index in islands.awake, kNoIndex = none
  bool membershipChanged = true;        // awake bodies or their contacts changed: islands must be built
  std::size_t sleptNow = 0;             // islands that fell asleep in this step: the last ones in islands.asleep

  void enlist(BodySet& bodies, BodyIndex body);        // into awake or moving, by type and velocity
  void delist(BodySet& bodies, BodyIndex body);        // out of all lists, with the forces waiting for it
  void countAsMoved(BodySet& bodies, BodyIndex body);  // a fixed or kinematic body that was made, moved or changed
  void settleUnmoved(BodySet& bodies);                 // the step is over: `unsettled` is emptied
  void push(BodyIndex body);
  void dropForces(BodySet& bodies);  // the step that they were for is over

  // Islands name bodies by slot. Islands that name this slot are built anew at the next step; the others are kept.
  void forgetIslandsOf(BodyIndex body);
  // No longer settled: the body's island; the islands that touch the body; all islands.
  void unsettleIslandOf(BodyIndex body);
  void unsettlePartnersOf(BodyIndex body);
  void unsettleAll();
  void renumberIslands();  // islandOf, after islands.awake changed

  void keepRoom(std::size_t dynamicBodies, std::size_t slots);

  // No body and no tie appeared or went since the islands were built.
  bool current(const Ties& ties) const { return !ties.changed() && !membershipChanged; }
  void checkStructure(Findings& f, const BodySet& bodies, const Ties& ties) const;
  void check(Findings& f, const BodySet& bodies, const Ties& ties) const;
};

}  // namespace brickfall
