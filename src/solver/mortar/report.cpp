// Mortar of an island, as the world tells of it: as bytes and hashes, in its checks, in the ledger.
#include <algorithm>
#include <cmath>

#include "solver/face/point_forces.h"
#include "solver/mortar/rows.h"
#include "solver/rows_report.h"

namespace brickfall {

namespace {

template <class Visit> void eachNumber(const FaceRecord& r, Visit visit) {
  for (const Vec3f& v : {r.n, r.t1, r.armA, r.armB})
    for (int i = 0; i < 3; i++) visit(v[i]);
  for (const float* list : {r.s1, r.s2, r.trialN, r.trial1, r.trial2, r.k, r.limit, r.leastN})
    for (int i = 0; i < 4; i++) visit(list[i]);
}

}  // namespace

void MortarRows::hashRecord(Mix& h, std::size_t k, const Ties&) const {
  if (records.empty()) return;
  eachNumber(records[k], [&](float number) { h(number); });
}

void MortarRows::checkRanges(Findings& f) const {
  for (std::size_t k = 0; k < records.size(); k++) {
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

Vec3 MortarRows::armOf(std::size_t k, bool ofB, const StepContext& context) const {
  if (!records.empty()) return toDouble(ofB ? records[k].armB : records[k].armA);
  const MortarPose pose(at(k, *context.ties), *context.bodies);
  return ofB ? pose.armB : pose.armA;
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
    if (records.empty()) {
      sum.elastic += elasticEnergy(tieOf[k], context);
      continue;
    }
    const PointForces now = pointForcesAt(records[k], island.motion.data());
    double held = 0;
    for (int i = 0; i < 4; i++) {
      sum.work += double(now.n[i]) * now.way[i] + double(now.t1[i]) * now.way1[i] + double(now.t2[i]) * now.way2[i];
      held += double(now.n[i]) * now.n[i] + double(now.t1[i]) * now.t1[i] + double(now.t2[i]) * now.t2[i];
    }
    sum.elastic += held / (2 * mortar::stiffnessOf(at(k, *context.ties)));
    sum.pull += double(starts[k].pull);
    sum.shear += double(starts[k].shear);
    sum.crush += double(starts[k].crush);
  }
}

Vec3T<float> mortar::forceBefore(const Island& island, MortarIndex index, const Mortar& m) {
  const MortarRows& rows = island.rows.mortar;
  const auto place = std::lower_bound(rows.tieOf.begin(), rows.tieOf.end(), index);
  const bool solved = !island.resting() && rows.starts.size() == rows.size();
  if (!solved || place == rows.tieOf.end() || *place != index) return m.force;
  return rows.starts[std::size_t(place - rows.tieOf.begin())].before;
}

template struct TieRows<MortarRows, MortarSet, &Ties::mortar, &MortarSet::slots>;
template struct LastingRows<MortarRows, MortarSet, &Ties::mortar>;

}  // namespace brickfall
