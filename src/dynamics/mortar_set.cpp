#include "dynamics/mortar_set.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <set>

#include "dynamics/tie_ranges.h"

namespace brickfall {

MortarPose::MortarPose(const Mortar& mortar, const BodySet& bodies) {
  const BodyMotion &a = bodies.motion[mortar.bodyA], &b = bodies.motion[mortar.bodyB];
  const Mat3 faceA = toMatrix(a.rotation * inDouble(mortar.frameA)),
             faceB = toMatrix(b.rotation * inDouble(mortar.frameB));
  n = faceA.column(0);
  t1 = faceA.column(1);
  t2 = faceA.column(2);
  const Vec3 toA = a.orientation * (inDouble(mortar.centreA) - bodies.data[mortar.bodyA].localCentre);
  const Vec3 toB = b.orientation * (inDouble(mortar.centreB) - bodies.data[mortar.bodyB].localCentre);
  const Vec3 apart = (b.position - a.position) + (toB - toA);
  armA = toA + apart * 0.5;
  armB = toB - apart * 0.5;
  centre = a.position + armA;
  auto inFace = [&](Vec3 v) { return Vec3{dot(n, v), dot(t1, v), dot(t2, v)}; };
  displaced = inFace(apart);
  along1 = inFace(faceB.column(1) - t1);
  along2 = inFace(faceB.column(2) - t2);
}

void placeFace(Mortar& m, bool onA, Vec3 centre, Quat frame) {
  (onA ? m.centreA : m.centreB) = {float(centre.x), float(centre.y), float(centre.z)};
  (onA ? m.frameA : m.frameB) = {float(frame.x), float(frame.y), float(frame.z), float(frame.w)};
}

MortarMode modeOf(const Mortar& m) {
  if (!(workOn(m) > 0)) return MortarMode::none;
  const JointStrength& s = m.strength;
  const float tension = m.tensionWork / s.tensionEnergy, shear = m.shearWork / s.shearEnergy;
  if (m.crushingWork / m.shared->crushingEnergy > std::max(tension, shear)) return MortarMode::crushing;
  return tension >= shear ? MortarMode::tension : MortarMode::shear;
}

MortarIndex MortarSet::create(const Mortar& mortar, const SharedStrength& shared, std::uint64_t userData) {
  // Each joint needs one at most: those of joints that are gone leave before there are twice as many.
  if (shared_.size() > 2 * slots.size() + 16) {
    std::set<const SharedStrength*> used;
    for (const Mortar& m : slots) used.insert(m.shared);
    std::erase_if(shared_, [&](const auto& entry) { return !used.contains(&entry.second); });
  }
  Mortar made = mortar;
  made.shared = share(shared);
  const MortarIndex index = LastingTies::create(made);
  if (userData != 0 && index >= userData_.size()) userData_.resize(index + 1);
  if (index < userData_.size()) userData_[index] = userData;
  return index;
}

const SharedStrength* MortarSet::share(const SharedStrength& strength) {
  return &shared_.try_emplace(std::bit_cast<Shared>(strength), strength).first->second;
}

void MortarSet::breakUp(MortarIndex index) {
  letCollide(index);
  Mortar& m = slots[index];
  m.broken = m.idle = true;
  m.ends = false;
  m.damage = 1;
  m.force = m.torque = {};
}

void MortarSet::crush(MortarIndex index) {
  Mortar& m = slots[index];
  m.crushed = true;
  m.opens = m.ends = false;
  m.damage = 1;
}

void MortarSet::destroy(MortarIndex mortar) {
  LastingTies::destroy(mortar);
  forget(kNoIndex);
}

void MortarSet::dropOf(BodyIndex body) {
  LastingTies::dropOf(body);
  forget(body);
}

const OpeningMemory* MortarSet::pastOf(MortarIndex mortar) const {
  const auto place = std::partition_point(pasts_.begin(), pasts_.end(),
                                          [&](const OpeningMemory& past) { return past.mortar < mortar; });
  return place != pasts_.end() && place->mortar == mortar ? &*place : nullptr;
}
OpeningMemory* MortarSet::pastOf(MortarIndex mortar) {
  return const_cast<OpeningMemory*>(std::as_const(*this).pastOf(mortar));
}

void MortarSet::addPasts(std::vector<OpeningMemory>&& fresh) {
  const auto isLess = [](const OpeningMemory& a, const OpeningMemory& b) { return a.mortar < b.mortar; };
  std::sort(fresh.begin(), fresh.end(), isLess);
  const auto old = std::ptrdiff_t(pasts_.size());
  pasts_.insert(pasts_.end(), fresh.begin(), fresh.end());
  std::inplace_merge(pasts_.begin(), pasts_.begin() + old, pasts_.end(), isLess);
}

// Records that name joints or a body that are no longer there.
void MortarSet::forget(BodyIndex gone) {
  if (pasts_.empty()) return;
  std::erase_if(watched, [&](MortarIndex mortar) { return !has(mortar); });
  std::erase_if(pasts_, [&](const OpeningMemory& past) { return !has(past.mortar); });
  for (OpeningMemory& past : pasts_) {
    TieLoad* const end = std::remove_if(past.loads, past.loads + past.count, [&](const TieLoad& load) {
      return load.names(gone) || (load.mortar != kNoIndex && !has(load.mortar));
    });
    past.count = std::uint32_t(end - past.loads);
    std::fill(end, past.loads + kTieLoads, TieLoad{});
  }
}

void MortarSet::renewConstants(BodyIndex body, const ShapeSet&, const BodySet& bodies) { renewIdle(body, bodies); }

void MortarSet::hash(Mix& h, MortarIndex mortar) const {
  const Mortar& m = slots[mortar];
  h(m.order, m.damage, m.opens, m.crushed, m.tougher, m.tensionWork, m.shearWork, m.crushingWork, m.centreA, m.force,
    m.torque);
  h.list(m.opening, kMortarPoints).list(m.slip1, kMortarPoints).list(m.slip2, kMortarPoints);
}

namespace {

template <class Archive, class One> void archiveMortar(Archive& a, One& m, SharedStrength& shared) {
  bool flags[] = {m.born, m.idle, m.cracked, m.broken, m.opens, m.crushed};
  for (bool& flag : flags) a.flag(flag);
  if constexpr (Archive::kReading) {
    m.born = flags[0];
    m.idle = flags[1];
    m.cracked = flags[2];
    m.broken = flags[3];
    m.opens = flags[4];
    m.crushed = flags[5];
  }
  for (auto* body : {&m.bodyA, &m.bodyB}) a.value(*body);
  a.value(m.order);
  for (auto* place : {&m.centreA, &m.centreB}) a.value(*place);
  for (auto* frame : {&m.frameA, &m.frameB}) a.value(*frame);
  a.value(m.area);
  a.value(m.damage);
  for (auto* number : {&m.tensionWork, &m.shearWork, &m.crushingWork}) a.value(*number);
  a.value(m.gyration);
  a.value(m.strength);
  a.value(shared);
  for (auto* number : {&m.arm, &m.tougher}) a.value(*number);
  for (auto* list : {&m.opening, &m.slip1, &m.slip2}) a.value(*list);
  for (auto* v : {&m.force, &m.torque}) a.value(*v);
}

template <class Archive, class List> void archivePasts(Archive& a, List& pasts) {
  const std::uint64_t count = a.count(pasts.size(), sizeof(OpeningMemory::loads));
  if constexpr (Archive::kReading) pasts.resize(std::size_t(count));
  for (auto& past : pasts) {
    for (auto* number : {&past.mortar, &past.count}) a.value(*number);
    for (auto* number : {&past.crackTime, &past.openTime, &past.grewTime, &past.breakTime, &past.damage})
      a.value(*number);
    a.value(past.force);
    a.value(past.loads);
  }
}

//! not of the method: fewest bytes of a slot in a snapshot
constexpr std::size_t kLeastMortar = 3;

}  // namespace

void MortarSet::archive(WriteArchive& a) const {
  archiveSlots(a, *this, kLeastMortar, [](auto& to, const Mortar& m) {
    SharedStrength shared = *m.shared;
    archiveMortar(to, m, shared);
  });
  a.list(userData_);
  a.list(watched);
  archivePasts(a, pasts_);
}
void MortarSet::archive(ReadArchive& a) {
  archiveSlots(a, *this, kLeastMortar, [this](auto& from, Mortar& m) {
    SharedStrength read;
    archiveMortar(from, m, read);
    m.shared = share(read);
  });
  a.list(userData_);
  a.list(watched);
  archivePasts(a, pasts_);
  findApart();
}

void MortarSet::checkStructure(Findings& f, const BodySet& bodies, const ShapeSet&) const {
  checkLists(f, bodies, "mortar");
  bool fine =
      std::is_sorted(pasts_.begin(), pasts_.end(), [](const auto& a, const auto& b) { return a.mortar <= b.mortar; }) &&
      isAscending(watched);
  for (MortarIndex mortar : watched) fine = fine && has(mortar) && pastOf(mortar);
  for (const OpeningMemory& past : pasts_) {
    fine = fine && has(past.mortar) && past.count <= kTieLoads;
    if (!fine) break;
    for (std::uint32_t i = 0; i < past.count; i++) {
      const TieLoad& load = past.loads[i];
      fine = fine && bodies.alive(load.bodyA) && bodies.alive(load.bodyB) &&
             (load.mortar == kNoIndex ||
              (has(load.mortar) && slots[load.mortar].names(load.bodyA) && slots[load.mortar].names(load.bodyB)));
    }
  }
  f.expect(fine, "mortar: how one opened names what is not there");
}

namespace {

using namespace ties;

bool isWithin(double x, double least, double most) { return x >= least && x <= most; }
bool isSoundMortar(const Mortar& m) {
  const JointStrength& s = m.strength;
  bool fine = isNear(inDouble(m.centreA), kFarthest) && isNear(inDouble(m.centreB), kFarthest) &&
              hasUnitLength(inDouble(m.frameA)) && hasUnitLength(inDouble(m.frameB)) && m.area > 0 &&
              m.area <= kFarthest && m.gyration[0] > 0 && m.gyration[0] <= kFarthest && m.gyration[1] > 0 &&
              m.gyration[1] <= kFarthest && isWithin(m.damage, 0, 1) && isWithin(double(m.arm), 1, 3) &&
              isWithin(double(m.tougher), 1, kLargestMemory);
  const SharedStrength& shared = *m.shared;
  for (float number : {s.tension, s.cohesion, s.tensionEnergy, s.shearEnergy, shared.compression, shared.crushingEnergy,
                       shared.stiffness})
    fine = fine && number > 0 && double(number) <= kLargestMemory;
  for (float work : {m.tensionWork, m.shearWork, m.crushingWork})
    fine = fine && isWithin(double(work), 0, kLargestMemory);
  fine = fine && isWithin(shared.friction, 0, kLargestMemory);
  for (const auto& v : {m.force, m.torque})
    fine = fine && isNear({double(v.x), double(v.y), double(v.z)}, kLargestMemory);
  for (int i = 0; i < kMortarPoints; i++)
    for (float way : {m.opening[i], m.slip1[i], m.slip2[i]}) fine = fine && std::fabs(double(way)) <= kFarthest;
  return fine;
}
bool isSoundPast(const OpeningMemory& past) {
  bool fine = isWithin(past.damage, 0, 1) && past.breakTime >= 0 &&
              isNear({double(past.force.x), double(past.force.y), double(past.force.z)}, kLargestMemory);
  for (double time : {past.crackTime, past.openTime, past.grewTime}) fine = fine && isWithin(time, 0, kLargestMemory);
  for (std::uint32_t i = 0; i < past.count && i < kTieLoads; i++)
    for (float force : {past.loads[i].before, past.loads[i].after})
      fine = fine && isWithin(double(force), 0, kLargestMemory);
  return fine;
}

}  // namespace

void MortarSet::checkRanges(Findings& f) const {
  for (const Mortar& m : slots) f.expect(!m.alive || isSoundMortar(m), "mortar: one's memory is out of range");
  for (const OpeningMemory& past : pasts_) f.expect(isSoundPast(past), "mortar: how one opened is out of range");
}

void MortarSet::check(Findings& f, const BodySet& bodies, const ShapeSet&) const { checkAsleep(f, bodies, "mortar"); }

}  // namespace brickfall
