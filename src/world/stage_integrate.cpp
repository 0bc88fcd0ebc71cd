// New poses and velocities. Whatever became non-finite is quarantined here: held where it was, out of all contacts.
#include <cmath>

#include "brickfall/limits.h"
#include "solver/store.h"
#include "world/world_impl.h"

namespace brickfall {

namespace {

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
  if (!isSane(next)) return false;
  m = next;
  return true;
}

}  // namespace

bool isSane(const BodyMotion& m) {
  return isFinite(m.position) && isFinite(m.rotation) && isFinite(m.linearVelocity) && isFinite(m.angularVelocity) &&
         std::fabs(m.position.x) < lost::kDistance && std::fabs(m.position.y) < lost::kDistance &&
         std::fabs(m.position.z) < lost::kDistance;
}

// A body that its forces or impulses would make absurdly fast is taken out before it can spoil the sums of its island.
void World::Impl::quarantineAbsurd() {
  for (BodyIndex body : awake) {
    if (bodies.still[body]) continue;
    const BodyMotion& m = bodies.motion[body];
    const BodyData& data = bodies.data[body];
    Vec3 velocity = m.linearVelocity + data.force * (bodies.mass[body].invMass * context.dt);
    Vec3 spin = m.angularVelocity;
    if (!(data.torque == Vec3{})) spin += bodies.worldInvInertia(body) * data.torque * context.dt;
    bool fine = length(velocity) < lost::kSpeed && length(spin) < lost::kSpeed;  // false for NaN
    if (!fine) quarantine(body);
  }
  for (BodyIndex body : pendingQuarantine) isolate(body);
  pendingQuarantine.clear();
}

bool World::Impl::solvedWell(const Island& island) const {
  for (BodyIndex body : island.bodies) {
    const SolvedMotion& s = context.solved[body];
    if (!isFinite(s.d) || !isFinite(s.th) || !isFinite(s.velocity) || !isFinite(s.angularMomentum)) return false;
  }
  return true;
}

// The sums of an island overflowed. Its fastest body, which must have caused it, is quarantined; the others stay where
// they are for this step, with the velocities they had, and their contacts start afresh.
void World::Impl::salvage(Island& island) {
  BodyIndex culprit = island.bodies.front();
  double fastest = -1;
  for (BodyIndex body : island.bodies) {
    const FreeMotion& free = context.free[body];
    double speed = length(free.startVelocity) + length(free.startSpin) * bodies.mass[body].outerRadius;
    speed += length(free.d) + length(free.th) * bodies.mass[body].outerRadius;
    if (!(speed <= fastest)) {  // also takes NaN
      culprit = body;
      fastest = std::isfinite(speed) ? speed : 1e300;
    }
  }
  for (BodyIndex body : island.bodies) {
    bodies.motion[body].linearVelocity = context.free[body].startVelocity;
    bodies.motion[body].angularVelocity = context.free[body].startSpin;
    bodies.still[body] = 0;
  }
  for (ContactIndex contact : island.rows.contacts.contactOf) {
    Contact& c = contacts.contacts[contact];
    for (int i = 0; i < 4; i++) clearPoint(c.points, i);
    c.touching = false;
    c.fresh = true;
  }
  island.ending = IslandEnding::unsolved;
  quarantine(culprit);
}

// Pose, velocity and acceleration of a body after the solve.
void World::Impl::finishBody(BodyIndex body) {
  BodyData& data = bodies.data[body];
  BodyMotion& m = bodies.motion[body];
  if (context.solved[body].rest) {
    m.linearVelocity = m.angularVelocity = {};
    bodies.still[body] = 1;
  } else {
    bodies.still[body] = 0;
    if (!move(body, bodies, context)) quarantine(body);
    keepBounds(body);
  }
  data.flying = context.solved[body].flying;
  if (!lastSubstep) return;
  data.linearAcceleration = (m.linearVelocity - data.lastLinearVelocity) * (1 / callDt);
  data.angularAcceleration = (m.angularVelocity - data.lastAngularVelocity) * (1 / callDt);
  data.lastLinearVelocity = m.linearVelocity;
  data.lastAngularVelocity = m.angularVelocity;
}

void World::Impl::integrate() {
  StageTimer timer(report, Stage::integrate);
  stopAtObstacles();
  for (auto& island : islands.awake) {
    if (island->settled()) {
      // Nothing moves and nothing did in the last step.
      for (BodyIndex body : island->bodies)
        if (!bodies.still[body]) finishBody(body);
      continue;
    }
    if (!solvedWell(*island)) {
      salvage(*island);
      continue;
    }
    advanceRows(*island, context);
    for (BodyIndex body : island->bodies) finishBody(body);
  }
  for (BodyIndex body : islands.single) finishBody(body);
  for (BodyIndex body : unsettled) bodies.still[body] = 1;
  unsettled.clear();
  for (BodyIndex body : moving) {
    BodyMotion& m = bodies.motion[body];
    m.position += m.linearVelocity * context.dt;
    bodies.setRotation(body, normalized(quatFromRotationVector(m.angularVelocity * context.dt) * m.rotation));
    bodies.still[body] = 0;
    keepBounds(body);
  }
  for (BodyIndex body : pendingQuarantine) isolate(body);
  pendingQuarantine.clear();
}

// The tree must hold a body where it is now: queries between steps rely on it. A collision may throw it out of the bounds
// that its velocity before the step foretold.
void World::Impl::keepBounds(BodyIndex body) {
  for (ShapeIndex shape : bodies.shapes[body]) {
    ShapeData& s = shapes.data[shape];
    Aabb now = bounds(s.geometry, shapes.worldPose(shape, bodies));
    if (!contains(broadPhase->kept(s.proxy), now)) broadPhase->update(s.proxy, merged(now, s.swept), slackOf(shape));
  }
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
    broadPhase->remove(shapes.data[shape].proxy);
    shapes.data[shape].proxy = kNoProxy;
  }
  delist(body);
}

}  // namespace brickfall
