// What any well-laid wall satisfies, checked brick by brick. For walls along x at the origin, without disorder.
#pragma once
#include <gtest/gtest.h>

#include <algorithm>
#include <string>
#include <vector>

#include "brickfall/masonry.h"

namespace brickfall {

inline std::vector<BrickPlacement> lay(const WallDef& wall, std::uint64_t seed = 1) {
  auto bricks = layBricks(wall, seed);
  EXPECT_TRUE(bricks.ok()) << bricks.error().message;
  return bricks ? *bricks : std::vector<BrickPlacement>{};
}

inline Vec3 lowerOf(const BrickPlacement& brick) { return brick.centre - brick.size * 0.5; }
inline Vec3 upperOf(const BrickPlacement& brick) { return brick.centre + brick.size * 0.5; }

// Overlap of two intervals, negative = gap.
inline double shared(double lowA, double highA, double lowB, double highB) {
  return std::min(highA, highB) - std::max(lowA, lowB);
}

inline void expectNoOverlap(const std::vector<BrickPlacement>& bricks) {
  for (std::size_t a = 0; a < bricks.size(); a++)
    for (std::size_t b = a + 1; b < bricks.size(); b++) {
      Vec3 la = lowerOf(bricks[a]), ua = upperOf(bricks[a]), lb = lowerOf(bricks[b]), ub = upperOf(bricks[b]);
      double depth =
          std::min({shared(la.x, ua.x, lb.x, ub.x), shared(la.y, ua.y, lb.y, ub.y), shared(la.z, ua.z, lb.z, ub.z)});
      EXPECT_LT(depth, 1e-12) << bricks[a].name << " and " << bricks[b].name;
    }
}

// Every brick above the foot rests on bricks on both sides of its centre, along the wall.
inline void expectCarried(const std::vector<BrickPlacement>& bricks, double bedJoint = 0) {
  for (const BrickPlacement& brick : bricks) {
    Vec3 l = lowerOf(brick), u = upperOf(brick);
    if (l.y < 1e-9) continue;
    double from = 1e9, to = -1e9;
    for (const BrickPlacement& below : bricks) {
      Vec3 lb = lowerOf(below), ub = upperOf(below);
      bool touches = std::fabs(ub.y + bedJoint - l.y) < 1e-9 && shared(l.x, u.x, lb.x, ub.x) > 1e-6 &&
                     shared(l.z, u.z, lb.z, ub.z) > 1e-6;
      if (!touches) continue;
      from = std::min(from, std::max(l.x, lb.x));
      to = std::max(to, std::min(u.x, ub.x));
    }
    EXPECT_LT(from, brick.centre.x) << brick.name;
    EXPECT_GT(to, brick.centre.x) << brick.name;
  }
}

}  // namespace brickfall
