// A column of small bricks at a long step: its springs give by more than a part of a brick in the first step. The fit of
// what ends aside took that for bodies that had ended in each other, and pushed the column apart: 9 of 16 fell.
#include "law/draw.h"

namespace brickfall::law {
namespace {

TEST(Regression, SlenderColumnOfSmallBricksFalls) {
  const double size = 0.0146, halfHeight = size / 4;
  for (int i = 0; i < 4; i++) {
    Draw draw(i + 999);
    LabSetup setup;
    setup.dt = 1.0 / 30;
    setup.turned = turn(draw.direction(), draw.between(0, 180));
    Lab lab(setup);
    lab.addGround(.6);
    BodyId top;
    for (int k = 0; k < 25; k++) {
      BodyDef def = bodyOf(
          draw.oneIn(3) ? drumOf(size * .45, halfHeight, 1900, .6) : boxOf({size / 2, halfHeight, size * .4}, 1900),
          {0, (2 * k + 1) * halfHeight, 0});
      top = lab.add(def);
    }
    lab.run(3);
    const Vec3 place = lab.state(top).position;
    EXPECT_LT(std::hypot(place.x, place.z), 0.1 * size) << setup.text();
  }
}

}  // namespace
}  // namespace brickfall::law
