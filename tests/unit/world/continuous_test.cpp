// A fast ball never passes through what is solid, whatever its speed, its direction and the time step.
#include "math/random.h"
#include "support/lab_measure.h"
#include "support/world_helpers.h"

namespace brickfall {
namespace {

using namespace test;

TEST(Continuous, FastBallNeverPassesThroughAThinPlate) {
  Random random(11);
  for (int shot = 0; shot < 400; shot++) {
    World world = emptySpace();
    add(world, bodyOf(boxOf({2, 2, 0.01}), {}, BodyType::fixed));  // 20 mm thick
    double radius = random.between(0.02, 0.2), speed = random.between(5, 200);
    Vec3 aim{random.between(-1, 1), random.between(-1, 1), 0};
    Vec3 from = aim + Vec3{random.between(-1, 1), random.between(-1, 1), random.between(0.3, 4)};
    BodyDef d = bodyOf(sphereOf(radius, 7800), from);
    d.linearVelocity = normalized(aim - from) * speed;
    BodyId ball = add(world, d);
    double dt = shot % 3 == 0 ? 1.0 / 30 : shot % 3 == 1 ? 1.0 / 60 : 1.0 / 240;
    for (int i = 0; i < 30; i++) {
      stepSound(world, dt);
      Vec3 at = world.state(ball)->position;
      bool beside = std::fabs(at.x) > 2 || std::fabs(at.y) > 2;
      ASSERT_TRUE(beside || at.z > 0) << "shot " << shot << " speed " << speed << " radius " << radius << " dt " << dt;
    }
  }
}

TEST(Continuous, FastBoxNeverPassesThroughAThinPlate) {
  Random random(12);
  for (int shot = 0; shot < 200; shot++) {
    World world = emptySpace();
    add(world, bodyOf(boxOf({2, 2, 0.01}), {}, BodyType::fixed));
    Vec3 aim{random.between(-1, 1), random.between(-1, 1), 0};
    Vec3 from = aim + Vec3{random.between(-0.5, 0.5), random.between(-0.5, 0.5), random.between(0.5, 4)};
    BodyDef d = bodyOf(boxOf({random.between(.03, .2), random.between(.03, .2), random.between(.03, .2)}), from);
    d.rotation = {random.between(-1, 1), random.between(-1, 1), random.between(-1, 1), 1};
    d.angularVelocity = {random.between(-10, 10), random.between(-10, 10), random.between(-10, 10)};
    d.linearVelocity = normalized(aim - from) * random.between(5, 200);
    BodyId box = add(world, d);
    for (int i = 0; i < 30; i++) {
      stepSound(world, shot % 2 ? 1.0 / 60 : 1.0 / 120);
      Vec3 at = world.state(box)->position;
      ASSERT_TRUE(std::fabs(at.x) > 1.9 || std::fabs(at.y) > 1.9 || at.z > 0) << "shot " << shot;
    }
  }
}

TEST(Continuous, NothingEverPassesThroughTheGround) {
  Random random(13);
  for (int shot = 0; shot < 200; shot++) {
    World world = makeWorld();
    bool plane = shot % 2 == 0;
    add(world, plane ? bodyOf(planeOf(), {}, BodyType::fixed)
                     : bodyOf(boxOf({200, 0.01, 200}), {0, -0.01, 0}, BodyType::fixed));
    ShapeDef shapes[] = {sphereOf(.1, 7800), boxOf({.1, .05, .2}), capsuleOf(.05, .2), hullOf(.2)};
    BodyDef d = bodyOf(shapes[shot % 4], {0, random.between(0.3, 5), 0});
    d.linearVelocity = {random.between(-100, 100), -random.between(1, 200), random.between(-100, 100)};
    d.angularVelocity = {random.between(-20, 20), random.between(-20, 20), random.between(-20, 20)};
    BodyId body = add(world, d);
    for (int i = 0; i < 40; i++) {
      stepSound(world);
      Vec3 at = world.state(body)->position;
      ASSERT_TRUE(at.y > 0 || std::fabs(at.x) > 190 || std::fabs(at.z) > 190) << "shot " << shot << " step " << i;
    }
  }
}

// Balls that the wall can stop, and balls that break it: in no step may the ball be on the far side without having moved
// bricks out of its way.
TEST(Continuous, BallMeetsTheWallAtAnySpeed) {
  Random random(14);
  for (int shot = 0; shot < 10; shot++) {
    lab::Scene s = lab::make("w10");
    double radius = random.between(0.08, 0.15), speed = random.between(20, 200);
    Vec3 aim{random.between(0.6, 1.5), random.between(0.2, 0.45), 0};
    Vec3 from = aim + Vec3{random.between(-0.3, 0.3), random.between(-0.1, 0.3), random.between(0.5, 3)};
    BodyDef d = bodyOf(sphereOf(radius, 7800), from);
    d.linearVelocity = normalized(aim - from) * speed;
    BodyId ball = add(s.world, d);
    for (int i = 0; i < 20; i++) stepSound(s.world);
    double moved = 0;
    for (std::size_t i = 0; i < s.boxes.size(); i++) moved = std::max(moved, lab::boxMove(s, i));
    EXPECT_GT(moved, 0.1) << "shot " << shot << ": no brick gave way";
    EXPECT_GT(s.world.state(ball)->linearVelocity.z, 0.9 * d.linearVelocity.z)
        << "shot " << shot << ": it lost no speed";
    EXPECT_GT(s.world.state(ball)->position.y, 0);
  }
}

}  // namespace
}  // namespace brickfall
