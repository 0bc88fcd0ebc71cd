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

// Way of the island as a whole, where nothing holds it.
RigidWay rigidWay(const Island& island, const StepContext& context) {
  RigidWay way;
  if (island.grounded() || island.facts.locked) return way;
  if (const RigidWay* all = island.chunks.ofAll()) return *all;
  Vec3 moment;
  double mass = 0;
  for (BodyIndex body : island.bodies) {
    moment += context.free[body].d * context.bodies->mass[body].mass;
    mass += context.bodies->mass[body].mass;
  }
  way.move = moment * (1 / mass);
  return way;
}

// rad: what the solve takes for the free turn of a body, beyond that of the island. Of one that turns, such that its
// angular momentum is that of the end of the step if it turns with the island.
Vec3 freeTurnOf(const Island& island, BodyIndex body, const StepContext& context) {
  const FreeMotion& free = context.free[body];
  if (!island.rigid.turns()) return free.th;
  const Mat3& turned = island.rigid.turned;
  const Vec3 along = turned * (context.bodies->worldInertia(body) * transposeTimes(turned, island.rigid.spin));
  return context.bodies->worldInvInertia(body) * (free.angularMomentum * island.dt - along);
}

// Forces act along arms of the start of the step, and hold a chunk that turns on arcs of the middle. The turn that this
// would give it is left out: its momenta are made exact in the finish.
void balanceTurn(Island& island, const BodySet& bodies) {
  RigidSum sum(island.origin);
  for (std::size_t i = 0; i < island.bodies.size(); i++) {
    const BodyIndex body = island.bodies[i];
    const double m = bodies.mass[body].mass;
    const Mat3 inertia = bodies.worldInertia(body);
    sum.add(m, bodies.motion[body].position, inertia, toDouble(island.masses[i].dFree) * m,
            inertia * toDouble(island.masses[i].thFree));
  }
  const Vec3 turn = sum.spin(), centre = sum.centre();
  for (std::size_t i = 0; i < island.bodies.size(); i++) {
    SolveMass& m = island.masses[i];
    m.dFree = toFloat(toDouble(m.dFree) - cross(turn, bodies.motion[island.bodies[i]].position - centre));
    m.thFree = toFloat(toDouble(m.thFree) - turn);
  }
}

void findLocks(Island& island, const BodySet& bodies) {
  island.locks.clear();
  if (!island.facts.locked) return;
  for (BodyIndex body : island.bodies) island.locks.push_back(bodies.mass[body].locks);
}

}  // namespace

void prepareBodies(Island& island, const StepContext& context) {
  const BodySet& bodies = *context.bodies;
  std::size_t count = island.bodies.size();
  island.motion.resize(count + island.partners.size());
  island.masses.resize(count);
  island.speeds.resize(count);
  findLocks(island, bodies);
  island.origin = bodies.motion[island.bodies.front()].position;
  island.chunks.find(island, context);
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
    m.dFree = toFloat(free.d - island.rigid.endOf(bodies.motion[body].position));
    m.thFree = toFloat(freeTurnOf(island, body, context));
    m.position = toFloat(bodies.motion[body].position - island.origin);
  }
  if (island.rigid.turns()) balanceTurn(island, bodies);
  for (std::size_t i = 0; i < island.partners.size(); i++) {
    const BodyMotion& m = bodies.motion[island.partners[i]];
    SolveMotion& out = island.motion[count + i];
    out.d = toFloat(m.linearVelocity * island.dt - island.rigid.move);
    out.th = toFloat(m.angularVelocity * island.dt);
  }
}

void prepareRows(Island& island, Ties& ties, const StepContext& context) {
  island.rows.eachKind([&](auto& kind) { kind.prepare(island, ties, context); });
}

}  // namespace brickfall
