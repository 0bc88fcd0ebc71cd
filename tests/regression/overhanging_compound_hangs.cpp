// A post with an arm far outside its foot stayed upright at 0.9 degrees: open points near the ground held every Newton
// step short, and the solve gave up with a residual of two weights.
#include "support/world_helpers.h"

namespace brickfall {
namespace {

using namespace test;

TEST(Regression, OverhangingCompoundTipsOver) {
  // An upside-down L whose arm carries the centre of mass outside the foot.
  World world = makeWorld();
  addGround(world, 1.0);
  BodyDef d;
  ShapeDef post = boxOf({0.05, 0.5, 0.1}), arm = boxOf({0.5, 0.05, 0.1});
  arm.local.position = {0.5, 0.55, 0};
  d.shapes = {post, arm};
  d.position = {0, 0.5, 0};
  BodyId body = add(world, d);
  run(world, 3);
  EXPECT_LT(toMatrix(world.state(body)->rotation).row[1].y, 0.95) << "rests on post and arm after 28 degrees";
}

}  // namespace
}  // namespace brickfall
