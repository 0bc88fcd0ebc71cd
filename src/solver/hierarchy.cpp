#include "solver/hierarchy.h"

#include "solver/numbering.h"

namespace brickfall {

namespace {

//! bodies | too small: 4 takes a fourth more visits | too large: 8 lets hit walls move more
constexpr std::uint32_t kClusterSize = 6;  // a fourth more visits with 4 for the same walls; hit walls move more with 8
//! not of the method: room; 6^13 bodies are more than any world has
constexpr int kMaxLevels = 13;

using Memory = std::pmr::memory_resource;
using Numbers = std::pmr::vector<std::uint32_t>;

// Neighbours of every cluster, with the strength of all links to each.
struct Neighbours {
  explicit Neighbours(Memory* memory) : of(memory), strength(memory) {}
  Adjacency of;
  std::pmr::vector<float> strength;  // as of.list
};

Neighbours neighboursOf(std::span<const ClusterLink> links, const Numbers& clusterOf, std::uint32_t clusters) {
  Neighbours out(clusterOf.get_allocator().resource());
  auto eachLink = [&](auto visit) {
    for (const ClusterLink& link : links) {
      if (link.bodyA == kNoIndex || link.bodyB == kNoIndex) continue;
      const std::uint32_t a = clusterOf[link.bodyA], b = clusterOf[link.bodyB];
      if (a != b) visit(a, b, link.strength);
    }
  };
  out.of.fill(clusters, [&](auto visit) { eachLink([&](std::uint32_t a, std::uint32_t b, float) { visit(a, b); }); });
  out.strength.assign(out.of.list.size(), 0);
  eachLink([&](std::uint32_t a, std::uint32_t b, float strength) {
    out.strength[out.of.find(a, b)] += strength;
    out.strength[out.of.find(b, a)] += strength;
  });
  return out;
}

// Greedy aggregation: each aggregate grows by the free neighbour most strongly tied to it. A cluster left alone joins
// its strongest neighbour's aggregate, unless that aggregate is too large already. Returns the number of aggregates.
std::uint32_t aggregate(const Neighbours& graph, std::uint32_t clusters, Numbers& aggregateOf) {
  aggregateOf.assign(clusters, kNoIndex);
  Numbers size(aggregateOf.get_allocator());
  size.reserve(clusters);
  for (std::uint32_t i = 0; i < clusters; i++) {
    if (aggregateOf[i] != kNoIndex) continue;
    std::uint32_t id = std::uint32_t(size.size());
    std::uint32_t members[kClusterSize] = {i}, count = 1;
    aggregateOf[i] = id;
    while (count < kClusterSize) {
      std::uint32_t best = kNoIndex;
      float bestTie = 0;
      for (std::uint32_t m = 0; m < count; m++)
        for (std::uint32_t e = graph.of.begin[members[m]]; e < graph.of.begin[members[m] + 1]; e++) {
          std::uint32_t candidate = graph.of.list[e];
          if (aggregateOf[candidate] != kNoIndex) continue;
          float tie = 0;
          for (std::uint32_t l = graph.of.begin[candidate]; l < graph.of.begin[candidate + 1]; l++)
            if (aggregateOf[graph.of.list[l]] == id) tie += graph.strength[l];
          if (tie > bestTie) {
            bestTie = tie;
            best = candidate;
          }
        }
      if (best == kNoIndex) break;
      aggregateOf[best] = id;
      members[count++] = best;
    }
    if (count == 1) {
      std::uint32_t host = kNoIndex;
      float bestTie = 0;
      for (std::uint32_t e = graph.of.begin[i]; e < graph.of.begin[i + 1]; e++) {
        std::uint32_t other = aggregateOf[graph.of.list[e]];
        if (other != kNoIndex && other != id && graph.strength[e] > bestTie && size[other] <= kClusterSize) {
          bestTie = graph.strength[e];
          host = other;
        }
      }
      if (host != kNoIndex) {
        aggregateOf[i] = host;
        size[host]++;
        continue;
      }
    }
    size.push_back(count);
  }
  return std::uint32_t(size.size());
}

// Bodies and boundary contacts by cluster, by counting.
Level makeLevel(std::span<const ClusterLink> links, const Numbers& clusterOf, std::uint32_t clusters) {
  Level level(clusterOf.get_allocator());
  level.clusterOf = clusterOf;
  level.clusters.resize(clusters);
  auto clusterAt = [&](std::uint32_t body) { return body == kNoIndex ? kNoIndex : clusterOf[body]; };
  for (std::uint32_t c : clusterOf) level.clusters[c].bodyEnd++;
  for (const ClusterLink& link : links) {
    std::uint32_t a = clusterAt(link.bodyA), b = clusterAt(link.bodyB);
    if (a == b) continue;  // inside a cluster: no relative motion, no net force
    if (a != kNoIndex) level.clusters[a].sideEnd++;
    if (b != kNoIndex) level.clusters[b].sideEnd++;
  }
  std::uint32_t bodies = 0, sides = 0;
  for (Cluster& c : level.clusters) {
    std::uint32_t bodyCount = c.bodyEnd, sideCount = c.sideEnd;
    c.bodyBegin = c.bodyEnd = bodies;
    c.sideBegin = c.sideEnd = sides;
    bodies += bodyCount;
    sides += sideCount;
  }
  level.bodies.resize(bodies);
  level.sides.resize(sides);
  for (std::uint32_t i = 0; i < clusterOf.size(); i++) level.bodies[level.clusters[clusterOf[i]].bodyEnd++] = i;
  for (std::uint32_t k = 0; k < links.size(); k++) {
    std::uint32_t a = clusterAt(links[k].bodyA), b = clusterAt(links[k].bodyB);
    if (a == b) continue;
    if (a != kNoIndex) level.sides[level.clusters[a].sideEnd++] = 2 * k;
    if (b != kNoIndex) level.sides[level.clusters[b].sideEnd++] = 2 * k + 1;
  }
  return level;
}

}  // namespace

void Hierarchy::build(std::uint32_t bodies, std::span<const ClusterLink> links) {
  levels.clear();
  Memory* memory = levels.get_allocator().resource();
  Numbers clusterOf(bodies, memory), aggregateOf(memory);
  for (std::uint32_t i = 0; i < bodies; i++) clusterOf[i] = i;
  std::uint32_t clusters = bodies;
  levels.push_back(makeLevel(links, clusterOf, clusters));
  while (int(levels.size()) < kMaxLevels && clusters > 1) {
    std::uint32_t merged = aggregate(neighboursOf(links, clusterOf, clusters), clusters, aggregateOf);
    if (int(levels.size()) + 1 == kMaxLevels) {  // a body with hundreds of neighbours takes in few of them a level
      aggregateOf.assign(clusters, 0);
      merged = 1;
    }
    if (merged == clusters) break;
    for (std::uint32_t& c : clusterOf) c = aggregateOf[c];
    clusters = merged;
    levels.push_back(makeLevel(links, clusterOf, clusters));
  }
}

void Hierarchy::refresh(std::span<const SolveMass> masses) {
  for (Level& level : levels)
    for (Cluster& c : level.clusters) {
      float mass = 0;
      Vec3f moment;
      for (std::uint32_t k = c.bodyBegin; k < c.bodyEnd; k++) {
        const SolveMass& b = masses[level.bodies[k]];
        mass += b.mass;
        moment += b.position * b.mass;
      }
      c.mass = mass;
      c.centre = c.bodyEnd - c.bodyBegin == 1 ? masses[level.bodies[c.bodyBegin]].position : moment * (1 / mass);
      float sum[6] = {};
      for (std::uint32_t k = c.bodyBegin; k < c.bodyEnd; k++) {
        const SolveMass& b = masses[level.bodies[k]];
        Vec3f r = b.position - c.centre;
        sum[0] += b.inertia[0] + b.mass * (r.y * r.y + r.z * r.z);
        sum[1] += b.inertia[1] - b.mass * r.x * r.y;
        sum[2] += b.inertia[2] + b.mass * (r.x * r.x + r.z * r.z);
        sum[3] += b.inertia[3] - b.mass * r.x * r.z;
        sum[4] += b.inertia[4] - b.mass * r.y * r.z;
        sum[5] += b.inertia[5] + b.mass * (r.x * r.x + r.y * r.y);
      }
      for (int i = 0; i < 6; i++) c.inertia[i] = sum[i];
    }
}

}  // namespace brickfall
