// What laws of joints are built from.
#pragma once
#include "law/law.h"

namespace brickfall::law {

inline JointId join(World& world, JointDef def, BodyId a, BodyId b) {
  def.bodyA = a;
  def.bodyB = b;
  Result<JointId> joint = world.createJoint(def);
  EXPECT_TRUE(joint.ok()) << joint.error().message;
  return joint.ok() ? *joint : JointId{};
}
inline JointDef at(JointType type, Vec3 anchor, Vec3 axis = {0, 0, 1}) {
  JointDef def;
  def.type = type;
  def.anchor = anchor;
  def.axis = axis;
  return def;
}
inline BodyId addFixed(World& world, Vec3 position) {
  return add(world, bodyOf(boxOf({0.1, 0.1, 0.1}), position, BodyType::fixed));
}
// A world that is turned as a whole, gravity and all: no axis of its joints is one of the world's, and no number of it is
// exactly 0.
inline Quat askew() { return turn({1, 2, 3}, 97); }
inline World turnedWorld(Quat turned) {
  WorldDef def;
  def.gravity = rotate(turned, def.gravity);
  return makeWorld(def);
}
inline BodyId addTurned(World& world, Quat turned, BodyDef def) {
  def.position = rotate(turned, def.position);
  def.rotation = turned * def.rotation;
  return add(world, def);
}
inline JointDef turnedBy(Quat turned, JointDef def) {
  def.anchor = rotate(turned, def.anchor);
  def.axis = rotate(turned, def.axis);
  return def;
}
inline std::string orAskew(Quat turned) { return turned == Quat{} ? "" : ", askew"; }
inline double energyOf(const World& world) { return world.energy().kinetic + world.energy().potential; }

}  // namespace brickfall::law
