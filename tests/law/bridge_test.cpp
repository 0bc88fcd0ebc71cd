// Bridges of boards on hinges: they come to rest, alone and under a load, and bear a blow.
#include <algorithm>
#include <utility>

#include "law/joint_parts.h"
#include "law/law.h"

namespace brickfall::law {
namespace {

// Boards in a row between two abutments, made as a parabola hangs.
struct BridgeForm {
  int boards;
  double step, span, slack;  // m: of each board; of all together; of the span, by which they are longer
  ShapeDef board, abutment;
  double before, behind;  // m, from the ends to the middles of the abutments
};
// Twenty that are tight.
BridgeForm tightBoards() {
  constexpr double kStep = 0.3;
  const ShapeDef abutment = boxOf({0.2, 0.2, 0.6});
  return {20, kStep, 20 * kStep, 0.03, boxOf({0.5 * kStep - 0.01, 0.02, 0.5}, 600), abutment, 0.21, 0.25};
}
// A hundred of 7 kg.
BridgeForm longRow() {
  constexpr double kStep = 0.2;
  const ShapeDef abutment = boxOf({0.1, 0.1, 0.6});
  return {100, kStep, 0.98 * 100 * kStep, 0.02, boxOf({0.09, 0.01, 0.5}, 7 / (0.18 * 0.02)), abutment, 0.11, 0.11};
}

struct Bridge {
  BridgeForm form;
  Quat turned;
  World world = turnedWorld(turned);
  std::vector<BodyId> boards;
  std::vector<JointId> hinges;
  double length = 0;  // m

  double height(double x) const {
    const double sag = std::sqrt(3 * form.span * form.span * form.slack / 8);
    return 5 - 4 * sag * (x / form.span) * (1 - x / form.span);
  }
  BodyId put(const BodyDef& def) { return addTurned(world, turned, def); }
  explicit Bridge(Quat turn = {}, const BridgeForm& of = tightBoards()) : form(of), turned(turn) {
    BodyId last = put(bodyOf(form.abutment, {-form.before, 5, 0}, BodyType::fixed));
    Vec3 at0{0, height(0), 0};
    auto tie = [&](BodyId next) {
      hinges.push_back(join(world, turnedBy(turned, at(JointType::revolute, at0)), last, next));
      last = next;
    };
    for (int i = 0; i < form.boards; i++) {
      double low = at0.x, high = at0.x + form.step;
      for (int k = 0; k < 50; k++) {
        const double middle = 0.5 * (low + high);
        (brickfall::length(Vec3{middle, height(middle), 0} - at0) < form.step ? low : high) = middle;
      }
      const Vec3 at1{high, height(high), 0}, along = at1 - at0;
      BodyDef def = bodyOf(form.board, (at0 + at1) * 0.5);
      def.rotation = quatFromAxisAngle({0, 0, 1}, std::atan2(along.y, along.x));
      boards.push_back(put(def));
      tie(boards.back());
      at0 = at1;
    }
    tie(put(bodyOf(form.abutment, at0 + Vec3{form.behind, 0, 0}, BodyType::fixed)));
    length = at0.x;
  }

  // A ball of 500 kg in its middle, its lowest point `above` it.
  BodyId drop(double radius, double above) {
    const double x = 0.5 * length, density = 500 / (4.0 / 3 * kPi * radius * radius * radius);
    return put(bodyOf(sphereOf(radius, density), {x, height(x) + radius + above, 0}));
  }
  struct Blow {
    double gape = 0, rise = 0;  // m: largest error of a hinge; J: most energy above that of the start
  };
  Blow bear(int steps) {
    const double start = energyOf(world);
    Blow out;
    for (int i = 0; i < steps; i++) {
      EXPECT_TRUE(world.step(kDt).ok());
      for (JointId hinge : hinges) out.gape = std::max(out.gape, world.state(hinge)->error);
      out.rise = std::max(out.rise, energyOf(world) - start);
    }
    expectSound(world);
    return out;
  }
};
constexpr double kFall = 500 * kG * 0.1;  // J, of the ball

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
    const BodyId ball = bridge.drop(0.3, 0.1);
    const Bridge::Blow blow = bridge.bear(120);
    atMost("error of a hinge under the blow" + orAskew(turned), kDt, 1e3 * blow.gape, 1, "mm");
    atMost("gain of energy, of that of the fall" + orAskew(turned), kDt, 100 * blow.rise / kFall, 1, "%");
    EXPECT_GT(rotate(conjugate(turned), bridge.world.state(ball)->centreOfMass).y,
              bridge.height(0.5 * bridge.length) - 0.5);
  }
}

// 500 kg fall on a hundred boards of 7 kg from 0.1 m above their upper side.
TEST(Law, Row30qALongBridgeBearsABlow) {
  for (Quat turned : {Quat{}, askew()}) {
    Bridge bridge(turned, longRow());
    bridge.drop(0.25, 0.11);
    const Bridge::Blow blow = bridge.bear(60);
    atMost("error of a hinge of a hundred boards under the blow" + orAskew(turned), kDt, 1e3 * blow.gape, 0.5, "mm");
    atMost("gain of energy, of that of the fall" + orAskew(turned), kDt, 100 * blow.rise / kFall, 1, "%");
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
