// A brick that fell on a shard of 20 mm was "far heavier than what it hits": the whole world was stepped in 5 parts, and so it was
// in each step in which anything in it came near a pebble. What is on the way of something heavy must weigh something, too.
#include "support/world_helpers.h"

namespace brickfall {
namespace {

using namespace test;

// Parts of the step in which a body at `speed` (m/s) meets shards of 20 mm before it.
int partsOf(const ShapeDef& shape, double front, double speed, int shards) {
  WorldDef def;
  def.gravity = {};
  World world = makeWorld(def);
  BodyDef body = bodyOf(shape, {0, 0, -front - 0.02});
  body.linearVelocity = {0, 0, speed};
  add(world, body);
  for (int i = 0; i < shards; i++)
    add(world, bodyOf(boxOf({0.01, 0.01, 0.01}, 1900), {0.021 * (i % 5 - 2), 0.021 * (i / 5 - 1), 0.01}));
  return world.step(kDt)->parts;
}

TEST(Regression, APebbleOnTheWayPartsNoStep) {
  const ShapeDef brick = boxOf({0.1075, 0.0325, 0.05125}, 1900), ball = sphereOf(0.15, 7800);
  EXPECT_EQ(partsOf(brick, 0.05125, 3, 1), 1);
  EXPECT_EQ(partsOf(ball, 0.15, 15, 1), 1);
  EXPECT_GT(partsOf(brick, 0.05125, 3, 15), 1) << "a twelfth of its mass";
}

}  // namespace
}  // namespace brickfall
