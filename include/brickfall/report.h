// The rigid-body system of the report "Breaking a Brick Wall", as it was described, with the parts that it left out to be
// switched on one by one: for seeing why its wall of 100 bricks fell. A rival of the engine, on top of the engine's public
// API; docs/report.md tells what it does. Library: brickfall::report.
#pragma once
#include <cstddef>
#include <memory>
#include <span>
#include <utility>
#include <vector>

#include "brickfall/integrators.h"
#include "brickfall/world.h"

namespace brickfall {

// All parts off = the report. Each may be switched on by itself; docs/report.md measures them added up in this order.
struct ReportSettings {
  bool allAxes = false;        // all 15 rows at every test, the widest gap is remembered; off: the first that separates
  bool lastAxis = false;       // contact row = the last to stop separating, from the motion of the last step
  bool restitution = false;    // impulse from masses, inertia and restitution; off: impulseFactor x speed
  bool friction = false;       // Coulomb's law; off: damping
  bool manifold = false;       // all points in which two boxes touch, and overlap is pushed out; off: one point
  bool warmStarting = false;   // impulses remembered from step to step, and sweeps over all contacts
  double impulseFactor = 1.5;  // of reduced mass x speed, >= 0; without `restitution`
  double damping = 0.3;        // 1/s, >= 0: of all velocities; without `friction`
  int sweeps = 10;             // 1 .. 1000, over all contacts; with `warmStarting`, else one
  Integrator integrator = Integrator::semiImplicitEuler;
};

// Moves the bodies of a world by the report's system, in place of World::step. Bodies are read and their motion is written
// back through the World's own calls, so that everything but its step goes on working: setters, queries, energies, hashes.
// To the system every body is the box around its shapes, a body with a plane a large box. What the world's step would do
// besides does not happen: the world's time stands still, nothing sleeps, there are no events and no contacts to ask for.
// A snapshot of the world holds none of what the run remembers of pairs; its own does.
class ReportRun {
 public:
  static Result<ReportRun> create(const ReportSettings& settings);  // names the setting that is out of range
  ReportRun(ReportRun&&) noexcept;
  ReportRun& operator=(ReportRun&&) noexcept;
  ~ReportRun();
  // Advances by dt seconds (> 0), in `substeps` equal parts (>= 1). Always of the same world. Of the report time, counts of
  // bodies and what it cost are filled in, `manifolds` and `touchingPoints` are pairs that collided. A body whose motion
  // the world refuses (not finite, absurdly fast) stays where it was, at rest, is named in `quarantined` and left out from
  // then on.
  Result<StepReport> step(World& world, double dt, int substeps = 1);
  // Pairs that collided in the last step.
  const std::vector<std::pair<BodyId, BodyId>>& collisions() const;
  // Masses, sizes and materials of bodies are read once: to be called when they changed.
  void rereadBodies();

  // What it remembers of pairs, and its time: with a snapshot of the world taken at the same moment it goes on bit for bit.
  // `world`: the one that has been restored. On an error nothing changes.
  std::vector<std::byte> snapshot() const;
  Status restore(std::span<const std::byte> snapshot, const World& world);

 private:
  struct Impl;
  explicit ReportRun(std::unique_ptr<Impl> impl);
  std::unique_ptr<Impl> impl_;
};

}  // namespace brickfall
