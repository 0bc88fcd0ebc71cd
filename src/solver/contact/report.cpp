// Contacts of an island, as the world tells of them: as hashes, in its checks, to listeners.
#include <cmath>

#include "solver/rows_report.h"

namespace brickfall {

namespace {

bool isLength(float x) { return std::fabs(x) <= kLargestPointLength; }
bool isForce(float x) { return std::fabs(x) <= kLargestPointForce; }

bool isSound(const FaceRecord& r, const ContactStart& start) {
  bool fine = r.newPoints < 16 && r.rolls <= 1 && start.falling < 16 && isForce(start.friction) &&
              isForce(start.rolling) && std::isfinite(start.held) && start.points >= 0 &&
              start.points <= (r.rolls ? kRollingLane : 4);
  for (const Vec3f& v : {r.n, r.t1, r.armA, r.armB, start.run})
    fine = fine && isLength(v.x) && isLength(v.y) && isLength(v.z);
  for (int i = 0; i < 4; i++)
    fine = fine && isLength(r.s1[i]) && isLength(r.s2[i]) && isForce(r.trialN[i]) && isForce(r.trial1[i]) &&
           isForce(r.trial2[i]) && isForce(r.k[i]) && r.k[i] >= 0 && isForce(r.limit[i]) && r.limit[i] >= 0 &&
           r.leastN[i] == 0 && isForce(start.approach[i]) && isLength(start.gap[i]) && isLength(start.arc[i]) &&
           isLength(start.arc1[i]) && isLength(start.arc2[i]) && isForce(start.curves[i]) &&
           isForce(start.stopping[i]) && isForce(start.taken[i]) && isForce(start.back[i]) && isForce(start.back1[i]) &&
           isForce(start.back2[i]);
  return fine;
}

}  // namespace

void ContactRows::hashName(Mix& h, std::size_t k, const Ties& ties) const {
  const Contact& c = at(k, ties);
  h(c.shapeA, c.shapeB);
}
void ContactRows::hashMemory(Mix& h, std::size_t k, const Ties& ties) const { mix(h, at(k, ties)); }
void ContactRows::hashRecord(Mix& h, std::size_t k, const Ties& ties) const {
  const FaceRecord& r = records[k];
  h(r.n, r.t1, r.armA, r.armB, r.newPoints);
  for (const float* field : {r.s1, r.s2, r.trialN, r.trial1, r.trial2, r.k, r.limit, r.leastN})
    h.list(field, at(k, ties).count);
  if (r.rolls)
    h(r.s1[kRollingLane], r.k[kRollingLane], r.trial1[kRollingLane], r.trial2[kRollingLane], r.limit[kRollingLane]);
}

void ContactRows::checkRanges(Findings& f) const {
  for (std::size_t k = 0; k < size(); k++)
    f.expect(isSound(records[k], starts[k]), "a contact's record is out of range");
}

PointCount ContactRows::countPoints(const Ties& ties) const {
  PointCount out;
  for (ContactIndex contact : tieOf) {
    const Contact& c = ties.contacts.contacts[contact];
    out.all += c.count;
    for (int i = 0; i < c.count; i++) out.touching += c.points.forceN[i] > 0 || c.points.hitN[i] > 0;
  }
  return out;
}

void ContactRows::startAfresh(Ties& ties) const {
  for (ContactIndex contact : tieOf) {
    Contact& c = ties.contacts.contacts[contact];
    for (int i = 0; i < 4; i++) clearPoint(c.points, i);
    c.touching = false;
    c.fresh = true;
  }
}

template struct TieRows<ContactRows, ContactSet, &Ties::contacts, &ContactSet::contacts>;

}  // namespace brickfall
