// The end of a solve for the contacts of an island: what their points remember.
#include <algorithm>
#include <cmath>
#include <cstring>

#include "solver/contact/kernel.h"
#include "solver/island.h"

namespace brickfall {

namespace {

struct StoredForces {
  alignas(16) float n[4], t1[4], t2[4];
  std::uint32_t sliding = 0;
};

StoredForces forcesAt(const ContactRecord& r, const SolveMotion* motion) {
  kernel::PointForces f = kernel::pointForces(r, kernel::pointMotion(r, kernel::frame(r), motion));
  StoredForces out;
  kernel::store(f.n, out.n);
  kernel::store(f.t1, out.t1);
  kernel::store(f.t2, out.t2);
  out.sliding = wide::bits(f.slides);
  return out;
}

// Multiplier for the next step: the force, but an impact's force must not act again, explicitly.
void holdForce(Contact& c, int i, const StoredForces& f) {
  float kept = kMultiplierShare * c.points.multiplierN[i];
  float cap = kMultiplierGrowth * kept + kMultiplierWeights * float(kReferenceGravity) * c.effectiveMass;
  float share = f.n[i] > cap ? cap / f.n[i] : 1;
  c.points.forceN[i] = f.n[i];
  c.points.force1[i] = f.t1[i];
  c.points.force2[i] = f.t2[i];
  c.points.multiplierN[i] = f.n[i] > cap ? cap : f.n[i];
  c.points.multiplier1[i] = f.t1[i] * share;
  c.points.multiplier2[i] = f.t2[i] * share;
}

// Where the anchor of a point that slides has to be for its spring to carry the sliding force.
void placeSlip(Contact& c, int i, bool sliding) {
  c.points.slip1[i] = c.points.slip2[i] = 0;
  if (!sliding || !(c.points.forceN[i] > 0)) return;
  float scale = -(1 - kMultiplierShare) / (c.points.stiffness[i] * kCorrect);
  c.points.slip1[i] = c.points.force1[i] * scale;
  c.points.slip2[i] = c.points.force2[i] * scale;
  float drift = std::sqrt(c.points.slip1[i] * c.points.slip1[i] + c.points.slip2[i] * c.points.slip2[i]);
  if (drift > kLargestDrift) {
    c.points.slip1[i] *= kLargestDrift / drift;
    c.points.slip2[i] *= kLargestDrift / drift;
  }
}

// A contact that cannot carry a moment: few loaded points, or all of them sliding.
bool updateWeak(Contact& c, int loaded, int slidingLoaded) {
  bool was = c.weak;
  if (loaded < 3 || slidingLoaded >= c.count) {
    c.weak = true;
    c.weakSteps = kWeakHold;
  } else if (--c.weakSteps <= 0) {
    c.weak = false;
    c.weakSteps = 0;
  }
  return c.weak != was;
}

}  // namespace

bool ContactRows::store(Island& island, Ties ties, StepContext& context) {
  bool changed = false;
  for (std::size_t k = 0; k < size(); k++) {
    Contact& c = ties.contacts.contacts[contactOf[k]];
    Contact before = c;
    StoredForces f = forcesAt(records[k], island.motion.data());
    int loaded = 0, slidingLoaded = 0;
    c.points.stickingMask = 0;
    for (int i = 0; i < c.count; i++) {
      bool sliding = f.sliding >> i & 1;
      loaded += f.n[i] > 0;
      slidingLoaded += sliding && f.n[i] > 0;
      holdForce(c, i, f);
      if (f.n[i] > 0 && !sliding) c.points.stickingMask |= 1u << i;
      placeSlip(c, i, sliding);
    }
    c.touching = loaded > 0;
    if (c.touching != before.touching) ties.contacts.touchingChanged = true;
    if (updateWeak(c, loaded, slidingLoaded)) island.byMechanism.valid = false;
    changed = changed || std::memcmp(&before, &c, sizeof c) != 0;
  }
  context.statistics.lightVisits += 4.0 * double(size());
  return changed;
}

void ContactRows::advance(const Island& island, Ties ties) const {
  for (std::size_t k = 0; k < size(); k++) {
    Contact& c = ties.contacts.contacts[contactOf[k]];
    const ContactRecord& r = records[k];
    kernel::PointMotion m = kernel::pointMotion(r, kernel::frame(r), island.motion.data());
    alignas(16) float n[4], t1[4], u2[4];
    kernel::store(m.n, n);
    kernel::store(m.t1, t1);
    kernel::store(m.t2, u2);
    for (int i = 0; i < c.count; i++) {
      c.points.gap[i] += n[i];
      c.points.drift1[i] += t1[i];
      c.points.drift2[i] += u2[i];
    }
  }
}

}  // namespace brickfall
