// The solve took a capsule to turn by one turn about one axis. It turns about its own axis first, and then with that: an
// anchor beside its axis came off by a second order of the turn in each step.
#include "support/world_helpers.h"

namespace brickfall {
namespace {

using namespace test;

// m: largest gape of a joint on which a capsule swings and spins.
double gape(JointType type, double dt) {
  World world = makeWorld();
  const BodyId base = add(world, bodyOf(boxOf({0.1, 0.1, 0.1}), {}, BodyType::fixed));
  BodyDef def = bodyOf(capsuleOf(0.1, 0.08), {0.2, -0.3, 0});
  def.linearVelocity = {0, 0, 1};
  def.angularVelocity = {3, 4, 2};
  JointDef joint;
  joint.type = type;
  joint.axis = normalized(Vec3{1, 2, 1});
  joint.anchor = {0.1, -0.2, 0};
  joint.bodyA = base;
  joint.bodyB = add(world, def);
  Result<JointId> made = world.createJoint(joint);
  EXPECT_TRUE(made.ok());
  double most = 0;
  for (double t = 0; t < 2; t += dt) {
    EXPECT_TRUE(world.step(dt).ok());
    most = std::max(most, world.state(*made)->error);
  }
  return most;
}

TEST(Regression, CapsulesComeOffTheirJoints) {
  for (JointType type : {JointType::spherical, JointType::revolute})
    for (double dt : {1.0 / 30, 1.0 / 60, 1.0 / 120}) EXPECT_LT(gape(type, dt), 1e-6) << int(type) << " 1/" << 1 / dt;
}

}  // namespace
}  // namespace brickfall
