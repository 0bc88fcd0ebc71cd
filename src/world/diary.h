// The record of a world's steps: events, the report, and on request hashes and the ledger. Code that moves bodies reads
// nothing of it.
#pragma once
#include <memory_resource>
#include <vector>

#include "brickfall/events.h"
#include "brickfall/step_report.h"
#include "brickfall/world.h"
#include "solver/tie_report.h"
#include "world/activity.h"
#include "world/ledger.h"
#include "world/registry.h"

namespace brickfall {

// Shapes that press on each other: of bodies first < second.
struct TouchingPair {
  BodyIndex first, second;
  ShapeIndex shapeFirst, shapeSecond;
  auto operator<=>(const TouchingPair&) const = default;
};
using TouchingPairs = std::vector<TouchingPair>;

class Diary {
 public:
  bool inStep = false;  // a step is under way
  StepReport report;
  TraceOptions traceOptions;
  LedgerState ledgerState;
  Events events;                               // of the last step, or of the one under way
  Events pending;                              // of calls between steps: the next step tells them
  TouchingPairs touchingNow, touchingBefore;   // of awake islands, sorted
  TouchingPairs slept;                         // pairs of islands that fell asleep in this step
  TouchingPairs room;                          // for merging the lists of pairs
  std::vector<SensorEvent> sensed, sensedNow;  // who is in which sensor, sorted; after the last step, and scratch

  Events& heard() { return inStep ? events : pending; }
  // Events of calls between the steps open the events of the next step.
  void tellPending();
  // Pairs of an island that wakes are looked for again; pairs of a body that is taken out end.
  void addTouching(const Island& island, const Ties& ties);
  void endTouchingOf(BodyIndex body, const Registry& registry);

  // Who came into sensors and who left, from sensedNow.
  void tellSensed();

  // The ledger of a step, from the balance before the step.
  void beginLedger(const Balance& now, bool firstPart);

  void keepRoom(std::size_t slots, std::size_t touching);

  void checkStructure(Findings& f, const Registry& registry) const;
  void check(Findings& f, const Registry& registry) const;
};

// Ordered by when the bodies were made: slots are used again, so their order does not tell.
ContactEvent byCreation(TouchingPair pair, const Registry& registry);
// Pairs of shapes that press on each other; a pair comes once for each of its contacts.
void appendTouching(const Island& island, const Ties& ties, TouchingPairs& out);

// Hits among impacts, as far as the world asks to hear of them.
void tellHits(const WorldDef& def, const Registry& registry, const std::pmr::vector<TieImpact>& impacts,
              std::vector<HitEvent>& out);

}  // namespace brickfall
