// Contacts kept the stiffness of the time step they were born at: after a change to a longer step they were up to 64 times
// too stiff for it, and a wall that was hit then fell apart in another way.
#include "support/lab_measure.h"
#include "support/world_helpers.h"

namespace brickfall {
namespace {

using namespace test;

TEST(Regression, WallForgetsTheTimeStepsOfThePast) {
  double sag[2];
  for (int n = 0; n < 2; n++) {
    lab::Scene s = lab::make("w10");
    if (n == 1) run(s.world, 0.5, 1.0 / 480);
    run(s.world, 1, 1.0 / 60);
    sag[n] = 0;
    for (std::size_t i = 0; i < s.boxes.size(); i++) sag[n] = std::max(sag[n], lab::boxMove(s, i));
  }
  EXPECT_NEAR(sag[1], sag[0], 0.05 * sag[0]);
}

}  // namespace
}  // namespace brickfall
