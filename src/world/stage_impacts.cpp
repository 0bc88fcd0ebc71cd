// Impacts of small islands, each at its moment: a step over an impact is right to first order in its length only. An
// island in which a point closes in this step goes on to that moment, its open points left out. It is collided anew,
// its velocities change, and so on. The stages that follow make the rest of the step. A body alone that turns fast in
// contact goes on in parts, too, since arms are frozen in each: otherwise a top would fall over (impact_parts.h).
#include <algorithm>
#include <limits>

#include "solver/finish/motion.h"
#include "solver/impact.h"
#include "solver/island_builder.h"
#include "solver/island_step.h"
#include "solver/island_trial.h"
#include "solver/store.h"
#include "world/activity.h"
#include "world/core_sweep.h"
#include "world/diary.h"
#include "world/fly_ahead.h"
#include "world/impact_parts.h"
#include "world/keep_out.h"
#include "world/move_body.h"
#include "world/narrow_phase.h"
#include "world/stage_hash.h"
#include "world/stages.h"

namespace brickfall {

namespace {

//! of the step | too small: the rest of the step after an impact is too short for floats
//! | too large: impacts are met early
constexpr double kBlink = 1e-3;
//! of the rest of the step | too small: implicit steps hold up what rebounds or falls to an impact | too large: cost
constexpr double kAhead = 2;
//! not of the method: a mark
constexpr double kNever = std::numeric_limits<double>::infinity();

class ImpactWalk {
 public:
  ImpactWalk(const WorldDef& def, Registry& registry, Proximity& proximity, Ties& ties, StepContext& context,
             StepReport& report, Events& events)
      : def_(def),
        registry_(registry),
        bodies_(registry.bodies),
        proximity_(proximity),
        ties_(ties),
        context_(context),
        parts_(registry, context),
        report_(report),
        events_(events) {}

  void run(Island& island);

 private:
  void solve(Island& island, double dt, bool toImpact, SolveStatistics& statistics);
  double nextImpact(Island& island, double left);
  bool goTo(Island& island, double dt, bool toImpact);
  bool impact(Island& island);

  const WorldDef& def_;
  Registry& registry_;
  BodySet& bodies_;
  Proximity& proximity_;
  Ties& ties_;
  StepContext& context_;
  const ImpactParts parts_;
  StepReport& report_;
  Events& events_;
};

// Fills StepContext::solved of the island's bodies, for `dt` s; to an impact: as if its open points were not there.
void ImpactWalk::solve(Island& island, double dt, bool toImpact, SolveStatistics& statistics) {
  IslandPart part = !toImpact                          ? IslandPart::between
                    : touchesNothing(island, context_) ? IslandPart::flight
                                                       : IslandPart::toImpact;
  stepIsland(island, part, dt, ties_, bodies_, context_, statistics);
}

// Time from now (s) at which the next point closes, if that is within `left` s, else infinity. Changes nothing.
double ImpactWalk::nextImpact(Island& island, double left) {
  IslandTrial trial(island, ties_, bodies_);
  SolveStatistics tried;  // of a motion that nothing makes: its cost counts, its left-over residual does not
  solve(island, left, true, tried);
  trial.restore();
  context_.statistics.addCost(tried);
  return firstClosing(island, left, context_);
}

// If the island cannot go there, it stays where it is. What turned into something on the way is fitted in.
bool ImpactWalk::goTo(Island& island, double dt, bool toImpact) {
  IslandTrial trial(island, ties_, bodies_);
  SolveStatistics tried;
  const bool flies = toImpact && touchesNothing(island, context_);
  solve(island, dt, toImpact, tried);
  const bool fitted = keepOut(island, toImpact, registry_, context_);
  if (fitted && !flies) tried.energyTaken += balanceIsland(island, ties_, context_);
  bool fine = solvedWell(island, context_) && !parts_.runThrough(island, dt, proximity_);
  if (fine) advanceRows(island, ties_, context_);
  for (BodyIndex body : island.bodies) fine = fine && moveBody(body, bodies_, context_);
  if (!fine) {
    trial.restore();
    context_.statistics.addCost(tried);
    return false;
  }
  context_.statistics.add(tried);
  NarrowPhase narrow(registry_, context_.dt, proximity_, ties_.contacts);
  island.rows.eachManifold([&](ContactIndex contact) { narrow.renew(contact); });
  report_.manifoldsComputed += narrow.computed();
  return true;
}

bool ImpactWalk::impact(Island& island) {
  std::pmr::vector<TieImpact> impacts(island.memory);
  island.dt = context_.dt;
  updateHierarchy(island, context_);
  if (!solveImpact(island, ties_, bodies_, context_, kBlink * context_.dt, context_.statistics, impacts)) return false;
  for (BodyIndex body : island.bodies) {
    bodies_.data[body].steady = {};
    context_.ahead[body].moved = true;
  }
  tellHits(def_, registry_, impacts, events_.hits);
  report_.impacts++;
  return true;
}

void ImpactWalk::run(Island& island) {
  if (!parts_.mayBeCut(island)) return flyAhead(island, registry_, proximity_, ties_, context_, report_);
  double left = context_.dt;
  const double blink = kBlink * context_.dt;
  for (int made = 0; made < kMostParts && left > blink; made++) {
    double part = std::min(left, parts_.longest(island));
    double next = mayClose(island, context_, kAhead) ? nextImpact(island, part) : kNever;
    bool ahead = next <= kAhead * part;  // a point that closes a little later must not stop the island short
    if (!ahead && part == left) break;
    double way = std::min({part, next, left - blink});
    if (way > blink) {
      if (!goTo(island, way, ahead)) break;
      left -= way;
      for (BodyIndex body : island.bodies)
        context_.ahead[body].left = left / context_.dt, context_.ahead[body].moved = true;
    }
    if (next <= part && !impact(island)) break;
  }
  island.dt = left;
}

}  // namespace

void meetImpacts(const WorldDef& def, Registry& registry, IslandSet& islands, Proximity& proximity, Ties& ties,
                 StepContext& context, StepReport& report, Events& events) {
  context.free.resize(registry.bodies.slots());
  context.solved.resize(registry.bodies.slots());
  context.ahead.assign(registry.bodies.slots(), {});
  ties.beginStep();
  ImpactWalk walk(def, registry, proximity, ties, context, report, events);
  for (IslandPointer& island : islands.awake) {
    island->dt = context.dt;
    if (!island->settled()) walk.run(*island);
  }
}

void hashImpacts(const Registry& registry, const IslandSet& islands, const Ties& ties, HashItems& out) {
  for (const IslandPointer& island : islands.awake) {
    if (island->settled()) continue;
    out.bodies(island->bodies, [&](Mix& h, BodyIndex body) { mix(h, registry.bodies.motion[body]); });
  }
  out.memories(islands, ties);
}

// Places and contacts changed, too: the whole change is booked.
void bookImpacts(const Registry& registry, const StepContext& context, Diary& diary) {
  Balance now = balanceNow(registry.bodies, context);
  diary.ledgerState.bookElastic(diary.report.ledger->impacts, now.elastic);
  diary.ledgerState.book(diary.report.ledger->impacts, now);
}

}  // namespace brickfall
