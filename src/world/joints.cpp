// Joints: making, reading, changing and removing them. Every call checks first and changes nothing on an error.
#include <algorithm>
#include <cmath>
#include <initializer_list>

#include "world/checks.h"
#include "world/world_impl.h"

namespace brickfall {

namespace {

//! not of the method: what joint.h says
constexpr double kLargestTurnLimit = 3.1415926535897932;  // rad
constexpr double kLeastCone = 0.01, kLargestCone = 3;     // rad

bool isOneOf(JointType type, std::initializer_list<JointType> of) {
  return std::find(of.begin(), of.end(), type) != of.end();
}
bool hasAxis(JointType t) { return isOneOf(t, {JointType::spherical, JointType::revolute, JointType::prismatic}); }
bool hasMotor(JointType t) { return isOneOf(t, {JointType::revolute, JointType::prismatic}); }
bool hasTwoAnchors(JointType t) {
  return isOneOf(t, {JointType::distance, JointType::rope, JointType::spring, JointType::drag});
}
bool hasLength(JointType t) { return isOneOf(t, {JointType::distance, JointType::rope, JointType::spring}); }
bool isElastic(JointType t) { return isOneOf(t, {JointType::spring, JointType::drag}); }

void checkLimit(Checks& check, JointType type, const JointDef::Limit& limit) {
  const double most = type == JointType::prismatic ? limits::kLargestSize : kLargestTurnLimit;
  check.range("limit.lower", limit.lower, -most, most);
  check.range("limit.upper", limit.upper, -most, most);
  check.condition(limit.lower <= 0 && limit.upper >= 0, "limit: found " + numberText(limit.lower) + " .. " +
                                                            numberText(limit.upper) + ", expected lower <= 0 <= upper");
}

void checkMotor(Checks& check, const JointDef::Motor& motor) {
  check.range("motor.speed", motor.speed, -limits::kLargestSpeed, limits::kLargestSpeed);
  check.range("motor.strength", motor.strength, 0, limits::kLargestPush);
}

void checkLength(Checks& check, const std::string& at, double length) {
  check.range(at, length, limits::kSmallestSize, limits::kLargestSize);
}

// Infinity is fine.
void checkBreaking(Checks& check, double force, double torque) {
  check.condition(force > 0, "breakForce: found " + numberText(force) + ", expected more than 0, or infinity");
  check.condition(torque > 0, "breakTorque: found " + numberText(torque) + ", expected more than 0, or infinity");
}

void checkAxis(Checks& check, Vec3 axis) {
  const double square = lengthSquared(axis);
  check.condition(square > 1e-12 && square < 1e12, "axis: found a vector of length squared " + numberText(square) +
                                                       ", expected a finite one that is not zero");
}

void checkPlaces(Checks& check, const JointDef& def) {
  check.vector("anchor", def.anchor, limits::kLargestCoordinate);
  if (hasTwoAnchors(def.type) && def.anchorB) check.vector("anchorB", *def.anchorB, limits::kLargestCoordinate);
  if (hasAxis(def.type)) checkAxis(check, def.axis);
  if (!hasLength(def.type) || check.failed()) return;
  const double apart = length(def.anchorB.value_or(def.anchor) - def.anchor);
  if (def.length)
    checkLength(check, "length", *def.length);
  else
    checkLength(check, "length (as far as the anchors are apart)", apart);
  if (def.type == JointType::distance)
    check.condition(apart >= limits::kSmallestSize, "anchorB: found it at the anchor of A, expected it " +
                                                        numberText(limits::kSmallestSize) + " m away or more");
}

void checkJoint(Checks& check, const JointDef& def) {
  check.condition(int(def.type) < kJointTypeCount,
                  "type: found " + std::to_string(int(def.type)) + ", expected a JointType");
  checkPlaces(check, def);
  if (hasAxis(def.type) && def.limit) checkLimit(check, def.type, *def.limit);
  if (def.type == JointType::spherical && def.cone) check.range("cone", *def.cone, kLeastCone, kLargestCone);
  if (hasMotor(def.type) && def.motor) checkMotor(check, *def.motor);
  if (isElastic(def.type)) {
    check.range("stiffness", def.stiffness, 0, limits::kLargestPush);
    check.range("damping", def.damping, 0, limits::kLargestPush);
  }
  if (def.type == JointType::drag) check.range("strength", def.strength, 0, limits::kLargestPush);
  checkBreaking(check, def.breakForce, def.breakTorque);
}

Error notYet(const std::string& call) { return {ErrorCode::wrongState, call + ": joints are not there yet"}; }

}  // namespace

Result<JointId> World::createJoint(const JointDef& def) {
  Impl& w = *impl_;
  if (Status open = w.openForChange("createJoint"); !open) return open.error();
  Result<BodyIndex> a = w.registry.find(def.bodyA), b = w.registry.find(def.bodyB);
  if (!a) return Error{a.error().code, "bodyA: " + a.error().message};
  if (!b) return Error{b.error().code, "bodyB: " + b.error().message};
  Checks check;
  check.condition(*a != *b, "bodyB: found the same body as bodyA, expected another");
  checkJoint(check, def);
  if (check.failed()) return check.error();
  return notYet("createJoint");
}

Status World::destroyJoint(JointId) { return notYet("destroyJoint"); }
bool World::isValid(JointId) const { return false; }
Result<JointState> World::state(JointId) const { return notYet("state"); }
Result<JointDef> World::definition(JointId) const { return notYet("definition"); }
std::vector<JointId> World::joints() const { return {}; }
std::vector<JointId> World::joints(BodyId) const { return {}; }
Status World::setMotor(JointId, std::optional<JointDef::Motor>) { return notYet("setMotor"); }
Status World::setLimit(JointId, std::optional<JointDef::Limit>) { return notYet("setLimit"); }
Status World::setLength(JointId, double) { return notYet("setLength"); }
Status World::setTarget(JointId, Vec3) { return notYet("setTarget"); }
Status World::setBreaking(JointId, double, double) { return notYet("setBreaking"); }

}  // namespace brickfall
