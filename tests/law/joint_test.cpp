// Joints: pendulums against closed forms, a heavy ball on light links, linkages that stay closed, breaking. Bridges:
// bridge_test.cpp.
#include <algorithm>
#include <cmath>
#include <functional>
#include <string>
#include <utility>

#include "law/joint_parts.h"
#include "law/law.h"

namespace brickfall::law {
namespace {

// s: of a swing of this amplitude, by the arithmetic-geometric mean.
double periodOf(double length, double amplitude) {
  double a = 1, b = std::cos(0.5 * amplitude);
  for (int i = 0; i < 20; i++) {
    const double mean = 0.5 * (a + b);
    b = std::sqrt(a * b);
    a = mean;
  }
  return 2 * kPi * std::sqrt(length / kG) / a;
}

// What a swing about z does, from its angle after each step.
struct Swing {
  double last = 0, first = -1, latest = 0, amplitude = 0, reached = 0;
  int periods = -1;
  void look(double time, double dt, double angle) {
    if (last > 0 && angle <= 0) {
      latest = time - dt + dt * last / (last - angle);
      if (first < 0) first = latest;
      periods++;
      amplitude = reached;
      reached = 0;
    }
    reached = std::max(reached, std::fabs(angle));
    last = angle;
  }
  double period() const { return (latest - first) / periods; }
};

// Hangs a ball under (0, 10, 0) at an angle; the turning part of its inertia counts as length.
struct Pendulum {
  static constexpr double kLength = 2, kRadius = 0.2;
  World world = makeWorld();
  BodyId bob;
  JointId joint;
  Swing swing;
  double start = 0, rise = 0;  // J

  explicit Pendulum(double angle, JointType type = JointType::spherical) {
    const BodyId base = addFixed(world, {0, 10, 0});
    BodyDef def = bodyOf(sphereOf(kRadius), {kLength * std::sin(angle), 10 - kLength * std::cos(angle), 0});
    def.rotation = quatFromAxisAngle({0, 0, 1}, angle);
    bob = add(world, def);
    joint = join(world, at(type, {0, 10, 0}), base, bob);
    swing.last = angle;
    start = energyOf(world);
  }
  void go(double seconds, double dt) {
    for (int i = 0; i < std::lround(seconds / dt); i++) {
      ASSERT_TRUE(world.step(dt).ok());
      const Vec3 p = world.state(bob)->centreOfMass;
      swing.look((i + 1) * dt, dt, std::atan2(p.x, 10 - p.y));
      rise = std::max(rise, energyOf(world) - start);
    }
  }
  static double formula(double angle) { return periodOf(kLength + 0.4 * kRadius * kRadius / kLength, angle); }
};

TEST(Law, Row30aAPendulumKeepsPeriodAndAmplitude) {
  for (JointType type : {JointType::spherical, JointType::revolute})
    for (double dt : {1.0 / 60, 1.0 / 240}) {
      Pendulum p(0.5, type);
      p.go(30, dt);
      reached(
          {"period of a pendulum, .5 rad", dt, 100 * (p.swing.period() / Pendulum::formula(0.5) - 1), 0, 0.05, "%"});
      reached({"its amplitude after ten swings", dt, 100 * (p.swing.amplitude / 0.5 - 1), 0, 0.1, "%"});
      atMost("its joint's error", dt, 1e3 * p.world.state(p.joint)->error, 0.01, "mm");
    }
}

TEST(Law, Row30bSmallSwingsAreNotBraked) {
  for (double dt : {1.0 / 60, 1.0 / 240}) {
    Pendulum p(0.01);
    p.go(60, dt);
    reached({"period of a swing of .01 rad", dt, 100 * (p.swing.period() / Pendulum::formula(0.01) - 1), 0, 0.3, "%"});
    reached({"its amplitude, of a swing", dt, 100 * (p.swing.amplitude / 0.01 - 1) / p.swing.periods, 0, 0.1, "%"});
  }
}

// Forty links of 5 kg and a ball of 2000 kg, from (0, 20, 0) at an angle.
struct Chain {
  static constexpr int kLinks = 40;
  static constexpr double kLink = 0.2, kWidth = 0.03, kRadius = 0.4, kLength = kLinks * kLink + kRadius;
  Quat turned;
  World world = turnedWorld(turned);
  BodyId ball;
  std::vector<JointId> joints;
  double start = 0, stretch = 0;

