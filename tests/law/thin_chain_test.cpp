// Row 30x: a chain as a newcomer writes it, fourteen thin rods of steel on ball joints with a ball of 1.4 t, that swings from 45
// degrees. Where anything ties a link's turn to its spin, about which it has next to no inertia, spins grow fourfold in a step.
// Rows 30y and 30z: the same also goes aside, so that forces do not lie in one plane with all links. There a force that acts
// beside a link's axis by micrometres spins it, and the chain came apart.
#include <algorithm>

#include "law/law.h"

namespace brickfall::law {
namespace {

constexpr int kRods = 14;
constexpr double kRod = 0.25, kBall = 0.35, kSteel = 7850;  // m, m, kg/m3

struct ThinChain {
  World world = makeWorld();
  std::vector<JointId> joints;
  std::vector<BodyId> bodies;

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
      bodies.push_back(last);
    };
    for (int i = 0; i < kRods; i++) hang(cylinderOf(radius, 0.5 * kRod, kSteel), i * kRod, (i + 0.5) * kRod);
    hang(sphereOf(kBall, kSteel), kRods * kRod, kRods * kRod + kBall);
  }
  // All of it, as it would go about the top.
  void goAside(double speed) {
    for (BodyId body : bodies) {
      const double far = length(world.state(body)->centreOfMass - Vec3{0, 20, 0}) / (kRods * kRod + kBall);
      ASSERT_TRUE(world.setLinearVelocity(body, {0, 0, speed * far}).ok());
    }
  }
  double energy() const { return world.energy().kinetic + world.energy().potential; }
};

// 3 s. `aside`: m/s of the ball, across the plane in which the chain hangs. `open`, mm: of a joint, at most. `lost`: % of
// what moves.
void swings(double radius, double dt, double aside, double open, double lost) {
  ThinChain chain(radius);
  if (aside > 0) chain.goAside(aside);
  double error = 0, rise = 0;
  const double start = chain.energy(), moves = 1400 * kG * kRods * kRod;
  for (int i = 0; i < std::lround(3 / dt); i++) {
    ASSERT_TRUE(chain.world.step(dt).ok());
    for (JointId joint : chain.joints) error = std::max(error, chain.world.state(joint)->error);
    rise = std::max(rise, chain.energy() - start);
  }
  expectSound(chain.world);
  const std::string rods = "rods of " + text(1e3 * radius, 0) + " mm: ";
  atMost(rods + "error of a joint", dt, 1e3 * error, open, "mm");
  atMost(rods + "energy over the start", dt, 1e6 * rise / moves, 5, "millionths of what moves");
  atMost(rods + "energy lost in 3 s", dt, 100 * (start - chain.energy()) / moves, lost, "% of what moves");
}

// Beads on ropes from centre to centre. Where they went slack, no solve ended: its limits were those of a line that lies.
TEST(Law, Row30pARowOfRopesUnderATonStaysClosed) {
  for (const auto& [radius, dt] :
       {std::pair{0.01, 1.0 / 60}, {0.005, 1.0 / 60}, {0.003, 1.0 / 60}, {0.01, 1.0 / 120}}) {
    World world = makeWorld();
    const Vec3 top{0, 20, 0}, out = normalized(Vec3{1, -1, 0});
    BodyId last = add(world, bodyOf(boxOf({0.1, 0.1, 0.1}), top, BodyType::fixed));
    std::vector<JointId> joints;
    const auto hang = [&](double size, double from, double to) {
      JointDef rope;
      rope.type = JointType::rope;
      rope.anchor = top + out * from;
      rope.anchorB = top + out * to;
      rope.bodyA = last;
      rope.bodyB = last = add(world, bodyOf(sphereOf(size, kSteel), top + out * to));
      joints.push_back(world.createJoint(rope).value());
    };
    for (int i = 0; i < kRods; i++) hang(radius, i * kRod, (i + 1) * kRod);
    hang(kBall, kRods * kRod, kRods * kRod + kBall);
    const auto energy = [&] { return world.energy().kinetic + world.energy().potential; };
    const double start = energy();
    double error = 0, rise = 0;
    for (int i = 0; i < std::lround(2 / dt); i++) {
      ASSERT_TRUE(world.step(dt).ok());
      for (JointId joint : joints) error = std::max(error, world.state(joint)->error);
      rise = std::max(rise, energy() - start);
    }
    expectSound(world);
    const std::string beads = "beads of " + text(1e3 * radius, 0) + " mm on ropes: ";
    atMost(beads + "error of a joint", dt, 1e3 * error, 0.5, "mm");
    atMost(beads + "energy over the start", dt, 1e6 * rise / (1400 * kG * kRods * kRod), 5, "millionths of what moves");
  }
}

TEST(Law, Row30xAChainOfThinRodsStaysClosed) {
  for (double radius : {0.02, 0.01})
    for (double dt : {1.0 / 60, 1.0 / 120, 1.0 / 240}) swings(radius, dt, 0, 0.1, 0.5);
}

TEST(Law, Row30yAChainOfThinRodsThatGoesAsideStaysClosed) {
  for (double radius : {0.01, 0.005})
    for (double dt : {1.0 / 30, 1.0 / 60, 1.0 / 120})
      swings(radius, dt, 2, dt > 1.0 / 40 ? 0.5 : 0.1, dt > 1.0 / 40 ? 3 : 0.5);
}

TEST(Law, Row30zAWireThatHoldsATonStaysClosed) {
  for (double radius : {0.003, 0.002}) swings(radius, 1.0 / 120, 2, 0.1, 1);
}

}  // namespace
}  // namespace brickfall::law
