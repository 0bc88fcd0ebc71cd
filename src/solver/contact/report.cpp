// Contacts of an island, as the world tells of them: as hashes, in its checks, to listeners.
#include <cmath>

#include "solver/island.h"

namespace brickfall {

namespace {

bool isLength(float x) { return std::fabs(x) <= kLargestPointLength; }
bool isForce(float x) { return std::fabs(x) <= kLargestPointForce; }

bool isSound(const FaceRecord& r, const ContactStart& start) {
  bool fine = r.newPoints < 16 && r.rolls <= 1 && start.falling < 16 && isForce(start.friction) &&
              isForce(start.rolling) && start.points >= 0 && start.points <= (r.rolls ? kRollingLane : 4);
  for (const Vec3f& v : {r.n, r.t1, r.armA, r.armB, start.bend, start.run})
    fine = fine && isLength(v.x) && isLength(v.y) && isLength(v.z);
  for (int i = 0; i < 4; i++)
    fine = fine && isLength(r.s1[i]) && isLength(r.s2[i]) && isForce(r.trialN[i]) && isForce(r.trial1[i]) &&
           isForce(r.trial2[i]) && isForce(r.k[i]) && r.k[i] >= 0 && isForce(r.limit[i]) && r.limit[i] >= 0 &&
           r.leastN[i] == 0 && isForce(start.approach[i]) && isLength(start.gap[i]) && isForce(start.stopping[i]) &&
           isForce(start.taken[i]) && isForce(start.back[i]) && isForce(start.back1[i]) && isForce(start.back2[i]);
  return fine;
}

BodyIndex bodyOf(const Island& island, std::uint32_t local) {
  const std::size_t own = island.bodies.size();
  return local < own ? island.bodies[local] : island.partners[local - own];
}

}  // namespace

void ContactRows::archive(WriteArchive& a) const {
  a.list(contactOf);
  a.list(records);
  a.list(starts);
}
void ContactRows::archive(ReadArchive& a) {
  a.list(contactOf);
  a.list(records);
  a.list(starts);
}

void ContactRows::hashName(Mix& h, std::size_t k, const Ties& ties) const {
  const Contact& c = ties.contacts.contacts[contactOf[k]];
  h(c.shapeA, c.shapeB);
}
void ContactRows::hashMemory(Mix& h, std::size_t k, const Ties& ties) const {
  mix(h, ties.contacts.contacts[contactOf[k]]);
}
void ContactRows::hashRecord(Mix& h, std::size_t k, const Ties& ties) const {
  const FaceRecord& r = records[k];
  h(r.n, r.t1, r.armA, r.armB, r.newPoints);
  for (const float* field : {r.s1, r.s2, r.trialN, r.trial1, r.trial2, r.k, r.limit, r.leastN})
    h.list(field, ties.contacts.contacts[contactOf[k]].count);
  if (r.rolls)
    h(r.s1[kRollingLane], r.k[kRollingLane], r.trial1[kRollingLane], r.trial2[kRollingLane], r.limit[kRollingLane]);
}

void ContactRows::checkStructure(Findings& f, const Island& island, const Ties& ties, const BodySet& bodies,
                                 bool current) const {
  const std::size_t all = island.bodies.size() + island.partners.size();
  f.expect(records.size() == size() && starts.size() == size(), "islands: lists of different lengths");
  for (ContactIndex c : contactOf) f.expect(c < ties.contacts.contacts.size(), "islands: a contact that is not there");
  for (const FaceRecord& r : records) f.expect(r.bodyA < all && r.bodyB < all, "islands: a record names no body");
  if (f.any() || !current) return;
  for (ContactIndex contact : contactOf) {
    const Contact& c = ties.contacts.contacts[contact];
    f.expect(bodies.alive(c.bodyA) && bodies.alive(c.bodyB) && c.count >= 1 && c.count <= 4,
             "islands: a contact of other bodies, or of none");
  }
}

void ContactRows::checkRanges(Findings& f) const {
  for (std::size_t k = 0; k < size(); k++)
    f.expect(isSound(records[k], starts[k]), "a contact's record is out of range");
}

void ContactRows::check(Findings& f, const Island& island, const Ties& ties, bool current) const {
  for (std::size_t k = 0; k < size(); k++) {
    // Until islands are built anew, a contact's slot may be empty or belong to another contact.
    const Contact& c = ties.contacts.contacts[contactOf[k]];
    const bool ours = c.count > 0 && !c.born;
    f.expect(ours || !current, "islands: a contact is gone");
    if (ours)
      f.expect(bodyOf(island, records[k].bodyA) == c.bodyA && bodyOf(island, records[k].bodyB) == c.bodyB,
               "islands: a record names other bodies than its contact");
  }
}

PointCount ContactRows::countPoints(const Ties& ties) const {
  PointCount out;
  for (ContactIndex contact : contactOf) {
    const Contact& c = ties.contacts.contacts[contact];
    out.all += c.count;
    for (int i = 0; i < c.count; i++) out.touching += c.points.forceN[i] > 0 || c.points.hitN[i] > 0;
  }
  return out;
}

void ContactRows::startAfresh(Ties& ties) const {
  for (ContactIndex contact : contactOf) {
    Contact& c = ties.contacts.contacts[contact];
    for (int i = 0; i < 4; i++) clearPoint(c.points, i);
    c.touching = false;
    c.fresh = true;
  }
}

}  // namespace brickfall
