#include "dynamics/point_memory.h"

#include <cmath>

namespace brickfall {

namespace {

bool inRange(float x, PointQuantity quantity) {
  const bool length = std::fabs(x) <= kLargestPointLength, force = std::fabs(x) <= kLargestPointForce;
  switch (quantity) {
    case PointQuantity::length:
      return length;
    case PointQuantity::overlap:
      return length && x <= 0;
    case PointQuantity::force:
      return force;
    case PointQuantity::pressure:
      return force && x >= 0;
    case PointQuantity::stiffness:
      return force && (x == 0 || x >= kLeastPointStiffness);
  }
  return false;
}

struct RangeCheck {
  bool sound = true;
  void operator()(const float (&lanes)[4], PointQuantity quantity) {
    for (float x : lanes) sound = sound && inRange(x, quantity);
  }
  void operator()(const std::uint32_t (&)[4]) {}  // features: any number is one
  void operator()(const PointPhase (&phases)[4]) {
    for (PointPhase phase : phases) sound = sound && phase <= PointPhase::resting;
  }
  void operator()(std::uint32_t mask) { sound = sound && mask < 16; }
};

}  // namespace

bool isSound(const PointMemory& m) {
  RangeCheck check;
  eachField(m, check);
  for (int i = 0; i < 4; i++) check.sound = check.sound && (m.phase[i] == PointPhase::fresh) == (m.stiffness[i] == 0);
  return check.sound;
}

void clearPoint(PointMemory& m, int i) {
  m.phase[i] = PointPhase::fresh;
  m.stiffness[i] = m.offset[i] = 0;
  m.multiplierN[i] = m.multiplier1[i] = m.multiplier2[i] = 0;
  m.forceN[i] = m.force1[i] = m.force2[i] = 0;
  m.slip1[i] = m.slip2[i] = 0;
  m.impulse[i] = m.impactSpeed[i] = 0;
  m.impactMask &= ~(1u << i);
  m.stickingMask &= ~(1u << i);
}

void addHit(PointMemory& m, int i, float n, float t1, float t2) {
  m.hitN[i] += n;
  m.hit1[i] += t1;
  m.hit2[i] += t2;
}
void endHit(PointMemory& m, int i) { m.hitN[i] = m.hit1[i] = m.hit2[i] = 0; }

void scaleForces(PointMemory& m, int i, float share) {
  m.multiplierN[i] = m.forceN[i] *= share;
  m.multiplier1[i] = m.force1[i] *= share;
  m.multiplier2[i] = m.force2[i] *= share;
}

void carryOver(PointMemory& to, int i, const PointMemory& from, int j, const TangentTurn& turn) {
  auto along1 = [&](float a, float b) { return a * turn.m[0] + b * turn.m[1]; };
  auto along2 = [&](float a, float b) { return a * turn.m[2] + b * turn.m[3]; };
  to.phase[i] = from.phase[j];
  to.stiffness[i] = from.stiffness[j];
  to.offset[i] = from.offset[j];
  to.multiplierN[i] = from.multiplierN[j];
  to.multiplier1[i] = along1(from.multiplier1[j], from.multiplier2[j]);
  to.multiplier2[i] = along2(from.multiplier1[j], from.multiplier2[j]);
  to.forceN[i] = from.forceN[j];
  to.force1[i] = along1(from.force1[j], from.force2[j]);
  to.force2[i] = along2(from.force1[j], from.force2[j]);
  to.slip1[i] = along1(from.slip1[j], from.slip2[j]);
  to.slip2[i] = along2(from.slip1[j], from.slip2[j]);
  to.impulse[i] = from.impulse[j];
  to.impactSpeed[i] = from.impactSpeed[j];
  to.hitN[i] = from.hitN[j];
  to.hit1[i] = along1(from.hit1[j], from.hit2[j]);
  to.hit2[i] = along2(from.hit1[j], from.hit2[j]);
  if (from.impactMask >> j & 1) to.impactMask |= 1u << i;
  if (from.sticks(j)) to.stickingMask |= 1u << i;
}

}  // namespace brickfall
