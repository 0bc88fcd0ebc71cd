// Boxes of all sizes that were dropped into a pit never came to rest. Where more than four corners of a pair touch, four were chosen
// anew in each step: a point that carried was dropped for another corner that was a micrometre deeper, its body fell for a step,
// was caught, and shook its neighbours.
#include "support/lab_scenes.h"
#include "support/world_helpers.h"

namespace brickfall {
namespace {

using namespace test;

// Sides of 0.1 to 0.4 m, ten layers of five by five.
World pitOfBoxes(int seed) {
  constexpr double kHalfPit = 1.22, kPitch = 0.46;
  World world = awakeWorld();
  addGround(world);
  for (int side : {-1, 1}) {
    add(world, bodyOf(boxOf({0.2, 5, kHalfPit + 0.4}), {side * (kHalfPit + 0.2), 5, 0}, BodyType::fixed));
    add(world, bodyOf(boxOf({kHalfPit + 0.4, 5, 0.2}), {0, 5, side * (kHalfPit + 0.2)}, BodyType::fixed));
  }
  lab::LabRandom random(seed);
  auto half = [&] { return 0.05 + 0.15 * random.unit(); };
  auto part = [&] { return random.unit() - 0.5; };
  for (int layer = 0; layer < 10; layer++)
    for (int i = -2; i <= 2; i++)
      for (int j = -2; j <= 2; j++) {
        const Vec3 size{half(), half(), half()};
        BodyDef box = bodyOf(boxOf(size, 1900), {i * kPitch, 0.4 + 0.5 * layer, j * kPitch});
        box.rotation = normalized(Quat{part(), part(), part(), part()});
        add(world, box);
      }
  return world;
}

TEST(Regression, HeapOfBoxesNeverRests) {
  for (int seed : {3, 4}) {
    World world = pitOfBoxes(seed);
    StepReport last;
    for (int step = 0; step < 7 / kDt; step++) {
      Result<StepReport> report = world.step(kDt);
      ASSERT_TRUE(report.ok() && report->quarantined.empty());
      last = *report;
    }
    EXPECT_EQ(last.restingIslands, last.islands) << "seed " << seed << ", " << last.solveVisits << " visits";
  }
}

}  // namespace
}  // namespace brickfall
