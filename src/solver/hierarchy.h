// Rigid clusters of an island, coarse to fine. Level 0 is the single bodies; each next level merges up to six
// neighbouring clusters, strongest link first, until one is left. Fixed bodies are never merged.
//
// Firm ties come first, by the load that they carry: a level carries loads and moments through long, well-connected
// walls (level_step.h).
#pragma once
#include <cstdint>
#include <memory_resource>
#include <span>
#include <utility>
#include <vector>

#include "dynamics/body_set.h"
#include "solver/solve_body.h"

namespace brickfall {

struct Cluster {
  Vec3f centre;                              // m, from the island's origin
  float mass = 0;                            // m / dt^2
  float inertia[6] = {};                     // / dt^2, about the centre: xx yx yy zx zy zz
  std::uint32_t bodyBegin = 0, bodyEnd = 0;  // in Level::bodies
  std::uint32_t sideBegin = 0, sideEnd = 0;  // in Level::sides
};

struct Level {
  std::pmr::vector<Cluster> clusters;
  std::pmr::vector<std::uint32_t> clusterOf;  // per body of the island
  std::pmr::vector<std::uint32_t> bodies;     // by cluster
  std::pmr::vector<std::uint32_t> sides;      // by cluster: boundary rows, 2 x row + (1 if our body is B)

  // A list of levels hands its memory on to them.
  using allocator_type = std::pmr::polymorphic_allocator<std::byte>;
  explicit Level(allocator_type from = {}) : clusters(from), clusterOf(from), bodies(from), sides(from) {}
  Level(const Level& other, allocator_type from)
      : clusters(other.clusters, from),
        clusterOf(other.clusterOf, from),
        bodies(other.bodies, from),
        sides(other.sides, from) {}
  Level(Level&& other, allocator_type from)
      : clusters(std::move(other.clusters), from),
        clusterOf(std::move(other.clusterOf), from),
        bodies(std::move(other.bodies), from),
        sides(std::move(other.sides), from) {}
};

// A row as a link between two bodies of the island. Fixed partners: kNoIndex.
struct ClusterLink {
  std::uint32_t bodyA = kNoIndex, bodyB = kNoIndex;
  float strength = 0;  // > 0
};

struct Hierarchy {
  bool valid = false;              // built for the island's contacts of now
  std::pmr::vector<Level> levels;  // 0 = bodies ... back() = the island

  explicit Hierarchy(std::pmr::memory_resource* memory = std::pmr::get_default_resource()) : levels(memory) {}
  void build(std::uint32_t bodies, std::span<const ClusterLink> links);
  // Mass, centre and inertia of every cluster from those of its bodies.
  void refresh(std::span<const SolveMass> masses);
};

}  // namespace brickfall
