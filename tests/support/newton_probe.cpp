#include "support/newton_probe.h"

#include <algorithm>
#include <map>

#include "solver/cycles.h"
#include "support/inside_world.h"

namespace brickfall::oracle {

namespace {

using test::inside;

Ending endingOf(const Island& island) {
  if (island.resting()) return Ending::rested;
  if (island.ending != IslandEnding::balanced) return Ending::exhausted;
  if (island.plan.exactSteps) return Ending::exact;
  return island.plan.slow ? Ending::slow : Ending::moving;
}

// As docs/step.md says it.
double allowedIn(const Island& island, const BodySet& bodies, double restTolerance) {
  bool rests = island.resting();
  const bool large = island.plan.large;
  double tolerance = !rests ? island.plan.tolerance : large ? 2e-2 : restTolerance, most = 0;
  for (std::size_t i = 0; i < island.bodies.size(); i++) {
    double load = double(island.loads[i]) / (bodies.mass[island.bodies[i]].mass * kReferenceGravity);
    bool moves = !island.plan.slow && island.speeds[i] > 0.03f;
    const double share = !large  ? std::max(1.0, kHeavyLoad * load)
                         : moves ? std::max(2.5, load)
                                 : std::max(1.0, kLoadShare * load);
    most = std::max(most, tolerance * share);
  }
  return most;
}

// Of the step: in shorter parts, which impacts leave, inertia is so large that doubles don't balance weights.
constexpr double kShortest = 0.05;

template <class Impl> void finishStep(Impl& w, Stage from = Stage::store) {
  w.runStages(from, Stage::count);
  w.endPart();
}

std::vector<Vec3> freeSpins(const Island& island, const StepContext& context) {
  std::vector<Vec3> out;
  for (BodyIndex body : island.bodies) out.push_back(context.free[body].angularMomentum);
  return out;
}

// What the end of the step has of momenta, as a motion. `spins`: angular momenta of free motion, as the solve had them; what
// turns far in flight has that of its end when it is done.
std::vector<Motion> keptBy(const Island& island, const Problem& problem, const std::vector<Vec3>& spins,
                           const StepContext& context) {
  std::vector<Motion> out;
  for (std::size_t i = 0; i < island.bodies.size(); i++) {
    const SolvedMotion& s = context.solved[island.bodies[i]];
    const Vec3 given = s.angularMomentum - spins[i];
    const ProblemBody& b = problem.bodies[i];
    out.push_back({s.velocity * problem.dt, b.thFree + b.invInertia * given * problem.dt});
  }
  return out;
}

template <class Impl> void startStep(Impl& w, double dt) {
  w.diary.report = {};
  w.clock.callDt = dt;
  w.clock.lastPart = true;
  if (w.clock.beginSubstep(dt)) w.activity.unsettleAll();
  w.beginPart(dt);
  w.runStages(Stage::pairs, Stage::rest);
}

}  // namespace

std::uint64_t probeStep(const World& world, double dt, const std::function<void(const SolvedIsland&)>& look,
                        const std::function<void(World&)>& prepareCopy) {
  World copy = std::move(World::create({})).value();
  if (!copy.restore(world.snapshot()).ok()) return 0;
  if (prepareCopy) prepareCopy(copy);
  auto& w = inside(copy);
  startStep(w, dt);
  std::vector<Problem> problems;
  for (auto& island : w.activity.islands.awake)
    problems.push_back(island->settled() ? Problem{} : problemOf(*island, w.solve.context));
  w.runStages(Stage::rest, Stage::solve);
  std::vector<std::pair<const Island*, SolvedIsland>> all;
  for (std::size_t i = 0; i < problems.size(); i++) {
    Island& island = *w.activity.islands.awake[i];
    if (island.settled()) continue;
    SolveStatistics statistics;
    SolvedIsland& found = all.emplace_back(&island, SolvedIsland{}).second;
    if (!island.resting()) {
      updateHierarchy(island, w.solve.context);
      runCycles(island, w.solve.context, statistics);
      found.ending = endingOf(island);
    }
    found.posed = problems[i];
    found.problem = std::move(problems[i]);
    takeLimits(found.problem, island);
    found.motion = engineMotion(island);
    found.grounded = island.grounded();
    found.allowed = allowedIn(island, w.registry.bodies, w.solve.context.settings.restTolerance);
    found.slow = island.plan.slow;
    found.cycles = statistics.cycles;
    found.residualRms = statistics.residualRms;
    found.solveVisits = statistics.solveSides;
  }
  std::vector<std::vector<Vec3>> spins;
  for (auto& [island, found] : all) spins.push_back(freeSpins(*island, w.solve.context));
  w.runStages(Stage::store, Stage::obstacles);
  for (std::size_t i = 0; i < all.size(); i++) {
    auto& [island, found] = all[i];
    found.kept = keptBy(*island, found.problem, spins[i], w.solve.context);
    if (island->dt >= kShortest * dt) look(found);
  }
  finishStep(w, Stage::obstacles);
  return copy.stateHash();
}

ConvergedStep stepConverged(World& world, double dt, double tolerance) {
  ConvergedStep out;
  auto& w = inside(world);
  startStep(w, dt);
  std::vector<Problem> problems;
  for (auto& island : w.activity.islands.awake)
    problems.push_back(island->settled() ? Problem{} : problemOf(*island, w.solve.context));
  w.runStages(Stage::rest, Stage::solve);
  for (std::size_t i = 0; i < problems.size(); i++) {
    Island& island = *w.activity.islands.awake[i];
    if (island.settled() || island.resting()) continue;
    updateHierarchy(island, w.solve.context);
    NewtonSettings settings;
    settings.tolerance = tolerance;
    Solution s = solveWithNewBounds(problems[i], settings);
    out.islands++;
    out.failed += !s.converged;
    out.iterations += s.iterations;
    out.worst = std::max(out.worst, s.left.worst());
    std::map<ContactIndex, std::size_t> record;
    for (std::size_t k = 0; k < island.rows.contacts.tieOf.size(); k++) record[island.rows.contacts.tieOf[k]] = k;
    for (const ProblemPoint& p : problems[i].points)
      island.rows.contacts.records[record.at(p.contact)].limit[p.lane] = float(p.limit);
    for (std::size_t k = 0; k < s.motion.size(); k++) {
      island.motion[k].d = toFloat(s.motion[k].d - island.rigid.move);
      island.motion[k].th = toFloat(s.motion[k].th);
    }
  }
  finishStep(w);
  return out;
}

}  // namespace brickfall::oracle
