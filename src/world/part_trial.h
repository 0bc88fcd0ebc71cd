// A part of a step that may be taken again, in halves: what its stages from impacts to the balance change, as it was
// before them.
#pragma once
#include <memory_resource>
#include <optional>
#include <utility>
#include <vector>

#include "solver/island_trial.h"
#include "world/activity.h"
#include "world/diary.h"

namespace brickfall {

// Whether a body of an island goes, or turns, so far that it may end deeper in another one by a core.
bool mayEndDeep(const BodySet& bodies, const IslandSet& islands, double dt);

class PartTrial {
 public:
  PartTrial(BodySet& bodies, const IslandSet& islands, Ties& ties, Diary& diary, const StepContext& context);
  // Whether the part, as it would end, leaves a body too deep in another one, or opens a joint of two too far.
  bool endsApart() const;
  // To be called as long as islands have the same bodies and ties. What the trial cost stays in the report.
  void restore();

 private:
  BodySet& bodies_;
  const IslandSet& islands_;
  Diary& diary_;
  const StepContext& context_;
  std::pmr::vector<IslandTrial> tried_;                        // islands that are not settled
  std::pmr::vector<std::pair<BodyMotion, BodyData>> singles_;  // by IslandSet::single
  std::pmr::vector<double> openings_;                          // m, of joints, by island
  std::optional<StepLedger> ledger_;
  LedgerState ledgerState_;
  std::size_t hits_;
  int impacts_;
};

}  // namespace brickfall
