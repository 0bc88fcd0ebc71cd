// A rope that was shortened a little before each step lagged behind: no more than 0.03 of a body was looked at of its error.
// At 1/60 s it wound up a ball of 0.1 m by 0.09 m/s at most. What a rod gave to what it wound up was taken back.
#include "support/world_helpers.h"

namespace brickfall {
namespace {

using namespace test;

// A ball that goes round in free space and is wound in keeps its angular momentum: it gets faster.
void windIn(JointType type, bool held, double rate, double dt) {
  SCOPED_TRACE(testing::Message() << "type " << int(type) << ", held " << held << ", " << rate << " m/s, dt 1/"
                                  << 1 / dt);
  World world = emptySpace();
  BodyDef near = bodyOf(sphereOf(0.1), {-1, 0, 0}, held ? BodyType::fixed : BodyType::dynamic),
          far = bodyOf(sphereOf(0.1), {1, 0, 0});
  if (!held) near.linearVelocity = {0, -1, 0};
  far.linearVelocity = {0, held ? 2.0 : 1.0, 0};
  JointDef def;
  def.type = type;
  def.bodyA = add(world, near);
  def.bodyB = add(world, far);
  def.anchor = near.position;
  def.anchorB = far.position;
  const JointId joint = world.createJoint(def).value();
  double length = 2;
  for (int i = 0; i < int(1.6 / dt); i++) {
    length -= rate * dt;
    ASSERT_TRUE(world.setLength(joint, length).ok());
    ASSERT_TRUE(world.step(dt).ok());
  }
  const BodyState a = *world.state(def.bodyA), b = *world.state(def.bodyB);
  const Vec3 way = b.position - a.position, speed = b.linearVelocity - a.linearVelocity;
  EXPECT_NEAR(brickfall::length(way), length, 1.1 * rate * dt + 0.0005);
  const double round = brickfall::length(cross(way, speed)) / brickfall::length(way);
  EXPECT_NEAR(round / (4 / brickfall::length(way)), 1, 0.005);
}

TEST(Regression, WinchLagsBehind) {
  for (JointType type : {JointType::rope, JointType::distance})
    for (bool held : {false, true})
      for (double dt : {1.0 / 60, 1.0 / 240}) {
        windIn(type, held, 0.05, dt);
        windIn(type, held, 0.3, dt);
      }
}

}  // namespace
}  // namespace brickfall
