// When open points of contacts close: an island goes on to that moment in a part of its step (solver/impact.h).
#include <algorithm>
#include <cmath>
#include <limits>

#include "solver/contact/speeds.h"
#include "solver/contact/stiffness.h"

namespace brickfall {

namespace {

// Time until a point at `gap`, which parts at `speed` under `acceleration`, closes faster than `least`.
double closingTime(double gap, double speed, double acceleration, double least) {
  const double never = std::numeric_limits<double>::infinity();
  if (gap <= 0 && !(speed > 0)) return -speed > least ? 0 : never;
  double square = speed * speed - 2 * acceleration * gap;
  if (!(square > least * least)) return never;
  double closing = std::sqrt(square);
  if (speed < 0) return 2 * gap / (closing - speed);
  return acceleration < 0 ? (speed + closing) / -acceleration : never;
}

// The point carried nothing in the last step, was not stopped in this one, and parts after a hit or is further apart
// than a closed point may be.
bool isOpen(const Contact& c, int i, const StepContext& context) {
  const float open = float(kNoGap * scaleOfPair(c, context).length);
  const bool apart = c.points.gap[i] > open || c.points.hitN[i] > 0;
  return c.points.forceN[i] == 0 && apart && !(c.points.metMask >> i & 1);
}

}  // namespace

// Of a body alone, what is slower than gravity makes it in a step rebounds into the next step at most, at any size. Of
// several bodies, what gives nothing back rests before that.
double slowestImpact(const Contact& contact, const Island& island, const StepContext& context) {
  const Scale& scale = island.facts.scale;
  const double unseen = kNearlyClosed * scale.length / context.dt;
  if (island.plan.alone) return std::min(unseen, scale.gravity * context.dt);
  const double resting = context.settings.restingApproachSpeed * scale.speed;
  const double falls = kTrifle * length(context.gravity) * context.dt;
  return std::max(unseen, contact.restitution > 0 ? std::min(resting, falls) : resting);
}

bool ContactRows::mayClose(const StepContext& context, double ahead) const {
  const BodySet& bodies = *context.bodies;
  const double fall = length(context.gravity) * context.dt * context.dt;
  for (ContactIndex contact : tieOf) {
    const Contact& c = context.ties->contacts.contacts[contact];
    const BodyMotion &a = bodies.motion[c.bodyA], &b = bodies.motion[c.bodyB];
    double most = length(b.linearVelocity - a.linearVelocity) +
                  length(a.angularVelocity) * bodies.mass[c.bodyA].outerRadius +
                  length(b.angularVelocity) * bodies.mass[c.bodyB].outerRadius;
    for (int i = 0; i < c.count; i++)
      if (c.points.forceN[i] == 0 && double(c.points.gap[i]) < ahead * (most * context.dt + fall)) return true;
  }
  return false;
}

bool ContactRows::touchNothing(const StepContext& context) const {
  for (std::size_t k = 0; k < size(); k++) {
    const Contact& c = at(k, *context.ties);
    if (c.touching) return false;
    for (int i = 0; i < c.count; i++)
      if (!isOpen(c, i, context) || isSlow(k, i)) return false;
  }
  return true;
}

void ContactRows::leaveOut(Ties& ties, const StepContext& context) {
  for (std::size_t k = 0; k < size(); k++) {
    Contact& c = at(k, ties);
    for (int i = 0; i < c.count; i++) {
      if (!isOpen(c, i, context) || isSlow(k, i)) continue;
      records[k].trialN[i] = -kLargestPointForce;
      clearPoint(c.points, i);
    }
  }
}

double ContactRows::firstClosing(const Island& island, double dt, const StepContext& context) {
  const BodySet& bodies = *context.bodies;
  const std::size_t count = island.bodies.size();
  auto startOf = [&](std::uint32_t local) { return velocityOf(bodies.motion[island.bodyAt(local)]); };
  auto endOf = [&](std::uint32_t local) {
    if (local >= count) return startOf(local);
    const BodyIndex body = island.bodies[local];
    return VelocityChange{context.solved[body].velocity,
                          bodies.worldInvInertia(body) * context.solved[body].angularMomentum};
  };
  double first = std::numeric_limits<double>::infinity();
  slow.assign(size(), 0);
  for (std::size_t k = 0; k < size(); k++) {
    const Contact& c = at(k, *context.ties);
    const FaceRecord& r = records[k];
    const double least = slowestImpact(c, island, context);
    double start[4], end[4];
    speedsOf(r, c.count, {startOf(r.bodyA), startOf(r.bodyB)}, start);
    speedsOf(r, c.count, {endOf(r.bodyA), endOf(r.bodyB)}, end);
    for (int i = 0; i < c.count; i++) {
      if (c.points.forceN[i] > 0) continue;
      double acceleration = (end[i] - start[i]) / dt;
      double gap = c.points.gap[i] > float(kNoGap * starts[k].scale.length) ? double(c.points.gap[i]) : 0;
      const double met = closingTime(gap, start[i], acceleration, least);
      first = std::min(first, met);
      if (!std::isfinite(met) && closingTime(gap, start[i], acceleration, 0) < dt) slow[k] |= std::uint8_t(1u << i);
    }
  }
  return first;
}

}  // namespace brickfall
