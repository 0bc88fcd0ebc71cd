// What a world holds for a mortar joint, container by container.
#include <gtest/gtest.h>

#include "support/inside_world.h"
#include "support/mortared_wall.h"

namespace brickfall::test {
namespace {

struct MortarBytes {
  double slots = 0;      // the joints themselves
  double lists = 0;      // who is awake or asleep, which bodies do not collide, which rows are whose
  double hierarchy = 0;  // rows between clusters, of all levels
  double records = 0;    // what the solve reads
  double atRest() const { return slots + lists + hierarchy; }
};

// By joint. Slots with the room that their list has left.
MortarBytes bytesOfMortar(World& world) {
  auto& w = inside(world);
  const std::size_t joints = w.ties.mortar.slots.size();
  MortarBytes sum;
  sum.slots = double(w.ties.mortar.slots.capacity() * sizeof(Mortar));
  // In one of two lists, and in that of bodies that do not collide.
  sum.lists = double(joints * 2 * sizeof(MortarIndex));
  auto add = [&](const Island& island) {
    const MortarRows& rows = island.rows.mortar;
    sum.lists += double(rows.tieOf.size() * sizeof(MortarIndex));
    sum.records += double(rows.records.capacity() * sizeof(FaceRecord) + rows.starts.capacity() * sizeof(MortarStart));
    const double share = double(rows.size()) / double(island.rows.size());
    for (const Level& level : island.hierarchy.levels)
      sum.hierarchy += share * double(level.sides.size() * sizeof(level.sides[0]));
  };
  for (const auto* list : {&w.activity.islands.awake, &w.activity.islands.asleep})
    for (const IslandPointer& island : *list) add(*island);
  for (double* bytes : {&sum.slots, &sum.lists, &sum.hierarchy, &sum.records}) *bytes /= double(joints);
  return sum;
}

TEST(MortarMemory, AJointAtRestIsLittle) {
  WorldDef def;
  def.sleepDelay = 0.1;
  MortaredWall wall = mortaredWall(20, 10, 0, def);
  (void)wall.world.destroyBody(wall.world.bodies().back());  // the ball
  ASSERT_TRUE(wall.world.step(1.0 / 60).ok());
  const MortarBytes solved = bytesOfMortar(wall.world);
  for (int i = 0; i < 60; i++) ASSERT_TRUE(wall.world.step(1.0 / 60).ok());
  ASSERT_TRUE(wall.world.validate().empty());
  const MortarBytes rest = bytesOfMortar(wall.world);
  std::printf("  bytes of a joint: slot %.0f, lists %.0f, hierarchy %.1f: at rest %.1f; while it is solved %.0f more\n",
              rest.slots, rest.lists, rest.hierarchy, rest.atRest(), solved.records);
  EXPECT_LT(rest.atRest(), 256);
  EXPECT_EQ(rest.records, 0);
  EXPECT_GT(solved.records, 0);
  // It goes on from there as if nothing had been put away.
  const std::vector<std::byte> bytes = wall.world.snapshot();
  World copy = std::move(World::create(def)).value();
  ASSERT_TRUE(copy.restore(bytes).ok());
  for (World* world : {&wall.world, &copy}) {
    ASSERT_TRUE(world->applyImpulse(world->bodies().back(), {0.2, 0, 0.5}).ok());
    for (int i = 0; i < 5; i++) ASSERT_TRUE(world->step(1.0 / 60).ok());
  }
  EXPECT_GT(bytesOfMortar(wall.world).records, 0);
  EXPECT_EQ(wall.world.stateHash(), copy.stateHash());
}

}  // namespace
}  // namespace brickfall::test
