#include "world/part_trial.h"

#include <algorithm>
#include <tuple>

#include "solver/joint/opening.h"
#include "world/core_sweep.h"

namespace brickfall {

bool mayEndDeep(const BodySet& bodies, const IslandSet& islands, double dt) {
  auto goesFar = [&](BodyIndex body) {
    const BodyMotion& m = bodies.motion[body];
    const BodyMass& mass = bodies.mass[body];
    const double speed = length(m.linearVelocity) + length(m.angularVelocity) * mass.outerRadius;
    return speed * dt > kCoreShare * mass.innerRadius;
  };
  return std::any_of(islands.awake.begin(), islands.awake.end(), [&](const IslandPointer& island) {
    return !island->settled() && std::any_of(island->bodies.begin(), island->bodies.end(), goesFar);
  });
}

PartTrial::PartTrial(BodySet& bodies, const IslandSet& islands, Ties& ties, Diary& diary, const StepContext& context)
    : bodies_(bodies),
      islands_(islands),
      diary_(diary),
      context_(context),
      tried_(context.memory),
      singles_(context.memory),
      openings_(context.memory),
      ledger_(diary.report.ledger),
      ledgerState_(diary.ledgerState),
      hits_(diary.events.hits.size()),
      impacts_(diary.report.impacts) {
  ties.beginStep();  // as the stage of impacts does: hits of the part before must not come back
  for (const IslandPointer& island : islands.awake) {
    tellOpenings(*island, context, openings_);
    if (!island->settled()) tried_.emplace_back(*island, ties, bodies);
  }
  for (BodyIndex body : islands.single) singles_.emplace_back(bodies.motion[body], bodies.data[body]);
}

bool PartTrial::endsApart() const {
  if (context_.overlap > kCoreShare) return true;
  const double* before = openings_.data();
  return std::any_of(islands_.awake.begin(), islands_.awake.end(),
                     [&](const IslandPointer& island) { return opensJoints(*island, context_, before); });
}

void PartTrial::restore() {
  for (const IslandTrial& island : tried_) island.restore();
  for (const IslandPointer& island : islands_.awake)
    if (!island->settled()) island->placePoses.clear();  // the trial has looked at its place, too
  for (std::size_t i = 0; i < singles_.size(); i++)
    std::tie(bodies_.motion[islands_.single[i]], bodies_.data[islands_.single[i]]) = singles_[i];
  diary_.report.ledger = ledger_;
  diary_.ledgerState = ledgerState_;
  diary_.events.hits.resize(hits_);
  diary_.report.impacts = impacts_;
}

}  // namespace brickfall
