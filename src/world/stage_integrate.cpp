// New poses and velocities. Whatever became non-finite is quarantined here: held where it was, out of all contacts.
#include <cmath>

#include "solver/store.h"
#include "world/world_impl.h"

namespace brickfall {

namespace {

constexpr double kLargestCoordinate = 1e7;  // m: a body beyond is lost, as one that became non-finite

bool sane(const BodyMotion& m) {
  return isFinite(m.position) && isFinite(m.rotation) && isFinite(m.linearVelocity) && isFinite(m.angularVelocity) &&
         std::fabs(m.position.x) < kLargestCoordinate && std::fabs(m.position.y) < kLargestCoordinate &&
         std::fabs(m.position.z) < kLargestCoordinate;
}

// Applies the solved motion. Returns false, and leaves the motion as it was, if the result is not sane.
bool move(BodyIndex body, BodySet& bodies, const StepContext& context) {
  const SolvedMotion& s = context.solved[body];
  const FreeMotion& free = context.free[body];
  BodyMotion& m = bodies.motion[body];
  BodyMotion next = m;
  next.position = m.position + s.d;
  next.rotation = s.freeTurn ? free.rotation : normalized(quatFromRotationVector(s.th) * m.rotation);
  next.linearVelocity = s.velocity;
  next.orientation = toMatrix(next.rotation);
  // Angular momentum carries over exactly; the spin follows from the new orientation.
  next.angularVelocity =
      next.orientation * (bodies.mass[body].invInertia * transposeTimes(next.orientation, s.angularMomentum));
  if (!sane(next)) return false;
  m = next;
  return true;
}

}  // namespace

void World::Impl::integrate() {
  StageTimer timer(report, Stage::integrate);
  double perDt = 1 / context.dt;
  auto finish = [&](BodyIndex body) {
    BodyData& data = bodies.data[body];
    BodyMotion& m = bodies.motion[body];
    if (context.solved[body].rest) {
      m.linearVelocity = m.angularVelocity = {};
      bodies.still[body] = 1;
    } else {
      bodies.still[body] = 0;
      if (!move(body, bodies, context)) quarantine(body);
    }
    data.flying = context.solved[body].flying;
    data.linearAcceleration = (m.linearVelocity - data.lastLinearVelocity) * perDt;
    data.angularAcceleration = (m.angularVelocity - data.lastAngularVelocity) * perDt;
    data.lastLinearVelocity = m.linearVelocity;
    data.lastAngularVelocity = m.angularVelocity;
    data.force = data.torque = {};
  };
  for (auto& island : islands.awake) {
    if (island->settled) {
      // Nothing moves and nothing did in the last step.
      for (BodyIndex body : island->bodies)
        if (!bodies.still[body]) finish(body);
      continue;
    }
    advanceGaps(*island, context);
    for (BodyIndex body : island->bodies) finish(body);
  }
  for (BodyIndex body : islands.single) finish(body);
  for (BodyIndex body : moving) {
    BodyMotion& m = bodies.motion[body];
    m.position += m.linearVelocity * context.dt;
    bodies.setRotation(body, normalized(quatFromRotationVector(m.angularVelocity * context.dt) * m.rotation));
    bodies.still[body] = 0;
  }
  for (BodyIndex body : pendingQuarantine) isolate(body);
  pendingQuarantine.clear();
}

// Holds a body that became non-finite: it keeps its last good pose, without velocity.
void World::Impl::quarantine(BodyIndex body) {
  BodyMotion& m = bodies.motion[body];
  m.linearVelocity = m.angularVelocity = {};
  bodies.data[body].quarantined = true;
  report.quarantined.push_back(idOf(body));
  pendingQuarantine.push_back(body);
}

// Takes a quarantined body out of all contacts and of every list that the step walks.
void World::Impl::isolate(BodyIndex body) {
  removeContactsOf(body);
  for (ShapeIndex shape : bodies.shapes[body]) {
    broadPhase.remove(shapes.data[shape].proxy);
    shapes.data[shape].proxy = kNoProxy;
  }
  delist(body);
}

}  // namespace brickfall
