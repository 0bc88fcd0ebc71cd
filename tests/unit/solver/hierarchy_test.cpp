// Cluster hierarchies: every body in one cluster of each level, one cluster at the top, boundaries that name exactly the
// contacts between a cluster and the rest.
#include "solver/hierarchy.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <set>

#include "math/random.h"

namespace brickfall {
namespace {

constexpr std::uint32_t kNone = kNoIndex;

void expectSound(const Hierarchy& h, std::uint32_t bodies, const std::vector<ClusterLink>& links) {
  ASSERT_FALSE(h.levels.empty());
  ASSERT_EQ(h.levels[0].clusters.size(), bodies) << "level 0 is the bodies";
  for (std::size_t l = 0; l < h.levels.size(); l++) {
    const Level& level = h.levels[l];
    std::vector<int> seen(bodies, 0);
    for (std::size_t c = 0; c < level.clusters.size(); c++) {
      const Cluster& cluster = level.clusters[c];
      ASSERT_LT(cluster.bodyBegin, cluster.bodyEnd) << "an empty cluster";
      for (std::uint32_t k = cluster.bodyBegin; k < cluster.bodyEnd; k++) {
        seen[level.bodies[k]]++;
        EXPECT_EQ(level.clusterOf[level.bodies[k]], c);
      }
      std::multiset<std::uint32_t> wanted, found;
      for (std::uint32_t i = 0; i < links.size(); i++) {
        auto in = [&](std::uint32_t body) { return body != kNone && level.clusterOf[body] == c; };
        if (in(links[i].bodyA) && !in(links[i].bodyB)) wanted.insert(2 * i);
        if (in(links[i].bodyB) && !in(links[i].bodyA)) wanted.insert(2 * i + 1);
      }
      for (std::uint32_t k = cluster.sideBegin; k < cluster.sideEnd; k++) found.insert(level.sides[k]);
      EXPECT_EQ(found, wanted) << "boundary of cluster " << c << " on level " << l;
    }
    for (int n : seen) EXPECT_EQ(n, 1) << "a body twice or never on level " << l;
    if (l == 0) continue;
    EXPECT_LT(level.clusters.size(), h.levels[l - 1].clusters.size()) << "a level that merges nothing";
    for (std::uint32_t a = 0; a < bodies; a++)
      for (std::uint32_t b = 0; b < bodies; b++)
        if (h.levels[l - 1].clusterOf[a] == h.levels[l - 1].clusterOf[b]) {
          ASSERT_EQ(level.clusterOf[a], level.clusterOf[b]) << "a cluster was torn apart";
        }
  }
}

std::vector<ClusterLink> wallLinks(std::uint32_t courses, std::uint32_t perCourse) {
  std::vector<ClusterLink> links;
  auto body = [&](std::uint32_t row, std::uint32_t i) { return row * perCourse + i; };
  for (std::uint32_t row = 0; row < courses; row++)
    for (std::uint32_t i = 0; i < perCourse; i++) {
      if (row == 0) links.push_back({kNone, body(row, i), 4});
      if (i + 1 < perCourse) links.push_back({body(row, i), body(row, i + 1), 4});
      if (row + 1 < courses) {
        links.push_back({body(row, i), body(row + 1, i), 100});
        if (i + 1 < perCourse) links.push_back({body(row, i + 1), body(row + 1, i), 100});
      }
    }
  return links;
}

TEST(Hierarchy, OfAWallIsSoundAndEndsInOneCluster) {
  for (auto [courses, bricks] : {std::pair{1u, 1u}, std::pair{1u, 7u}, std::pair{10u, 10u}, std::pair{20u, 12u}}) {
    std::vector<ClusterLink> links = wallLinks(courses, bricks);
    Hierarchy h;
    h.build(courses * bricks, links);
    expectSound(h, courses * bricks, links);
    EXPECT_EQ(h.levels.back().clusters.size(), 1u);
    EXPECT_LE(h.levels.size(), 10u) << "merges too slowly";
  }
}

TEST(Hierarchy, OfRandomGraphsIsSound) {
  Random random(5);
  for (int n = 0; n < 60; n++) {
    std::uint32_t bodies = 2 + random.below(60);
    std::vector<ClusterLink> links;
    for (std::uint32_t i = 1; i < bodies; i++)  // a tree, so that all hang together
      links.push_back({random.below(i), i, float(random.between(0.5, 100))});
    for (std::uint32_t i = 0; i < bodies; i++) {
      std::uint32_t a = random.below(bodies), b = random.below(bodies);
      if (a != b) links.push_back({a, b, float(random.between(0.5, 100))});
      if (random.unit() < 0.2) links.push_back({a, kNone, 3});
    }
    Hierarchy h;
    h.build(bodies, links);
    expectSound(h, bodies, links);
    EXPECT_EQ(h.levels.back().clusters.size(), 1u);
  }
}

TEST(Hierarchy, TheStrongestLinkIsMergedFirst) {
  // Two stacks of four, joined by the strongest link of all.
  std::vector<ClusterLink> links;
  for (std::uint32_t stack : {0u, 4u})
    for (std::uint32_t i = 0; i < 3; i++) links.push_back({stack + i, stack + i + 1, 1});
  links.push_back({3, 4, 1000});
  Hierarchy h;
  h.build(8, links);
  expectSound(h, 8, links);
  EXPECT_EQ(h.levels[1].clusterOf[3], h.levels[1].clusterOf[4]);
}

TEST(Hierarchy, ClusterMassAndInertiaAreThoseOfItsBodies) {
  Random random(9);
  std::vector<ClusterLink> links = wallLinks(4, 5);
  Hierarchy h;
  h.build(20, links);
  std::vector<SolveMass> masses(20);
  for (SolveMass& m : masses) {
    m.mass = float(random.between(1, 5));
    for (int i : {0, 2, 5}) m.inertia[i] = float(random.between(0.1, 0.2));
    m.inertia[3] = float(random.between(-0.02, 0.02));
    m.position = {float(random.between(-2, 2)), float(random.between(-2, 2)), float(random.between(-2, 2))};
  }
  h.refresh(masses);
  for (const Level& level : h.levels)
    for (const Cluster& c : level.clusters) {
      double mass = 0, xx = 0, zx = 0;
      Vec3 moment;
      for (std::uint32_t k = c.bodyBegin; k < c.bodyEnd; k++) {
        mass += double(masses[level.bodies[k]].mass);
        moment += toDouble(masses[level.bodies[k]].position) * double(masses[level.bodies[k]].mass);
      }
      Vec3 centre = moment * (1 / mass);
      for (std::uint32_t k = c.bodyBegin; k < c.bodyEnd; k++) {
        const SolveMass& m = masses[level.bodies[k]];
        Vec3 r = toDouble(m.position) - centre;
        xx += double(m.inertia[0]) + double(m.mass) * (r.y * r.y + r.z * r.z);
        zx += double(m.inertia[3]) - double(m.mass) * r.x * r.z;
      }
      EXPECT_NEAR(double(c.mass), mass, 1e-5 * mass);
      EXPECT_NEAR(length(toDouble(c.centre) - centre), 0, 1e-5);
      EXPECT_NEAR(double(c.inertia[0]), xx, 1e-5 * (1 + xx));
      EXPECT_NEAR(double(c.inertia[3]), zx, 1e-5 * (1 + xx));
    }
}

}  // namespace
}  // namespace brickfall
