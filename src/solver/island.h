// An island: dynamic bodies tied to each other, not through anything fixed. It has all that its solve needs, numbered
// from 0 and kept from step to step as long as the same bodies and ties make it up.
#pragma once
#include <cstdint>
#include <memory_resource>
#include <vector>

#include "solver/blows.h"
#include "solver/chunks.h"
#include "solver/finish/groups.h"
#include "solver/hierarchy.h"
#include "solver/plan.h"
#include "solver/rigid_sum.h"
#include "solver/rows.h"
#include "solver/solve_body.h"
#include "solver/step_context.h"

namespace brickfall {

// Which part of its step an island makes: an island that impacts cut (stage_impacts.cpp) makes several.
enum class IslandPart : std::uint8_t {
  last,      // the rest of its step, or all of it if nothing cut it: a slow island is damped, and may rest
  between,   // an earlier part
  toImpact,  // a part until a point closes: open points are left out, velocities are those of that moment
  flight     // the same for an island that touches nothing
};

struct Island {
  // Islands come and go in a step: all their lists, and the scratch of their solve, come from `memory`.
  explicit Island(std::pmr::memory_resource* from = std::pmr::get_default_resource()) : memory(from) {}
  std::pmr::memory_resource* memory;

  std::pmr::vector<BodyIndex> bodies{memory};    // dynamic, ascending
  std::pmr::vector<BodyIndex> partners{memory};  // fixed or kinematic bodies touched; motion[bodies.size() + i]

  Rows rows{memory};                             // the ties of its bodies
  std::pmr::vector<SolveMotion> motion{memory};  // bodies, then partners
  std::pmr::vector<SolveMass> masses{memory};    // bodies
  std::pmr::vector<Wrench> residual{memory};     // bodies
  std::pmr::vector<std::uint8_t> locks{memory};  // bodies (dynamics/axis_locks.h); empty: none has any
  std::pmr::vector<float> loads{memory};         // N, bodies: half the sum of the forces that rows exert on the body
  // m/s at the reference's scale, bodies: |v| + |w| outer radius at the start of the step
  std::pmr::vector<float> speeds{memory};
  Hierarchy hierarchy{memory};
  double dt = 0;          // s: its time step: the rest of the world's after the impacts that it met (stage_impacts.cpp)
  Vec3 origin;            // m, of SolveMass::position and Cluster::centre
  Chunks chunks{memory};  // of this step
  // Of this step: unknowns and free motions leave it out, so that a fast island in flight is solved as finely as one at
  // rest. Floats round ways, and firm ties make forces of that.
  RigidWay rigid;

  IslandPart part = IslandPart::last;
  Blows blows{memory};    // of this step
  Groups groups{memory};  // of its bodies, by the forces of this step

  IslandFacts facts;  // of this step, or of the last one in which the island was not passed over
  SolvePlan plan;
  IslandEnding ending = IslandEnding::unsolved;
  std::int32_t points = 0, touchingPoints = 0;  // counted in the last step in which the island was not passed over
  // Bodies: poses of a slow island when its present watch began; empty = none.
  std::pmr::vector<Transform> placePoses{memory};
  double inPlaceTime = 0;       // s, since the watch began
  double fastestLately = 0.02;  // x sqrt(gravity x radius), of a body that swings; it fades
  double restTime = 0;          // s, rested without a break

  BodyIndex bodyAt(std::uint32_t local) const {  // as numbered in `motion`
    return local < bodies.size() ? bodies[local] : partners[local - bodies.size()];
  }
  BodyIndex key() const { return bodies.front(); }
  bool grounded() const { return !partners.empty(); }  // touches something fixed or kinematic
  bool toImpact() const { return part == IslandPart::toImpact || part == IslandPart::flight; }
  // It stays where it is in this step; nothing about it changes: the coming step passes it over.
  bool resting() const { return ending == IslandEnding::rested || settled(); }
  bool settled() const { return ending == IslandEnding::inPlace || ending == IslandEnding::settled; }
  // The island was changed from outside: the coming step looks at it again, and a watch of its place begins anew.
  void unsettle() {
    placePoses.clear();
    if (settled()) ending = IslandEnding::rested;
  }
};

}  // namespace brickfall
