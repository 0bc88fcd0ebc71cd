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
inline double energyOf(const World& world) { return world.energy().kinetic + world.energy().potential; }

}  // namespace brickfall::law
