// A column of bricks that leaned past its balance stayed up, the surer the shorter the step: the direct solve jumped to and fro over
// the points that open at its foot, ended far from balance, and threw it back. Made leaning, it began by turning back:
// between any two bricks friction held one brick's weight's worth in the first step, and the column sheared.
#include "law/law.h"

namespace brickfall {
namespace {

using namespace law;

// Time of a rigid block of this depth and height on its edge, under gravity that leans by `lean`, to turn from 0 to `end` (rad).
double rigidTime(double depth, double height, double lean, double end) {
  const double radius = 0.5 * std::hypot(depth, height), balance = std::atan2(depth, height);
  const double step = 1e-5;
  double angle = 0, spin = 0, time = 0;
  for (; angle < end; time += step) {
    spin += step * kG * std::sin(angle + lean - balance) / (4 * radius / 3);
    angle += step * spin;
  }
  return time;
}

// A column of blocks on the ground, turned about the edge of its foot by `lean`, or upright under gravity that is.
struct Column {
  Column(int count, Vec3 half, double lean, bool turned, double dt)
      : height(2 * half.y * count), depth(2 * half.z), step(dt) {
    addGround(world, 0.65);
    const Quat turn = turned ? quatFromAxisAngle({1, 0, 0}, lean) : Quat{};
    EXPECT_TRUE(world.setGravity(turned ? Vec3{0, -kG, 0} : Vec3{0, -std::cos(lean), std::sin(lean)} * kG).ok());
    for (int i = 0; i < count; i++) {
      BodyDef def = bodyOf(boxOf(half, 1900, 0.65), edge() + rotate(turn, Vec3{0, half.y * (2 * i + 1), 0} - edge()));
      def.rotation = turn;
      blocks.push_back(add(world, def));
    }
    start = angle();
  }
  Vec3 edge() const { return {0, 0, 0.5 * depth}; }
  double angle() const {
    const Vec3 at = world.state(blocks.back())->position - edge();
    return std::atan2(at.z, at.y);
  }
  // s, until it has turned by `end`; `most` if it has not by then.
  double timeTo(double end, double most) {
    while (angle() - start < end && world.time() < most) stepSound(world, step);
    return world.time();
  }
  World world = awakeWorld();
  double height, depth, step, start = 0;
  std::vector<BodyId> blocks;
};

TEST(Regression, LeaningColumnStaysUp) {
  const Vec3 brick{0.1075, 0.0325, 0.05125};
  for (int count : {18, 24})
    for (double dt : {1.0 / 60, 1.0 / 120, 1.0 / 240}) {
      const double lean = 1.05 * std::atan2(2 * brick.z, 2 * brick.y * count), end = 25 * kPi / 180;
      const double right = rigidTime(2 * brick.z, 2 * brick.y * count, lean, end);
      Column column(count, brick, lean, false, dt);
      EXPECT_NEAR(column.timeTo(end, 2 * right), right, 0.1 * right) << count << " bricks, 1/" << 1 / dt;
    }
}

TEST(Regression, LeaningColumnTurnsBackFirst) {
  for (int count : {10, 12, 16})
    for (double dt : {1.0 / 60, 1.0 / 120}) {
      const Vec3 half{0.1075, 0.325 / count, 0.05125};
      const double balance = std::atan2(half.z, 0.325), lean = 1.1 * balance, end = 40 * kPi / 180 - lean;
      const double right = rigidTime(2 * half.z, 0.65, lean, end);
      Column column(count, half, lean, true, dt);
      stepSound(column.world, dt);
      EXPECT_GT(column.angle(), column.start - 1e-3) << count << " blocks, 1/" << 1 / dt;
      EXPECT_NEAR(column.timeTo(end, 2 * right), right, 0.05 * right) << count << " blocks, 1/" << 1 / dt;
    }
}

}  // namespace
}  // namespace brickfall
