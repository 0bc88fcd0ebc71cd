#include "solver/chunks.h"

#include <algorithm>
#include <type_traits>

#include "solver/island.h"
#include "solver/rigid_sum.h"
#include "solver/union_find.h"

namespace brickfall {

std::pmr::vector<std::uint32_t> chunksOf(const Island& island, const Ties& ties) {
  const std::uint32_t count = std::uint32_t(island.bodies.size());
  UnionFind sets(count, island.memory);
  std::pmr::vector<std::uint32_t> chunkOf(count, kNoIndex, island.memory);
  island.rows.each([&](const auto& kind, std::size_t k) {
    if (!kind.makesOne(k, ties)) return;
    const RowEnds ends = kind.ends(k);
    if (ends.a < count && ends.b < count) sets.join(ends.a, ends.b);
    for (std::uint32_t body : {ends.a, ends.b})
      if (body < count) chunkOf[body] = 0;
  });
  for (std::uint32_t i = 0; i < count; i++)
    if (chunkOf[i] != kNoIndex) chunkOf[i] = sets.find(i);
  return chunkOf;
}

namespace {

// Joints know of no motion but that of all.
bool allMakeOne(const Island& island, const Ties& ties) {
  bool all = true;
  island.rows.each([&]<class Kind>(const Kind& kind, std::size_t k) {
    if (std::remove_cvref_t<Kind>::kLasts) all = all && kind.makesOne(k, ties);
  });
  return all;
}

}  // namespace

void Chunks::find(const Island& island, const StepContext& context) {
  ways_.clear();
  chunkOf_.clear();
  all_ = false;
  if (!island.facts.firm || island.facts.locked || island.grounded()) return;
  if (island.facts.jointed && !allMakeOne(island, *context.ties)) return;
  const std::size_t count = island.bodies.size();
  const std::pmr::vector<std::uint32_t> found = chunksOf(island, *context.ties);
  chunkOf_.assign(found.begin(), found.end());
  const BodySet& bodies = *context.bodies;
  std::pmr::vector<RigidSum> sums(count, RigidSum(island.origin), island.memory);
  for (std::uint32_t i = 0; i < count; i++) {
    if (chunkOf_[i] == kNoIndex) continue;
    const BodyIndex body = island.bodies[i];
    const double m = bodies.mass[body].mass;
    const Mat3 inertia = bodies.worldInertia(body);
    sums[chunkOf_[i]].add(m, bodies.motion[body].position, inertia, context.free[body].d * m,
                          inertia * context.free[body].startSpin * island.dt);
  }
  all_ = std::all_of(chunkOf_.begin(), chunkOf_.end(), [](std::uint32_t chunk) { return chunk == 0; });
  if (island.facts.jointed && !all_) return chunkOf_.clear();
  ways_.resize(count);
  for (std::uint32_t i = 0; i < count; i++)
    if (chunkOf_[i] == i) ways_[i] = rigidWayOf(sums[i]);
}

void Chunks::start(Island& island, const StepContext& context) const {
  for (std::uint32_t i = 0; i < chunkOf_.size(); i++) {
    const RigidWay* way = of(i);
    if (!way) continue;
    const Vec3 at = context.bodies->motion[island.bodies[i]].position;
    island.motion[i].d = toFloat(way->of(at) - island.rigid.of(at));
    island.motion[i].th = toFloat(way->turn - island.rigid.turn);
  }
}

}  // namespace brickfall
