// Lasting ties of an island, as the world checks them and counts what partners gave by them. For the report.cpp of each
// kind, which makes them for its rows.
#pragma once
#include "solver/island.h"

namespace brickfall {

template <class Rows, class Set, Set Ties::*kSet>
void LastingRows<Rows, Set, kSet>::checkStructure(Findings& f, const Island& island, const Ties& ties,
                                                  const BodySet& bodies, bool current) const {
  const std::size_t all = island.bodies.size() + island.partners.size();
  const std::size_t laid = rows().records.size();  // none while the island rests
  f.expect((laid == size() || laid == 0) && rows().starts.size() == laid,
           "islands: lists of joints or mortar of different lengths");
  for (std::uint32_t tie : tieOf)
    f.expect(tie < (ties.*kSet).slots.size(), "islands: a joint or mortar that is not there");
  for (const auto& r : rows().records)
    f.expect(r.bodyA < all && r.bodyB < all, "islands: a row of a joint or of mortar names no body");
  if (f.any() || !current) return;
  for (std::size_t k = 0; k < size(); k++) {
    const Tie& tie = at(k, ties);
    f.expect(tie.alive && !tie.gone() && bodies.alive(tie.bodyA) && bodies.alive(tie.bodyB),
             "islands: a joint or mortar that has ended");
    const RowEnds ends = rows().endsIn(island, ties, k);
    f.expect(ends.a < all && ends.b < all, "islands: a row of a joint or of mortar is of another island");
  }
}

template <class Rows, class Set, Set Ties::*kSet>
void LastingRows<Rows, Set, kSet>::check(Findings& f, const Island& island, const Ties& ties, bool current) const {
  const std::size_t own = island.bodies.size();
  auto bodyOf = [&](std::uint32_t local) { return local < own ? island.bodies[local] : island.partners[local - own]; };
  for (std::size_t k = 0; k < size(); k++) {
    const Tie& tie = at(k, ties);
    // Rows of ties that have ended go when the islands are made anew; those of others stay.
    if (!current && (!tie.alive || tie.born)) continue;
    if (rows().records.empty()) continue;
    f.expect(bodyOf(rows().records[k].bodyA) == tie.bodyA && bodyOf(rows().records[k].bodyB) == tie.bodyB,
             "islands: a row of a joint or of mortar is of other bodies");
  }
}

template <class Rows, class Set, Set Ties::*kSet>
void LastingRows<Rows, Set, kSet>::addSupport(const Island& island, const StepContext& context,
                                              BalanceChange& sum) const {
  for (std::size_t k = 0; k < size(); k++) {
    const RowEnds ends = rows().endsIn(island, *context.ties, k);
    const bool partnerA = ends.a >= island.bodies.size(), partnerB = ends.b >= island.bodies.size();
    if (!partnerA && !partnerB) continue;
    const Tie& tie = at(k, *context.ties);
    const BodyMotion& partner = context.bodies->motion[partnerA ? tie.bodyA : tie.bodyB];
    const Vec3 arm = rows().armOf(k, partnerB, context);
    const double sign = partnerA ? island.dt : -island.dt;
    const Vec3 impulse = toDouble(tie.force) * sign, turning = toDouble(tie.torque) * sign;
    sum.linear += impulse;
    sum.angular += cross(partner.position + arm, impulse) + turning;
    sum.energy += dot(impulse, partner.linearVelocity + cross(partner.angularVelocity, arm)) +
                  dot(turning, partner.angularVelocity);
  }
}

}  // namespace brickfall
