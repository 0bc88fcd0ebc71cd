// What the solve found is kept: forces for the next step, motions for the stages to come. Hits are told here, by the forces of
// the solve.
#include <algorithm>

#include "solver/contact/energy.h"
#include "solver/finish/motion.h"
#include "solver/island_step.h"
#include "world/activity.h"
#include "world/diary.h"
#include "world/hits.h"
#include "world/registry.h"
#include "world/stage_hash.h"
#include "world/stages.h"

namespace brickfall {

namespace {

void collectHits(const WorldDef& def, const Registry& registry, const Island& island, const StepContext& context,
                 std::vector<HitEvent>& out) {
  std::pmr::vector<ContactImpact> impacts(island.memory);
  island.rows.contacts.findHits(island, context, def.hitEventSpeed, impacts);
  for (const ContactImpact& impact : impacts) tellHit(def, registry, island.rows.contacts, impact, context, out);
}

}  // namespace

void storeSolution(const WorldDef& def, const Registry& registry, IslandSet& islands, ContactSet& contacts,
                   StepContext& context, Events& events) {
  for (BodyIndex body : islands.single) storeFreeBody(body, context.dt, context);
  for (IslandPointer& island : islands.awake) {
    const bool solved = !island->resting();
    storeIsland(*island, Ties{contacts}, context);
    if (solved) collectHits(def, registry, *island, context, events.hits);
  }
}

void hashStore(const IslandSet& islands, const ContactSet& contacts, const StepContext& context, HashItems& out) {
  out.solved(islands, context);
  out.records(islands, contacts, [](Mix& h, const Island& island, std::size_t, const Contact& c) {
    mix(h, c);
    h(int(island.ending), island.inPlaceTime);
  });
}

namespace {

// Impulse of a contact with something fixed or kinematic on the island's body, about the world's origin; its work is that
// of the partner's motion.
BalanceChange impulseOf(const Contact& c, const ContactRecord& r, const ContactStart& start, const BodySet& bodies,
                        bool onB, double dt) {
  BalanceChange out;
  Vec3 n = toDouble(r.n), t1 = toDouble(r.t1), t2 = cross(n, t1);
  Vec3 centre = bodies.motion[c.bodyA].position + toDouble(r.armA);
  const BodyMotion& partner = bodies.motion[onB ? c.bodyA : c.bodyB];
  double sign = onB ? dt : -dt;
  for (int i = 0; i < c.count; i++) {
    auto sum = [&](float force, float back) { return double(force) + double(back); };
    Vec3 impulse = (n * sum(c.points.forceN[i], start.back[i]) + t1 * sum(c.points.force1[i], start.back1[i]) +
                    t2 * sum(c.points.force2[i], start.back2[i])) *
                   sign;
    Vec3 point = centre + t1 * double(r.s1[i]) + t2 * double(r.s2[i]);
    Vec3 velocity = partner.linearVelocity + cross(partner.angularVelocity, point - partner.position);
    out += {impulse, cross(point, impulse), dot(impulse, velocity)};
  }
  return out;
}

BalanceChange supportImpulses(const Island& island, const BodySet& bodies, const ContactSet& contacts, double dt) {
  BalanceChange sum;
  for (std::size_t k = 0; k < island.rows.contacts.records.size(); k++) {
    const ContactRecord& r = island.rows.contacts.records[k];
    bool partnerA = r.bodyA >= island.bodies.size(), partnerB = r.bodyB >= island.bodies.size();
    if (partnerA || partnerB)
      sum += impulseOf(contacts.contacts[island.rows.contacts.contactOf[k]], r, island.rows.contacts.starts[k], bodies,
                       partnerA, dt);
  }
  return sum;
}

// The work of contacts, and what it did to what they hold.
BalanceChange contactsNow(const IslandSet& islands, const ContactSet& contacts, const StepContext& context,
                          double elasticBefore, double& rebound) {
  BalanceChange out;
  double elastic = elasticOf(contacts.asleep, contacts, context);
  for (const IslandPointer& island : islands.awake) {
    ContactWork ofContacts = contactWork(*island, context);
    out.energy += ofContacts.work;
    rebound += ofContacts.rebound;
    elastic += ofContacts.elastic;
  }
  out.elastic = elastic - elasticBefore;
  return out;
}

}  // namespace

void bookStore(const Registry& registry, const Activity& activity, const ContactSet& contacts,
               const StepContext& context, Diary& diary) {
  const BodySet& bodies = registry.bodies;
  LedgerState& s = diary.ledgerState;
  StepLedger& ledger = *diary.report.ledger;
  BalanceChange supports;
  for (const IslandPointer& island : activity.islands.awake)
    supports += supportImpulses(*island, bodies, contacts, island->dt);
  Vec3 inFlight, inContact;
  for (BodyIndex body : activity.awake) {
    const SolvedMotion& m = context.solved[body];
    (m.flying ? inFlight : inContact) += cross(m.d, m.velocity * bodies.mass[body].mass);
  }
  supports.angular += inContact;
  ledger.supports += supports;
  ledger.gravity.angular += inFlight;
  Balance now = s.moving(solvedBalance(activity.awake, bodies, context));
  double rebound = 0;
  BalanceChange ofContacts = contactsNow(activity.islands, contacts, context, s.now.elastic, rebound);
  ledger.solve += now - s.now - s.push - supports - BalanceChange{{}, inFlight, ofContacts.energy + rebound};
  ledger.rebound.energy += rebound;
  s.now = now;
  s.now.elastic += ofContacts.elastic;
  ledger.contacts += ofContacts;
}

}  // namespace brickfall
