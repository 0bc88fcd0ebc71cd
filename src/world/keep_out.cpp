#include "world/keep_out.h"

#include <algorithm>
#include <cmath>
#include <type_traits>

#include "geometry/queries.h"
#include "solver/finish/motion.h"
#include "solver/free_motion.h"
#include "world/core_sweep.h"

namespace brickfall {

namespace {

class KeptOut {
 public:
  KeptOut(const Island& island, const Registry& registry, StepContext& context)
      : bodies_(registry.bodies),
        shapes_(registry.shapes),
        context_(context),
        alone_(island.bodies.size() == 1),
        tied_(island.memory) {
    if (!island.facts.firm) return;
    island.rows.each([&]<class Kind>(const Kind& kind, std::size_t k) {
      if (!std::remove_cvref_t<Kind>::kFirm) return;
      const auto [a, b] = kind.bodies(k, *context.ties);
      tied_.push_back(a);
      tied_.push_back(b);
    });
    std::sort(tied_.begin(), tied_.end());
  }

  // The body turned so far that the solve, with the arms of its start, may be wrong about where it ends; and a shift
  // changes nobody else's momentum, and tears no firm tie.
  bool mayBeShifted(BodyIndex body) const {
    if (!moves(body) || (context_.solved[body].flying && !alone_)) return false;
    if (std::binary_search(tied_.begin(), tied_.end(), body)) return false;
    const FreeMotion& free = context_.free[body];
    auto far = [&](Vec3 turn) {
      const Vec3 visible = visibleTurn(bodies_.mass[body], bodies_.motion[body].orientation, turn);
      return lengthSquared(visible) > 0.25 * kMostTurn * kMostTurn;
    };
    return free.turnsFaster || far(context_.solved[body].th) || far(free.startSpin * free.dt);
  }

  // Parts the contact's bodies along its normal `n` if they ended deeper in each other than they began. Returns whether
  // it did so.
  bool part(const Contact& c, Vec3 n) {
    const bool shiftsA = mayBeShifted(c.bodyA), shiftsB = mayBeShifted(c.bodyB);
    if (!shiftsA && !shiftsB) return false;
    const ShapeData &a = shapes_.data[c.shapeA], &b = shapes_.data[c.shapeB];
    double had = kNearlyClosed * lengthScale(a.innerRadius, b.innerRadius);
    for (int i = 0; i < c.count; i++) had = std::max(had, -double(c.points.gap[i]));
    const double depth = penetrationDepth(
        a.geometry, b.geometry, inverse(endOf(c.bodyA) * a.inCentreFrame) * (endOf(c.bodyB) * b.inCentreFrame));
    if (!(depth > had)) return false;
    const bool lighterB = bodies_.mass[c.bodyB].mass < bodies_.mass[c.bodyA].mass;
    const bool ofB = shiftsB && (lighterB || !shiftsA);
    const Vec3 frame = bodies_.motion[ofB ? c.bodyA : c.bodyB].linearVelocity;
    return shiftBy(ofB ? c.bodyB : c.bodyA, n * (ofB ? depth - had : had - depth), frame);
  }

 private:
  bool moves(BodyIndex body) const {
    const BodyData& data = bodies_.data[body];
    return data.type == BodyType::dynamic && data.activity == BodyActivity::awake && !context_.solved[body].rest;
  }

  Transform endOf(BodyIndex body) const {
    const BodyMotion& m = bodies_.motion[body];
    if (moves(body)) return {m.position + context_.solved[body].d, rotationAtEnd(body, context_)};
    if (bodies_.data[body].type == BodyType::dynamic) return {m.position, m.rotation};
    return {m.position + m.linearVelocity * context_.dt,
            normalized(quatFromRotationVector(m.angularVelocity * context_.dt) * m.rotation)};
  }

  // The work against gravity and outside forces is taken from the body's own motion if nothing presses on it, seen from
  // what it is shifted out of: the last check asks groups alone that are supported.
  bool shiftBy(BodyIndex body, Vec3 way, Vec3 frame) {
    const SolvedMotion& s = context_.solved[body];
    if (s.flying) {
      const BodyData& data = bodies_.data[body];
      const Vec3 force = context_.gravity * (bodies_.mass[body].mass * data.gravityScale) + data.force;
      const double work = std::max(0.0, -dot(force, way)), has = kineticEnergyAtEnd(body, frame, context_);
      if (!(work < has)) return false;
      const double lost = std::sqrt(1 - work / has) - 1;
      accelerate(body, (s.velocity - frame) * lost, s.angularMomentum * lost, context_);
    }
    shorten(body, 1, 1, way, false, context_);
    return true;
  }

  const BodySet& bodies_;
  const ShapeSet& shapes_;
  StepContext& context_;
  bool alone_;
  std::pmr::vector<BodyIndex> tied_;  // by firm ties, ascending
};

}  // namespace

bool keepOut(const Island& island, const Registry& registry, StepContext& context) {
  KeptOut bodies(island, registry, context);
  if (std::none_of(island.bodies.begin(), island.bodies.end(), [&](BodyIndex b) { return bodies.mayBeShifted(b); }))
    return false;
  bool any = false, shifted = true;
  for (int sweep = 0; sweep < kMostLooks && shifted; sweep++) {
    shifted = false;
    island.rows.eachManifold([&](ContactIndex contact) {
      const Contact& c = context.ties->contacts.contacts[contact];
      const Vec3 n = registry.bodies.motion[c.bodyA].orientation * context.ties->contacts.geometry[contact].normal;
      shifted = bodies.part(c, n) || shifted;
    });
    any = any || shifted;
  }
  return any;
}

}  // namespace brickfall
