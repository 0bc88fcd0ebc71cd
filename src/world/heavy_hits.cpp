#include "world/heavy_hits.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "geometry/core.h"
#include "geometry/queries.h"
#include "solver/blows.h"
#include "solver/mortar/law.h"
#include "solver/step_context.h"
#include "world/core_sweep.h"
#include "world/fly_ahead.h"
#include "world/look_ahead.h"

namespace brickfall {

namespace {

//! of its thickness along the way | too small: cost of hits
//! | too large: bodies that a ball knocks out are gone before they can push anything aside
constexpr double kHitWay = 0.35;  // of the struck body, in a part
//! of another's way | too small: cost of hits | too large: loose bodies are pressed into what hits them
constexpr double kFirstPart = 0.25;  // of a hit
//! of the time in which mortar gives the blow's impulse with all of its strength | too small: cost of hits
//! | too large: what lies beside what is struck gives way before it moves, or holds what a blow would break
constexpr double kBlowPart = 0.5;  // the first of a blow that breaks mortar
//! x the part before | too small: cost of the steps after hits
//! | too large: long parts damp the waves of a blow, and a wall that is hit rocks less
constexpr double kBlowGrows = 4.0 / 3;  // each part after a blow on mortar, at most
//! not of the method: no bound
constexpr double kAny = std::numeric_limits<double>::infinity();  // s: of any length

// m: a body that goes less far in a step asks for no parts.
double littleWay(double radius) { return kLittleWay * radius / kReferenceSize; }

double thicknessAlong(const Shape& shape, Vec3 direction) {
  return dot(coreSupport(shape, direction) - coreSupport(shape, -direction), direction) + 2 * coreRadius(shape);
}

class HitSearch {
 public:
  HitSearch(const Registry& registry, const Proximity& proximity, const Ties& ties, const HitRoom& room,
            const HitPart& before)
      : bodies_(registry.bodies),
        shapes_(registry.shapes),
        proximity_(proximity),
        ties_(ties),
        dt_(room.left),
        resting_(room.resting),
        gravity_(room.gravity),
        flown_(before.flight),
        rings_(before.rings > 0) {}

  void weigh(BodyIndex body) { lightest_ = std::min(lightest_, bodies_.mass[body].mass); }
  void look(BodyIndex body) {
    const BodyMotion& m = bodies_.motion[body];
    const double speed = length(m.linearVelocity), inner = bodies_.mass[body].innerRadius;
    if (bodies_.still[body]) return;
    if (!(speed * dt_ > littleWay(inner)) && !(ties_.mortar.any() && strikes(body, lightest_, speed))) return;
    const Sweep own = sweepOf(bodies_, body, m.linearVelocity * dt_, m.angularVelocity * dt_);
    double mass = 0;                         // kg, of bodies on the way
    double flight = 1, part = 1, parts = 0;  // of the body
    bool breaksMortar = false;
    for (ShapeIndex shape : bodies_.shapes[body]) {
      const ShapeData& s = shapes_.data[shape];
      const Aabb reach = sweptBounds(s, own);
      // What ends a little before what mortar holds flies ahead to it, and hits it in this step.
      const double beyond = ties_.mortar.any() ? kShortOf * bodies_.mass[body].outerRadius : 0;
      const Vec3 room{beyond, beyond, beyond};
      const Aabb further{reach.lower - room, reach.upper + room};
      proximity_.broadPhase->query(further, [&](std::uint32_t other) {
        const ShapeData& o = shapes_.data[other];
        const Aabb& there = proximity_.around[other].swept;  // kept bounds are the tree's history
        if (!overlaps(reach, there) && !(overlaps(further, there) && isHeld(o.body))) return true;
        if (o.body == body || !isHeavyFor(body, o.body) || !shapes_.mayTouch(shape, other)) return true;
        if (!ties_.mayCollide(body, o.body)) return true;
        const bool held = isHeld(o.body);
        const Approach way = approach(body, shape, other, held ? beyond : 0);
        if (!(way.parts > 0)) return true;
        part = std::min(part, 1 / way.parts);
        flight = std::min(flight, way.flight);
        parts = std::max(parts, way.parts * (1 - way.flight));
        breaksMortar = breaksMortar || way.breaksMortar;
        mass += bodies_.mass[o.body].mass / double(bodies_.shapes[o.body].size());
        return true;
      });
    }
    // A loose pebble on its way has not the whole world stepped in parts.
    if (!breaksMortar && !bodies_.isDriven(body) && !(mass >= kTrifle * bodies_.mass[body].mass)) return;
    flight_ = std::min(flight_, flight);
    part_ = std::min(part_, part);
    parts_ = std::max(parts_, parts);
    breaksMortar_ = breaksMortar_ || breaksMortar;
  }

