#include "world/passed_pairs.h"

#include <algorithm>
#include <limits>

namespace brickfall {

namespace {

//! m | too small: what rolls bounces off what it passes | too large: what bounces goes into what it then meets
constexpr double kAside = 1e-3;  // by which a touch turns a body aside from what it would have passed

// m/s, at the middle of a contact's points.
double closingSpeed(const BodyMotion& a, const BodyMotion& b, const ContactGeometry& g) {
  const Vec3 n = a.orientation * g.normal, at = a.position + a.orientation * g.centre;
  return dot(n, a.linearVelocity + cross(a.angularVelocity, at - a.position) - b.linearVelocity -
                    cross(b.angularVelocity, at - b.position));
}

}  // namespace

void findStraight(const BodySet& bodies, const ContactSet& contacts, std::span<const PassedPair> passed,
                  std::vector<double>& until) {
  constexpr double kPassesNothing = -1;
  until.assign(bodies.slots(), kPassesNothing);
  for (const PassedPair& one : passed) {
    const CandidatePair& pair = contacts.pairs[one.pair];
    until[pair.bodyA] = until[pair.bodyB] = std::numeric_limits<double>::infinity();
  }
  auto passes = [&](BodyIndex body) { return until[body] != kPassesNothing; };
  for (const CandidatePair& pair : contacts.pairs) {
    if (pair.contact == kNoIndex || (!passes(pair.bodyA) && !passes(pair.bodyB))) continue;
    const double closing =
        closingSpeed(bodies.motion[pair.bodyA], bodies.motion[pair.bodyB], contacts.geometry[pair.contact]);
    if (!(closing > 0)) continue;
    const Contact& c = contacts.contacts[pair.contact];
    const double gap = double(*std::min_element(c.points.gap, c.points.gap + c.count));
    const double aside = (std::max(0.0, gap) + kAside) / closing;
    for (BodyIndex body : {pair.bodyA, pair.bodyB})
      if (bodies.mass[body].invMass > 0) until[body] = std::min(until[body], aside);
  }
}

}  // namespace brickfall
