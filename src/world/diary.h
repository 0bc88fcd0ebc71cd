// What a world tells of its steps: events, the report, and on request hashes and the ledger. Nothing of it is read by what
// moves bodies.
#pragma once
#include <vector>

#include "brickfall/events.h"
#include "brickfall/step_report.h"
#include "world/activity.h"
#include "world/ledger.h"
#include "world/registry.h"

namespace brickfall {

// Bodies that press on each other, first < second.
struct BodyPair {
  BodyIndex first, second;
  auto operator<=>(const BodyPair&) const = default;
};
using BodyPairs = std::vector<BodyPair>;

class Diary {
 public:
  bool inStep = false;  // a step is under way
  StepReport report;
  TraceOptions traceOptions;
  LedgerState ledgerState;
  Events events;                          // of the last step, or of that under way
  Events pending;                         // what happened between steps: told by the next
  BodyPairs touchingNow, touchingBefore;  // of awake islands, sorted
  BodyPairs slept;                        // of those that fell asleep in this step
  BodyPairs room;                         // for merging them

  Events& heard() { return inStep ? events : pending; }
  // What happened between the steps opens the events of the next one.
  void tellPending();
  // Pairs of an island that wakes are looked for again; those of a body that is taken out end.
  void addTouching(const Island& island, const ContactSet& contacts);
  void endTouchingOf(BodyIndex body, const Registry& registry);

  // The ledger of a step, from what there is before it.
  void beginLedger(const Balance& now, bool firstPart);

  void keepRoom(std::size_t slots, std::size_t touching);

  void checkStructure(Findings& f, const Registry& registry) const;
  void check(Findings& f, const Registry& registry) const;
};

// Slots are used again, so their order is not that of creation.
ContactEvent byCreation(BodyPair pair, const Registry& registry);
// Pairs of bodies that press on each other; a pair comes once for each of its contacts.
void appendTouching(const Island& island, const ContactSet& contacts, BodyPairs& out);

}  // namespace brickfall
