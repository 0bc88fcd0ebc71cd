// Joints: making, reading, changing and removing them. Every call checks first and changes nothing on an error.
#include <algorithm>
#include <cmath>
#include <initializer_list>

#include "solver/joint/equations.h"
#include "world/checks.h"
#include "world/tie_calls.h"
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

// The frame whose first axis is this one.
Quat frameAlong(Vec3 axis) {
  const Vec3 x{1, 0, 0}, to = normalized(axis);
  if (dot(x, to) < -0.999999) return {0, 0, 1, 0};
  const Vec3 across = cross(x, to);
  return normalized(Quat{across.x, across.y, across.z, 1 + dot(x, to)});
}

void setMotorOf(Joint& joint, const std::optional<JointDef::Motor>& motor) {
  joint.driven = motor.has_value();
  joint.speed = motor ? motor->speed : 0;
  joint.strength = motor ? motor->strength : 0;
}
void setLimitOf(Joint& joint, const std::optional<JointDef::Limit>& limit) {
  joint.limited = limit.has_value();
  joint.lower = limit ? limit->lower : 0;
  joint.upper = limit ? limit->upper : 0;
}

Vec3 toBody(const BodySet& bodies, BodyIndex body, Vec3 pointWorld) {
  return transposeTimes(bodies.motion[body].orientation, pointWorld - bodies.origin(body));
}

Joint jointFrom(const JointDef& def, BodyIndex a, BodyIndex b, const BodySet& bodies) {
  Joint joint;
  joint.type = def.type;
  joint.collide = def.collide;
  joint.bodyA = a;
  joint.bodyB = b;
  joint.userData = def.userData;
  const Vec3 onB = hasTwoAnchors(def.type) ? def.anchorB.value_or(def.anchor) : def.anchor;
  joint.anchorA = toBody(bodies, a, def.anchor);
  joint.anchorB = toBody(bodies, b, onB);
  const Quat frame = hasAxis(def.type) ? frameAlong(def.axis) : Quat{};
  joint.frameA = normalized(conjugate(bodies.motion[a].rotation) * frame);
  joint.frameB = normalized(conjugate(bodies.motion[b].rotation) * frame);
  if (hasAxis(def.type)) setLimitOf(joint, def.limit);
  joint.coned = def.type == JointType::spherical && def.cone;
  if (joint.coned) joint.cone = *def.cone;
  if (hasMotor(def.type)) setMotorOf(joint, def.motor);
  if (hasLength(def.type)) joint.length = def.length.value_or(length(onB - def.anchor));
  if (isElastic(def.type)) {
    joint.stiffness = def.stiffness;
    joint.damping = def.damping;
  }
  if (def.type == JointType::drag) joint.strength = def.strength;
  joint.breakForce = def.breakForce;
  joint.breakTorque = def.breakTorque;
  return joint;
}

JointState stateOf(const Joint& joint, const Registry& registry) {
  const BodySet& bodies = registry.bodies;
  const BodyMotion &a = bodies.motion[joint.bodyA], &b = bodies.motion[joint.bodyB];
  const JointPose pose(joint, bodies);
  const JointSystem system = equationsOf(joint, pose);
  JointState s;
  s.type = joint.type;
  s.bodyA = registry.idOf(joint.bodyA);
  s.bodyB = registry.idOf(joint.bodyB);
  s.anchorA = pose.pointA;
  s.anchorB = pose.pointA + pose.way;
  if (hasAxis(joint.type)) s.axis = rotate(pose.frameA, Vec3{1, 0, 0});
  s.force = joint.force + joint.earlierForce;
  // Forces act at the joint's centre; the torque is told about the anchor of B.
  s.torque = joint.torque + joint.earlierTorque - cross(pose.way * (1 - system.onB), s.force);
  s.position = system.position;
  const Vec3 spin = b.angularVelocity - a.angularVelocity;
  const Vec3 speed = velocityAgainst(a, b, pose.armA + pose.way * (hasAxis(joint.type) ? 1.0 : 0.0), pose.armB);
  s.speed = isOneOf(joint.type, {JointType::spherical, JointType::revolute}) ? dot(s.axis, spin)
            : joint.type == JointType::prismatic                             ? dot(s.axis, speed)
            : hasTwoAnchors(joint.type)                                      ? dot(system.way.axes[0], speed)
                                                                             : 0;
  s.error = errorOf(system.way);
  s.turnError = errorOf(system.turn);
  s.awake = bodies.data[joint.bodyA].activity == BodyActivity::awake ||
            bodies.data[joint.bodyB].activity == BodyActivity::awake;
  s.userData = joint.userData;
  return s;
}

