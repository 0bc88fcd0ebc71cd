#include "dynamics/mortar_set.h"

#include <cmath>

#include "dynamics/tie_ranges.h"

namespace brickfall {

MortarPose::MortarPose(const Mortar& mortar, const BodySet& bodies) {
  const BodyMotion &a = bodies.motion[mortar.bodyA], &b = bodies.motion[mortar.bodyB];
  const Mat3 faceA = toMatrix(a.rotation * mortar.frameA), faceB = toMatrix(b.rotation * mortar.frameB);
  n = faceA.column(0);
  t1 = faceA.column(1);
  t2 = faceA.column(2);
  const Vec3 toA = a.orientation * (mortar.centreA - bodies.data[mortar.bodyA].localCentre);
  const Vec3 toB = b.orientation * (mortar.centreB - bodies.data[mortar.bodyB].localCentre);
  const Vec3 apart = (b.position - a.position) + (toB - toA);
  armA = toA + apart * 0.5;
  armB = toB - apart * 0.5;
  centre = a.position + armA;
  auto inFace = [&](Vec3 v) { return Vec3{dot(n, v), dot(t1, v), dot(t2, v)}; };
  displaced = inFace(apart);
  along1 = inFace(faceB.column(1) - t1);
  along2 = inFace(faceB.column(2) - t2);
}

MortarMode modeOf(const Mortar& m) {
  if (!(m.tensionWork > 0) && !(m.shearWork > 0)) return MortarMode::none;
  return m.tensionWork / m.strength.tensionEnergy >= m.shearWork / m.strength.shearEnergy ? MortarMode::tension
                                                                                          : MortarMode::shear;
}

void MortarSet::breakUp(MortarIndex index) {
  letCollide(index);
  Mortar& m = slots[index];
  m.broken = m.idle = true;
  m.damage = 1;
  m.force = m.torque = {};
}

void MortarSet::renewConstants(BodyIndex body, const ShapeSet&, const BodySet& bodies) {
  renewIdle(body, [&](BodyIndex b) { return bodies.data[b].type == BodyType::dynamic; });
}

void MortarSet::hash(Mix& h, MortarIndex mortar) const {
  const Mortar& m = slots[mortar];
  h(m.order, m.damage, m.tensionWork, m.shearWork, m.centreA, m.force, m.torque);
  h.list(m.opening, kMortarPoints).list(m.slip1, kMortarPoints).list(m.slip2, kMortarPoints);
}

namespace {

template <class Archive, class One> void archiveMortar(Archive& a, One& m) {
  for (auto* flag : {&m.born, &m.idle, &m.cracked, &m.broken}) a.flag(*flag);
  for (auto* body : {&m.bodyA, &m.bodyB}) a.value(*body);
  for (auto* number : {&m.order, &m.userData}) a.value(*number);
  for (auto* place : {&m.centreA, &m.centreB}) a.value(*place);
  for (auto* frame : {&m.frameA, &m.frameB}) a.value(*frame);
  for (auto* number : {&m.area, &m.damage, &m.tensionWork, &m.shearWork}) a.value(*number);
  a.value(m.gyration);
  auto& s = m.strength;
  for (auto* number :
       {&s.tension, &s.cohesion, &s.friction, &s.tensionEnergy, &s.shearEnergy, &s.compression, &s.stiffness})
    a.value(*number);
  a.value(m.arm);
  for (auto* list : {&m.opening, &m.slip1, &m.slip2}) a.value(*list);
  for (auto* v : {&m.force, &m.torque}) a.value(*v);
}

//! not of the method: fewest bytes of a slot in a snapshot
constexpr std::size_t kLeastMortar = 3;

}  // namespace

void MortarSet::archive(WriteArchive& a) const {
  archiveSlots(a, *this, kLeastMortar, [](auto& to, const Mortar& m) { archiveMortar(to, m); });
}
void MortarSet::archive(ReadArchive& a) {
  archiveSlots(a, *this, kLeastMortar, [](auto& from, Mortar& m) { archiveMortar(from, m); });
  findApart();
}

void MortarSet::checkStructure(Findings& f, const BodySet& bodies, const ShapeSet&) const {
  checkLists(f, bodies, "mortar");
}

namespace {

using namespace ties;

bool isWithin(double x, double least, double most) { return x >= least && x <= most; }
bool isSoundMortar(const Mortar& m) {
  const MortarStrength& s = m.strength;
  bool fine = isNear(m.centreA, kFarthest) && isNear(m.centreB, kFarthest) && hasUnitLength(m.frameA) &&
              hasUnitLength(m.frameB) && m.area > 0 && m.area <= kFarthest && m.gyration[0] > 0 &&
              m.gyration[0] <= kFarthest && m.gyration[1] > 0 && m.gyration[1] <= kFarthest &&
              isWithin(m.damage, 0, 1) && isWithin(m.tensionWork, 0, kLargestMemory) &&
              isWithin(m.shearWork, 0, kLargestMemory) && isWithin(double(m.arm), 1, 3);
  for (double number : {s.tension, s.cohesion, s.tensionEnergy, s.shearEnergy, s.compression, s.stiffness})
    fine = fine && number > 0 && number <= kLargestMemory;
  fine = fine && isWithin(s.friction, 0, kLargestMemory);
  for (const auto& v : {m.force, m.torque})
    fine = fine && isNear({double(v.x), double(v.y), double(v.z)}, kLargestMemory);
  for (int i = 0; i < kMortarPoints; i++)
    for (float way : {m.opening[i], m.slip1[i], m.slip2[i]}) fine = fine && std::fabs(double(way)) <= kFarthest;
  return fine;
}

}  // namespace

void MortarSet::checkRanges(Findings& f) const {
  for (const Mortar& m : slots) f.expect(!m.alive || isSoundMortar(m), "mortar: one's memory is out of range");
}

void MortarSet::check(Findings& f, const BodySet& bodies, const ShapeSet&) const { checkAsleep(f, bodies, "mortar"); }

}  // namespace brickfall
