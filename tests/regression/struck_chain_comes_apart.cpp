// A ball of 460 kg on a chain of forty links hits a wall. Steps of the direct solve ran out before rounds of joints'
// multipliers did, and ways that were cut short at obstacles were chords of turns by radians: links came apart.
#include "law/joint_parts.h"
#include "law/law.h"

namespace brickfall {
namespace {

using namespace law;

// m: largest gape of a joint.
double gape(double speed, double dt) {
  constexpr double kRadius = 0.25, kReach = 1.8, kLink = (kReach - kRadius) / 40;
  World world = makeWorld();
  addGround(world);
  for (int y = 0; y < 20; y++)
    for (int z = 0; z < 20; z++)
      addBox(world, {0.055, 0.0325, 0.11}, {kRadius + 0.065, 0.0325 + 0.065 * y, 0.22 * (z - 9.5) + 0.11 * (y % 2)});
  const Vec3 top{0, 0.4 + kReach, 0};
  BodyId last = addFixed(world, top);
  std::vector<JointId> joints;
  for (int i = 0; i <= 40; i++) {
    const bool ball = i == 40;
    const double down = ball ? kReach : (i + 0.5) * kLink;
    BodyDef def =
        bodyOf(ball ? sphereOf(kRadius, 7000) : boxOf({0.01, 0.5 * kLink - 0.002, 0.01}, 7000), top - Vec3{0, down, 0});
    def.linearVelocity = {speed * down / kReach, 0, 0};
    def.angularVelocity = {0, 0, speed / kReach};
    const BodyId next = add(world, def);
    joints.push_back(join(world, at(JointType::spherical, top - Vec3{0, i * kLink, 0}), last, next));
    last = next;
  }
  double most = 0;
  for (double t = 0; t < 0.75; t += dt) {
    EXPECT_TRUE(world.step(dt).ok());
    for (JointId joint : joints) most = std::max(most, world.state(joint)->error);
  }
  return most;
}

TEST(Regression, StruckChainComesApart) {
  for (double dt : {1.0 / 30, 1.0 / 60})
    for (double speed : {6.0, 8.0}) EXPECT_LT(gape(speed, dt), 0.3e-3) << speed << " m/s, 1/" << 1 / dt;
}

}  // namespace
}  // namespace brickfall
