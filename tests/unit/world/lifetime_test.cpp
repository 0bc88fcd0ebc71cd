// Bodies come and go at any moment: in contact, asleep, many times over.
#include <set>

#include "math/random.h"
#include "support/world_helpers.h"

namespace brickfall {
namespace {

using namespace test;

TEST(Lifetime, DestroyedInContactTheOthersGoOn) {
  World world = makeWorld();
  addGround(world);
  std::vector<BodyId> stack;
  for (int i = 0; i < 6; i++) stack.push_back(addBox(world, {0.2, 0.1, 0.2}, {0, 0.1 + 0.2 * i, 0}));
  run(world, 0.3);
  ASSERT_TRUE(world.destroyBody(stack[2]).ok());
  expectSound(world);
  ASSERT_TRUE(world.destroyBody(stack[0]).ok());
  expectSound(world);
  run(world, 2);
  EXPECT_NEAR(world.state(stack[1])->position.y, 0.1, 5e-3);
  EXPECT_NEAR(world.state(stack[5])->position.y, 0.7, 1e-2);
}

TEST(Lifetime, CreatedBetweenStepsOnTopOfASleepingStack) {
  World world = makeWorld();
  addGround(world);
  std::vector<BodyId> stack;
  for (int i = 0; i < 6; i++) {
    stack.push_back(addBox(world, {0.2, 0.1, 0.2}, {0, 0.1 + 0.2 * i, 0}));
    run(world, 1);
  }
  for (int i = 0; i < 6; i++) {
    EXPECT_NEAR(world.state(stack[std::size_t(i)])->position.y, 0.1 + 0.2 * i, 2e-3);
    EXPECT_FALSE(world.state(stack[std::size_t(i)])->awake);
  }
}

TEST(Lifetime, SlotsAreReusedWithNewGenerations) {
  World world = emptySpace();
  std::set<BodyId> seen;
  BodyId first = addBox(world, {0.1, 0.1, 0.1}, {});
  std::uint32_t slot = first.index;
  seen.insert(first);
  for (int i = 0; i < 2000; i++) {
    ASSERT_TRUE(world.destroyBody(first).ok());
    BodyId next = addBox(world, {0.1, 0.1, 0.1}, {});
    EXPECT_EQ(next.index, slot) << "the slot is free";
    EXPECT_TRUE(seen.insert(next).second) << "an id came twice";
    EXPECT_FALSE(world.isValid(first));
    EXPECT_TRUE(world.isValid(next));
    first = next;
  }
  // past the end of the generation counter an id may return, but never 0
  for (int i = 0; i < 70000; i++) {
    ASSERT_TRUE(world.destroyBody(first).ok());
    first = *world.createBody(bodyOf(boxOf({0.1, 0.1, 0.1}), {}));
    ASSERT_NE(first.generation, 0);
  }
  EXPECT_EQ(world.bodies().size(), 1u);
}

TEST(Lifetime, RandomBirthsAndDeathsKeepEveryInvariant) {
  for (std::uint64_t seed : {1, 2, 3, 4}) {
    Random random(seed);
    World world = makeWorld();
    addGround(world);
    std::vector<BodyId> alive;
    int destroyed = 0;
    for (int i = 0; i < 250; i++) {
      if (alive.size() < 5 || (alive.size() < 40 && random.unit() < 0.5)) {
        ShapeDef shapes[] = {boxOf({.1, .1, .1}), sphereOf(.1), capsuleOf(.05, .1), hullOf(.15)};
        BodyDef d = bodyOf(shapes[random.below(4)],
                           {random.between(-.4, .4), random.between(.2, 1.5), random.between(-.4, .4)});
        if (random.unit() < 0.15) d.type = BodyType::fixed;
        if (random.unit() < 0.1) {
          d.type = BodyType::kinematic;
          d.linearVelocity = {random.between(-1, 1), 0, random.between(-1, 1)};
        }
        alive.push_back(add(world, d));
      }
      if (random.unit() < 0.3) {
        std::size_t at = random.below(std::uint32_t(alive.size()));
        ASSERT_TRUE(world.destroyBody(alive[at]).ok());
        alive.erase(alive.begin() + std::ptrdiff_t(at));
        destroyed++;
        expectSound(world);
      }
      if (!alive.empty() && random.unit() < 0.1) {
        BodyId body = alive[random.below(std::uint32_t(alive.size()))];
        BodyType types[] = {BodyType::fixed, BodyType::kinematic, BodyType::dynamic};
        ASSERT_TRUE(world.setType(body, types[random.below(3)]).ok());
        expectSound(world);
      }
      if (!alive.empty() && random.unit() < 0.1) {
        BodyId body = alive[random.below(std::uint32_t(alive.size()))];
        ASSERT_TRUE(world.setTransform(body, {random.between(-.4, .4), random.between(.2, 1.5), 0}, {}).ok());
        expectSound(world);
      }
      if (random.unit() < 0.05) {
        ASSERT_TRUE(world.restore(world.snapshot()).ok()) << "step " << i;
        expectSound(world);
      }
      stepSound(world);
      ASSERT_FALSE(testing::Test::HasFailure()) << "seed " << seed << " step " << i;
      ASSERT_EQ(world.bodies().size(), alive.size() + 1);
    }
    EXPECT_GT(destroyed, 30);
  }
}

TEST(Lifetime, AWorldCanBeMovedAndDestroyedAtAnyTime) {
  World world = makeWorld();
  addGround(world);
  BodyId box = addBox(world, {0.2, 0.2, 0.2}, {0, 1, 0});
  run(world, 0.2);
  World other = std::move(world);
  run(other, 0.2);
  EXPECT_TRUE(other.isValid(box));
  World third = emptySpace();
  third = std::move(other);
  run(third, 1);
  EXPECT_NEAR(third.state(box)->position.y, 0.2, 2e-3);
}

}  // namespace
}  // namespace brickfall
