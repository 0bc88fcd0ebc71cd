#include "ledger.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "support/validation_record.h"

namespace brickfall::oracle {

namespace {

void raise(double& worst, double value) {
  if (!(value <= worst)) worst = value;  // takes NaN
}

double errorOfForces(const Problem& problem, const std::vector<Motion>& x, const std::vector<Motion>& y) {
  double unit = problem.mass() / double(problem.bodies.size()) * 9.81, worst = 0;
  for (const ProblemPoint& p : problem.points) {
    PointForce f = pointForce(problem, p, x), g = pointForce(problem, p, y);
    raise(worst, length(p.n * (f.n - g.n) + f.t - g.t) / unit);
  }
  return worst;
}

int stateOf(const PointForce& f) { return f.loaded() ? (f.slides ? 2 : 1) : 0; }

// What the step added to the momentum of an island that nothing outside touches, linear and angular (about the first body,
// as a velocity at the bodies' mean radius).
double momentumMadeUp(const Problem& problem, const std::vector<Motion>& x) {
  Vec3 linear, angular;
  double mass = problem.mass(), radius = 0;
  for (std::size_t i = 0; i < problem.bodies.size(); i++) {
    const ProblemBody& b = problem.bodies[i];
    Vec3 p = (x[i].d - b.dFree) * b.mass;
    linear += p;
    angular += cross(b.position, p) + b.inertia * (x[i].th - b.thFree);
    radius += b.mass / mass * std::sqrt(lengthSquared(b.position) + b.outer * b.outer);
  }
  return (length(linear) + length(angular) / radius) / (mass * 9.81 * problem.dt * problem.dt);
}

// Motions are float: what the last bit of a body's way makes of a force through the stiffest spring, in weights of the
// lighter body. Bodies that move some 0.1 m in a step under springs of 1000 m / h^2 have 2e-3.
double roundingOf(const Problem& problem, const std::vector<Motion>& x) {
  double worst = 0;
  for (const ProblemPoint& p : problem.points) {
    double way = 0, mass = 1e300;
    for (int body : {p.a, p.b}) {
      if (std::size_t(body) >= x.size()) continue;
      const ProblemBody& b = problem.bodies[std::size_t(body)];
      way = std::max(way, length(x[std::size_t(body)].d) + length(x[std::size_t(body)].th) * b.outer);
      mass = std::min(mass, b.mass);
    }
    raise(worst, p.k * way * 0x1p-24 / (mass * 9.81));
  }
  return worst;
}

constexpr double kNoise = 5e-5;  // weights: float kernels under loads of some ten weights
constexpr double kRoundings =
    5;  // of what floats may round off a motion, over rows and bodies (4.3 in an arch that comes down)
constexpr std::size_t kOwnBoundBodies = 200;  // larger islands cost too much to solve over and over

}  // namespace

void Ledger::add(const SolvedIsland& solved) {
  const Problem& problem = solved.problem;
  Solution exact = solveFrozen(problem);
  islands++;
  raise(oracleLeft, exact.left.worst());
  failures += !exact.converged;
  iterations += exact.iterations;

  Imbalance engine = imbalanceAt(problem, solved.motion);
  Deviation apart = deviationOf(problem, solved.motion, exact.motion);
  raise(excess, apart.mean / (engine.mean + exact.left.mean + 1e-9));  // motions in double: some 1e-12
  if (!solved.grounded) {
    floating++;
    raise(momentum, momentumMadeUp(problem, solved.kept));
  }

  EndingSums& s = endings[std::size_t(solved.ending)];
  s.islands++;
  s.bodies += int(problem.bodies.size());
  s.cycles += solved.cycles;
  raise(s.force, engine.force);
  raise(s.torque, engine.torque);
  raise(s.rms, engine.rmsForce);
  raise(s.mean, engine.mean);
  raise(s.deviation, apart.mean);
  raise(s.millimetres, apart.largest * 1e3);
  raise(s.forceError, errorOfForces(problem, solved.motion, exact.motion));
  if (problem.bodies.size() <= kOwnBoundBodies) {
    Problem own = solved.posed;
    Solution solution = solveWithNewBounds(own);
    ownBoundSolves++;
    ownBoundFailures += !solution.converged;
    if (solution.converged) raise(s.ownBounds, deviationOf(problem, solved.motion, solution.motion).mean);
  }

  bool steady = true;
  for (const ProblemPoint& p : problem.points) {
    PointForce f = pointForce(problem, p, exact.motion), e = pointForce(problem, p, solved.motion);
    sticking += stateOf(f) == 1;
    sliding += stateOf(f) == 2;
    open += stateOf(f) == 0;
    opening += !p.carriedNothing && !f.loaded();
    closing += p.carriedNothing && f.loaded();
    wrongStates += stateOf(f) != stateOf(e);
    steady = steady && !(p.carriedNothing && e.loaded());
  }
  double rounding = roundingOf(problem, solved.motion);
  if (solved.ending == Ending::rested) raise(s.ofAllowed, (engine.worst() - kNoise) / solved.allowed);
  if (!steady) return;
  if (solved.ending != Ending::exhausted && solved.grounded)
    raise(s.ofAllowed, (engine.worst() - kRoundings * rounding - kNoise) / solved.allowed);
  raise(s.steady, engine.worst() - kRoundings * rounding);
  raise(s.steadyRms, engine.rmsForce - kRoundings * rounding);
  if (solved.ending != Ending::rested && solved.grounded)
    raise(s.noise, std::fabs(engine.rmsForce - solved.residualRms));
}

void Ledger::add(const Ledger& o) {
  using S = EndingSums;
  using L = Ledger;
  for (std::size_t i = 0; i < endings.size(); i++) {
    for (auto field : {&S::islands, &S::bodies, &S::cycles}) endings[i].*field += o.endings[i].*field;
    for (auto field : {&S::force, &S::torque, &S::rms, &S::mean, &S::steady, &S::steadyRms, &S::ofAllowed, &S::noise,
                       &S::deviation, &S::millimetres, &S::forceError, &S::ownBounds})
      raise(endings[i].*field, o.endings[i].*field);
  }
  for (auto field :
       {&L::steps, &L::islands, &L::sticking, &L::sliding, &L::open, &L::opening, &L::closing, &L::wrongStates,
        &L::iterations, &L::failures, &L::ownBoundSolves, &L::ownBoundFailures, &L::floating, &L::hashesDiffer})
    this->*field += o.*field;
  for (auto field : {&L::oracleLeft, &L::excess, &L::momentum}) raise(this->*field, o.*field);
}

void Ledger::print(const std::string& title) const {
  std::printf(
      "  %s: %d steps, %d islands; points sticking %d, sliding %d, open %d, opening %d, closing %d; in another state "
      "in the engine %d\n",
      title.c_str(), steps, islands, sticking, sliding, open, opening, closing, wrongStates);
  std::printf(
      "    oracle: residual %.1e, iterations %.1f, failed %d, own bounds failed %d of %d; deviation / allowed %.3f; "
      "floating %d, momentum %.1e\n",
      oracleLeft, double(iterations) / std::max(1, islands), failures, ownBoundFailures, ownBoundSolves, excess,
      floating, momentum);
  std::printf("    %-9s %7s %7s %6s  %8s %8s %8s %8s  %8s %8s  %8s %8s %8s %8s\n", "ended", "islands", "bodies",
              "cycles", "force", "torque", "rms", "mean", "steady", "noise", "dev/gh2", "dev mm", "forces", "own");
  for (int i = 0; i < kEndings; i++) {
    const EndingSums& s = endings[std::size_t(i)];
    if (s.islands == 0) continue;
    std::printf("    %-9s %7d %7.1f %6.1f  %8.1e %8.1e %8.1e %8.1e  %8.1e %8.1e  %8.1e %8.1e %8.1e %8.1e\n",
                kEndingNames[i], s.islands, double(s.bodies) / s.islands, double(s.cycles) / s.islands, s.force,
                s.torque, s.rms, s.mean, s.steady, s.noise, s.deviation, s.millimetres, s.forceError, s.ownBounds);
  }
}

Ledger follow(Trial trial, double seconds, int every) {
  Ledger ledger;
  WorldDef def = trial.world.definition();
  def.solver.maxHitParts = 1;  // what is looked at is one solve a step
  EXPECT_TRUE(trial.world.setDefinition(def).ok());
  int steps = int(std::lround(seconds / trial.dt));
  for (int step = 0; step < steps; step++) {
    std::uint64_t expected = 0;
    bool looked = step % every == 0;
    if (looked) {
      expected = probeStep(
          trial.world, trial.dt, [&](const SolvedIsland& s) { ledger.add(s); }, trial.push);
      ledger.steps++;
    }
    if (trial.push) trial.push(trial.world);
    Result<StepReport> report = trial.world.step(trial.dt);
    EXPECT_TRUE(report.ok() && report->quarantined.empty()) << "step " << step;
    if (looked) ledger.hashesDiffer += trial.world.stateHash() != expected;
  }
  return ledger;
}

namespace {

std::string endingsOf(const Ledger& l) {
  std::string out;
  for (int i = 0; i < kEndings; i++) {
    const EndingSums& s = l.endings[std::size_t(i)];
    if (s.islands == 0) continue;
    char text[160];
    std::snprintf(text, sizeof text, "%s%s %d: residual %.1g weights, off by %.1g g h^2, %.1g mm",
                  out.empty() ? "" : "; ", kEndingNames[i], s.islands, std::max(s.force, s.torque), s.deviation,
                  s.millimetres);
    out += text;
  }
  return out;
}

}  // namespace

void conclude(const std::string& name, double dt, const Ledger& l) {
  l.print(name);
  test::record({.section = "Against the converged solution",
                .name = name + ": distance from it, of what the residual allows",
                .dt = dt,
                .expected = 1,
                .found = l.excess,
                .atMost = true,
                .pass = l.excess <= 1,
                .cases = l.islands,
                .note = "islands " + endingsOf(l)});
  EXPECT_EQ(l.hashesDiffer, 0);
  EXPECT_EQ(l.failures, 0);
  EXPECT_LE(l.excess, 1);
  for (Ending ending : {Ending::rested, Ending::slow, Ending::exact, Ending::moving})
    EXPECT_LE(l.of(ending).ofAllowed, 1) << kEndingNames[int(ending)] << ": residual over what its plan allows";
  EXPECT_LE(l.momentum, 1e-12);
}

Ledger look(const std::string& name, Trial trial, double seconds, int every) {
  double dt = trial.dt;
  Ledger l = follow(std::move(trial), seconds, every);
  conclude(name, dt, l);
  return l;
}

}  // namespace brickfall::oracle
