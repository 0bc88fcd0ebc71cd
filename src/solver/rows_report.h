// Rows of an island, as the world checks them and counts what partners gave by them. For the report.cpp of each kind,
// which makes them for its rows.
#pragma once
#include "solver/island.h"

namespace brickfall {

template <class Rows, class Set, Set Ties::*kSet, auto kList>
void TieRows<Rows, Set, kSet, kList>::checkStructure(Findings& f, const Island& island, const Ties& ties,
                                                     const BodySet& bodies, bool current) const {
  const std::size_t all = island.bodies.size() + island.partners.size();
  f.expect(rows().laidOut() && rows().starts.size() == rows().records.size(), "islands: lists of different lengths");
  for (std::uint32_t tie : tieOf)
    f.expect(tie < ((ties.*kSet).*kList).size(), "islands: a contact, joint or mortar that is not there");
  for (const auto& r : rows().records) f.expect(r.bodyA < all && r.bodyB < all, "islands: a row names no body");
  if (f.any() || !current) return;
  for (std::size_t k = 0; k < size(); k++) {
    const Tie& tie = at(k, ties);
    f.expect(Rows::isThere(tie) && bodies.alive(tie.bodyA) && bodies.alive(tie.bodyB),
             "islands: a row of a contact, joint or mortar that has ended");
    const RowEnds ends = rows().endsIn(island, ties, k);
    f.expect(ends.a < all && ends.b < all, "islands: a row is of another island");
  }
}

// Until islands are built anew, a slot may be empty or belong to another tie.
template <class Rows, class Set, Set Ties::*kSet, auto kList>
void TieRows<Rows, Set, kSet, kList>::check(Findings& f, const Island& island, const Ties& ties, bool current) const {
  for (std::size_t k = 0; k < size(); k++) {
    const Tie& tie = at(k, ties);
    const bool ours = Rows::isThere(tie) && !tie.born;
    f.expect(ours || !current, "islands: a row's tie is gone");
    if (!ours || rows().records.empty()) continue;
    f.expect(island.bodyAt(rows().records[k].bodyA) == tie.bodyA && island.bodyAt(rows().records[k].bodyB) == tie.bodyB,
             "islands: a row names other bodies than its tie");
  }
}

template <class Rows, class Set, Set Ties::*kSet>
void LastingRows<Rows, Set, kSet>::addSupport(const Island& island, const StepContext& context,
                                              BalanceChange& sum) const {
  for (std::size_t k = 0; k < this->size(); k++) {
    const RowEnds ends = this->rows().endsIn(island, *context.ties, k);
    const bool partnerA = ends.a >= island.bodies.size(), partnerB = ends.b >= island.bodies.size();
    if (!partnerA && !partnerB) continue;
    const auto& tie = this->at(k, *context.ties);
    const BodyMotion& partner = context.bodies->motion[partnerA ? tie.bodyA : tie.bodyB];
    const Vec3 arm = this->rows().armOf(k, partnerB, context);
    const double sign = partnerA ? island.dt : -island.dt;
    const Vec3 impulse = toDouble(tie.force) * sign, turning = toDouble(tie.torque) * sign;
    sum.linear += impulse;
    sum.angular += cross(partner.position + arm, impulse) + turning;
    sum.energy += dot(impulse, partner.linearVelocity + cross(partner.angularVelocity, arm)) +
                  dot(turning, partner.angularVelocity);
  }
}

}  // namespace brickfall
