// The step: a list of stages, one file each, no logic between them. docs/step.md says what each reads and writes.
#include <algorithm>
#include <chrono>
#include <iterator>
#include <string>

#include "brickfall/limits.h"
#include "world/world_impl.h"

namespace brickfall {

std::int64_t nowNanoseconds() {
  return std::chrono::duration_cast<std::chrono::nanoseconds>(std::chrono::steady_clock::now().time_since_epoch())
      .count();
}

StageTimer::StageTimer(StepReport& report, Stage stage) : report_(report), stage_(stage), start_(nowNanoseconds()) {}
StageTimer::~StageTimer() {
  report_.stageMilliseconds[std::size_t(stage_)] += double(nowNanoseconds() - start_) * 1e-6;
}

void World::Impl::step(double dt) {
  struct StageCall {
    Stage stage;
    void (Impl::*run)();
  };
  constexpr StageCall kStages[] = {{Stage::pairs, &Impl::findPairs},      {Stage::contacts, &Impl::updateContacts},
                                   {Stage::islands, &Impl::buildIslands}, {Stage::prepare, &Impl::prepare},
                                   {Stage::rest, &Impl::checkRest},       {Stage::solve, &Impl::solve},
                                   {Stage::store, &Impl::store},          {Stage::restitution, &Impl::restitute},
                                   {Stage::integrate, &Impl::integrate},  {Stage::sleep, &Impl::updateSleep},
                                   {Stage::events, &Impl::collectEvents}};
  static_assert(std::size(kStages) == kStageCount);
  beginStep(dt);
  traceStage({});
  quarantineAbsurd();
  for (const StageCall& call : kStages) {
    (this->*call.run)();
    traceStage(call.stage);
  }
  endStep();
}

void World::Impl::beginStep(double dt) {
  context.dt = dt;
  context.gravity = def.gravity;
  context.settings = def.solver;
  context.integrator = def.integrator;
  context.bodies = &bodies;
  context.contacts = &contacts;
  context.memory = &stepMemory;
  context.statistics = {};
  if (dt != lastDt) {  // stiffnesses are in units of mass / dt^2: nothing is settled at another time step
    for (auto& island : islands.awake) island->unsettle();
    lastDt = dt;
  }
}

void World::Impl::endStep() {
  time += context.dt;
  stepCount++;
  const SolveStatistics& s = context.statistics;
  report.islands = s.islands;
  report.restingIslands = s.restingIslands;
  report.cycles += s.cycles;
  report.solveVisits += 0.5 * s.solveSides;
  report.lightVisits += s.lightVisits;
  report.residualRms = std::max(report.residualRms, s.residualRms);
}

void World::Impl::traceStage(std::optional<Stage> stage) {
  if (traceOptions.stages || traceOptions.items) hashStage(stage);
  if (traceOptions.ledger) bookStage(stage);
}

void World::trace(const TraceOptions& options) {
  if (!options.ledger) impl_->ledgerState = {};
  impl_->traceOptions = options;
}

Result<StepReport> World::step(double dt, int substeps) {
  if (!(dt >= limits::kShortestTimeStep && dt <= limits::kLongestTimeStep))
    return Error{ErrorCode::invalidArgument, "dt: found " + std::to_string(dt) + " s, expected 0.00001 .. 0.1 s"};
  if (!(substeps >= 1 && substeps <= limits::kMostSubsteps))
    return Error{ErrorCode::invalidArgument, "substeps: found " + std::to_string(substeps) + ", expected 1 .. 64"};
  Impl& w = *impl_;
  if (Status open = w.openForChange("step"); !open) return open.error();
  w.stepping = true;
  std::int64_t start = nowNanoseconds();
  w.report = {};
  w.keepRoom();
  w.tellPending();
  w.callDt = dt;
  for (int i = 0; i < substeps; i++) {
    w.report.manifolds = w.report.contactPoints = w.report.touchingPoints = 0;
    w.substep = i;
    w.lastSubstep = i == substeps - 1;
    w.step(dt / substeps);
  }
  w.report.stepIndex = w.stepCount;
  w.report.time = w.time;
  for (BodyIndex body : w.pushed) w.bodies.data[body].force = w.bodies.data[body].torque = {};
  w.pushed.clear();
  w.report.bodies = w.dynamicBodies;
  w.report.awakeBodies = int(w.awake.size());
  w.report.milliseconds = double(nowNanoseconds() - start) * 1e-6;
  w.stepping = false;
  return w.report;
}

}  // namespace brickfall
