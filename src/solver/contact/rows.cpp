#include "solver/contact/rows.h"

#include <algorithm>
#include <cmath>

#include "solver/face/point_forces.h"

namespace brickfall {

void ContactRows::remember(const Ties& ties, Memory& out) const {
  out.contacts.reserve(size());
  out.geometry.reserve(size());
  for (ContactIndex contact : tieOf) {
    out.contacts.push_back(ties.contacts.contacts[contact]);
    out.geometry.push_back(ties.contacts.geometry[contact]);
  }
  out.struck = ties.contacts.struck.size();
  out.touchingChanged = ties.contacts.touchingChanged;
}
void ContactRows::restore(Ties& ties, const Memory& memory) const {
  for (std::size_t k = 0; k < size(); k++) {
    at(k, ties) = memory.contacts[k];
    ties.contacts.geometry[tieOf[k]] = memory.geometry[k];
  }
  ties.contacts.struck.resize(memory.struck);
  ties.contacts.touchingChanged = memory.touchingChanged;
}

// Each point counts 1, and 100 per effective weight that it carries.
float ContactRows::strength(std::size_t k, const StepContext& context) const {
  const Contact& c = at(k, *context.ties);
  float sum = 0;
  for (int i = 0; i < c.count; i++)
    sum += 1 + 100 * std::fabs(c.points.multiplierN[i]) / (c.effectiveMass * float(context.judgingGravity));
  return sum;
}

bool ContactRows::holds(std::size_t k, const StepContext& context) const {
  const Contact& c = at(k, *context.ties);
  const float leaves = float(context.settings.restingApproachSpeed * starts[k].scale.speed);
  bool any = false;
  for (int i = 0; i < c.count; i++)
    any = any || (c.points.forceN[i] > 0 && c.points.impulse[i] == 0 && starts[k].approach[i] < leaves);
  return any;
}

RowGrip ContactRows::grip(std::size_t k, const StepContext& context) const {
  const Contact& c = at(k, *context.ties);
  double force = 0;
  for (int i = 0; i < c.count; i++) force += double(c.points.forceN[i]);
  return {toDouble(records[k].n) * force, double(c.friction) * force};
}

bool ContactRows::meetsWithin(std::size_t k, Vec3f way, const SolveMotion* motion, const StepContext& context) const {
  const Contact& c = at(k, *context.ties);
  if (c.touching) return true;
  const PointWays moved = pointWaysAt(records[k], motion);
  const float reach = std::fabs(dot(records[k].n, way));
  for (int i = 0; i < c.count; i++)
    if (c.points.gap[i] + moved.way[i] < reach) return true;
  return false;
}

//! - | too small: stacks that land, or are made leaning, shear
//! | too large: floats give way under bodies that bear 1e16 of their weight
constexpr float kMostOver = 1e4f;  // of ContactStart::stopping

// A point that carried nothing in the last step has no frozen normal force for its friction limit. It gets the present
// force, but no more than stops the approach and carries the pair's weight; `over`: up to kMostOver times that. A point
// whose limit only falls after an impact gets no more than it had.
bool ContactRows::renewBounds(std::size_t k, const SolveMotion* motion, float slack, bool over) {
  FaceRecord& r = records[k];
  if (r.newPoints == 0) return false;
  const ContactStart& start = starts[k];
  const PointForces now = pointForcesAt(r, motion);
  bool changed = false;
  for (int i = 0; i < start.points; i++) {
    if (!(r.newPoints >> i & 1)) continue;
    const float most = start.stopping[i] * (over && !(start.falling >> i & 1) ? kMostOver : 1);
    const float limit = start.friction * std::max(0.0f, std::min(now.n[i], most));
    if (std::fabs(limit - r.limit[i]) <= slack * std::max(limit, r.limit[i])) continue;
    r.limit[i] = limit;
    changed = true;
  }
  if (changed && r.rolls) {
    float load = 0;
    for (int i = 0; i < start.points; i++)
      load += std::max(0.0f, r.newPoints >> i & 1 ? std::min(now.n[i], start.stopping[i]) : now.n[i]);
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
  const PointForces now = pointForcesAt(r, motion);
  bool changed = false;
  for (int i = 0; i < start.points; i++) {
    if (!(now.n[i] > known[i])) continue;
    start.stopping[i] = now.n[i];
    start.falling &= ~(1u << i);
    r.limit[i] = start.friction * now.n[i];
    r.newPoints |= 1u << i;
    changed = true;
  }
  return changed;
}

bool ContactRows::owes(std::size_t k, const StepContext& context) const {
  const PointMemory& m = at(k, *context.ties).points;
  return std::any_of(m.impulse, m.impulse + starts[k].points, [](float taken) { return taken > 0; });
}

double ContactRows::reboundWork(std::size_t k, const SolveMotion* motion) const {
  const ContactStart& start = starts[k];
  if (std::none_of(start.back, start.back + start.points, [](float force) { return force > 0; })) return 0;
  const PointWays m = pointWaysAt(records[k], motion);
  double work = 0;
  for (int i = 0; i < start.points; i++)
    work += double(start.back[i]) * double(m.way[i]) + double(start.back1[i]) * double(m.way1[i]) +
            double(start.back2[i]) * double(m.way2[i]);
  return work;
}

}  // namespace brickfall
