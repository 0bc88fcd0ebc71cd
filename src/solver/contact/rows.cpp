#include "solver/contact/rows.h"

#include <algorithm>
#include <cmath>

namespace brickfall {

// A contact's slot may have gone to another contact since: such contacts are marked born.
bool ContactRows::continues(const ContactRows& old, const StepContext& context) const {
  if (contactOf != old.contactOf) return false;
  return std::none_of(contactOf.begin(), contactOf.end(),
                      [&](ContactIndex c) { return context.ties->contacts.contacts[c].born; });
}

void ContactRows::remember(const Ties& ties, Memory& out) const {
  for (ContactIndex contact : contactOf) {
    out.contacts.push_back(ties.contacts.contacts[contact]);
    out.geometry.push_back(ties.contacts.geometry[contact]);
  }
  out.struck = ties.contacts.struck.size();
  out.touchingChanged = ties.contacts.touchingChanged;
}
void ContactRows::restore(Ties& ties, const Memory& memory) const {
  for (std::size_t k = 0; k < size(); k++) {
    ties.contacts.contacts[contactOf[k]] = memory.contacts[k];
    ties.contacts.geometry[contactOf[k]] = memory.geometry[k];
  }
  ties.contacts.struck.resize(memory.struck);
  ties.contacts.touchingChanged = memory.touchingChanged;
}

// Each point counts 1, and 100 per effective weight that it carries.
float ContactRows::strength(std::size_t k, const StepContext& context) const {
  const Contact& c = context.ties->contacts.contacts[contactOf[k]];
  float sum = 0;
  for (int i = 0; i < c.count; i++)
    sum += 1 + 100 * std::fabs(c.points.multiplierN[i]) / (c.effectiveMass * float(context.judgingGravity));
  return sum;
}

bool ContactRows::holds(std::size_t k, const StepContext& context) const {
  const Contact& c = context.ties->contacts.contacts[contactOf[k]];
  const float leaves = float(context.settings.restingApproachSpeed * starts[k].scale.speed);
  bool any = false;
  for (int i = 0; i < c.count; i++)
    any = any || (c.points.forceN[i] > 0 && c.points.impulse[i] == 0 && starts[k].approach[i] < leaves);
  return any;
}

RowGrip ContactRows::grip(std::size_t k, const StepContext& context) const {
  const Contact& c = context.ties->contacts.contacts[contactOf[k]];
  double force = 0;
  for (int i = 0; i < c.count; i++) force += double(c.points.forceN[i]);
  return {toDouble(records[k].n) * force, double(c.friction) * force};
}

bool ContactRows::meetsWithin(std::size_t k, Vec3f way, const SolveMotion* motion, const StepContext& context) const {
  const Contact& c = context.ties->contacts.contacts[contactOf[k]];
  if (c.touching) return true;
  alignas(16) float n[4];
  kernel::store(kernel::pointMotion(records[k], kernel::frame(records[k]), motion).n, n);
  float reach = std::fabs(dot(records[k].n, way));
  for (int i = 0; i < c.count; i++)
    if (c.points.gap[i] + n[i] < reach) return true;
  return false;
}

//! - | too small: stacks that land, or are made leaning, shear
//! | too large: floats give way under bodies that bear 1e16 of their weight
constexpr float kMostOver = 1e4f;  // of ContactStart::stopping

// A point that carried nothing in the last step has no frozen normal force for its friction limit. It gets the present
// force, but no more than stops the approach and carries the pair's weight; `over`: up to kMostOver times that. A point
// whose limit only falls after an impact gets no more than it had.
bool ContactRows::renewNewPoints(std::size_t k, const SolveMotion* motion, float slack, bool over) {
  FaceRecord& r = records[k];
  const ContactStart& start = starts[k];
  alignas(16) float fn[4];
  kernel::store(kernel::pointForces(r, kernel::pointMotion(r, kernel::frame(r), motion)).n, fn);
  bool changed = false;
  for (int i = 0; i < start.points; i++) {
    if (!(r.newPoints >> i & 1)) continue;
    const float most = start.stopping[i] * (over && !(start.falling >> i & 1) ? kMostOver : 1);
    const float limit = start.friction * std::max(0.0f, std::min(fn[i], most));
    if (std::fabs(limit - r.limit[i]) <= slack * std::max(limit, r.limit[i])) continue;
    r.limit[i] = limit;
    changed = true;
  }
  if (changed && r.rolls) {
    float load = 0;
    for (int i = 0; i < start.points; i++)
      load += std::max(0.0f, r.newPoints >> i & 1 ? std::min(fn[i], start.stopping[i]) : fn[i]);
    r.limit[kRollingLane] = start.rolling * load;
  }
  return changed;
}

//! - | too small: limits follow forces met on the solve's way | too large: what jams slips out like soap
constexpr float kJammed = 3;  // x the force that the friction limit is made for: a point that bears more is jammed

bool ContactRows::holdJam(std::size_t k, const SolveMotion* motion, float force) {
  FaceRecord& r = records[k];
  ContactStart& start = starts[k];
  if (!(start.friction > 0)) return false;
  float known[4], sum = 0;
  for (int i = 0; i < start.points; i++)
    sum += known[i] = kJammed * std::max(r.limit[i] / start.friction, start.stopping[i]);
  if (!(force > sum)) return false;
  alignas(16) float fn[4];
  kernel::store(kernel::pointForces(r, kernel::pointMotion(r, kernel::frame(r), motion)).n, fn);
  bool changed = false;
  for (int i = 0; i < start.points; i++) {
    if (!(fn[i] > known[i])) continue;
    start.stopping[i] = fn[i];
    start.falling &= ~(1u << i);
    r.limit[i] = start.friction * fn[i];
    r.newPoints |= 1u << i;
    changed = true;
  }
  return changed;
}

bool ContactRows::owes(std::size_t k, const StepContext& context) const {
  const PointMemory& m = context.ties->contacts.contacts[contactOf[k]].points;
  return std::any_of(m.impulse, m.impulse + starts[k].points, [](float taken) { return taken > 0; });
}

double ContactRows::reboundWork(std::size_t k, const SolveMotion* motion) const {
  const ContactStart& start = starts[k];
  if (std::none_of(start.back, start.back + start.points, [](float force) { return force > 0; })) return 0;
  auto m = kernel::pointMotion(records[k], kernel::frame(records[k]), motion);
  alignas(16) float n[4], t1[4], t2[4];
  kernel::store(m.n, n);
  kernel::store(m.t1, t1);
  kernel::store(m.t2, t2);
  double work = 0;
  for (int i = 0; i < start.points; i++)
    work += double(start.back[i]) * double(n[i]) + double(start.back1[i]) * double(t1[i]) +
            double(start.back2[i]) * double(t2[i]);
  return work;
}

}  // namespace brickfall
