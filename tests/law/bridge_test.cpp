// Bridges of boards on hinges: they come to rest, alone and under a load, and bear a blow.
#include <algorithm>
#include <utility>

#include "law/joint_parts.h"
#include "law/law.h"

namespace brickfall::law {
namespace {

// Twenty tight boards.
struct Bridge {
  static constexpr double kBoards = 20, kStep = 0.3, kSpan = kBoards * kStep;
  Quat turned;
  World world = turnedWorld(turned);
  std::vector<BodyId> boards;
  std::vector<JointId> hinges;
  double length = 0;  // m

  static double height(double x) {
    const double sag = std::sqrt(3 * kSpan * kSpan * 0.03 / 8);
    return 5 - 4 * sag * (x / kSpan) * (1 - x / kSpan);
  }
  BodyId put(const BodyDef& def) { return addTurned(world, turned, def); }
  explicit Bridge(Quat turn = {}) : turned(turn) {
    BodyId last = put(bodyOf(boxOf({0.2, 0.2, 0.6}), {-0.21, 5, 0}, BodyType::fixed));
    Vec3 at0{0, height(0), 0};
    auto tie = [&](BodyId next) {
      hinges.push_back(join(world, turnedBy(turned, at(JointType::revolute, at0)), last, next));
      last = next;
    };
    for (int i = 0; i < kBoards; i++) {
      double low = at0.x, high = at0.x + kStep;
      for (int k = 0; k < 50; k++) {
        const double middle = 0.5 * (low + high);
        (brickfall::length(Vec3{middle, height(middle), 0} - at0) < kStep ? low : high) = middle;
      }
      const Vec3 at1{high, height(high), 0}, along = at1 - at0;
      BodyDef def = bodyOf(boxOf({0.5 * kStep - 0.01, 0.02, 0.5}, 600), (at0 + at1) * 0.5);
      def.rotation = quatFromAxisAngle({0, 0, 1}, std::atan2(along.y, along.x));
      boards.push_back(put(def));
      tie(boards.back());
      at0 = at1;
    }
    tie(put(bodyOf(boxOf({0.2, 0.2, 0.6}), at0 + Vec3{0.25, 0, 0}, BodyType::fixed)));
    length = at0.x;
  }
};

TEST(Law, Row30vABridgeComesToRest) {
  for (auto [dt, turned] : {std::pair{1.0 / 60, Quat{}}, {1.0 / 240, Quat{}}, {1.0 / 240, askew()}}) {
    Bridge bridge(turned);
    auto awake = [&] {
      return std::any_of(bridge.boards.begin(), bridge.boards.end(),
                         [&](BodyId board) { return bridge.world.state(board)->awake; });
    };
    double time = 0;
    for (; time < 20 && awake(); time += dt) ASSERT_TRUE(bridge.world.step(dt).ok());
    atMost("twenty boards, made as a parabola" + orAskew(turned) + ": at rest after", dt, time, 6, "s");
  }
}

// 500 kg lie on the twenty boards. Hinges without friction swing on, and nothing feeds them; hinges that rub come to rest.
TEST(Law, Row30vABridgeUnderALoadRestsWhereItsHingesRub) {
  const double dt = 1.0 / 120;
  Bridge bridge;
  World& world = bridge.world;
  for (JointId hinge : bridge.hinges) ASSERT_TRUE(world.setMotor(hinge, JointDef::Motor{0, 5}).ok());
  const double side = 0.3, height = bridge.height(0.5 * bridge.length);
  const BodyId box = add(world, bodyOf(boxOf({side, 0.25, side}, 500 / (8 * side * side * 0.25)),
                                       {0.5 * bridge.length, height + 0.37, 0}));
  double time = 0;
  for (; time < 15 && world.state(box)->awake; time += dt) ASSERT_TRUE(world.step(dt).ok());
  atMost("a bridge under 500 kg, hinges that rub with 5 N m: at rest after", dt, time, 12, "s");
}

// 500 kg fall on them from 0.1 m.
TEST(Law, Row30lABridgeOfTightBoardsBearsABlow) {
  for (Quat turned : {Quat{}, askew()}) {
    Bridge bridge(turned);
    World& world = bridge.world;
    const double radius = 0.3, height = bridge.height(0.5 * bridge.length);
    const BodyId ball = bridge.put(bodyOf(sphereOf(radius, 500 / (4.0 / 3 * kPi * radius * radius * radius)),
                                          {0.5 * bridge.length, height + radius + 0.1, 0}));
    const double start = energyOf(world), fall = 500 * kG * 0.1;
    double gape = 0, rise = 0;
    for (int i = 0; i < 120; i++) {
      ASSERT_TRUE(world.step(kDt).ok());
      for (JointId hinge : bridge.hinges) gape = std::max(gape, world.state(hinge)->error);
      rise = std::max(rise, energyOf(world) - start);
    }
    expectSound(world);
    atMost("error of a hinge under the blow" + orAskew(turned), kDt, 1e3 * gape, 1, "mm");
    atMost("gain of energy, of that of the fall" + orAskew(turned), kDt, 100 * rise / fall, 1, "%");
    EXPECT_GT(rotate(conjugate(turned), world.state(ball)->centreOfMass).y, height - 0.5);
  }
}

// A hundred boards of 7 kg, made as a parabola hangs, bear 500 kg that fall on them from 0.1 m.
TEST(Law, Row30qALongBridgeBearsABlow) {
  for (Quat turned : {Quat{}, askew()}) {
    World world = turnedWorld(turned);
    const int boards = 100;
    const double step = 0.2, span = 0.98 * boards * step, sag = std::sqrt(3 * span * span * 0.02 / 8);
    auto height = [&](double x) { return 5 - 4 * sag * (x / span) * (1 - x / span); };
    BodyId last = addTurned(world, turned, bodyOf(boxOf({0.1, 0.1, 0.6}), {-0.11, 5, 0}, BodyType::fixed));
    std::vector<JointId> hinges;
    Vec3 from{0, 5, 0};
    auto tie = [&](BodyId next) {
      hinges.push_back(join(world, turnedBy(turned, at(JointType::revolute, from)), last, next));
      last = next;
    };
    for (int i = 0; i < boards; i++) {
      double low = from.x, high = from.x + step;
      for (int k = 0; k < 50; k++) {
        const double middle = 0.5 * (low + high);
        (length(Vec3{middle, height(middle), 0} - from) < step ? low : high) = middle;
      }
      const Vec3 to{high, height(high), 0}, along = to - from;
      BodyDef def = bodyOf(boxOf({0.09, 0.01, 0.5}, 7 / (0.18 * 0.02)), (from + to) * 0.5);
      def.rotation = quatFromAxisAngle({0, 0, 1}, std::atan2(along.y, along.x));
      tie(addTurned(world, turned, def));
      from = to;
    }
    tie(addTurned(world, turned, bodyOf(boxOf({0.1, 0.1, 0.6}), from + Vec3{0.11, 0, 0}, BodyType::fixed)));
    const double radius = 0.25, middle = 0.5 * from.x;
    addTurned(world, turned,
              bodyOf(sphereOf(radius, 500 / (4.0 / 3 * kPi * radius * radius * radius)),
                     {middle, height(middle) + radius + 0.11, 0}));
    const double start = energyOf(world), fall = 500 * kG * 0.1;
    double gape = 0, rise = 0;
    for (int i = 0; i < 60; i++) {
      ASSERT_TRUE(world.step(kDt).ok());
      for (JointId hinge : hinges) gape = std::max(gape, world.state(hinge)->error);
      rise = std::max(rise, energyOf(world) - start);
    }
    expectSound(world);
    atMost("error of a hinge of a hundred boards under the blow" + orAskew(turned), kDt, 1e3 * gape, 0.5, "mm");
    atMost("gain of energy, of that of the fall" + orAskew(turned), kDt, 100 * rise / fall, 1, "%");
  }
}

// Four hundred boards that hang by their rim, made flat: their net goes tight within some steps, and joints that gape by hundredths
// of a millimetre could close only by lifting all of it.
TEST(Law, Row30lANetThatGoesTightGainsNothing) {
  const int side = 20;
  const double step = 0.2;
  World world = makeWorld();
  auto place = [&](int i, int k) { return Vec3{step * (i - 0.5 * (side - 1)), 5, step * (k - 0.5 * (side - 1))}; };
  std::vector<BodyId> boards;
  std::vector<JointId> joints;
  auto tie = [&](Vec3 anchor, BodyId a, BodyId b) {
    joints.push_back(join(world, at(JointType::spherical, anchor), a, b));
  };
  for (int i = 0; i < side; i++)
    for (int k = 0; k < side; k++) {
      const BodyId board =
          boards.emplace_back(add(world, bodyOf(boxOf({0.45 * step, 0.01, 0.45 * step}, 600), place(i, k))));
      auto hang = [&](Vec3 out) {
        const Vec3 edge = place(i, k) + out * (0.5 * step);
        tie(edge, add(world, bodyOf(boxOf({0.02, 0.02, 0.02}), edge + out * 0.03, BodyType::fixed)), board);
      };
      if (i > 0) tie((place(i, k) + place(i - 1, k)) * 0.5, boards[std::size_t((i - 1) * side + k)], board);
      if (k > 0) tie((place(i, k) + place(i, k - 1)) * 0.5, boards[std::size_t(i * side + k - 1)], board);
      if (i == 0 || i == side - 1) hang({i == 0 ? -1.0 : 1.0, 0, 0});
      if (k == 0 || k == side - 1) hang({0, 0, k == 0 ? -1.0 : 1.0});
    }
  double last = energyOf(world), gain = 0, gape = 0, fell = 0;
  for (int i = 0; i < 60; i++) {
    ASSERT_TRUE(world.step(kDt).ok());
    for (JointId joint : joints) gape = std::max(gape, world.state(joint)->error);
    const double now = energyOf(world);
    gain = std::max(gain, now - last), last = now;
    fell = std::max(fell, world.energy().kinetic);
  }
  expectSound(world);
  EXPECT_GT(fell, 1);
  atMost("a net of 840 joints: gained in a step", kDt, 1e6 * gain / fell, 1, "millionths of what moves");
  atMost("a net of 840 joints: gape", kDt, 1e3 * gape, 0.1, "mm");
}

}  // namespace
}  // namespace brickfall::law
