#include "solver/finish/finish.h"

#include <algorithm>
#include <numeric>
#include <utility>

#include "solver/finish/motion.h"
#include "solver/rigid_sum.h"
#include "solver/support.h"
#include "solver/union_find.h"

namespace brickfall {

namespace {

// A motion of a whole group over the step.
struct Missing {
  RigidMotion motion;
  Vec3 aside;  // m: of the centre of mass from where its momentum leads
};

// The part of a group's momenta that the solve missed, kg m and kg m2. Bodies of an island that goes along arcs end at
// other arms than they started.
Missing missingOf(const Island& island, std::span<const std::uint32_t> group, const StepContext& context) {
  const BodySet& bodies = *context.bodies;
  const Vec3 origin = bodies.motion[island.bodies[group.front()]].position;
  const bool turns = island.rigid.turns();
  RigidSum missing(origin), free(origin), solved(origin);
  for (std::uint32_t i : group) {
    const BodyIndex body = island.bodies[i];
    const FreeMotion& f = context.free[body];
    const SolvedMotion& s = context.solved[body];
    const double m = bodies.mass[body].mass;
    const Vec3 at = bodies.motion[body].position;
    const Mat3 inertia = bodies.worldInertia(body);
    const Vec3 way = f.d + f.late * island.dt, spin = f.angularMomentum + inertia * f.lateSpin;
    if (turns) {
      free.add(m, at, inertia, way * m, spin * island.dt);
      solved.add(m, at + s.d, inertia, s.velocity * (m * island.dt), s.angularMomentum * island.dt);
    } else {
      missing.add(m, at, inertia, (way - s.d) * m, (spin - s.angularMomentum) * island.dt);
    }
  }
  if (!turns) return {missing.motion(), {}};
  return {{solved.centre(), free.velocity() - solved.velocity(),
           inverse(solved.inertia()) * (free.angularMomentum() - solved.angularMomentum())},
          solved.centre() - (free.centre() + free.velocity())};
}

// m: half of the way that outside forces add to the way of the group.
Vec3 halfFall(const Island& island, std::span<const std::uint32_t> group, const StepContext& context) {
  Vec3 fall;
  double mass = 0;
  for (std::uint32_t i : group) {
    const BodyIndex body = island.bodies[i];
    const double m = context.bodies->mass[body].mass;
    const FreeMotion& free = context.free[body];
    fall += (free.d + (free.late - free.startVelocity) * island.dt) * m;
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

// One that locks hold in another way would support the others.
bool fallsAlike(const Island& island, std::span<const std::uint32_t> group) {
  if (island.locks.empty()) return true;
  const unsigned first = island.locks[group.front()] & kAllWays;
  return std::all_of(group.begin(), group.end(),
                     [&](std::uint32_t i) { return (island.locks[i] & kAllWays) == first; });
}

// What nothing holds along a direction keeps its momentum in it.
void keepMomenta(const Island& island, std::span<const std::uint32_t> group, Vec3 ground, StepContext& context) {
  const bool turns = island.rigid.turns(), lies = ground != Vec3{};
  const auto [all, aside] = missingOf(island, group, context);
  RigidMotion missing = all;
  if (lies) missing = {all.centre, all.move - ground * dot(ground, all.move), {}};
  for (std::uint32_t i : group) {
    const BodyIndex body = island.bodies[i];
    const Vec3 at = context.bodies->motion[body].position;
    const Vec3 way = missing.at(turns ? at + context.solved[body].d : at);
    // Ways along arcs are what they should be, but for the floats in which the solve found them: a centre of mass
    // that these put aside would change the angular momentum.
    if (!turns)
      shift(body, way, missing.spin, context);
    else if (!lies)
      shift(body, -aside, {}, context);
    accelerate(body, way * (1 / island.dt), context.bodies->worldInertia(body) * missing.spin * (1 / island.dt),
               context);
  }
}

// Bodies that press on each other, and on smooth flat ground alone, as if they flew along it.
void finishOnSmoothGround(const Island& island, StepContext& context) {
  const std::uint32_t count = std::uint32_t(island.bodies.size());
  struct Ground {
    std::uint32_t body;
    Vec3 normal;
    bool smooth;
  };
  std::pmr::vector<Ground> grounds(island.memory);
  bool any = false;
  island.rows.each([&](const auto& kind, std::size_t k) {
    const RowEnds ends = kind.ends(k);
    if ((ends.a < count && ends.b < count) || !kind.ties(k, context)) return;
    const RowGrip grip = kind.grip(k, context);
    const bool smooth = grip.friction == 0 && grip.force != Vec3{} && !kind.sticks(k, context);
    grounds.push_back({std::min(ends.a, ends.b), kind.normal(k), smooth});
    any = any || smooth;
  });
  if (!any) return;
  UnionFind sets(count, island.memory);
  island.rows.each([&](const auto& kind, std::size_t k) {
    const RowEnds ends = kind.ends(k);
    if (ends.a < count && ends.b < count && kind.ties(k, context)) sets.join(ends.a, ends.b);
  });
  // By set, which its lowest body names.
  std::pmr::vector<Vec3> normals(count, Vec3{}, island.memory);
  std::pmr::vector<char> held(count, 0, island.memory);
  for (const Ground& ground : grounds) {
    const std::uint32_t set = sets.find(ground.body);
    if (normals[set] == Vec3{}) normals[set] = ground.normal;
    if (!ground.smooth || !(length(cross(normals[set], ground.normal)) <= kShapesRound)) held[set] = 1;
  }
  std::pmr::vector<std::uint32_t> bodies(count, island.memory);
  std::iota(bodies.begin(), bodies.end(), 0u);
  std::sort(bodies.begin(), bodies.end(),
            [&](std::uint32_t a, std::uint32_t b) { return std::pair(sets.find(a), a) < std::pair(sets.find(b), b); });
  for (auto begin = bodies.begin(), end = begin; begin != bodies.end(); begin = end) {
    const std::uint32_t set = sets.find(*begin);
    end = std::find_if(begin, bodies.end(), [&](std::uint32_t body) { return sets.find(body) != set; });
    if (normals[set] == Vec3{} || held[set]) continue;
    keepMomenta(island, {&*begin, std::size_t(end - begin)}, normals[set], context);
  }
}

}  // namespace

void finishFlights(const Island& island, StepContext& context) {
  std::pmr::vector<char> near(island.memory);
  for (std::size_t g = 0; g < island.groups.count(); g++) {
    if (!island.groups.flies(g)) continue;
    if (near.empty()) near = nearSupport(island, context);
    const std::span<const std::uint32_t> group = island.groups.bodies(g);
    if (!fallsAlike(island, group)) continue;
    if (group.size() > 1 && !island.facts.locked) keepMomenta(island, group, {}, context);
    if (near[group.front()]) continue;
    const Vec3 fall = halfFall(island, group, context);
    for (std::uint32_t i : group) shift(island.bodies[i], fall, {}, context);
  }
  if (island.grounded() && island.bodies.size() > 1 && !island.facts.locked) finishOnSmoothGround(island, context);
}

}  // namespace brickfall