  // Share of the step in which nothing hits yet.
  double flight() const { return flight_; }
  // Share of the step in which a hit is to be made.
  double part() const { return part_; }
  // In how many what follows the flight is to be made; 0: nothing hits.
  double parts() const { return parts_; }
  // Whether a blow will break mortar.
  bool breaksMortar() const { return breaksMortar_; }

 private:
  // Mortared bodies are pushed out of their neighbours, which stop what comes after: there any heavier one is heavy.
  bool isHeavyFor(BodyIndex body, BodyIndex other) {
    if (bodies_.data[other].type != BodyType::dynamic) return false;
    const double times = isHeld(other) ? 1 + kTrifle : kHeavier;
    return bodies_.isDriven(body) || bodies_.mass[body].mass >= times * bodies_.mass[other].mass;
  }
  // By mortar, which is looked up where anything is hit.
  bool isHeld(BodyIndex body) {
    if (!ties_.mortar.any()) return false;
    if (firstOf_.empty()) listMortar();
    return firstOf_[body] < firstOf_[body + 1];
  }
  // A wall has three joints for each brick, and a ball asks of many bricks: by body, those awake first.
  void listMortar() {
    auto each = [&](auto&& visit) {
      ties_.mortar.eachAwake(visit);
      ties_.mortar.eachAsleep(visit);
    };
    firstOf_.assign(bodies_.motion.size() + 1, 0);
    each([&](const Link& link) {
      for (BodyIndex body : {link.bodyA, link.bodyB}) firstOf_[body + 1]++;
    });
    for (std::size_t body = 1; body < firstOf_.size(); body++) firstOf_[body] += firstOf_[body - 1];
    mortarOf_.resize(firstOf_.back());
    std::vector<std::uint32_t> next = firstOf_;
    each([&](const Link& link) {
      for (BodyIndex body : {link.bodyA, link.bodyB}) mortarOf_[next[body]++] = link.index;
    });
  }

  // Whether a body may meet another that it moves by `way` against, judged by the bounding spheres of both. Bodies that
  // it leaves behind do not count.
  bool mayMeet(BodyIndex body, BodyIndex other, Vec3 way, double far) const {
    const BodyMass &own = bodies_.mass[body], &its = bodies_.mass[other];
    const Vec3 to = bodies_.motion[other].position - bodies_.motion[body].position;
    const double along = dot(to, way) / far;
    if (along < own.innerRadius - own.outerRadius) return false;  // it may be widest behind its centre, unless round
    return length(to - way * std::clamp(along / far, 0.0, 1.0)) < own.outerRadius + its.outerRadius;
  }

  // s: in which mortar with all of its strength gives the impulse of a blow: that with which what comes along a way
  // at a speed and what it strikes come to one velocity. A longer part sees none of the force that a blow makes.
  // Infinity where the blow has not the energy to break it.
  double stopping(BodyIndex body, BodyIndex other, Vec3 along, double speed) const {
    Holding held;
    for (std::uint32_t i = firstOf_[other]; i < firstOf_[other + 1]; i++)
      mortar::addHolding(ties_.mortar.slots[mortarOf_[i]], bodies_, along, held);
    const double mass = bodies_.mass[body].mass, struck = bodies_.mass[other].mass;
    return 0.5 * mass * speed * speed > held.energy ? mass * struck / (mass + struck) * speed / held.force : kAny;
  }

  // Mortar may get a blow (solver/blows.h) from what is faster than what begins to rest, or heavy, however short the
  // part is.
  bool strikes(BodyIndex body, double mass, double speed) const {
    if (rings_) return false;  // parts are short already
    return speed > resting_ * scaleOf(bodies_.mass[body].innerRadius, gravity_).speed ||
           bodies_.mass[body].mass >= kHeavier * mass;
  }
  // Two shapes on each other: their blow is over.
  bool presses(ShapeIndex a, ShapeIndex b) const {
    CandidatePair pair{std::min(a, b), std::max(a, b)};
    const auto& pairs = ties_.contacts.pairs;
    for (auto at = std::lower_bound(pairs.begin(), pairs.end(), pair); at != pairs.end(); ++at) {
      if (at->shapeA != pair.shapeA || at->shapeB != pair.shapeB) break;
      if (at->contact == kNoIndex) continue;
      const Contact& c = ties_.contacts.contacts[at->contact];
      if (c.touching || c.struck) return true;
    }
    return false;
  }

