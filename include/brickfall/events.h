// What happened in the last step, and between it and the one before (bodies destroyed, moved or woken by calls). Valid
// until the next step or restore. A body destroyed since may still be named in `end`.
#pragma once
#include <vector>

#include "brickfall/ids.h"
#include "brickfall/math.h"
#include "brickfall/mortar.h"

namespace brickfall {

// Two shapes of two bodies began to press on each other, or ceased to. bodyA < bodyB by creation. Bodies of several shapes
// have an event for each pair of shapes.
struct ContactEvent {
  BodyId bodyA, bodyB;
  ShapeId shapeA, shapeB;  // of these bodies; may be destroyed in `end`
};

// An impact: two bodies met faster than WorldDef::hitEventSpeed.
struct HitEvent {
  BodyId bodyA, bodyB;
  ShapeId shapeA, shapeB;    // of these bodies: those that met
  Vec3 pointWorld;           // m, mean of the contact points
  Vec3 normalWorld;          // unit, from A to B
  double approachSpeed = 0;  // m/s along the normal, before the step
  double impulse = 0;        // N s along the normal during the step
};

// A joint broke. It is gone, its id stale.
struct BreakEvent {
  JointId joint;
  BodyId bodyA, bodyB;
  Vec3 pointWorld;     // m: where it held
  Vec3 force, torque;  // N, N m, from A on B: under which it broke
};

// Mortar cracked: the first of the energy that breaks it is spent. Or it broke; its id stays valid. Or it was dropped: a
// body was replaced by pieces of which none has its whole face; its id has ended, one of its bodies is gone.
struct MortarEvent {
  MortarId mortar;
  BodyId bodyA, bodyB;
  Vec3 pointWorld;                     // m: the face's centre
  MortarMode mode = MortarMode::none;  // that took more of it
  double energy = 0;                   // J, spent on it so far
  bool broken = false;
  bool dropped = false;
};

// A shape of a dynamic or kinematic body came into a sensor, or left it: at the poses after the step. Either may be destroyed
// in `sensorEnd`. Sensors do not sense each other, nor fixed bodies.
struct SensorEvent {
  ShapeId sensor, shape;
  BodyId sensorBody, body;
  auto operator<=>(const SensorEvent&) const = default;
};

struct Events {
  std::vector<ContactEvent> begin;
  std::vector<ContactEvent> end;
  std::vector<HitEvent> hits;
  std::vector<BreakEvent> breaks;
  std::vector<MortarEvent> mortar;
  std::vector<SensorEvent> sensorBegin;  // by sensor, then shape, each in order of its slot
  std::vector<SensorEvent> sensorEnd;
  std::vector<BodyId> moved;  // bodies whose pose changed in the step
  std::vector<BodyId> fellAsleep;
  std::vector<BodyId> woke;
};

}  // namespace brickfall