  explicit Chain(double angle, Quat turn = {}) : turned(turn) {
    const Vec3 down{std::sin(angle), -std::cos(angle), 0}, top{0, 20, 0};
    BodyId last = addFixed(world, rotate(turned, top));
    auto hang = [&](const ShapeDef& shape, double centre, double anchor) {
      BodyDef def = bodyOf(shape, top + down * centre);
      def.rotation = quatFromAxisAngle({0, 0, 1}, angle);
      const BodyId next = addTurned(world, turned, def);
      joints.push_back(join(world, turnedBy(turned, at(JointType::spherical, top + down * anchor)), last, next));
      last = next;
    };
    const double density = 5 / (4 * kWidth * kWidth * kLink),
                 heavy = 2000 / (4.0 / 3 * kPi * kRadius * kRadius * kRadius);
    for (int i = 0; i < kLinks; i++) hang(boxOf({kWidth, 0.5 * kLink, kWidth}, density), (i + 0.5) * kLink, i * kLink);
    hang(sphereOf(kRadius, heavy), kLength, kLinks * kLink);
    ball = last;
    start = energyOf(world);
  }
  StepReport step(double dt) {
    Result<StepReport> report = world.step(dt);
    EXPECT_TRUE(report.ok());
    stretch = std::max(stretch, length(world.state(ball)->centreOfMass - rotate(turned, Vec3{0, 20, 0})) - kLength);
    return report ? *report : StepReport{};
  }
};

// Kinetic and potential energy, after each step, against the start: of all that moves.
void keepsEnergy(World& world, double moves, double seconds, double dt, const std::string& of) {
  const double start = energyOf(world);
  double rise = 0, fall = 0, last = start, step = 0;
  for (int i = 0; i < std::lround(seconds / dt); i++) {
    ASSERT_TRUE(world.step(dt).ok());
    const double now = energyOf(world);
    rise = std::max(rise, now - start), fall = std::max(fall, start - now), step = std::max(step, now - last);
    last = now;
  }
  const double coarse = std::pow(std::max(1.0, 60 * dt), 3);
  atMost("energy of " + of + ": over the start", dt, 1e6 * rise / moves, 5, "millionths of what moves");
  atMost("energy of " + of + ": gained in a step", dt, 1e6 * step / moves, 20 * coarse, "millionths of what moves");
  atMost("energy of " + of + ": under the start", dt, 100 * fall / moves, 0.1 * coarse, "%");
}

TEST(Law, Row30uEnergyIsThatOfOneMoment) {
  for (double dt : {1.0 / 30, 1.0 / 60, 1.0 / 240}) {
    Pendulum p(1, JointType::revolute);
    const double mass = p.world.state(p.bob)->mass;
    keepsEnergy(p.world, mass * kG * Pendulum::kLength * (1 - std::cos(1.0)), 10, dt, "a swing of 1 rad");
    Chain chain(0.3);
    keepsEnergy(chain.world, 2000 * kG * Chain::kLength * (1 - std::cos(0.3)), 4, dt, "a chain of forty links");
  }
}

// A plate hangs on two rods, and a box lies on it: what touches a linkage changes no moment of its velocities.
TEST(Law, Row30wEnergyIsThatOfOneMomentUnderALoad) {
  for (double dt : {1.0 / 60, 1.0 / 240}) {
    World world = makeWorld();
    const double angle = 0.3, reach = 2;
    const Vec3 down{reach * std::sin(angle), -reach * std::cos(angle), 0}, top{0, 10, 0};
    const BodyId plate = add(world, bodyOf(boxOf({0.5, 0.05, 0.4}, 1000, 0.9), top + down));
    for (double x : {-0.45, 0.45}) {
      const Vec3 from = top + Vec3{x, 0, 0};
      BodyDef def = bodyOf(boxOf({0.02, 0.5 * reach, 0.02}), from + down * 0.5 + Vec3{0, 0, 0.5});
      def.rotation = quatFromAxisAngle({0, 0, 1}, angle);
      const BodyId rod = add(world, def);
      join(world, at(JointType::revolute, from), addFixed(world, from + Vec3{0, 0.3, 0}), rod);
      join(world, at(JointType::revolute, from + down), rod, plate);
    }
    add(world, bodyOf(boxOf({0.2, 0.2, 0.2}, 2000, 0.9), top + down + Vec3{0, 0.25, 0}));
    const double start = energyOf(world), moves = (80 + 128) * kG * reach * (1 - std::cos(angle));
    double rise = 0, step = 0, last = start;
    for (int i = 0; i < std::lround(10 / dt); i++) {
      ASSERT_TRUE(world.step(dt).ok());
      const double now = energyOf(world);
      rise = std::max(rise, now - start), step = std::max(step, now - last);
      last = now;
    }
    expectSound(world);
    atMost("energy of a tray with a load: over the start", dt, 1e6 * rise / moves, 5, "millionths of what moves");
    atMost("energy of a tray with a load: gained in a step", dt, 1e6 * step / moves, 20, "millionths of what moves");
  }
}

TEST(Law, Row30vSlowSwingsFade) {
  for (double dt : {1.0 / 60, 1.0 / 240}) {
    Chain chain(0.001);
    double time = 0;
    for (; time < 20 && chain.world.state(chain.ball)->awake; time += dt) chain.step(dt);
    atMost("a swing by 8 mm of 2000 kg: at rest after", dt, time, 8, "s");
    // A thousandth of what turns it back: alone that would take minutes.
    Pendulum braked(0.003, JointType::revolute);
    ASSERT_TRUE(braked.world.setMotor(braked.joint, JointDef::Motor{0, 2e-3}).ok());
    for (time = 0; time < 20 && braked.world.state(braked.bob)->awake; time += dt) braked.go(dt, dt);
    atMost("a swing by 6 mm of 34 kg on a hinge that rubs: at rest after", dt, time, 12, "s");
    // It hung where it had turned back: there the last of its velocity and gravity balance for a step.
    const Vec3 place = braked.world.state(braked.bob)->centreOfMass;
    atMost("its angle there, of 3 mrad", dt, 1e3 * std::fabs(std::atan2(place.x, 10 - place.y)), 1, "mrad");
  }
}

TEST(Law, Row30cAHeavyBallHangsStillOnLightLinks) {
  Chain chain(0);
  for (int i = 0; i < 90; i++) chain.step(kDt);
  EXPECT_FALSE(chain.world.state(chain.ball)->awake);
  expectSound(chain.world);
  atMost("stretch of forty links under 400 times their weight", kDt, 100 * chain.stretch / Chain::kLength, 0.05, "%");
  const double weight = (2000 + 5 * Chain::kLinks) * kG;
  reached({"force of its uppermost joint", kDt, chain.world.state(chain.joints[0])->force.y / weight, 1, 2e-3, ""});
}

// Small swings go up and down by a second order. What they lose by the fourth is given back: it was 0.8 % of the amplitude
// in ten swings at 1/30 s.
TEST(Law, Row30dAHeavyBallSwingsOnLightLinks) {
  for (auto [dt, swings] : {std::pair{1.0 / 30, 10}, {kDt, 3}}) {
    Chain chain(0.3);
    Swing swing{.last = 0.3};
    double taken = 0;
    for (int i = 0; swing.periods < swings - 1; i++) {
      ASSERT_LT(i, 4000);
      taken += chain.step(dt).energyTaken;
      const Vec3 p = chain.world.state(chain.ball)->centreOfMass;
      swing.look((i + 1) * dt, dt, std::atan2(p.x, 20 - p.y));
    }
    const double reach = Chain::kLinks * Chain::kLink;
    const double light = 5 * Chain::kLinks, moment = 2000 * Chain::kLength + light * 0.5 * reach;
    const double inertia = 2000 * (Chain::kLength * Chain::kLength + 0.4 * 0.16) + light * reach * reach / 3;
    reached({"period of the chain", dt, 100 * (swing.period() / periodOf(inertia / moment, 0.3) - 1), 0, 0.1, "%"});
    reached({"its amplitude", dt, 100 * (swing.amplitude / 0.3 - 1), 0, 0.1, "%"});
    atMost("its stretch", dt, 100 * chain.stretch / Chain::kLength, 0.05, "%");
    atMost("what the last check takes from it", dt, taken, dt > kDt ? 4 : 1, "J");
  }
}

// A ring of ten bars with a hinge between each two, thrown into space and turning.
TEST(Law, Row30eALinkageInFlightStaysClosedAndKeepsItsMomenta) {
  World world = emptySpace();
  const int count = 10;
  auto corner = [](int i) { return Vec3{std::cos(2 * kPi * i / 10), 5 + std::sin(2 * kPi * i / 10), 0}; };
  std::vector<BodyId> bars;
  std::vector<JointId> joints;
  for (int i = 0; i < count; i++) {
    const Vec3 middle = (corner(i) + corner(i + 1)) * 0.5, along = corner(i + 1) - corner(i);
    BodyDef def = bodyOf(boxOf({0.5 * length(along) - 0.03, 0.03, 0.03}), middle);
    def.rotation = quatFromAxisAngle({0, 0, 1}, std::atan2(along.y, along.x));
    def.angularVelocity = {0, 0, 3};
    def.linearVelocity = cross(def.angularVelocity, middle - Vec3{0, 5, 0}) + Vec3{0.3 * (i % 3 - 1), 0.2 * (i % 2), 0};
    bars.push_back(add(world, def));
  }
  for (int i = 0; i < count; i++)
    joints.push_back(
        join(world, at(JointType::revolute, corner(i + 1)), bars[std::size_t(i)], bars[std::size_t((i + 1) % count)]));
  const Vec3 before = world.angularMomentum();
  const double start = energyOf(world);
  double gape = 0, rise = 0;
  for (int i = 0; i < 300; i++) {
    ASSERT_TRUE(world.step(kDt).ok());
    for (JointId joint : joints) gape = std::max(gape, world.state(joint)->error);
    rise = std::max(rise, energyOf(world) - start);
  }
  expectSound(world);
  atMost("error of ten hinges in a ring", kDt, 1e3 * gape, 0.1, "mm");
  atMost("its angular momentum, relative", kDt, length(world.angularMomentum() - before) / length(before), 1e-9, "");
  atMost("its gain of energy", kDt, rise, 1e-6 * start, "J");
}

// Four boxes in a row that turn as one, by up to two radians in a step: no part of a step follows so long arcs, so it is
// taken again in shorter ones. They may lose by that, and gain nothing: the last check of each part leaves what floats
// round. (What is held wholly flies as one body: law 31f.)
TEST(Law, Row30eALinkageThatSpinsGainsNothing) {
  struct Kind {
    const char* name;
    JointType outer, middle;
  };
  for (const Kind& kind : {Kind{"on hinges", JointType::revolute, JointType::revolute},
                           Kind{"on ball joints", JointType::spherical, JointType::spherical},
                           Kind{"two and two, and a hinge", JointType::fixed, JointType::revolute},
                           Kind{"two and two, and a ball joint", JointType::fixed, JointType::spherical}})
    for (double dt : {1.0 / 30, kDt, 1.0 / 120, 1.0 / 240}) {
      World world = emptySpace();
      std::vector<BodyId> boxes;
      const Vec3 centre{0.0125, 0.3, 0}, spin = normalized(Vec3{0.3, 0.8, 0.5}) * 60.0;
      for (int i = 0; i < 4; i++) {
        BodyDef def = bodyOf(boxOf({0.1, 0.1, 0.1}), {i == 3 ? 0.05 : 0, 0.2 * i, 0});
        def.angularVelocity = spin;
        def.linearVelocity = cross(spin, def.position - centre);
        boxes.push_back(add(world, def));
      }
      std::vector<JointId> joints;
      for (int i = 0; i < 3; i++)
        joints.push_back(join(
            world, at(i == 1 ? kind.middle : kind.outer, {i == 2 ? 0.025 : 0, 0.2 * i + 0.1, 0}, {1, 0.5, 0.7 * i}),
            boxes[std::size_t(i)], boxes[std::size_t(i + 1)]));
      ASSERT_TRUE(world.step(dt).ok());  // velocities become those that joints let be
      const double start = energyOf(world);
      const Vec3 momentum = world.angularMomentum();
      double most = start, rise = 0, last = start, gape = 0;
      for (int i = 0; i < int(std::lround(2 / dt)); i++) {
        const Result<StepReport> report = world.step(dt);
        ASSERT_TRUE(report.ok());
        const double now = energyOf(world);
        most = std::max(most, now);
        // So few bodies go in parts of 0.2 rad, too.
        const double parts = std::max(double(report->parts), std::ceil(length(spin) * dt / 0.2));
        rise = std::max(rise, (now - std::exchange(last, now)) / parts);
        for (JointId joint : joints) gape = std::max(gape, world.state(joint)->error);
      }
      const std::string name = std::string("four boxes at 60 rad/s, ") + kind.name;
      atMost(name + ": gain of energy", dt, most / start - 1, 1e-5, "");
      atMost(name + ": gain in a part of a step", dt, rise / start, 2e-6, "");
      atMost(name + ": loss of energy in 2 s", dt, 100 * (1 - last / start), 15, "%");
      atMost(name + ": error of its joints", dt, 1e3 * gape, 3, "mm");
      atMost(name + ": change of angular momentum", dt, length(world.angularMomentum() - momentum) / length(momentum),
             1e-9, "");
    }
}

// Loops of bars that fall with one bar fixed: four in a plane, and six with hinges square to each other in turn (of Bricard), which
// move only because of their measures.
TEST(Law, Row30eLoopsStayClosed) {
  struct Loop {
    const char* name;
    std::vector<Vec3> corners, axes;
  };
  const double side = 0.5 * std::sqrt(3.0);
  const Vec3 a{-1, 0, 0}, b{1, 0, 0}, c{0, 0, 2 * side}, up{0, 1, 0};
  const Vec3 ab = (a + b) * 0.5, bc = (b + c) * 0.5, ca = (c + a) * 0.5;
  const Vec3 z{0, 0, 1};
  const Loop loops[] = {{"four bars", {{0, 0, 0}, {1, 0, 0}, {1.4, 0.9, 0}, {-0.3, 0.6, 0}}, {z, z, z, z}},
                        {"Bricard's six bars",
                         {a, ab, b, bc, c, ca},
                         {up, cross(b - a, up), up, cross(c - b, up), up, cross(a - c, up)}}};
  for (const Loop& loop : loops)
    for (double dt : {1.0 / 30, 1.0 / 60, 1.0 / 240}) {
      World world = makeWorld();
      const std::size_t count = loop.corners.size();
      std::vector<BodyId> bars;
      std::vector<JointId> joints;
      for (std::size_t i = 0; i < count; i++) {
        const Vec3 from = loop.corners[i], to = loop.corners[(i + 1) % count], along = to - from;
        BodyDef def = bodyOf(boxOf({0.5 * length(along) - 0.04, 0.02, 0.02}), Vec3{0, 10, 0} + (from + to) * 0.5,
                             i == 0 ? BodyType::fixed : BodyType::dynamic);
        const Vec3 turn = cross(Vec3{1, 0, 0}, normalized(along));
        def.rotation = normalized(Quat{turn.x, turn.y, turn.z, 1 + normalized(along).x + 1e-9});
        def.shapes[0].filter = {2, 0};
        bars.push_back(add(world, def));
      }
      for (std::size_t i = 0; i < count; i++)
        joints.push_back(join(world, at(JointType::revolute, Vec3{0, 10, 0} + loop.corners[i], loop.axes[i]),
                              bars[(i + count - 1) % count], bars[i]));
      const double start = energyOf(world);
      double gape = 0, rise = 0, fell = 0;
      for (int i = 0; i < std::lround(4 / dt); i++) {
        ASSERT_TRUE(world.step(dt).ok());
        for (JointId joint : joints) gape = std::max(gape, world.state(joint)->error);
        rise = std::max(rise, energyOf(world) - start), fell = std::max(fell, world.energy().kinetic);
      }
      expectSound(world);
      EXPECT_GT(fell, 1);
      atMost(std::string(loop.name) + ": error of a hinge", dt, 1e3 * gape, 0.1, "mm");
      atMost(std::string(loop.name) + ": energy over the start", dt, 1e6 * rise / fell, 5, "millionths of what moves");
    }
}

// The bob meets a fixed block at its lowest point.
TEST(Law, Row30fABobThatHitsABlockStaysOnItsJoint) {
  Pendulum p(-1);
  add(p.world, bodyOf(boxOf({0.3, 0.3, 0.3}), {Pendulum::kRadius + 0.3, 8, 0}, BodyType::fixed));
  const double had = 33.5 * kG * Pendulum::kLength * (1 - std::cos(1.0));
  double error = 0;
  for (int i = 0; i < 60; i++) {
    ASSERT_TRUE(p.world.step(kDt).ok());
    error = std::max(error, p.world.state(p.joint)->error);
    EXPECT_LT(energyOf(p.world) - p.start, 0.01 * had);
  }
  expectSound(p.world);
  atMost("error of the joint of a bob that hits a block", kDt, 1e3 * error, 0.01, "mm");
  EXPECT_LT(p.world.state(p.bob)->centreOfMass.x, 0.002);
}

// From above its pivot a heavy ball falls, its chain goes slack, and snaps.
TEST(Law, Row30kAChainThatSnapsGainsNothing) {
  const std::pair<double, double> falls[] = {{2.2, kDt}, {2.6, kDt}, {3.0, kDt}, {2.8, 0.5 * kDt}, {2.9, 0.5 * kDt}};
  for (int n = 0; n < 10; n++) {
    const auto [angle, dt] = falls[n % 5];
    const Quat turned = n < 5 ? Quat{} : askew();
    Chain chain(angle, turned);
    const double moves = 2000 * kG * Chain::kLength * (1 - std::cos(angle));
    double rise = 0, step = 0, gape = 0, last = chain.start;
    for (int i = 0; i < std::lround(4 / dt); i++) {
      EXPECT_TRUE(chain.step(dt).quarantined.empty());
      for (JointId joint : chain.joints) gape = std::max(gape, chain.world.state(joint)->error);
      const double now = energyOf(chain.world);
      rise = std::max(rise, now - chain.start), step = std::max(step, now - last), last = now;
    }
    expectSound(chain.world);
    atMost("energy gained by a chain that snaps from " + text(angle, 1) + " rad" + orAskew(turned), dt, rise, 1e-6,
           "J");
    atMost("its largest gain in a step, of what gravity gives", dt, 1e6 * step / moves, 1, "millionths");
    atMost("stretch of it", dt, 100 * chain.stretch / Chain::kLength, 0.1, "%");
    atMost("error of a joint of it", dt, 1e3 * gape, 20, "mm");
  }
}

// A ball on a chain breaks a small wall. What a step gains is what gravity gives before a way instead of along it.
TEST(Law, Row30mAChainGainsNothingInAHit) {
  for (int links : {7, 12})
    for (double dt : {1.0 / 60, 1.0 / 120}) {
      World world = makeWorld();
      addGround(world);
      for (int y = 0; y < 4; y++)
        for (int z = 0; z < 4; z++)
          addBox(world, {0.055, 0.0325, 0.11}, {0.255, 0.0325 + 0.065 * y, 0.22 * (z - 1.5) + 0.11 * (y % 2)});
      const double speed = 8, reach = 2, radius = 0.19, angle = -1.2, link = (reach - radius) / links;
      const Vec3 top{0, 0.25 + reach, 0}, down{std::sin(angle), -std::cos(angle), 0}, ahead{-down.y, down.x, 0};
      BodyId last = addFixed(world, top);
      std::vector<BodyId> bodies;
      auto hang = [&](const ShapeDef& shape, double centre, double anchor) {
        BodyDef def = bodyOf(shape, top + down * centre);
        def.rotation = quatFromAxisAngle({0, 0, 1}, angle);
        def.angularVelocity = {0, 0, speed / reach};
        def.linearVelocity = ahead * (speed / reach * centre);
        const BodyId next = add(world, def);
        join(world, at(JointType::spherical, top + down * anchor), last, next);
        bodies.push_back(last = next);
      };
      for (int i = 0; i < links; i++) hang(boxOf({0.02, 0.5 * link - 0.002, 0.02}, 7800), (i + 0.5) * link, i * link);
      hang(sphereOf(radius, 7000), reach, reach - radius);
      auto upwards = [&] {
        double sum = 0;
        for (BodyId body : bodies) sum += world.state(body)->mass * world.state(body)->linearVelocity.y;
        return sum;
      };
      const double start = world.energy().kinetic;
      double energy = energyOf(world), momentum = upwards(), most = 0;
      for (int i = 0; i < std::lround(2 / dt); i++) {
        ASSERT_TRUE(world.step(dt).ok());
        const double before = energy, had = momentum;
        energy = energyOf(world), momentum = upwards();
        most = std::max(most, energy - before - 0.5 * dt * kG * std::fabs(momentum - had));
      }
      expectSound(world);
      atMost("gain of a step of a chain of " + std::to_string(links) + " links in a hit", dt, 100 * most / start, 1,
             "%");
    }
}

// Twenty balls of 1 kg on rods or ropes from centre to centre, and 500 kg at their end.
TEST(Law, Row30pLightBeadsHoldAHeavyBall) {
  for (JointType type : {JointType::distance, JointType::rope}) {
    World world = makeWorld();
    const double angle = 0.5, step = 0.2, radius = 0.05, volume = 4.0 / 3 * kPi * radius * radius * radius;
    const Vec3 top{0, 10, 0}, down{std::sin(angle), -std::cos(angle), 0};
    BodyId last = addFixed(world, top);
    std::vector<JointId> joints;
    for (int i = 0; i < 20; i++) {
      const Vec3 to = top + down * (step * (i + 1));
      const BodyId next = add(world, bodyOf(sphereOf(radius, (i < 19 ? 1 : 500) / volume), to));
      JointDef def = at(type, to - down * step);
      def.anchorB = to;
      joints.push_back(join(world, def, last, next));
      last = next;
    }
    Swing swing;
    swing.last = angle;
    double gape = 0;
    for (int i = 0; i < 660; i++) {
      ASSERT_TRUE(world.step(kDt).ok());
      for (JointId joint : joints) gape = std::max(gape, world.state(joint)->error);
      const Vec3 p = world.state(last)->centreOfMass;
      swing.look((i + 1) * kDt, kDt, std::atan2(p.x, 10 - p.y));
    }
    expectSound(world);
    const std::string of = type == JointType::rope ? "beads on ropes" : "beads on rods";
    const double moment = 500 * 4 + 0.2 * 190, inertia = 500 * 16 + 0.04 * 2470;  // sums of i and of i^2, 1 to 19
    atMost("gape of " + of, kDt, 1e3 * gape, 0.1, "mm");
    reached({"period of " + of, kDt, 100 * (swing.period() / periodOf(inertia / moment, angle) - 1), 0, 0.2, "%"});
    reached({"their amplitude", kDt, 100 * (swing.amplitude / angle - 1), 0, 1, "%"});
  }
}

// A rod slides in a sleeve that swings by a quarter radian in a step: the line turns with the sleeve.
TEST(Law, Row30sWhatSlidesKeepsToALineThatTurns) {
  for (double dt : {1.0 / 30, 1.0 / 60, 1.0 / 240}) {
    World world = makeWorld({.gravity = {}});
    const Vec3 spin{0, 0, 0.25 / dt};
    auto turning = [&](Vec3 place) {
      BodyDef def = bodyOf(boxOf({0.2, 0.05, 0.05}), place);
      def.linearVelocity = cross(spin, place);
      def.angularVelocity = spin;
      return add(world, def);
    };
    const BodyId sleeve = turning({0.3, 0, 0}), rod = turning({0.3, 0.3, 0});
    join(world, at(JointType::revolute, {}), addFixed(world, {}), sleeve);
    JointDef def = at(JointType::prismatic, {0.3, 0.1, 0}, {1, 0, 0});
    def.limit = JointDef::Limit{-0.2, 0.2};
    const JointId slide = join(world, def, sleeve, rod);
    double off = 0, slid = 0;
    for (int i = 0; i < 60; i++) {
      ASSERT_TRUE(world.step(dt).ok());
      off = std::max(off, world.state(slide)->error);
      slid = std::max(slid, world.state(slide)->position);
    }
    expectSound(world);
    EXPECT_GT(slid, 0.1);
    atMost("way of a rod off the line in which it slides", dt, 1e3 * off, 0.1, "mm");
  }
}

// Each type under its own weight: what it holds, what it tells, that it comes to rest.
TEST(Law, Row30gEachTypeHoldsWhatItIsToHold) {
  World world = makeWorld();
  const double mass = 64;
  double x = 0;
  auto hang = [&](JointDef def, Vec3 offset, std::optional<Vec3> anchorB = {}) {
    const Vec3 top{x += 3, 10, 0};
    const BodyId base = addFixed(world, top), body = add(world, bodyOf(boxOf({0.2, 0.2, 0.2}), top + offset));
    def.anchor = top + def.anchor;
    if (anchorB) def.anchorB = top + *anchorB;
    return join(world, def, base, body);
  };
  JointDef fixed = at(JointType::fixed, {0, 0, 0}), slide = at(JointType::prismatic, {0, -0.5, 0}, {0, -1, 0});
  JointDef hinge = at(JointType::revolute, {0, 0, 0}), rope = at(JointType::rope, {0, 0, 0});
  slide.limit = JointDef::Limit{-1, 0.5};
  hinge.limit = JointDef::Limit{-0.5, 0.25};
  rope.length = 1.5;
  JointDef spring = at(JointType::spring, {0, 0, 0});
  spring.stiffness = 5000, spring.damping = 800;
  const JointId f = hang(fixed, {1, 0, 0}), s = hang(slide, {0, -0.5, 0}), h = hang(hinge, {-1, 0, 0});
  const JointId d = hang(at(JointType::distance, {0, 0, 0}), {0, -1, 0}, Vec3{0, -0.8, 0});
  const JointId r = hang(rope, {0, -1, 0}, Vec3{0, -0.8, 0}), k = hang(spring, {0, -1, 0}, Vec3{0, -0.8, 0});
  run(world, 5);
  auto told = [&](JointId joint) { return *world.state(joint); };
  const double weight = mass * kG;
  reached({"torque of a fixed joint", kDt, told(f).torque.z, weight * 1, 0.002 * weight, "N m"});
  reached({"way of a slide to its limit", kDt, told(s).position, 0.5, 1e-4, "m"});
  reached({"turn of a hinge to its limit", kDt, told(h).position, 0.25, 1e-4, "rad"});
  reached({"length of a distance joint", kDt, told(d).position, 0.8, 1e-4, "m"});
  reached({"length of a rope", kDt, told(r).position, 1.5, 1e-4, "m"});
  reached({"length of a spring", kDt, told(k).position, 0.8 + weight / 5000, 1e-3, "m"});
  for (JointId joint : {f, s, h, d, r, k}) {
    EXPECT_NEAR(length(told(joint).force), weight, 0.005 * weight);
    EXPECT_FALSE(told(joint).awake);
  }
}

TEST(Law, Row30hMotorsDriveAndAreNoStrongerThanTheyAre) {
  World world = emptySpace();
  const BodyId base = addFixed(world, {}), wheel = add(world, bodyOf(sphereOf(0.3), {0, 0, 1}));
  JointDef def = at(JointType::revolute, {0, 0, 1});
  def.motor = JointDef::Motor{100, 5};
  const JointId joint = join(world, def, base, wheel);
  run(world, 1);
  const double inertia = 0.4 * world.state(wheel)->mass * 0.09;
  reached({"speed that a torque of 5 N m gives in 1 s", kDt, world.state(joint)->speed, 5 / inertia, 0.001, "rad/s"});
  EXPECT_TRUE(world.setMotor(joint, JointDef::Motor{-1, 1e4}).ok());
  run(world, 0.1);
  reached({"speed of a strong motor", kDt, world.state(joint)->speed, -1, 1e-3, "rad/s"});
}

// A joint that bears less than what hangs on it breaks, is told, and lets its bodies collide.
TEST(Law, Row30iAJointBreaksAndItsBodiesCollideThen) {
  World world = makeWorld();
  addGround(world);
  const BodyId lower = addBox(world, {0.2, 0.2, 0.2}, {0, 0.2, 0}),
               upper = addBox(world, {0.2, 0.2, 0.2}, {0, 0.55, 0});
  JointDef def = at(JointType::fixed, {0, 0.4, 0});
  const JointId joint = join(world, def, lower, upper);
  run(world, 2);
  EXPECT_FALSE(world.state(upper)->awake);
  reached({"height of a box that a joint holds over another", kDt, world.state(upper)->position.y, 0.55, 1e-3, "m"});
  EXPECT_TRUE(world.setBreaking(joint, 0.9 * 64 * kG, 1e9).ok());
  ASSERT_TRUE(world.step(kDt).ok());
  ASSERT_EQ(world.events().breaks.size(), 1u);
  EXPECT_EQ(world.events().breaks[0].joint, joint);
  EXPECT_NEAR(length(world.events().breaks[0].force), 64 * kG, 1);
  EXPECT_FALSE(world.isValid(joint));
  EXPECT_FALSE(world.state(joint).ok());
  run(world, 2);
  reached({"and after the joint broke: it lies on it", kDt, world.state(upper)->position.y, 0.6, 2e-3, "m"});
}

// Two balls that hang from each other, integrated in steps of 1/12000 s.
struct FineDouble {
  static constexpr double kMass = 1, kRadius = 0.05, kReach = 1, kStep = 1.0 / 12000;
  static constexpr double kOwn = 0.4 * kMass * kRadius * kRadius;
  double state[4] = {0.5, 0.8, 0, 0};  // angles, rates

