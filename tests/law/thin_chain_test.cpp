// Row 30x: a chain as a newcomer writes it, fourteen thin rods of steel on ball joints with a ball of 1.4 t, that swings from 45
// degrees. Where anything ties a link's turn to its spin, about which it has next to no inertia, spins grow fourfold in a step.
#include <algorithm>

#include "law/law.h"

namespace brickfall::law {
namespace {

constexpr int kRods = 14;
constexpr double kRod = 0.25, kBall = 0.35, kSteel = 7850;  // m, m, kg/m3

struct ThinChain {
  World world = makeWorld();
  std::vector<JointId> joints;

  explicit ThinChain(double radius) {
    const Vec3 top{0, 20, 0}, out = normalized(Vec3{1, -1, 0});
    BodyId last = add(world, bodyOf(boxOf({0.1, 0.1, 0.1}), top, BodyType::fixed));
    auto hang = [&](const ShapeDef& shape, double from, double centre) {
      BodyDef def = bodyOf(shape, top + out * centre);
      def.rotation = quatFromAxisAngle({0, 0, 1}, kPi / 4);
      JointDef joint;
      joint.type = JointType::spherical;
      joint.anchor = top + out * from;
      joint.bodyA = last;
      joint.bodyB = last = add(world, def);
      joints.push_back(world.createJoint(joint).value());
    };
    for (int i = 0; i < kRods; i++) hang(cylinderOf(radius, 0.5 * kRod, kSteel), i * kRod, (i + 0.5) * kRod);
    hang(sphereOf(kBall, kSteel), kRods * kRod, kRods * kRod + kBall);
  }
  double energy() const { return world.energy().kinetic + world.energy().potential; }
};

TEST(Law, Row30xAChainOfThinRodsStaysClosed) {
  for (double radius : {0.02, 0.01})
    for (double dt : {1.0 / 60, 1.0 / 120, 1.0 / 240}) {
      ThinChain chain(radius);
      double error = 0, rise = 0;
      const double start = chain.energy(), moves = 1400 * kG * kRods * kRod;
      for (int i = 0; i < std::lround(3 / dt); i++) {
        ASSERT_TRUE(chain.world.step(dt).ok());
        for (JointId joint : chain.joints) error = std::max(error, chain.world.state(joint)->error);
        rise = std::max(rise, chain.energy() - start);
      }
      expectSound(chain.world);
      const std::string rods = "rods of " + text(1e3 * radius, 0) + " mm: ";
      atMost(rods + "error of a joint", dt, 1e3 * error, 0.1, "mm");
      atMost(rods + "energy over the start", dt, 1e6 * rise / moves, 5, "millionths of what moves");
      atMost(rods + "energy lost in 3 s", dt, 100 * (start - chain.energy()) / moves, 0.5, "% of what moves");
    }
}

}  // namespace
}  // namespace brickfall::law
