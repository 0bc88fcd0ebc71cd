// Mortar of an island, as the world tells of it: as bytes and hashes, in its checks, in the ledger.
#include <cmath>

#include "solver/face/point_forces.h"
#include "solver/island.h"
#include "solver/mortar/rows.h"

namespace brickfall {

void MortarRows::archive(WriteArchive& a) const {
  a.list(mortarOf);
  a.list(records);
  a.list(starts);
}
void MortarRows::archive(ReadArchive& a) {
  a.list(mortarOf);
  a.list(records);
  a.list(starts);
}

namespace {

template <class Visit> void eachNumber(const FaceRecord& r, Visit visit) {
  for (const Vec3f& v : {r.n, r.t1, r.armA, r.armB})
    for (int i = 0; i < 3; i++) visit(v[i]);
  for (const float* list : {r.s1, r.s2, r.trialN, r.trial1, r.trial2, r.k, r.limit, r.leastN})
    for (int i = 0; i < 4; i++) visit(list[i]);
}

}  // namespace

void MortarRows::hashRecord(Mix& h, std::size_t k, const Ties&) const {
  eachNumber(records[k], [&](float number) { h(number); });
}

void MortarRows::checkStructure(Findings& f, const Island& island, const Ties& ties, const BodySet& bodies,
                                bool current) const {
  const std::size_t all = island.bodies.size() + island.partners.size();
  f.expect(records.size() == size() && starts.size() == size(), "islands: lists of mortar of different lengths");
  for (MortarIndex m : mortarOf) f.expect(m < ties.mortar.slots.size(), "islands: mortar that is not there");
  for (const FaceRecord& r : records) f.expect(r.bodyA < all && r.bodyB < all, "islands: a mortar's row names no body");
  if (f.any() || !current) return;
  for (std::size_t k = 0; k < size(); k++) {
    const Mortar& m = mortarAt(k, ties);
    f.expect(m.alive && !m.broken && bodies.alive(m.bodyA) && bodies.alive(m.bodyB), "islands: mortar that has ended");
  }
}

void MortarRows::checkRanges(Findings& f) const {
  for (std::size_t k = 0; k < size(); k++) {
    bool fine = starts[k].left >= 0 && starts[k].left <= 1;
    eachNumber(records[k], [&](float number) { fine = fine && std::fabs(number) <= 1e30f; });
    fine = fine && records[k].near <= 0 && records[k].near >= -1e30f && records[k].rolls == 0;
    for (int i = 0; i < 4; i++)
      fine = fine && records[k].k[i] >= 0 && records[k].limit[i] >= 0 && records[k].leastN[i] <= 0 &&
             std::fabs(starts[k].heldN[i]) <= 1e30f && std::fabs(starts[k].held1[i]) <= 1e30f &&
             std::fabs(starts[k].held2[i]) <= 1e30f;
    f.expect(fine, "a mortar's record is out of range");
  }
}

void MortarRows::check(Findings& f, const Island& island, const Ties& ties, bool current) const {
  if (!current) return;
  const std::size_t own = island.bodies.size();
  auto bodyOf = [&](std::uint32_t local) { return local < own ? island.bodies[local] : island.partners[local - own]; };
  for (std::size_t k = 0; k < size(); k++) {
    const Mortar& m = mortarAt(k, ties);
    f.expect(bodyOf(records[k].bodyA) == m.bodyA && bodyOf(records[k].bodyB) == m.bodyB,
             "islands: a mortar's row is of other bodies");
  }
}

double MortarRows::elasticEnergy(MortarIndex index, const StepContext& context) {
  const Mortar& m = context.ties->mortar.slots[index];
  const MortarPose pose(m, *context.bodies);
  double sum = 0;
  for (int i = 0; i < 4; i++) {
    const Vec3 gap = mortar::gapAt(pose, mortar::placeOf(m, i, double(m.arm)));
    sum += lengthSquared(gap - Vec3{double(m.opening[i]), double(m.slip1[i]), double(m.slip2[i])});
  }
  return 0.5 * mortar::stiffnessOf(m) * sum;
}

void MortarRows::addWork(const Island& island, const StepContext& context, TieWork& sum) const {
  for (std::size_t k = 0; k < size(); k++) {
    const PointForces now = pointForcesAt(records[k], island.motion.data());
    double held = 0;
    for (int i = 0; i < 4; i++) {
      sum.work += double(now.n[i]) * now.way[i] + double(now.t1[i]) * now.way1[i] + double(now.t2[i]) * now.way2[i];
      held += double(now.n[i]) * now.n[i] + double(now.t1[i]) * now.t1[i] + double(now.t2[i]) * now.t2[i];
    }
    sum.elastic += held / (2 * mortar::stiffnessOf(mortarAt(k, *context.ties)));
    sum.pull += double(starts[k].pull);
    sum.shear += double(starts[k].shear);
    sum.crush += double(starts[k].crush);
  }
}

void MortarRows::addSupport(const Island& island, const StepContext& context, BalanceChange& sum) const {
  const BodySet& bodies = *context.bodies;
  for (std::size_t k = 0; k < size(); k++) {
    const FaceRecord& r = records[k];
    const bool partnerA = r.bodyA >= island.bodies.size(), partnerB = r.bodyB >= island.bodies.size();
    if (!partnerA && !partnerB) continue;
    const Mortar& m = mortarAt(k, *context.ties);
    const BodyMotion& partner = bodies.motion[partnerA ? m.bodyA : m.bodyB];
    const Vec3 centre = bodies.motion[m.bodyA].position + toDouble(r.armA);
    const double sign = partnerA ? island.dt : -island.dt;
    const Vec3 impulse = toDouble(m.force) * sign, turning = toDouble(m.torque) * sign;
    sum.linear += impulse;
    sum.angular += cross(centre, impulse) + turning;
    sum.energy += dot(impulse, partner.linearVelocity + cross(partner.angularVelocity, centre - partner.position)) +
                  dot(turning, partner.angularVelocity);
  }
}

}  // namespace brickfall
