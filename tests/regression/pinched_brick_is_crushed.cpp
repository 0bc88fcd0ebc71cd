// A slab that leaned on a brick pressed it to the ground with 330 kN for one step, in slow motion: 47 times its weight. Friction of
// both faces of the brick slid; a direct step stopped where one of the slips turned round, the next one where it turned back, and
// after a hundred of them the solve was as far from balance as at first. What slides now resists by its secant where steps stall.
#include "law/draw.h"

namespace brickfall::law {
namespace {

// N: the largest force between any two.
double largestForce(const World& world) {
  double most = 0;
  world.forEachContact([&](const ContactView& contact) {
    double sum = 0;
    for (int i = 0; i < contact.pointCount; i++) sum += contact.points[i].normalForce;
    most = std::max(most, sum);
  });
  return most;
}

double fastest(const World& world, const std::vector<BodyId>& bodies) {
  double most = 0;
  for (BodyId body : bodies) most = std::max(most, length(world.state(body)->linearVelocity));
  return most;
}

TEST(Regression, PinchedBrickIsCrushed) {
  int left = 0, steps = 0;
  for (int seed = 170; seed < 210; seed++) {
    Draw draw(seed);
    World world = awakeWorld();
    addGround(world, draw.between(0.4, 0.8));
    std::vector<BodyId> bodies;
    const int bricks = 1 + seed % 3;
    for (int i = 0; i < bricks; i++) {
      BodyDef brick = bodyOf(boxOf({0.1075, 0.0325, 0.05125}, 1900, draw.between(0.4, 0.8)),
                             {draw.between(-0.2, 0.2), 0.0325, 0.25 * (i - 0.5 * (bricks - 1))});
      brick.rotation = turn({0, 1, 0}, draw.between(0, 180));
      bodies.push_back(add(world, brick));
    }
    const Vec3 half{draw.between(0.6, 1.2), draw.between(0.03, 0.06), draw.between(0.3, 0.7)};
    BodyDef slab = bodyOf(
        boxOf(half, 2400, draw.between(0.4, 0.8)),
        {draw.between(0, 0.9) * half.x, 0.075 + half.y + draw.between(0, 0.15), draw.between(-0.3, 0.3) * half.z});
    slab.rotation = turn({draw.between(-1, 1), draw.between(-0.2, 0.2), draw.between(-1, 1)}, draw.between(0, 6));
    bodies.push_back(add(world, slab));
    const double weight = kG * world.state(bodies.back())->mass, dt = seed % 2 ? 1.0 / 60 : 1.0 / 240;
    while (world.time() < 1.5) {
      const bool slow = fastest(world, bodies) < 0.1;
      stepSound(world, dt);
      if (!slow || fastest(world, bodies) > 0.1) continue;
      steps++;
      left += largestForce(world) > 10 * weight;
    }
  }
  EXPECT_GT(steps, 5000);
  EXPECT_EQ(left, 0) << "of " << steps << " steps";
}

}  // namespace
}  // namespace brickfall::law
