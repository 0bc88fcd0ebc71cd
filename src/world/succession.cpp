#include "world/succession.h"

#include <algorithm>

#include "dynamics/point_matcher.h"
#include "world/narrow_phase.h"

namespace brickfall {

Succession::Estate Succession::seenFrom(const Registry& registry, const Contact& c, const ContactGeometry& g,
                                        bool bodyIsB) {
  Transform a = registry.bodies.pose(c.bodyA), b = registry.bodies.pose(c.bodyB);
  double sign = bodyIsB ? 1 : -1;  // a contact tells its forces as they act on B
  Estate out;
  out.neighbour = bodyIsB ? c.shapeA : c.shapeB;
  out.contact = c;
  out.reach =
      kMatchShare * std::min(registry.shapes.data[c.shapeA].innerRadius, registry.shapes.data[c.shapeB].innerRadius);
  out.normal = rotate(a.rotation, g.normal) * sign;
  out.tangent1 = rotate(a.rotation, g.tangent1) * sign;
  out.tangent2 = rotate(a.rotation, cross(g.normal, g.tangent1)) * sign;
  for (int i = 0; i < c.count; i++) {
    Vec3 onA = transformPoint(a, g.anchorA[i]), onB = transformPoint(b, g.anchorB[i]);
    out.onBody[i] = bodyIsB ? onB : onA;
    out.onNeighbour[i] = bodyIsB ? onA : onB;
  }
  return out;
}

Succession::Succession(const Registry& registry, const ContactSet& contacts, BodyIndex body) {
  for (const CandidatePair& pair : contacts.pairs) {
    if (pair.contact == kNoIndex || (pair.bodyA != body && pair.bodyB != body)) continue;
    estates_.push_back(
        seenFrom(registry, contacts.contacts[pair.contact], contacts.geometry[pair.contact], pair.bodyB == body));
  }
}

std::vector<CandidatePair> Succession::meet(const Registry& registry, const std::vector<BodyIndex>& pieces,
                                            Proximity& proximity, Ties& ties) const {
  std::vector<ShapeIndex> neighbours;
  for (const Estate& estate : estates_) neighbours.push_back(estate.neighbour);
  makeAscending(neighbours);
  NarrowPhase narrow(registry, 0, proximity, ties.contacts);
  std::vector<CandidatePair> found;
  for (BodyIndex piece : pieces)
    for (ShapeIndex own : registry.bodies.shapes[piece])
      for (ShapeIndex other : neighbours) {
        if (!registry.mayMeet(own, other) || !ties.mayCollide(piece, registry.shapes.data[other].body)) continue;
        ShapeIndex a = std::min(own, other), b = std::max(own, other);
        narrow.meet({a, b, registry.shapes.data[a].body, registry.shapes.data[b].body, kNoIndex, 0}, found);
      }
  // Pairs that are near without a point are left to the broad phase.
  std::erase_if(found, [](const CandidatePair& pair) { return pair.contact == kNoIndex; });
  std::sort(found.begin(), found.end());
  return found;
}

// Bequests of the nearest points first: each old point once, each new point once. Forces on another face say nothing.
std::vector<Succession::Bequest> Succession::bequests(const std::vector<Estate>& heirs) const {
  std::vector<Bequest> all, out;
  for (std::size_t h = 0; h < heirs.size(); h++)
    for (std::size_t e = 0; e < estates_.size(); e++) {
      if (heirs[h].neighbour != estates_[e].neighbour || dot(heirs[h].normal, estates_[e].normal) < kSameFace) continue;
      for (int to = 0; to < heirs[h].contact.count; to++)
        for (int from = 0; from < estates_[e].contact.count; from++) {
          double apart = lengthSquared(heirs[h].onNeighbour[to] - estates_[e].onNeighbour[from]);
          if (apart < heirs[h].reach * heirs[h].reach) all.push_back({apart, h, e, to, from});
        }
    }
  std::stable_sort(all.begin(), all.end(), [](const Bequest& a, const Bequest& b) { return a.apart < b.apart; });
  std::vector<std::uint32_t> taken(heirs.size(), 0), given(estates_.size(), 0);  // bit per point
  for (const Bequest& b : all) {
    if (taken[b.heir] >> b.to & 1 || given[b.estate] >> b.from & 1) continue;
    taken[b.heir] |= 1u << b.to;
    given[b.estate] |= 1u << b.from;
    out.push_back(b);
  }
  return out;
}

void Succession::pass(const Registry& registry, const std::vector<BodyIndex>& pieces, Proximity& proximity,
                      Ties& ties) const {
  ContactSet& contacts = ties.contacts;
  std::vector<CandidatePair> pairs = meet(registry, pieces, proximity, ties);
  std::vector<bool> isB;
  std::vector<Estate> heirs;
  for (const CandidatePair& pair : pairs) {
    isB.push_back(std::find(pieces.begin(), pieces.end(), pair.bodyB) != pieces.end());
    heirs.push_back(seenFrom(registry, contacts.contacts[pair.contact], contacts.geometry[pair.contact], isB.back()));
  }
  for (const Bequest& b : bequests(heirs)) {
    const Estate &old = estates_[b.estate], &heir = heirs[b.heir];
    const CandidatePair& pair = pairs[b.heir];
    Contact& c = contacts.contacts[pair.contact];
    ContactGeometry& g = contacts.geometry[pair.contact];
    TangentTurn turn{{float(dot(old.tangent1, heir.tangent1)), float(dot(old.tangent2, heir.tangent1)),
                      float(dot(old.tangent1, heir.tangent2)), float(dot(old.tangent2, heir.tangent2))}};
    carryOver(c.points, b.to, old.contact.points, b.from, turn);
    c.touching = c.touching || (old.contact.touching && old.contact.points.forceN[b.from] > 0);
    if (!old.contact.points.sticks(b.from) || c.rolls || dot(old.normal, heir.normal) < kKeptFace) continue;
    Vec3 onA = isB[b.heir] ? old.onNeighbour[b.from] : old.onBody[b.from];
    Vec3 onB = isB[b.heir] ? old.onBody[b.from] : old.onNeighbour[b.from];
    g.anchorA[b.to] = transformPoint(inverse(registry.bodies.pose(c.bodyA)), onA);
    g.anchorB[b.to] = transformPoint(inverse(registry.bodies.pose(c.bodyB)), onB);
  }
  for (const CandidatePair& pair : pairs)
    measurePoints(contacts.contacts[pair.contact], contacts.geometry[pair.contact],
                  inverse(registry.bodies.pose(pair.bodyA)) * registry.bodies.pose(pair.bodyB));
  contacts.insert(pairs);
}

}  // namespace brickfall
