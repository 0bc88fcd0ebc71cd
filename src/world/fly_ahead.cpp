#include "world/fly_ahead.h"

#include <algorithm>

#include "geometry/queries.h"
#include "solver/finish/motion.h"
#include "solver/free_motion.h"
#include "world/core_sweep.h"
#include "world/impact_parts.h"
#include "world/move_body.h"
#include "world/narrow_phase.h"

namespace brickfall {

namespace {

class FlightAhead {
 public:
  FlightAhead(const Registry& registry, const Proximity& proximity, const StepContext& context, const Island& island)
      : registry_(registry), proximity_(proximity), context_(context) {
    for (BodyIndex partner : island.partners)
      if (registry.bodies.isDriven(partner)) frame_ = registry.bodies.motion[partner].linearVelocity;
  }

  // m/s: flights are seen from what moves at this velocity.
  Vec3 frame() const { return frame_; }

  // Share of the step that the body may fly: 0 if that is not worth it.
  double shareOf(BodyIndex body) const {
    const BodyMass& mass = registry_.bodies.mass[body];
    const Vec3 way = (registry_.bodies.motion[body].linearVelocity - frame_) * context_.dt;
    const double least = kFarWay * mass.outerRadius;
    if (!(lengthSquared(way) > least * least)) return 0;
    double share = 1;
    for (ShapeIndex shape : registry_.bodies.shapes[body]) share = std::min(share, untilMet(body, shape, way));
    return share < 1 && share * length(way) > mass.outerRadius ? share : 0;
  }

 private:
  // By the ball around the body: however it turns, it is inside.
  double untilMet(BodyIndex body, ShapeIndex shape, Vec3 way) const {
    const BodySet& bodies = registry_.bodies;
    const BodyData& data = bodies.data[body];
    const Shape ball = sphereOfRadius(bodies.mass[body].outerRadius);
    // m: so far from what it meets it ends, and so far its way bends.
    const Vec3 acceleration = context_.gravity * data.gravityScale + data.force * bodies.mass[body].invMass;
    const double bend = 0.5 * length(acceleration) * context_.dt * context_.dt, apart = kShortOf * ball.radius + bend;
    const double side = ball.radius + 2 * apart;
    const Vec3 at = bodies.motion[body].position, room{side, side, side};
    double share = 1;
    proximity_.broadPhase->query({min(at, at + way) - room, max(at, at + way) + room}, [&](std::uint32_t other) {
      const ShapeData& o = registry_.shapes.data[other];
      if (o.body == body || !registry_.shapes.mayTouch(shape, other)) return true;
      share = std::min(share, untilNear(o, ball, at, way, apart));
      return share > 0;
    });
    return share;
  }

  // From where the other is, and from where it goes: each of the two may be moved before the other. What drives the
  // island stays where it is. What turns far counts as the ball around its body.
  double untilNear(const ShapeData& other, const Shape& ball, Vec3 at, Vec3 way, double apart) const {
    const BodySet& bodies = registry_.bodies;
    const BodyMotion& m = bodies.motion[other.body];
    const bool turns = turnsFar(bodies, other.body, m.angularVelocity * context_.dt);
    const Vec3 othersWay = (m.linearVelocity - frame_) * context_.dt;
    const Shape shape = turns ? sphereOfRadius(bodies.mass[other.body].outerRadius) : other.geometry;
    const Transform back = inverse(turns ? bodies.pose(other.body) : bodies.pose(other.body) * other.inCentreFrame);
    const Transform ballInOther{transformPoint(back, at), {}};
    // Faces that a straight way leaves behind, its bend may meet.
    if (!(shapeDistance(shape, ball, ballInOther).distance > apart)) return 0;
    auto until = [&](Vec3 motion) {
      return timeOfImpact(shape, ball, ballInOther, rotate(back.rotation, motion), apart).value_or(1);
    };
    return othersWay == Vec3{} ? until(way) : std::min(until(way), until(way - othersWay));
  }

  const Registry& registry_;
  const Proximity& proximity_;
  const StepContext& context_;
  Vec3 frame_;
};

void fly(BodyIndex body, double dt, Vec3 frame, BodySet& bodies, StepContext& context) {
  predictFreeMotion(context, bodies, body, dt, false);
  storeFreeBody(body, dt, context);
  shift(body, frame * -dt, {}, context);
  moveBody(body, bodies, context);
}

}  // namespace

void flyAhead(const Island& island, Registry& registry, Proximity& proximity, Ties& ties, StepContext& context,
              StepReport& report) {
  const FlightAhead ahead(registry, proximity, context, island);
  // What hangs on joints goes with what they hold.
  std::pmr::vector<char> held(island.bodies.size() + island.partners.size(), 0, island.memory);
  island.rows.eachKind([&]<class Kind>(const Kind& kind) {
    if constexpr (Kind::kLasts)
      for (std::size_t k = 0; k < kind.size(); k++) held[kind.ends(k).a] = held[kind.ends(k).b] = 1;
  });
  auto moved = [&](BodyIndex body) { return context.aheadOf(body) > 0; };
  for (std::size_t i = 0; i < island.bodies.size(); i++) {
    const BodyIndex body = island.bodies[i];
    const double share = held[i] ? 0.0 : ahead.shareOf(body);
    context.ahead[body] = {share, ahead.frame(), 1 - share, share > 0};
  }
  if (std::none_of(island.bodies.begin(), island.bodies.end(), moved)) return;
  for (BodyIndex body : island.bodies)
    if (moved(body)) fly(body, context.aheadOf(body) * context.dt, ahead.frame(), registry.bodies, context);
  NarrowPhase narrow(registry, context.dt, proximity, ties.contacts);
  island.rows.eachManifold([&](ContactIndex contact) {
    const Contact& c = ties.contacts.contacts[contact];
    if (moved(c.bodyA) || moved(c.bodyB)) narrow.follow(contact);
  });
  report.manifoldsComputed += narrow.computed();
}

}  // namespace brickfall
