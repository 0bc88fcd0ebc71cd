// A column of drums on a slope that is less steep than it needs to fall crept down or fell. Of the many corners of a drum's foot four
// are points; which ones was decided without the load that they carry, and not again before the drum had tipped by half a milliradian.
#include "support/world_helpers.h"

namespace brickfall {
namespace {

using namespace test;

constexpr int kDrums = 9;
constexpr double kDrumRadius = 0.3, kDrumHeight = 0.3;

ShapeDef drum(int sides) {
  ShapeDef shape = boxOf({}, 1900, 0.8);
  shape.type = ShapeType::hull;
  for (int i = 0; i < sides; i++)
    for (double y : {-kDrumHeight / 2, kDrumHeight / 2}) {
      const double angle = 2 * kPi * (i + 0.5) / sides;
      shape.vertices.push_back({kDrumRadius * std::sin(angle), y, kDrumRadius * std::cos(angle)});
    }
  return shape;
}

// A column on a plane that falls away towards `direction` (rad, about the vertical), by `share` of the tilt at which its middle is above
// the edge of its foot.
struct DrumColumn {
  DrumColumn(int sides, double share, double direction) {
    const double side = 2 * kPi / sides,
                 off = direction - side * std::round(direction / side);  // from the middle of a side
    const double edge = kDrumRadius * std::cos(side / 2) / std::cos(off);
    const double tilt = share * std::atan2(edge, kDrums * kDrumHeight / 2);
    const Quat turned = quatFromAxisAngle({std::cos(direction), 0, -std::sin(direction)}, tilt);
    BodyDef slope = bodyOf(planeOf(0.8), {}, BodyType::fixed);
    slope.rotation = turned;
    add(world, slope);
    for (int i = 0; i < kDrums; i++) {
      start = rotate(turned, Vec3{0, kDrumHeight * (i + 0.5), 0});
      BodyDef def = bodyOf(drum(sides), start);
      def.rotation = turned;
      top = add(world, def);
    }
  }
  double moved() const { return length(world.state(top)->position - start); }

  World world = awakeWorld();
  BodyId top;
  Vec3 start;
};

const double kDrumSteps[] = {1.0 / 60, 1.0 / 120, 1.0 / 240};

TEST(Regression, ColumnOfDrumsCreeps) {
  struct Case {
    int sides;
    double share;
  };
  for (Case c : {Case{20, 0.95}, {6, 0.985}, {12, 0.97}})
    for (double direction : {0.0, 0.1, 0.26})
      for (double dt : kDrumSteps) {
        DrumColumn column(c.sides, c.share, direction);
        StepReport last;
        for (int step = 0; step < 4 / dt; step++) last = column.world.step(dt).value();
        EXPECT_LT(column.moved(), 1e-3) << c.sides << " sides, towards " << direction << ", 1/" << 1 / dt << " s";
        EXPECT_EQ(last.restingIslands, last.islands) << c.sides << " sides, towards " << direction << ", 1/" << 1 / dt;
      }
}

TEST(Regression, ColumnOfDrumsTooSteepFalls) {
  for (int sides : {6, 20})
    for (double dt : kDrumSteps) {
      DrumColumn column(sides, 1.02, 0.1);
      run(column.world, 4, dt);
      EXPECT_GT(column.moved(), 1) << sides << " sides, 1/" << 1 / dt << " s";
    }
}

}  // namespace
}  // namespace brickfall
