// Rigid clusters of an island, coarse to fine. Level 0 is the single bodies; each next level merges up to six
// neighbouring clusters, strongest link first, until one is left. What is fixed is never merged.
//
// Two hierarchies are used in turn:
//   by strength    all contacts count, weighted by load: carries loads and moments through long, well-connected walls;
//   by mechanism   weak contacts (joints that can turn or slide) are merged last, so that a cluster is a part that really
//                  moves rigidly and its boundary is the set of joints of the collapse: slow collapses keep their speed.
#pragma once
#include <cstdint>
#include <vector>

#include "solver/contact_record.h"

namespace brickfall {

struct Cluster {
  Vec3f centre;                              // m, from the island's origin
  float mass = 0;                            // m / dt^2
  float inertia[6] = {};                     // / dt^2, about the centre: xx yx yy zx zy zz
  std::uint32_t bodyBegin = 0, bodyEnd = 0;  // in Level::bodies
  std::uint32_t sideBegin = 0, sideEnd = 0;  // in Level::sides
};

struct Level {
  std::vector<Cluster> clusters;
  std::vector<std::uint32_t> clusterOf;  // per body of the island
  std::vector<std::uint32_t> bodies;     // by cluster
  std::vector<std::uint32_t> sides;      // by cluster: boundary contacts, 2 x record + (1 if our body is B)
};

// A contact as a link between two bodies of the island. Fixed partners: kNoBody.
struct ClusterLink {
  static constexpr std::uint32_t kNoBody = 0xffffffffu;
  std::uint32_t bodyA = kNoBody, bodyB = kNoBody;
  float strength = 0;  // > 0
  bool weak = false;
};

struct Hierarchy {
  std::vector<Level> levels;  // 0 = bodies ... back() = the island

  void build(std::uint32_t bodies, const std::vector<ClusterLink>& links, bool weakLast);
  // Mass, centre and inertia of every cluster from those of its bodies.
  void refresh(const std::vector<SolveMass>& masses);
};

}  // namespace brickfall
