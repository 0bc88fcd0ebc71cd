// The load that each joint is to hold: of all that hangs together by joints, and of what touches it.
#include <algorithm>
#include <limits>
#include <utility>

#include "solver/island.h"
#include "solver/joint/rows.h"
#include "solver/numbering.h"
#include "solver/union_find.h"

namespace brickfall {

namespace {

//! x (joints in a row)^2 / joints x the mass of all that hangs by them | too small: bridges gape
//! | too large: as a large kFirmness
constexpr double kInRow = 0.1;  // a load's part by which long rows of joints are firm
//! of a body's weight | too small: long rows of joints that are fast are soft | too large: whips are left unsolved
constexpr double kMostRounded = 0.1;  // that the rounding of its way, times kFirmness of a row, may be

// Bodies that hang together by joints, directly or through others.
struct Hanging {
  double mass = 0;      // kg
  double heaviest = 0;  // kg, of them and of what touches one of them
  double joints = 0;
  double depth = 0;  // joints on the way between two that are far from each other
  double lightest = std::numeric_limits<double>::infinity();  // kg
  double fastest = 0;                                         // m/s

  // The load that a joint of theirs must hold as one joint alone would hold it. Joints in a row give in a row: all of
  // their load hangs on a spring that is so much softer. But floats must tell the way of a body finely enough.
  double load(double gravity, double dt, double reach = 1) const {
    const double inRow = kInRow * (mass + heaviest) * depth * depth / std::max(joints, 1.0) * reach;
    const double told =
        kMostRounded * lightest * gravity * dt / (kFirmness * 0.5 * kLastBit * (fastest + gravity * dt));
    return std::max(heaviest, std::min(inRow, told));
  }
};

// Breadth-first from a body. Returns the last one, and how far it is.
std::pair<std::uint32_t, double> farthest(const Adjacency& near, std::uint32_t from, std::pmr::vector<char>& reached,
                                          std::pmr::vector<std::uint32_t>& queue) {
  double depth = 0;
  queue.assign(1, from);
  const char mark = ++reached[from];
  std::size_t ring = 1;  // end of the bodies that are as near as the present one
  for (std::size_t i = 0; i < queue.size(); i++) {
    if (i == ring) depth++, ring = queue.size();
    for (std::uint32_t k = near.begin[queue[i]]; k < near.begin[queue[i] + 1]; k++) {
      const std::uint32_t next = near.list[k];
      if (reached[next] == mark) continue;
      reached[next] = mark;
      queue.push_back(next);
    }
  }
  return {queue.back(), depth};
}

}  // namespace

void JointRows::findLoads(const Island& island, const StepContext& context) {
  const BodySet& bodies = *context.bodies;
  const std::size_t count = island.bodies.size();
  UnionFind sets(count, island.memory);
  std::pmr::vector<char> joined(count, 0, island.memory), reached(count, 0, island.memory);
  std::pmr::vector<Hanging> hanging(count, Hanging{}, island.memory);
  Adjacency near(island.memory);
  near.fill(std::uint32_t(count), [&](auto visit) {
    for (const JointRecord& r : records)
      if (r.bodyA < count && r.bodyB < count) visit(r.bodyA, r.bodyB);
  });
  for (const JointRecord& r : records) {
    if (r.bodyA < count) joined[r.bodyA] = 1;
    if (r.bodyB < count) joined[r.bodyB] = 1;
    if (r.bodyA < count && r.bodyB < count) sets.join(r.bodyA, r.bodyB);
  }
  auto massOf = [&](std::uint32_t body) { return bodies.mass[island.bodies[body]].mass; };
  auto take = [&](std::uint32_t body, std::uint32_t into) {
    double& most = hanging[sets.find(into)].heaviest;
    most = std::max(most, massOf(body));
  };
  std::pmr::vector<std::uint32_t> queue(island.memory);
  for (std::uint32_t i = 0; i < count; i++) {
    if (!joined[i]) continue;
    take(i, i);
    Hanging& all = hanging[sets.find(i)];
    const BodyIndex body = island.bodies[i];
    all.mass += massOf(i);
    all.lightest = std::min(all.lightest, massOf(i));
    all.fastest =
        std::max(all.fastest, length(bodies.motion[body].linearVelocity) +
                                  length(bodies.motion[body].angularVelocity) * bodies.mass[body].outerRadius);
    if (reached[i]) continue;
    const auto [end, _] = farthest(near, i, reached, queue);
    hanging[sets.find(i)].depth = 1 + farthest(near, end, reached, queue).second;
  }
  island.rows.each([&](const auto& kind, std::size_t k) {
    const RowEnds ends = kind.ends(k);
    if (ends.a >= count || ends.b >= count) return;
    if (joined[ends.a]) take(ends.b, ends.a);
    if (joined[ends.b]) take(ends.a, ends.b);
  });
  auto setOf = [&](const JointRecord& r) -> Hanging& { return hanging[sets.find(std::min(r.bodyA, r.bodyB))]; };
  for (const JointRecord& r : records) setOf(r).joints++;
  for (std::size_t k = 0; k < size(); k++) {
    const Hanging& all = setOf(records[k]);
    starts[k].load = float(all.load(context.judgingGravity, island.dt));
    starts[k].turning = float(all.load(context.judgingGravity, island.dt, all.depth * all.depth));
  }
}

}  // namespace brickfall