  static void rates(const double (&at)[4], double (&out)[4]) {
    const double c = std::cos(at[0] - at[1]), s = std::sin(at[0] - at[1]), both = kMass * kReach * kReach;
    const double a = 2 * both + kOwn, b = both + kOwn, mixed = both * c;
    const double p = -both * s * at[3] * at[3] - 2 * kMass * kG * kReach * std::sin(at[0]),
                 q = both * s * at[2] * at[2] - kMass * kG * kReach * std::sin(at[1]);
    const double det = a * b - mixed * mixed;
    out[0] = at[2], out[1] = at[3], out[2] = (p * b - q * mixed) / det, out[3] = (q * a - p * mixed) / det;
  }
  void step() {  // the midpoint's rule
    double rate[4], middle[4];
    rates(state, rate);
    for (int i = 0; i < 4; i++) middle[i] = state[i] + 0.5 * kStep * rate[i];
    rates(middle, rate);
    for (int i = 0; i < 4; i++) state[i] += kStep * rate[i];
  }
  Vec3 end() const {
    return Vec3{std::sin(state[0]) + std::sin(state[1]), -std::cos(state[0]) - std::cos(state[1]), 0} * kReach;
  }
};

TEST(Law, Row30oADoublePendulumKeepsToAFineOne) {
  for (double dt : {1.0 / 60, 1.0 / 240}) {
    World world = makeWorld();
    FineDouble fine;
    const Vec3 top{0, 10, 0};
    BodyId last = addFixed(world, top + Vec3{0, 4, 0});
    Vec3 anchor = top;
    for (int i = 0; i < 2; i++) {
      const double angle = fine.state[i];
      const double density = FineDouble::kMass / (4.0 / 3 * kPi * std::pow(FineDouble::kRadius, 3));
      const Vec3 place = anchor + Vec3{std::sin(angle), -std::cos(angle), 0} * FineDouble::kReach;
      const BodyId next = add(world, bodyOf(sphereOf(FineDouble::kRadius, density), place));
      join(world, at(JointType::spherical, anchor), last, next);
      last = next;
      anchor = place;
    }
    double off = 0, time = 0;
    for (int i = 0; i * dt < 10; i++) {
      ASSERT_TRUE(world.step(dt).ok());
      for (; time < i * dt + dt - 0.5 * FineDouble::kStep; time += FineDouble::kStep) fine.step();
      off = std::max(off, length(world.state(last)->centreOfMass - top - fine.end()));
    }
    atMost("the lower ball's distance from a finely integrated one", dt, 1e3 * off, dt > 0.01 ? 4 : 0.3, "mm");
  }
}

// A ball on a chain goes into a small wall: the chain holds, and the wall is solved as well as under a free ball.
TEST(Law, Row30jAChainHoldsInAHitOfAWall) {
  double unbalanced[2] = {};
  // At 1/30 s a link would go beside its joint by 9 mm, to where a brick that it meets leaves it room.
  for (auto [chained, dt] : {std::pair{0, kDt}, {1, kDt}, {1, 2 * kDt}}) {
    World world = makeWorld();
    addGround(world);
    for (int y = 0; y < 12; y++)
      for (int z = 0; z < 10; z++)
        addBox(world, {0.055, 0.0325, 0.11}, {0.255, 0.0325 + 0.065 * y, 0.22 * (z - 4.5) + 0.11 * (y % 2)});
    const double speed = 5, reach = 2;
    const Vec3 top{0, 0.4 + reach, 0};
    BodyId last = addFixed(world, top);
    BodyDef ball = bodyOf(sphereOf(0.19, 7000), top - Vec3{0, reach, 0});
    ball.linearVelocity = {speed, 0, 0};
    const int links = 16;
    std::vector<JointId> joints;
    for (int i = 0; i < links * chained; i++) {
      const double link = (reach - 0.19) / links;
      BodyDef def = bodyOf(boxOf({0.01, 0.5 * link - 0.002, 0.01}, 7000), top - Vec3{0, (i + 0.5) * link, 0});
      def.linearVelocity = {speed * (i + 0.5) * link / reach, 0, 0};
      def.angularVelocity = {0, 0, speed / reach};
      const BodyId next = add(world, def);
      joints.push_back(join(world, at(JointType::spherical, top - Vec3{0, i * link, 0}), last, next));
      last = next;
    }
    ball.angularVelocity = {0, 0, chained ? speed / reach : 0};
    const BodyId body = add(world, ball);
    if (chained) joints.push_back(join(world, at(JointType::spherical, top - Vec3{0, reach - 0.19, 0}), last, body));
    double stretch = 0, gape = 0;
    for (int i = 0; i < std::lround(0.75 / dt); i++) {
      Result<StepReport> report = world.step(dt);
      ASSERT_TRUE(report.ok() && report->quarantined.empty());
      if (dt == kDt) unbalanced[chained] += report->unbalancedBodies / 45.0;
      for (JointId joint : joints) gape = std::max(gape, world.state(joint)->error);
      if (chained) stretch = std::max(stretch, length(world.state(body)->centreOfMass - top) - reach);
    }
    expectSound(world);
    if (chained) atMost("stretch of a chain of 5 kg in a hit by 200 kg", dt, 100 * stretch / reach, 0.1, "%");
    if (chained) atMost("gape of its joints", dt, 1e3 * gape, 1, "mm");
  }
  atMost("bodies out of balance, beside a free ball", kDt, unbalanced[1] - unbalanced[0], 1, "");
}

}  // namespace
}  // namespace brickfall::law
