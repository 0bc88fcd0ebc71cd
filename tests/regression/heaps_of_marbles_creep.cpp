// Marbles in a jar and cans in a bin never came to rest: they went on to sink by a tenth of a millimetre in a second. What rolls touches
// at another place in each step, and its friction began anew there without the way that it had given: it gave a little more.
#include <algorithm>

#include "support/lab_scenes.h"
#include "support/world_helpers.h"

namespace brickfall {
namespace {

using namespace test;

// An open box, 2 `half` wide inside.
World jarOf(double half) {
  World world = awakeWorld();
  auto wall = [&](Vec3 size, Vec3 place) { add(world, bodyOf(boxOf(size), place, BodyType::fixed)); };
  wall({2 * half, 0.1 * half, 2 * half}, {0, -0.1 * half, 0});
  for (int side : {-1, 1}) {
    wall({0.1 * half, 6 * half, 2 * half}, {side * 1.1 * half, 5.9 * half, 0});
    wall({2 * half, 6 * half, 0.1 * half}, {0, 5.9 * half, side * 1.1 * half});
  }
  return world;
}

// `layers` layers of `count` by `count`, a little out of place and each turned somehow.
void fill(World& world, const ShapeDef& shape, int count, int layers, double pitch, int seed) {
  lab::LabRandom random(seed);
  auto part = [&] { return random.unit() - 0.5; };
  for (int layer = 0; layer < layers; layer++)
    for (int i = 0; i < count; i++)
      for (int j = 0; j < count; j++) {
        const Vec3 place{i - 0.5 * (count - 1), 1.2 * layer + 0.9, j - 0.5 * (count - 1)};
        BodyDef body = bodyOf(shape, (place + Vec3{part(), part(), part()} * 0.1) * pitch);
        body.rotation = normalized(Quat{part(), part(), part(), part()});
        add(world, body);
      }
}

// m: that half of the bodies moved by no more than in the last half second. (A loose one may roll on.)
double creepOf(World& world, double seconds, double dt) {
  run(world, seconds - 0.5, dt);
  std::vector<std::pair<BodyId, Vec3>> before;
  for (BodyId body : world.bodies())
    if (world.state(body)->type == BodyType::dynamic) before.emplace_back(body, world.state(body)->position);
  run(world, 0.5, dt);
  std::vector<double> moved;
  for (const auto& [body, place] : before) moved.push_back(length(world.state(body)->position - place));
  std::nth_element(moved.begin(), moved.begin() + moved.size() / 2, moved.end());
  return moved[moved.size() / 2];
}

constexpr double kStill = 1e-7;  // m

TEST(Regression, HeapsOfMarblesCreep) {
  ShapeDef marble = sphereOf(0.01, 2500, 0.3);
  marble.material.restitution = 0.5;
  for (double dt : {1.0 / 60, 1.0 / 120})
    for (int seed : {1, 2}) {
      World world = jarOf(0.05);
      fill(world, marble, 4, 4, 0.0225, seed);
      EXPECT_LT(creepOf(world, 3, dt), kStill) << "marbles, seed " << seed << " at " << dt << " s";
    }
}

TEST(Regression, HeapsOfCansCreep) {
  for (int seed : {1, 2}) {
    World world = jarOf(0.3);
    fill(world, cylinderOf(0.033, 0.0575, 700, 0.4), 4, 3, 0.14, seed);
    EXPECT_LT(creepOf(world, 6, 1.0 / 60), kStill) << "cans, seed " << seed;
  }
}

}  // namespace
}  // namespace brickfall
