// A corbel of nineteen bricks, each shifted by 1 % more than it bears, stood: in some steps the search along a direct step
// ended after sixteen evaluations, far from its minimum, and what was left of the topple was stopped as a vibration.
#include "law/draw.h"

namespace brickfall::law {
namespace {

TEST(Regression, CorbelPastItsBalanceStands) {
  constexpr int kBricks = 19;
  for (double size : {0.873, 2.16}) {  // m, length of a brick
    LabSetup setup;
    setup.dt = 1.0 / 480;
    setup.turned = turn({1, 2, 3}, 77);
    Lab lab(setup);
    lab.add(bodyOf(boxOf({5 * size, size, 5 * size}, 1000, 1), {-5 * size, -size, 0}, BodyType::fixed));
    BodyId top;
    Vec3 start;
    for (int k = 0; k < kBricks; k++) {
      start = {-.75 * size + k * 1.01 * size / kBricks, .3 * size * (k + .5), 0};
      top = lab.add(bodyOf(boxOf({.5 * size, .15 * size, .2 * size}, 1000, 1), start));
    }
    const double most = 3 * std::sqrt(size / 0.1);  // s
    while (lab.world.time() < most && length(lab.state(top).position - start) < .02 * size && lab.step()) {
    }
    EXPECT_LT(lab.world.time(), most) << "bricks of " << size << " m";
  }
}

}  // namespace
}  // namespace brickfall::law
