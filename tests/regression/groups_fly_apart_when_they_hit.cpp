// Two blocks of bricks, flush, that meet in flight: the forces between bricks beside each other had faded to 1e-23 N, whose cube is none in
// floats; the matrix of the direct solve was NaN, and the blocks flew apart with up to 77 times their energy, or as if e were 1.
#include "law/law.h"

namespace brickfall {
namespace {

using namespace law;

TEST(Regression, GroupsFlyApartWhenTheyHit) {
  const Vec3 half{0.1075, 0.0325, 0.05125};
  for (int side : {2, 3})
    for (double speed : {1.3, 3.0})
      for (double dt : {1.0 / 60, 1.0 / 240, 1.0 / 480})
        for (int shot = 0; shot < 12; shot++) {
          const double gap = 0.05 + 0.01285 * shot;
          World world = emptySpace();
          std::vector<BodyId> bricks;
          for (int i = 0; i < side * side; i++)
            for (int block : {0, 1}) {
              BodyDef brick = bodyOf(boxOf(half, 1900, 0.65),
                                     {block ? 0 : -0.215 - gap, 0.0325 + (i / side) * 0.065, (i % side) * 0.1025});
              brick.shapes[0].material.restitution = 0.1;
              brick.linearVelocity = {block ? 0 : speed, 0, 0};
              bricks.push_back(add(world, brick));
            }
          run(world, gap / speed + 0.1, dt);
          Vec3 mean[2];
          double slowest = 1e9, fastest = 0;
          for (std::size_t i = 0; i < bricks.size(); i++) {
            const Vec3 v = world.state(bricks[i])->linearVelocity;
            mean[i % 2] += v * (2.0 / double(bricks.size()));
            slowest = std::min(slowest, v.x), fastest = std::max(fastest, v.x);
          }
          const std::string name = std::to_string(2 * side * side) + " bricks, " + text(speed, 1) + " m/s, 1/" +
                                   text(1 / dt, 0) + " s, from " + text(gap, 4) + " m";
          const double part = (mean[1].x - mean[0].x) / speed;
          ASSERT_GT(part, 0) << name;
          ASSERT_LT(part, 0.12) << name << ": e is 0.1";
          EXPECT_LT(fastest - slowest, 0.2 * speed) << name;
        }
}

}  // namespace
}  // namespace brickfall
