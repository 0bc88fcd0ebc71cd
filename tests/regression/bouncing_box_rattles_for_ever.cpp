// Boxes and rods that were dropped, of restitution 0.7, rattled for ever at 1/60 s: one in four rocked from edge to edge in each step, by
// a quarter of a millimetre. Where a rebound lifted it off one edge and it turned back within the rest of the step, that was taken for
// the end of a slide.
#include "support/lab_scenes.h"
#include "support/world_helpers.h"

namespace brickfall {
namespace {

using namespace test;

void expectAllRest(const ShapeDef& dropped, double height, double seconds, double dt, const char* name) {
  World world = awakeWorld();
  addGround(world);
  lab::LabRandom random(1);
  auto part = [&] { return random.unit() - 0.5; };
  constexpr int kSide = 6;
  std::vector<BodyId> bodies;
  for (int i = 0; i < kSide * kSide; i++) {
    BodyDef body = bodyOf(dropped, {3.0 * (i % kSide), height, 3.0 * (i / kSide)});
    body.shapes[0].material.restitution = 0.7f;
    body.rotation = normalized(Quat{part(), part(), part(), part()});
    bodies.push_back(add(world, body));
  }
  run(world, seconds, dt);
  const StepReport last = stepSound(world, dt);
  EXPECT_EQ(last.impacts, 0) << name << " at " << dt << " s";
  int moving = 0;
  for (BodyId body : bodies) moving += world.state(body)->linearVelocity != Vec3{};
  EXPECT_EQ(moving, 0) << name << " at " << dt << " s";
}

TEST(Regression, BouncingBoxRattlesForEver) {
  for (double dt : {1.0 / 30, 1.0 / 60, 1.0 / 240}) {
    expectAllRest(boxOf({0.15, 0.1, 0.05}, 600, 0.5), 1.5, 7, dt, "boxes");
    expectAllRest(boxOf({0.1, 0.1, 0.1}, 600, 0.5), 1.5, 7, dt, "cubes");
  }
}

// What rolls may go on.
TEST(Regression, BouncingRodRattlesForEver) {
  World world = awakeWorld();
  addGround(world, 0.5);
  BodyDef rod = bodyOf(cylinderOf(0.02, 0.05, 600, 0.5), {0, 0.5, 0});
  rod.shapes[0].material.restitution = 0.8f;
  lab::LabRandom random(1);
  auto part = [&] { return random.unit() - 0.5; };
  for (int i = 0; i < 36; i++) {
    rod.position.x = 2.0 * i;
    rod.rotation = normalized(Quat{part(), part(), part(), part()});
    add(world, rod);
  }
  run(world, 7, 1.0 / 60);
  EXPECT_EQ(stepSound(world, 1.0 / 60).impacts, 0);
}

}  // namespace
}  // namespace brickfall
