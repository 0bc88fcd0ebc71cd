// Bricks that were dropped into a shaft pressed into each other where they met at 10 m/s. The core of each then stood in the
// other's way, so they stayed as they were, up to 120 mm deep, for seconds, while their speeds rose to 17 m/s.
#include <algorithm>
#include <cmath>

#include "support/world_helpers.h"

namespace brickfall {
namespace {

using namespace test;

TEST(Regression, BricksDroppedIntoAShaftComeToLieBesideEachOther) {
  for (int bricks : {240, 260, 270}) {
    World world = awakeWorld();
    addGround(world, 0.6);
    for (int side : {-1, 1}) {
      add(world, bodyOf(boxOf({0.1, 2, 0.8}), {side * 0.6, 2, 0}, BodyType::fixed));
      add(world, bodyOf(boxOf({0.8, 2, 0.1}), {0, 2, side * 0.6}, BodyType::fixed));
    }
    std::vector<BodyId> heap;
    for (int i = 0; i < bricks; i++) {
      BodyDef brick = bodyOf(boxOf({0.12, 0.0325, 0.0575}, 1900, 0.6),
                             {(i % 3 - 1) * 0.28, 0.2 + 0.29 * (i / 9), (i / 3 % 3 - 1) * 0.28});
      brick.rotation = turn({std::sin(1.7 * i), std::cos(2.3 * i), std::sin(0.9 * i + 1)}, 137.5 * i);
      heap.push_back(add(world, brick));
    }
    run(world, 4, 1.0 / 60);
    double fastest = 0, deepest = 0;
    for (BodyId body : heap) fastest = std::max(fastest, length(world.state(body)->linearVelocity));
    world.forEachContact([&](const ContactView& c) {
      for (int i = 0; i < c.pointCount; i++) deepest = std::max(deepest, -c.points[i].separation);
    });
    EXPECT_LT(fastest, 2) << bricks << " bricks";
    EXPECT_LT(deepest, 0.01) << bricks << " bricks";
  }
}

}  // namespace
}  // namespace brickfall