JointDef definitionOf(const Joint& joint, const Registry& registry) {
  const JointPose pose(joint, registry.bodies);
  JointDef def;
  def.type = joint.type;
  def.bodyA = registry.idOf(joint.bodyA);
  def.bodyB = registry.idOf(joint.bodyB);
  def.anchor = pose.pointA;
  if (hasTwoAnchors(joint.type)) def.anchorB = pose.pointA + pose.way;
  if (hasAxis(joint.type)) def.axis = rotate(pose.frameA, Vec3{1, 0, 0});
  if (joint.limited) def.limit = {joint.lower, joint.upper};
  if (joint.coned) def.cone = joint.cone;
  if (joint.driven) def.motor = {joint.speed, joint.strength};
  if (hasLength(joint.type)) def.length = joint.length;
  if (isElastic(joint.type)) {
    def.stiffness = joint.stiffness;
    def.damping = joint.damping;
  }
  if (joint.type == JointType::drag) def.strength = joint.strength;
  def.breakForce = joint.breakForce;
  def.breakTorque = joint.breakTorque;
  def.collide = joint.collide;
  def.userData = joint.userData;
  return def;
}

void checkType(Checks& check, const std::string& call, bool fits) {
  check.condition(fits, call + ": found a joint of a type that has none");
}

}  // namespace

Result<JointId> World::createJoint(const JointDef& def) {
  Impl& w = *impl_;
  if (Status open = w.openForChange("createJoint"); !open) return open.error();
  const auto ends = bodiesToTie(def, w.registry, [&](Checks& check) { checkJoint(check, def); });
  if (!ends) return ends.error();
  const Joint joint = jointFrom(def, ends->first, ends->second, w.registry.bodies);
  return tieId<JointId>(w.ties.joints, w.upkeep().join(joint), w.registry);
}

Result<JointIndex> World::Impl::openForChange(const std::string& call, JointId id) const {
  if (Status open = openForChange(call); !open) return open.error();
  return findTie(ties.joints, id, registry, "joint");
}

Status World::destroyJoint(JointId id) {
  Result<JointIndex> joint = impl_->openForChange("destroyJoint", id);
  if (!joint) return joint.error();
  impl_->upkeep().unjoin(*joint);
  return {};
}

bool World::isValid(JointId id) const { return findTie(impl_->ties.joints, id, impl_->registry, "joint").ok(); }

Result<JointState> World::state(JointId id) const {
  const Impl& w = *impl_;
  Result<JointIndex> index = findTie(w.ties.joints, id, w.registry, "joint");
  if (!index) return index.error();
  return stateOf(w.ties.joints.slots[*index], w.registry);
}

Result<JointDef> World::definition(JointId id) const {
  const Impl& w = *impl_;
  Result<JointIndex> index = findTie(w.ties.joints, id, w.registry, "joint");
  if (!index) return index.error();
  return definitionOf(w.ties.joints.slots[*index], w.registry);
}

std::vector<JointId> World::joints() const {
  return tieIds<JointId>(impl_->ties.joints, impl_->registry, [](const Joint&) { return true; });
}
std::vector<JointId> World::joints(BodyId id) const { return tieIds<JointId>(impl_->ties.joints, impl_->registry, id); }

template <class Check, class Change>
Status World::Impl::changeJoint(const std::string& call, JointId id, Check&& check, Change&& change) {
  Result<JointIndex> joint = openForChange(call, id);
  if (!joint) return joint.error();
  Checks checks;
  check(checks, ties.joints.slots[*joint].type);
  if (checks.failed()) return checks.error();
  change(ties.joints.slots[*joint]);
  upkeep().disturbJoint(*joint);
  return {};
}

Status World::setMotor(JointId id, std::optional<JointDef::Motor> motor) {
  return impl_->changeJoint(
      "setMotor", id,
      [&](Checks& check, JointType type) {
        checkType(check, "motor", hasMotor(type));
        if (motor) checkMotor(check, *motor);
      },
      [&](Joint& joint) { setMotorOf(joint, motor); });
}

Status World::setLimit(JointId id, std::optional<JointDef::Limit> limit) {
  return impl_->changeJoint(
      "setLimit", id,
      [&](Checks& check, JointType type) {
        checkType(check, "limit", hasAxis(type));
        if (limit) checkLimit(check, type, *limit);
      },
      [&](Joint& joint) {
        const double lower = joint.lower, upper = joint.upper;
        setLimitOf(joint, limit);
        joint.wound += std::fabs(joint.lower - lower) + std::fabs(joint.upper - upper);
      });
}

Status World::setLength(JointId id, double length) {
  return impl_->changeJoint(
      "setLength", id,
      [&](Checks& check, JointType type) {
        checkType(check, "length", hasLength(type));
        checkLength(check, "length", length);
      },
      [&](Joint& joint) {
        joint.wound += std::fabs(length - joint.length);
        joint.length = length;
      });
}

Status World::setTarget(JointId id, Vec3 pointWorld) {
  const BodySet& bodies = impl_->registry.bodies;
  return impl_->changeJoint(
      "setTarget", id,
      [&](Checks& check, JointType type) {
        checkType(check, "target", type == JointType::drag);
        check.vector("pointWorld", pointWorld, limits::kLargestCoordinate);
      },
      [&](Joint& joint) { joint.anchorA = toBody(bodies, joint.bodyA, pointWorld); });
}

Status World::setBreaking(JointId id, double breakForce, double breakTorque) {
  return impl_->changeJoint(
      "setBreaking", id, [&](Checks& check, JointType) { checkBreaking(check, breakForce, breakTorque); },
      [&](Joint& joint) {
        joint.breakForce = breakForce;
        joint.breakTorque = breakTorque;
      });
}

}  // namespace brickfall
