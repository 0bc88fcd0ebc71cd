// The step: a table of stages, in their order, each with the owners that it reads and changes. docs/step.md goes
// through them.
#include <algorithm>
#include <chrono>
#include <cmath>
#include <string>

#include "brickfall/limits.h"
#include "world/checks.h"
#include "world/core_sweep.h"
#include "world/heavy_hits.h"
#include "world/notes.h"
#include "world/part_trial.h"
#include "world/sense.h"
#include "world/stage_hash.h"
#include "world/stages.h"
#include "world/world_impl.h"

namespace brickfall {

namespace {

//! not of the method: room
constexpr std::size_t kTouchingPerBody = 4;

std::int64_t nowNanoseconds() {
  return std::chrono::duration_cast<std::chrono::nanoseconds>(std::chrono::steady_clock::now().time_since_epoch())
      .count();
}

}  // namespace

struct World::Impl::StageRow {
  Stage stage;
  void (*run)(Impl&);
  void (*hash)(const Impl&, HashItems&);  // of the stage's output
  void (*book)(Impl&) = nullptr;          // the stage's change of momentum and energy; none: no change
};

std::span<const World::Impl::StageRow> World::Impl::stageRows() {
  using W = Impl;
  using H = HashItems;
  static constexpr StageRow kRows[] = {
      {Stage::pairs, [](W& w) { findPairs(w.registry, w.activity, w.solve.context, w.proximity, w.ties); },
       [](const W& w, H& out) { hashPairs(w.registry, w.activity, w.proximity, out); }},

      {Stage::contacts,
       [](W& w) {
         updateContacts(w.preSolve, w.registry, w.activity, w.solve.context, w.proximity, w.ties, w.diary.report,
                        w.upkeep());
       },
       [](const W& w, H& out) { hashContacts(w.ties, out); }},

      {Stage::islands, [](W& w) { renewIslands(w.registry, w.solve.context, w.activity, w.ties); },
       [](const W& w, H& out) { hashIslands(w.ties, w.activity.islands, out); },
       [](W& w) { bookIslands(w.registry, w.solve.context, w.diary); }},

      {Stage::impacts,
       [](W& w) {
         meetImpacts(w.def, w.registry, w.activity.islands, w.proximity, w.ties, w.solve.context, w.diary.report,
                     w.diary.events);
       },
       [](const W& w, H& out) { hashImpacts(w.registry, w.activity.islands, w.ties, out); },
       [](W& w) { bookImpacts(w.registry, w.solve.context, w.diary); }},

      {Stage::prepare, [](W& w) { prepare(w.registry, w.activity.islands, w.ties, w.solve.context); },
       [](const W& w, H& out) { hashPrepare(w.registry, w.activity.islands, w.ties, w.solve.context, out); },
       [](W& w) { bookPrepare(w.registry, w.activity, w.solve.context, w.diary); }},

      {Stage::rest, [](W& w) { checkRest(w.activity.islands, w.solve.context); },
       [](const W& w, H& out) { hashRest(w.activity.islands, out); }},

      {Stage::solve, [](W& w) { solveIslands(w.activity.islands, w.solve); },
       [](const W& w, H& out) { hashSolve(w.registry, w.activity.islands, out); }},

      {Stage::store,
       [](W& w) { storeSolution(w.def, w.registry, w.activity.islands, w.ties, w.solve.context, w.diary.events); },
       [](const W& w, H& out) { hashStore(w.activity.islands, w.ties, w.solve.context, out); },
       [](W& w) { bookStore(w.registry, w.activity, w.solve.context, w.diary); }},

      {Stage::obstacles, [](W& w) { stopAtObstacles(w.registry, w.activity, w.proximity, w.solve.context); },
       [](const W& w, H& out) { hashObstacles(w.activity.islands, w.solve.context, out); },
       [](W& w) { bookObstacles(w.registry, w.activity, w.solve.context, w.diary); }},

      {Stage::balance, [](W& w) { balanceIslands(w.registry, w.activity, w.proximity, w.ties, w.solve.context); },
       [](const W& w, H& out) { hashBalance(w.activity.islands, w.solve.context, out); },
       [](W& w) { bookBalance(w.registry, w.activity, w.solve.context, w.diary); }},

      {Stage::integrate,
       [](W& w) { integrate(w.clock, w.solve.context, w.registry, w.activity, w.proximity, w.ties, w.quarantine()); },
       [](const W& w, H& out) { hashIntegrate(w.registry, w.activity, w.ties, out); },
       [](W& w) { bookIntegrate(w.registry, w.activity, w.solve.context, w.diary); }},

      {Stage::breaking,
       [](W& w) { breakTies(w.registry, w.clock, w.solve.context, w.activity, w.ties, w.diary, w.upkeep()); },
       [](const W& w, H& out) { hashBreaking(w.ties, out); }},

      {Stage::sleep, [](W& w) { fallAsleep(w.def, w.solve.context.dt, w.registry, w.activity, w.ties, w.diary); },
       [](const W& w, H& out) { hashSleep(w.registry, w.activity.islands, out); }},

      {Stage::events, [](W& w) { collectEvents(w.registry, w.activity, w.ties, w.diary); },
       [](const W& w, H& out) { hashEvents(w.diary.events, out); }},
  };
  static_assert(std::size(kRows) == kStageCount);
  return kRows;
}

void World::Impl::runStages(Stage first, Stage end) {
  for (const StageRow& row : stageRows()) {
    if (row.stage < first || row.stage >= end) continue;
    std::int64_t start = nowNanoseconds();
    row.run(*this);
    diary.report.stageMilliseconds[std::size_t(row.stage)] += double(nowNanoseconds() - start) * 1e-6;
    traceStage(row.stage, row.hash, row.book);
  }
}

void World::Impl::traceStage(std::optional<Stage> stage, void (*hash)(const Impl&, HashItems&), void (*book)(Impl&)) {
  const TraceOptions& wanted = diary.traceOptions;
  if (wanted.stages || wanted.items) {
    HashItems items(registry, wanted.items);
    hash(*this, items);
    diary.report.stageHashes.push_back(items.take(clock.part, stage));
  }
  if (wanted.ledger && book) book(*this);
}

void World::Impl::beginPart(double dt) {
  StepContext& context = solve.context;
  context.dt = dt;
  context.gravity = def.gravity;
  context.airDensity = def.airDensity;
  context.judgingGravity = judgingGravity(def.gravity);
  context.settings = def.solver;
  context.integrator = def.integrator;
  context.bodies = &registry.bodies;
  context.ties = &ties;
  context.memory = &solve.memory;
  context.statistics = {};
  context.part = dt / clock.lastDt;
  context.stretch = clock.lastDt / clock.stiffnessDt;
  traceStage(
      {}, [](const Impl& w, HashItems& out) { hashGiven(w.registry, w.activity.islands, w.ties, out); },
      [](Impl& w) {
        Balance now = balanceNow(w.registry.bodies, w.solve.context);
        w.diary.beginLedger(now, w.clock.part == 0);
      });
  quarantineAbsurd(registry, activity, dt, quarantine());
}

void World::Impl::addCost() {
  const SolveStatistics& s = solve.context.statistics;
  diary.report.cycles += s.cycles;
  diary.report.solveVisits += 0.5 * s.solveSides;
  diary.report.lightVisits += s.lightVisits;
}

void World::Impl::endPart() {
  registry.shapes.edits.clear();
  addCost();
  const SolveStatistics& s = solve.context.statistics;
  StepReport& report = diary.report;
  report.islands = s.islands;
  report.restingIslands = s.restingIslands;
  report.residualRms = std::max(report.residualRms, s.residualRms);
  report.worstResidual = std::max(report.worstResidual, s.worstResidual);
  report.unbalancedBodies += s.leftOver;
  report.energyTaken += s.energyTaken;
}

// Arms, normals and the choice of contacts are those of a part's start, so a body that a hit turns far may end where no
// force is against it, and no room. What can't be known before the part is solved is judged by how it ends.
void World::Impl::runPart(double dt, bool last) {
  diary.report.manifolds = diary.report.contactPoints = diary.report.touchingPoints = 0;
  clock.lastPart = last;
  const std::size_t hashes = diary.report.stageHashes.size();
  beginPart(dt);
  runStages(Stage::pairs, Stage::impacts);
  const bool mayBeCut = 2 * dt * def.solver.maxHitParts > clock.lastDt && def.solver.maxHitParts > 1;
  if (mayBeCut && mayEndDeep(registry.bodies, activity.islands, dt)) {
    PartTrial trial(registry.bodies, activity.islands, ties, diary, solve.context);
    runStages(Stage::impacts, Stage::integrate);
    if (trial.endsApart()) {
      addCost();
      trial.restore();
      diary.report.stageHashes.resize(hashes);
      runPart(dt / 2, false);
      return runPart(dt / 2, last);
    }
    runStages(Stage::integrate, Stage::count);
  } else {
    runStages(Stage::impacts, Stage::count);
  }
  endPart();
  clock.part++;
  diary.report.parts++;
}

void World::Impl::runSubstep(double dt, bool last) {
  // No island stays settled when the time step changes.
  if (clock.beginSubstep(dt)) activity.unsettleAll();
  // What is hit slows down what hits it: after each part the next is asked for.
  HitPart part{.rings = clock.rings};
  double left = dt;
  for (int most = def.solver.maxHitParts; left > 0; most--) {
    part = partForHits(registry, activity, proximity, ties,
                       {left, most, def.solver.restingApproachSpeed, judgingGravity(def.gravity)}, part);
    const bool whole = part.length == left;
    runPart(part.length, last && whole);
    left = whole ? 0 : left - part.length;
  }
  clock.rings = part.rings < limits::kLongestTimeStep ? part.rings : 0;
  clock.time += dt;
  clock.stepCount++;
}

// All memory that the step may need is taken before the step.
void World::Impl::keepRoom() {
  std::size_t dynamic = std::size_t(registry.dynamicBodies), touching = kTouchingPerBody * dynamic;
  std::size_t slots = registry.bodies.slots();
  ties.keepRoom(registry.shapes.slots());
  proximity.keepRoom(registry.shapes.slots(), ties.contacts.pairs.capacity(), touching);
  activity.keepRoom(dynamic, slots);
  solve.keepRoom(dynamic, slots);
  diary.keepRoom(slots, touching);
}

void World::trace(const TraceOptions& options) {
  if (!options.ledger) impl_->diary.ledgerState = {};
  impl_->diary.traceOptions = options;
}

Result<StepReport> World::step(double dt, int substeps) {
  if (!(dt >= limits::kShortestTimeStep && dt <= limits::kLongestTimeStep))
    return Error{ErrorCode::invalidArgument, "dt: found " + numberText(dt) + " s, expected 0.00001 .. 0.1 s"};
  if (!(substeps >= 1 && substeps <= limits::kMostSubsteps))
    return Error{ErrorCode::invalidArgument, "substeps: found " + std::to_string(substeps) + ", expected 1 .. 64"};
  Impl& w = *impl_;
  if (Status open = w.openForChange("step"); !open) return open.error();
  StepReport& report = w.diary.report;
  w.diary.inStep = true;
  std::int64_t start = nowNanoseconds();
  report = {};
  w.keepRoom();
  w.diary.tellPending();
  w.clock.callDt = dt;
  w.clock.part = 0;
  for (int i = 0; i < substeps; i++) w.runSubstep(dt / substeps, i == substeps - 1);
  report.stepIndex = w.clock.stepCount;
  report.time = w.clock.time;
  w.activity.dropForces(w.registry.bodies);
  sense(w.registry, w.proximity, w.diary);
  report.bodies = w.registry.dynamicBodies;
  report.awakeBodies = int(w.activity.awake.size());
  report.milliseconds = double(nowNanoseconds() - start) * 1e-6;
  w.diary.inStep = false;
  noteStep(report);
  return report;
}

}  // namespace brickfall
