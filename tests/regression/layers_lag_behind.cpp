// Boxes that slide on a box that slides went up to a fifth too short, or their lowest too far: all of them were moved
// back as one body, by the mean of how their velocities changed.
#include <array>

#include "support/world_helpers.h"

namespace brickfall {
namespace {

using namespace test;

// Three layers; the lowest, on smooth ground, is pulled from under the others.
TEST(Regression, LayersThatArePulledApartGoAsFarAsTheyMust) {
  const double lower = 0.3, upper = 0.2, seconds = 0.5;  // friction between the layers
  for (int rate : {30, 60, 240}) {
    World world = makeWorld();
    addGround(world, 0);
    const std::array<double, 3> places{0, -0.5, -0.5};
    const std::array<BodyId, 3> layers{
        add(world, bodyOf(boxOf({2, 0.1, 0.5}, 1000, lower), {places[0], 0.1, 0})),
        add(world, bodyOf(boxOf({0.5, 0.1, 0.5}, 1000, lower), {places[1], 0.3, 0})),
        add(world, bodyOf(boxOf({0.3, 0.1, 0.5}, 1000, upper * upper / lower), {places[2], 0.5, 0}))};
    std::array<double, 3> m{};
    for (std::size_t i = 0; i < 3; i++) m[i] = world.state(layers[i])->mass;
    const double pull = 12 * m[0], below = lower * (m[1] + m[2]) * kG, above = upper * m[2] * kG;
    for (int i = 0; i < int(seconds * rate); i++) {
      ASSERT_TRUE(world.applyForce(layers[0], {pull, 0, 0}).ok());
      stepSound(world, 1.0 / rate);
    }
    const std::array<double, 3> forces{pull - below, below - above, above};
    for (std::size_t i = 0; i < 3; i++) {
      const double way = 0.5 * forces[i] / m[i] * seconds * seconds;
      EXPECT_NEAR(world.state(layers[i])->position.x - places[i], way, 0.006 * way)
          << "layer " << i << " at 1/" << rate;
    }
  }
}

// A block that is shot onto a plank on smooth ground slides until both go alike.
TEST(Regression, BlockSlidesAlongAPlankAsFarAsItMust) {
  const double friction = 0.4, speed = 3;
  for (int rate : {30, 60, 240}) {
    World world = makeWorld();
    addGround(world, 0);
    const BodyId plank = add(world, bodyOf(boxOf({3, 0.05, 0.5}, 500, friction), {0, 0.05, 0}));
    BodyDef shot = bodyOf(boxOf({0.2, 0.1, 0.2}, 3000, friction), {-2, 0.2, 0});
    shot.linearVelocity = {speed, 0, 0};
    const BodyId block = add(world, shot);
    for (int i = 0; i < 3 * rate / 2; i++) stepSound(world, 1.0 / rate);
    const double share = world.state(block)->mass / world.state(plank)->mass;
    const double way = speed * speed / (2 * friction * kG * (1 + share));
    EXPECT_NEAR(world.state(block)->position.x + 2 - world.state(plank)->position.x, way, 0.002 * way) << "1/" << rate;
  }
}

}  // namespace
}  // namespace brickfall
