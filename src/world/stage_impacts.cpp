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
constexpr double kAhead = 3;
//! not of the method: a mark
constexpr double kNever = std::numeric_limits<double>::infinity();

struct ImpactWalk {
  void run(Island& island);
  void solve(Island& island, double dt, bool toImpact, SolveStatistics& statistics);
  double nextImpact(Island& island, double left);
  bool goTo(Island& island, double dt, bool toImpact);
  bool impact(Island& island);

  const WorldDef& def;
  Registry& registry;
  Proximity& proximity;
  Ties& ties;
  StepContext& context;
  StepReport& report;
  Events& events;
  BodySet& bodies = registry.bodies;
  const ImpactParts parts{registry, context};
};

// Fills StepContext::solved of the island's bodies, for `dt` s; to an impact: as if its open points were not there.
void ImpactWalk::solve(Island& island, double dt, bool toImpact, SolveStatistics& statistics) {
  IslandPart part = !toImpact                         ? IslandPart::between
                    : touchesNothing(island, context) ? IslandPart::flight
                                                      : IslandPart::toImpact;
  stepIsland(island, part, dt, ties, bodies, context, statistics);
}

// Time from now (s) at which the next point closes, if that is within `left` s, else infinity. Changes nothing.
double ImpactWalk::nextImpact(Island& island, double left) {
  island.rows.eachKind([](auto& kind) { kind.forgetSlow(); });
  IslandTrial trial(island, ties, bodies);
  SolveStatistics tried;  // of a motion that nothing makes: its cost counts, its left-over residual does not
  solve(island, left, true, tried);
  trial.restore();
  context.statistics.addCost(tried);
  return firstClosing(island, left, context);
}

// If the island cannot go there, it stays where it is. What turned into something on the way is fitted in.
bool ImpactWalk::goTo(Island& island, double dt, bool toImpact) {
  IslandTrial trial(island, ties, bodies);
  SolveStatistics tried;
  const bool flies = toImpact && touchesNothing(island, context);
  solve(island, dt, toImpact, tried);
  const bool fitted = keepOut(island, toImpact, registry, context);
  if (fitted && !flies) tried.energyTaken += balanceIsland(island, ties, context);
  bool fine = solvedWell(island, context) && !parts.runThrough(island, dt, proximity);
  if (fine) advanceRows(island, ties, context);
  for (BodyIndex body : island.bodies) fine = fine && moveBody(body, bodies, context);
  if (!fine) {
    trial.restore();
    context.statistics.addCost(tried);
    return false;
  }
  context.statistics.add(tried);
  NarrowPhase narrow(registry, context.dt, proximity, ties.contacts);
  island.rows.eachManifold([&](ContactIndex contact) { narrow.renew(contact); });
  report.manifoldsComputed += narrow.computed();
  return true;
}

bool ImpactWalk::impact(Island& island) {
  std::pmr::vector<TieImpact> impacts(island.memory);
  island.dt = context.dt;
  updateHierarchy(island, context);
  if (!solveImpact(island, ties, bodies, context, kBlink * context.dt, context.statistics, impacts)) return false;
  for (BodyIndex body : island.bodies) {
    bodies.data[body].steady = {};
    context.ahead[body].moved = true;
  }
  tellHits(def, registry, impacts, events.hits);
  report.impacts++;
  return true;
}

void ImpactWalk::run(Island& island) {
  island.rows.eachKind([](auto& kind) { kind.forgetSlow(); });
  if (!parts.mayBeCut(island)) return flyAhead(island, registry, proximity, ties, context, report);
  double left = context.dt;
  const double blink = kBlink * context.dt;
  for (int made = 0; made < kMostParts && left > blink; made++) {
    double part = std::min(left, parts.longest(island));
    double next = mayClose(island, context, kAhead) ? nextImpact(island, part) : kNever;
    bool ahead = next <= kAhead * part;  // a point that closes a little later must not stop the island short
    if (!ahead && part == left) break;
    double way = std::min({part, next, left - blink});
    if (way > blink) {
      if (!goTo(island, way, ahead)) break;
      left -= way;
      for (BodyIndex body : island.bodies)
        context.ahead[body].left = left / context.dt, context.ahead[body].moved = true;
    }
    if (next <= part && !impact(island)) break;
  }
  island.dt = left;
}

}  // namespace

void meetImpacts(const WorldDef& def, Registry& registry, IslandSet& islands, Proximity& proximity, Ties& ties,
                 StepContext& context, StepReport& report, Events& events) {
  context.makeRoom(registry.bodies.slots());
  context.ahead.assign(registry.bodies.slots(), {});
  ties.beginStep();
  ImpactWalk walk{def, registry, proximity, ties, context, report, events};
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
