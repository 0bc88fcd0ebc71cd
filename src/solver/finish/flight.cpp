#include "solver/finish/flight.h"

#include "solver/finish/motion.h"
#include "solver/rigid_sum.h"
#include "solver/support.h"

namespace brickfall {

namespace {

// The part of a group's momenta that the solve missed, as a motion of the whole group: kg m and kg m2.
RigidSum missingOf(const Island& island, std::span<const std::uint32_t> group, const StepContext& context) {
  const BodySet& bodies = *context.bodies;
  RigidSum missing(bodies.motion[island.bodies[group.front()]].position);
  for (std::uint32_t i : group) {
    const BodyIndex body = island.bodies[i];
    const FreeMotion& free = context.free[body];
    const SolvedMotion& s = context.solved[body];
    const double m = bodies.mass[body].mass;
    missing.add(m, bodies.motion[body].position, bodies.worldInertia(body), (free.d - s.d) * m,
                (free.angularMomentum - s.angularMomentum) * island.dt);
  }
  return missing;
}

// m: half of the way that outside forces add to the way of the group.
Vec3 halfFall(const Island& island, std::span<const std::uint32_t> group, const StepContext& context) {
  Vec3 fall;
  double mass = 0;
  for (std::uint32_t i : group) {
    const BodyIndex body = island.bodies[i];
    const double m = context.bodies->mass[body].mass;
    fall += (context.free[body].d - context.free[body].startVelocity * island.dt) * m;
    mass += m;
  }
  return fall * (-0.5 / mass);
}

// Marks bodies that a chain of ties leads to something fixed or kinematic. A tie counts if it carries force, or if its
// gap is less than the way between the two parabolas.
std::pmr::vector<char> nearSupport(const Island& island, const StepContext& context) {
  const Vec3f fall = toFloat(context.gravity * (-0.5 * island.dt * island.dt));
  std::pmr::vector<char> near(island.memory);
  findSupported(island, near, [&](const auto& kind, std::size_t k) {
    return kind.meetsWithin(k, fall, island.motion.data(), context);
  });
  return near;
}

}  // namespace

void finishFlights(const Island& island, StepContext& context) {
  std::pmr::vector<char> near(island.memory);
  for (std::size_t g = 0; g < island.groups.count(); g++) {
    if (!island.groups.flies(g)) continue;
    if (near.empty()) near = nearSupport(island, context);
    const std::span<const std::uint32_t> group = island.groups.bodies(g);
    if (group.size() > 1) {
      const RigidSum missing = missingOf(island, group, context);
      const Vec3 centre = missing.centre(), move = missing.velocity(), turn = missing.spin();
      for (std::uint32_t i : group) {
        const BodyIndex body = island.bodies[i];
        const Vec3 way = move + cross(turn, context.bodies->motion[body].position - centre);
        shift(body, way, turn, context);
        accelerate(body, way * (1 / island.dt), context.bodies->worldInertia(body) * turn * (1 / island.dt), context);
      }
    }
    if (near[group.front()]) continue;
    const Vec3 fall = halfFall(island, group, context);
    for (std::uint32_t i : group) shift(island.bodies[i], fall, {}, context);
  }
}

}  // namespace brickfall
