// Row 30r: springs, those that swing too fast for the step and those that do not.
#include <algorithm>

#include "law/joint_parts.h"
#include "law/law.h"

namespace brickfall::law {
namespace {

// A ball on a spring that swings within a step or a few: what it holds is no more than what moved before.
TEST(Law, Row30rAStiffSpringGainsNothing) {
  for (double dt : {1.0 / 30, 1.0 / 120})
    for (double fast : {4.0, 100.0, 1e4})  // (angular frequency x dt)^2
      for (Vec3 way : {Vec3{1, 0, 0}, Vec3{0, 1, 0}, Vec3{0.6, 0.8, 0}}) {
        World world = makeWorld({.gravity = {}});
        const BodyId ball = add(world, bodyOf(sphereOf(0.01), {0.1, 0, 0}));
        JointDef def = at(JointType::spring, {});
        def.anchorB = Vec3{0.1, 0, 0};
        def.stiffness = fast * world.state(ball)->mass / (dt * dt);
        const JointId spring = join(world, def, addFixed(world, {}), ball);
        EXPECT_TRUE(world.setLinearVelocity(ball, way * (0.02 / dt)).ok());
        const double start = energyOf(world);
        double most = 0;
        for (int i = 0; i < 100; i++) {
          ASSERT_TRUE(world.step(dt).ok());
          const double stretch = world.state(spring)->position - 0.1;
          most = std::max(most, energyOf(world) + 0.5 * def.stiffness * stretch * stretch);
        }
        expectSound(world);
        atMost(text(fast, 0) + ", " + text(way.x, 1) + " along it: energy, of that at the start", dt, most / start,
               1.05, "");
      }
}

// A ball on a spring of 1 m, below a place or, in space, below another ball.
struct SprungBall {
  World world;
  BodyId ball;
  JointId joint;
  double mass = 0, stiffness = 0, start = 0;

  // fast: (angular frequency x dt)^2
  SprungBall(bool floats, double fast, double length) : world(makeWorld({.gravity = {0, floats ? 0 : -kG, 0}})) {
    const BodyId top = add(world, bodyOf(sphereOf(0.1), {}, floats ? BodyType::dynamic : BodyType::fixed));
    ball = add(world, bodyOf(sphereOf(0.1), {0, -1, 0}));
    mass = world.state(ball)->mass;
    stiffness = fast * (floats ? 0.5 : 1) * mass / (kDt * kDt);
    JointDef def = at(JointType::spring, {});
    def.anchorB = Vec3{0, -1, 0};
    def.stiffness = stiffness;
    def.length = length;
    joint = join(world, def, top, ball);
    start = energy();
  }
  double stretch() const { return world.state(joint)->position - *world.definition(joint)->length; }
  double energy() const { return energyOf(world) + 0.5 * stiffness * stretch() * stretch(); }
};

// What a spring gives is what it held before less what it holds afterwards, whatever hangs beside it.
TEST(Law, Row30rASpringGivesWhatItHeld) {
  SprungBall space(true, 0.01, 0.8);
  double most = 0;
  for (int i = 0; i < 2000; i++) {
    ASSERT_TRUE(space.world.step(kDt).ok());
    if (i >= 1900) most = std::max(most, std::fabs(space.stretch()));
  }
  reached({"two balls on a spring in space: stretch after thirty swings", kDt, most, 0.2, 2e-3, "m"});

  for (bool rope : {false, true}) {
    SprungBall hangs(false, 0.01, 1);
    if (rope) {  // slack: a light ball falls beside it
      const BodyId light = add(hangs.world, bodyOf(sphereOf(0.02), {0.5, -1, 0}));
      JointDef def = at(JointType::rope, {0, -1, 0});
      def.anchorB = Vec3{0.5, -1, 0};
      def.length = 1000;
      join(hangs.world, def, hangs.ball, light);
      hangs.start = hangs.energy();
    }
    double moved = 0, gains = 0, loses = 0;
    for (int i = 0; i < (rope ? 120 : 600); i++) {
      ASSERT_TRUE(hangs.world.step(kDt).ok());
      moved = std::max(moved, hangs.world.energy().kinetic);
      gains = std::max(gains, hangs.energy() - hangs.start), loses = std::max(loses, hangs.start - hangs.energy());
    }
    expectSound(hangs.world);
    const std::string of = rope ? "the same beside a slack rope" : "a ball that falls on a spring";
    atMost(of + ": energy gained, of what moves", kDt, gains / moved, 1e-4, "");
    atMost(of + ": energy lost", kDt, loses / moved, 1e-3, "");
  }

  SprungBall stiff(false, 16, 1);
  for (int i = 0; i < 20; i++) ASSERT_TRUE(stiff.world.step(kDt).ok());
  const double weight = stiff.mass * kG;
  atMost("a stiff spring that bears a ball: speed told", kDt, length(stiff.world.state(stiff.ball)->linearVelocity),
         1e-3, "m/s");
  reached({"its stretch", kDt, stiff.stretch() * stiff.stiffness / weight, 1, 1e-3, "weights"});
}

// A drag that bears half of a ball's weight, however firm.
TEST(Law, Row30rADragIsNoStrongerThanItIs) {
  World world = makeWorld();
  const BodyId ball = add(world, bodyOf(sphereOf(0.1), {0, -1, 0}));
  JointDef def = at(JointType::drag, {0, -1, 0});
  def.stiffness = 1e5;
  def.strength = 0.5 * world.state(ball)->mass * kG;
  join(world, def, addFixed(world, {}), ball);
  for (int i = 0; i < 60; i++) ASSERT_TRUE(world.step(kDt).ok());
  expectSound(world);
  reached({"a ball that a drag bears by half: speed after 1 s", kDt, length(world.state(ball)->linearVelocity),
           0.5 * kG, 0.05, "m/s"});
}

}  // namespace
}  // namespace brickfall::law
