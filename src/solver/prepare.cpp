// The start of a step for one island: its bodies' constants and free motions. Each kind of row prepares its own.
#include "solver/prepare.h"

#include "solver/rigid_sum.h"

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

// Way of the island as a whole, where nothing holds it.
RigidWay rigidWay(const Island& island, const StepContext& context) {
  RigidWay way;
  if (island.grounded()) return way;
  const BodySet& bodies = *context.bodies;
  Vec3 moment;
  double mass = 0;
  for (BodyIndex body : island.bodies) {
    moment += context.free[body].d * bodies.mass[body].mass;
    mass += bodies.mass[body].mass;
  }
  way.move = moment * (1 / mass);
  if (!island.facts.mortared || island.facts.jointed) return way;
  RigidSum sum(island.origin);
  for (BodyIndex body : island.bodies) {
    const Mat3 inertia = bodies.worldInertia(body);
    const double m = bodies.mass[body].mass;
    sum.add(m, bodies.motion[body].position, inertia, context.free[body].d * m, inertia * context.free[body].startSpin * island.dt);
  }
  return rigidWayOf(sum);
}

}  // namespace

void prepareBodies(Island& island, const StepContext& context) {
  const BodySet& bodies = *context.bodies;
  std::size_t count = island.bodies.size();
  island.motion.resize(count + island.partners.size());
  island.masses.resize(count);
  island.speeds.resize(count);
  island.origin = bodies.motion[island.bodies.front()].position;
  island.rigid = rigidWay(island, context);
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
    m.dFree = toFloat(free.d - island.rigid.of(bodies.motion[body].position));
    m.thFree = toFloat(free.th - island.rigid.turn);
    m.position = toFloat(bodies.motion[body].position - island.origin);
  }
  for (std::size_t i = 0; i < island.partners.size(); i++) {
    const BodyMotion& m = bodies.motion[island.partners[i]];
    SolveMotion& out = island.motion[count + i];
    out.d = toFloat(m.linearVelocity * island.dt - island.rigid.move);
    out.th = toFloat(m.angularVelocity * island.dt);
  }
}

void prepareRows(Island& island, Ties& ties, const StepContext& context) {
  island.chunks.find(island, context);
  island.rows.eachKind([&](auto& kind) { kind.prepare(island, ties, context); });
}

}  // namespace brickfall
