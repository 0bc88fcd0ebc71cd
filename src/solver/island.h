// An island: dynamic bodies joined by contacts, not through anything fixed. Holds all that its solve needs, numbered from
// 0 and kept from step to step as long as the same bodies and contacts make it up.
#pragma once
#include <cstdint>
#include <memory_resource>
#include <vector>

#include "dynamics/contact_set.h"
#include "solver/contact_record.h"
#include "solver/hierarchy.h"
#include "solver/plan.h"
#include "solver/step_context.h"

namespace brickfall {

// Start-of-step facts of a contact that the records don't hold: for restitution and for the friction of new points.
struct ContactStart {
  float approach[4] = {};  // m/s, normal relative velocity; negative = closing
  float gap[4] = {};       // m
};

struct Island {
  // Islands come and go in a step: all their lists, and what is needed while they are solved, come from `memory`.
  explicit Island(std::pmr::memory_resource* from = std::pmr::get_default_resource()) : memory(from) {}
  std::pmr::memory_resource* memory;

  std::pmr::vector<BodyIndex> bodies{memory};       // dynamic, ascending
  std::pmr::vector<ContactIndex> contacts{memory};  // with points, in pair order
  std::pmr::vector<BodyIndex> partners{memory};     // fixed or kinematic bodies touched; motion[bodies.size() + i]

  std::pmr::vector<ContactRecord> records{memory};  // by contact
  std::pmr::vector<ContactStart> starts{memory};    // by contact
  std::pmr::vector<SolveMotion> motion{memory};     // bodies, then partners
  std::pmr::vector<SolveMass> masses{memory};       // bodies
  std::pmr::vector<Wrench> residual{memory};        // bodies
  Hierarchy byStrength{memory}, byMechanism{memory};
  Vec3 origin;  // m, of SolveMass::position and Cluster::centre
  Vec3 drift;   // m: rigid displacement of this step that d and dFree leave out
  Vec3 lag;     // kg m: mass times way, by which bodies were stopped at obstacles after the solve

  IslandFacts facts;  // of this step, or of the last in which it was not passed over
  SolvePlan plan;
  IslandEnding ending = IslandEnding::unsolved;
  std::int32_t points = 0, touchingPoints = 0;  // counted in the last step that was not passed over
  // Bodies: where a slow island was when its present watch began; empty = none.
  std::pmr::vector<Transform> heldPoses{memory};
  double heldTime = 0;  // s, since then
  double restTime = 0;  // s, rested without a break

  BodyIndex key() const { return bodies.front(); }
  bool grounded() const { return !partners.empty(); }  // touches something fixed or kinematic
  bool resting() const { return isResting(ending); }
  bool settled() const { return isSettled(ending); }
  // Something about it changed from outside: the coming step looks at it again.
  void unsettle() {
    if (settled()) ending = IslandEnding::rested;
  }
};

// The contact as a link between bodies, for hierarchies.
std::pmr::vector<ClusterLink> clusterLinks(const Island& island, const ContactSet& contacts);

// Inertia's part of a body's residual: M (dFree - d) / dt^2, I (thFree - th) / dt^2.
Wrench inertiaResidual(const SolveMass& mass, const SolveMotion& motion);

// Forces at the present motion of one cluster's boundary and inertia of its bodies: residual about the cluster's centre.
// With `matrix`, also its Newton matrix. Returns true if a boundary point slides or yields.
struct Symmetric6;  // solver/symmetric6.h
bool clusterResidual(const Island& island, const Level& level, const Cluster& cluster, Wrench& residual,
                     Symmetric6* matrix, double& visits);
// One Newton step of a cluster, moving it rigidly; with a line search where friction slides.
void clusterStep(Island& island, const Level& level, const Cluster& cluster, double& visits);

// Forces at the present motion into Island::residual. With `updateLimits`, points that carried nothing in the last step
// get their friction limit from the present normal force.
void lightPass(Island& island, const ContactSet& contacts, bool updateLimits, double dt, double& visits);
// Largest residual of a body, in weights (torque: as a force at the body's inner radius).
double worstResidual(const Island& island, const BodySet& bodies);
double rmsResidual(const Island& island, const BodySet& bodies);

}  // namespace brickfall
