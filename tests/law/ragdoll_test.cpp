// Row 30n: fifteen bodies on joints with limits fall down a flight of stairs.
#include <algorithm>

#include "law/law.h"

namespace brickfall::law {
namespace {

class Ragdoll {
 public:
  World world = makeWorld();
  std::vector<BodyId> parts;
  std::vector<JointId> joints;

  // Ten steps of 0.3 by 0.18 m; the doll stands on the landing above them, leans and goes.
  Ragdoll(double lean, Vec3 about, double speed)
      : up_{0, 2.9 + 0.25 * lean, 0}, lean_(quatFromAxisAngle(normalized(about), -lean)), speed_(speed) {
    addGround(world);
    for (int i = 0; i < 10; i++) {
      const double half = 0.09 * (10 - i);
      add(world, bodyOf(boxOf({0.15, half, 1.5}), {0.3 * i - 0.15, half, 0}, BodyType::fixed));
    }
    add(world, bodyOf(boxOf({1, 0.9, 1.5}), {-1.3, 0.9, 0}, BodyType::fixed));
    const BodyId pelvis = part({0.1, 0.08, 0.15}, {0, 0, 0}), torso = part({0.1, 0.22, 0.17}, {0, 0.34, 0});
    const BodyId head = part({0.09, 0.11, 0.09}, {0, 0.72, 0});
    ball(pelvis, torso, {0, 0.1, 0}, {0, 1, 0}, 0.5, 0.4);
    ball(torso, head, {0, 0.58, 0}, {0, 1, 0}, 0.6, 0.8);
    for (double side : {-1.0, 1.0}) {
      const double z = 0.24 * side, w = 0.09 * side;
      const BodyId upper = part({0.045, 0.14, 0.045}, {0, 0.4, z}), fore = part({0.04, 0.13, 0.04}, {0, 0.11, z});
      const BodyId hand = part({0.02, 0.08, 0.045}, {0, -0.12, z}), thigh = part({0.07, 0.2, 0.07}, {0, -0.3, w});
      const BodyId shin = part({0.05, 0.2, 0.05}, {0, -0.72, w}), foot = part({0.12, 0.03, 0.045}, {0.06, -0.97, w});
      ball(torso, upper, {0, 0.54, 0.2 * side}, {0, -1, 0}, 1.5, 1);
      hinge(upper, fore, {0, 0.25, z}, {0, 2.4});
      ball(fore, hand, {0, -0.03, z}, {0, -1, 0}, 0.6, 0.5);
      ball(pelvis, thigh, {0, -0.09, w}, {0, -1, 0}, 1.2, 0.6);
      hinge(thigh, shin, {0, -0.51, w}, {-2.4, 0});
      ball(shin, foot, {0, -0.93, w}, {0, -1, 0}, 0.5, 0.4);
    }
  }
  double energy() const { return world.energy().kinetic + world.energy().potential; }
  // m/s, of the fastest part that presses on something. A shin that touches nothing swings on: its knee has no friction.
  double fastestThatPresses() const {
    double fastest = 0;
    bool presses = false;
    world.forEachContact([&](const ContactView& contact) {
      double force = 0;
      for (int i = 0; i < contact.pointCount; i++) force += contact.points[i].normalForce;
      if (!(force > 0)) return;
      presses = true;
      for (BodyId body : {contact.bodyA, contact.bodyB})
        fastest = std::max(fastest, length(world.state(body)->linearVelocity));
    });
    EXPECT_TRUE(presses) << "nothing lies on anything";
    return fastest;
  }

 private:
  BodyId part(Vec3 half, Vec3 place) {
    BodyDef def = bodyOf(boxOf(half), up_ + rotate(lean_, place));
    def.rotation = lean_;
    def.linearVelocity = {speed_, 0, 0};
    return parts.emplace_back(add(world, def));
  }
  void join(JointDef def) {
    def.anchor = up_ + rotate(lean_, def.anchor);
    def.axis = rotate(lean_, def.axis);
    Result<JointId> joint = world.createJoint(def);
    EXPECT_TRUE(joint.ok()) << joint.error().message;
    if (joint) joints.push_back(*joint);
  }
  void ball(BodyId a, BodyId b, Vec3 anchor, Vec3 axis, double cone, double twist) {
    join({.bodyA = a,
          .bodyB = b,
          .anchor = anchor,
          .axis = axis,
          .limit = JointDef::Limit{-twist, twist},
          .cone = cone});
  }
  void hinge(BodyId a, BodyId b, Vec3 anchor, JointDef::Limit limit) {
    join({.type = JointType::revolute, .bodyA = a, .bodyB = b, .anchor = anchor, .axis = {0, 0, 1}, .limit = limit});
  }

  Vec3 up_;
  Quat lean_;
  double speed_;
};

TEST(Law, Row30nARagdollFallsDownStairs) {
  const int falls = 6;  // in one alone chance decides whether joints snap
  double error = 0, over = 0, gains = 0, fastest = 0, pressing = 0;
  for (int fall = 0; fall < falls; fall++) {
    const double k = 0.4 * fall;
    Ragdoll doll(0.1 + 0.4 * k, {0.2 * k, 0.6 * k, 1}, 1 + 2 * k);
    double last = doll.energy(), gained = 0;
    for (int n = 0; n < 420; n++) {
      ASSERT_TRUE(doll.world.step(kDt).ok());
      for (JointId joint : doll.joints) {
        const JointState s = *doll.world.state(joint);
        error = std::max(error, s.error);
        over = std::max(over, s.turnError);
      }
      gained = std::max(gained, doll.energy() - last);
      last = doll.energy();
    }
    gains += gained;
    EXPECT_TRUE(doll.world.validate().empty());
    pressing = std::max(pressing, doll.fastestThatPresses());
    for (BodyId part : doll.parts) {
      fastest = std::max(fastest, length(doll.world.state(part)->linearVelocity));
      EXPECT_LT(doll.world.state(part)->position.y, 2.2) << "it fell";
    }
  }
  atMost("six falls: joints gape", kDt, error, 1e-3, "m");
  atMost("six falls: turns beyond their limits", kDt, over, 0.02, "rad", 0.25);
  atMost("six falls: largest energy gained in a step, mean", kDt, gains / falls, 1e-3, "J");
  atMost("six falls: fastest part that presses after 7 s", kDt, pressing, 0.01, "m/s");
  atMost("six falls: fastest part after 7 s", kDt, fastest, 0.01, "m/s", 0.5);
}

}  // namespace
}  // namespace brickfall::law
