// The start of a step for one island: its bodies' constants and free motions. Each kind of row prepares its own.
#include "solver/prepare.h"

namespace brickfall {

namespace {

void writeInertia(SolveMass& out, const Mat3& world, double perDt2) {
  out.inertia[0] = float(world.row[0].x * perDt2);
  out.inertia[1] = float(world.row[1].x * perDt2);
  out.inertia[2] = float(world.row[1].y * perDt2);
  out.inertia[3] = float(world.row[2].x * perDt2);
  out.inertia[4] = float(world.row[2].y * perDt2);
  out.inertia[5] = float(world.row[2].z * perDt2);
}

// Way of the island as a whole. It is left out of d, so that a fast island in flight is solved as finely as one at
// rest.
Vec3 rigidTravel(const Island& island, const StepContext& context) {
  if (island.grounded()) return {};
  Vec3 moment;
  double mass = 0;
  for (BodyIndex body : island.bodies) {
    moment += context.free[body].d * context.bodies->mass[body].mass;
    mass += context.bodies->mass[body].mass;
  }
  return moment * (1 / mass);
}

}  // namespace

void prepareBodies(Island& island, const StepContext& context) {
  const BodySet& bodies = *context.bodies;
  std::size_t count = island.bodies.size();
  island.motion.resize(count + island.partners.size());
  island.masses.resize(count);
  island.speeds.resize(count);
  island.origin = bodies.motion[island.bodies.front()].position;
  island.travel = rigidTravel(island, context);
  double perDt2 = 1 / (island.dt * island.dt);
  for (std::size_t i = 0; i < count; i++) {
    BodyIndex body = island.bodies[i];
    const FreeMotion& free = context.free[body];
    SolveMass& m = island.masses[i];
    const BodyMass& mass = bodies.mass[body];
    island.speeds[i] = float((length(free.startVelocity) + length(free.startSpin) * mass.outerRadius) /
                             island.facts.scale.ofBody(mass.innerRadius).speed);
    m.mass = float(mass.mass * perDt2);
    writeInertia(m, bodies.worldInertia(body), perDt2);
    m.dFree = toFloat(free.d - island.travel);
    m.thFree = toFloat(free.th);
    m.position = toFloat(bodies.motion[body].position - island.origin);
  }
  for (std::size_t i = 0; i < island.partners.size(); i++) {
    const BodyMotion& m = bodies.motion[island.partners[i]];
    SolveMotion& out = island.motion[count + i];
    out.d = toFloat(m.linearVelocity * island.dt - island.travel);
    out.th = toFloat(m.angularVelocity * island.dt);
  }
}

void prepareRows(Island& island, Ties& ties, const StepContext& context) {
  island.rows.eachKind([&](auto& kind) { kind.prepare(island, ties, context); });
}

}  // namespace brickfall
