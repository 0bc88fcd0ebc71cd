// Two boxes on a joint fly, and turn by one or two radians in a step. No solve follows so long arcs, and what flew was
// not taken again in shorter parts: the boxes went straight on, half a metre apart, and lost nearly all of their energy.
#include "law/random_linkage.h"

namespace brickfall {
namespace {

using namespace test;

TEST(Regression, LinkageThatSpinsInTheAirComesApart) {
  for (JointType type : {JointType::spherical, JointType::revolute})
    for (double dt : {1.0 / 30, 1.0 / 60}) {
      World world = makeWorld();
      JointDef joint;
      joint.type = type;
      joint.axis = {1, 0.5, 0};
      joint.anchor = {0, 0.1, 0};
      const Vec3 spin = normalized(Vec3{0.3, 0.8, 0.5}) * 60.0;
      for (BodyId* body : {&joint.bodyA, &joint.bodyB}) {
        BodyDef def = bodyOf(boxOf({0.1, 0.1, 0.1}), {0, body == &joint.bodyA ? 0 : 0.2, 0});
        def.angularVelocity = spin;
        def.linearVelocity = Vec3{0, 5, 0} + cross(spin, def.position - joint.anchor);
        *body = add(world, def);
      }
      Result<JointId> made = world.createJoint(joint);
      ASSERT_TRUE(made.ok());
      const double start = world.energy().kinetic + world.energy().potential;
      double most = 0;
      for (double t = 0; t < 1; t += dt) {
        ASSERT_TRUE(world.step(dt).ok());
        most = std::max(most, world.state(*made)->error);
      }
      EXPECT_LT(most, 2e-3) << int(type) << " 1/" << 1 / dt;
      EXPECT_GT(world.energy().kinetic + world.energy().potential, 0.99 * start) << int(type) << " 1/" << 1 / dt;
    }
}

// A limb that whips round in a fall: all eight joints were open in one step, by up to 0.11 of a body.
TEST(Regression, FallingLinkageIsTornApart) {
  law::RandomLinkage linkage = law::drawLinkage(law::LinkageKind::falls, 628);
  double most = 0;
  for (int i = 0; i < linkage.steps; i++) {
    ASSERT_TRUE(linkage.world.step(linkage.dt, linkage.substeps).ok());
    for (std::size_t k = 0; k < linkage.joints.size(); k++)
      most = std::max(most, linkage.world.state(linkage.joints[k])->error / linkage.spans[k]);
  }
  EXPECT_LT(most, 0.02);
}

}  // namespace
}  // namespace brickfall