  struct Approach {
    double parts = 0;   // that it asks for, if all of the step were a hit; 0: they do not meet
    double flight = 1;  // share of the step before they touch, or come near
    bool breaksMortar = false;
  };
  // `beyond`: m, that count as a part of the way.
  Approach approach(BodyIndex body, ShapeIndex own, ShapeIndex struck, double beyond) {
    const ShapeData &s = shapes_.data[own], &o = shapes_.data[struck];
    const BodyMotion& other = bodies_.motion[o.body];
    const Vec3 way = (bodies_.motion[body].linearVelocity - other.linearVelocity) * dt_;
    const double far = length(way);
    // What goes a little way asks for parts by a blow alone.
    const bool little = !(far > littleWay(o.innerRadius));
    if (little && !(far > 0 && isHeld(o.body) && strikes(body, bodies_.mass[o.body].mass, far / dt_))) return {};
    const double room = 1 + beyond / far;
    if (!mayMeet(body, o.body, way * room, far * room)) return {};
    const Vec3 direction = way * (1 / far);
    const Vec3 along = rotate(conjugate(o.inCentreFrame.rotation), transposeTimes(other.orientation, direction));
    Approach out{far / (kHitWay * thicknessAlong(o.geometry, along))};
    // Springs of a blow give by its way in the part. Mortar's takes its time, below.
    if (flown_ && !isHeld(o.body)) out.parts /= kFirstPart;
    const Transform at = shapes_.worldPose(struck, bodies_);
    Transform ownInStruck = inverse(at) * shapes_.worldPose(own, bodies_);
    const Vec3 motion = rotate(conjugate(at.rotation), way * room);
    auto until = [&](double apart) {
      return timeOfImpact(o.geometry, s.geometry, ownInStruck, motion, apart * o.innerRadius);
    };
    const std::optional<double> met = until(kShapesRound), near = met ? met : until(kShortOf);
    if (!near) return {};
    out.flight = std::min(room * *near, 1.0);
    // Before a blow: what follows it pushes, and the joints stop it. It acts along the normal of where they meet.
    const Approach noBlow = little ? Approach{} : out;
    if (!met || (*met == 0 && (rings_ || presses(own, struck))) || !isHeld(o.body) || bodies_.isDriven(body))
      return noBlow;
    ownInStruck.position += motion * *met;
    const DistanceResult gap = shapeDistance(o.geometry, s.geometry, ownInStruck);
    const Vec3 push = gap.distance > 0 ? rotate(at.rotation, (gap.onA - gap.onB) * (1 / gap.distance)) : direction;
    const double closing = dot(way, push) / dt_;
    if (!(closing > 0)) return noBlow;
    const double stops = stopping(body, o.body, push, closing);
    out.breaksMortar = stops < kAny;
    if (!out.breaksMortar) return noBlow;
    out.parts = std::max(out.parts, dt_ / (kBlowPart * stops));
    return out;
  }

  const BodySet& bodies_;
  const ShapeSet& shapes_;
  const Proximity& proximity_;
  const Ties& ties_;
  const double dt_;         // s
  const double resting_;    // m/s, at the scale of reference
  const double gravity_;    // m/s2
  double lightest_ = kAny;  // kg, of what is awake
  const bool flown_;        // the part before ended where this one hits
  const bool rings_;        // a blow on mortar is under way: what is as near as shapes are round is part of it
  std::vector<std::uint32_t> firstOf_;  // by body: its first in `mortarOf_`; empty: not looked up yet
  std::vector<MortarIndex> mortarOf_;
  double flight_ = 1, part_ = 1, parts_ = 0;
  bool breaksMortar_ = false;
};

}  // namespace

HitPart partForHits(const Registry& registry, const Activity& activity, const Proximity& proximity, const Ties& ties,
                    const HitRoom& room, const HitPart& before) {
  const double left = room.left;
  if (room.most == 1) return {left, false, before.rings > 0 ? kBlowGrows * left : 0};
  HitSearch search(registry, proximity, ties, room, before);
  for (BodyIndex body : activity.awake) search.weigh(body);
  for (BodyIndex body : activity.awake) search.look(body);
  for (BodyIndex body : activity.moving) search.look(body);
  // Parts before the hit would be missing after it.
  if (search.flight() > 2 * search.part()) return {left * (search.flight() - kTrifle * search.part()), true};
  // What a short part has begun, a part twice as long at most goes on with; waves in mortar one little longer.
  double longest = search.parts() > 0 ? left / search.parts() : kAny;
  if (before.rings > 0)
    longest = std::min(longest, before.rings);
  else if (before.length > 0 && !before.flight)
    longest = std::min(longest, 2 * before.length);
  const bool rings = before.rings > 0 || search.breaksMortar();
  return {left / std::ceil(std::clamp(left / longest, 1.0, std::ldexp(1.0, room.most - 1))), false,
          rings ? kBlowGrows * longest : 0};
}

}  // namespace brickfall
