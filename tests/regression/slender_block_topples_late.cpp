// A block of 86 mm whose speed grows by half in each step of 1/30 s as it topples: only what it gained last was asked whether the
// same forces go on, so every second step was of first order, and it came to 60 degrees a tenth too late.
#include "law/draw.h"
#include "law/reference.h"

namespace brickfall::law {
namespace {

TEST(Regression, SlenderBlockTopplesLate) {
  for (double width : {.0168, .0265}) {
    const double height = .09, start = 1.1 * std::atan(width / height), target = kPi / 3;
    LabSetup setup;
    setup.dt = 1.0 / 30;
    Lab lab(setup);
    lab.addGround(2);
    BodyDef d = bodyOf(boxOf({width / 2, height / 2, width}, 1900, 2), {});
    d.rotation = turn({0, 0, 1}, -start * 180 / kPi);
    d.position = -rotate(d.rotation, Vec3{width / 2, -height / 2, 0});
    const BodyId block = lab.add(d);
    RockingBlock exact(height, width, start);
    while (exact.tilt < target) exact.advance(1e-4);
    double before = start, now = start;
    while (now < target && lab.world.time() < 1 && lab.step()) {
      before = now;
      now = -rotationVector(lab.state(block).rotation).z;
    }
    const double found = lab.world.time() - setup.dt * (now - target) / (now - before);
    EXPECT_NEAR(found / exact.time, 1, .03) << width;
  }
}

}  // namespace
}  // namespace brickfall::law
