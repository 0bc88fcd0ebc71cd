#include "brickfall/fall.h"

#include <utility>

#include "dynamics/body_set.h"
#include "solver/union_find.h"

namespace brickfall {

FallFinder::FallFinder(std::span<const FallJoint> joints, const std::vector<bool>& moves)
    : joints_(joints), moves_(moves), chunk_(moves.size()), start_(moves.size() + 1, 0) {
  UnionFind chunks(moves.size(), std::pmr::get_default_resource());
  auto isKnown = [&](const FallJoint& j) { return j.bodyA < moves_.size() && j.bodyB < moves_.size(); };
  auto breaks = [](const FallJoint& j) { return j.breakTime < std::numeric_limits<double>::infinity(); };
  for (const FallJoint& j : joints_)
    if (isKnown(j) && !breaks(j) && moves_[j.bodyA] && moves_[j.bodyB]) chunks.join(j.bodyA, j.bodyB);
  for (std::uint32_t body = 0; body < chunk_.size(); body++) chunk_[body] = chunks.find(body);
  for (const FallJoint& j : joints_)
    if (isKnown(j) && breaks(j)) start_[j.bodyA + 1]++, start_[j.bodyB + 1]++;
  for (std::size_t i = 1; i < start_.size(); i++) start_[i] += start_[i - 1];
  broken_.resize(start_.back());
  std::vector<std::uint32_t> next(start_.begin(), start_.end() - 1);
  firstOf_.assign(chunk_.size(), kNoIndex);
  firstHeld_ = firstOf_;
  auto keepFirst = [&](std::uint32_t& first, std::uint32_t joint) {
    if (first == kNoIndex || isEarlier(joint, first)) first = joint;
  };
  for (std::uint32_t k = 0; k < joints_.size(); k++) {
    const FallJoint& j = joints_[k];
    if (!isKnown(j) || !breaks(j)) continue;
    for (std::uint32_t body : {j.bodyA, j.bodyB}) {
      broken_[next[body]++] = k;
      if (chunk_[j.bodyA] == chunk_[j.bodyB]) continue;  // inside of a chunk
      keepFirst(firstOf_[chunk_[body]], k);
      if (holdsUp(k, body)) keepFirst(firstHeld_[chunk_[body]], k);
    }
  }
}

bool FallFinder::isEarlier(std::uint32_t a, std::uint32_t b) const {
  return std::pair(joints_[a].breakTime, a) < std::pair(joints_[b].breakTime, b);
}

bool FallFinder::holdsUp(std::uint32_t joint, std::uint32_t body) const {
  const FallJoint& j = joints_[joint];
  return body == j.bodyB ? j.lift > 0 : j.lift < 0;
}

std::optional<std::uint32_t> FallFinder::first(std::uint32_t body) const {
  if (body >= moves_.size() || !moves_[body]) return std::nullopt;
  const std::uint32_t chunk = chunk_[body];
  std::uint32_t found = firstHeld_[chunk];
  if (found == kNoIndex) return firstOf_[chunk] == kNoIndex ? std::nullopt : std::optional(firstOf_[chunk]);
  const FallJoint& own = joints_[found];
  std::uint32_t under = chunk_[own.bodyA] == chunk ? own.bodyB : own.bodyA;
  // Times only go back, so this ends.
  while (moves_[under]) {
    std::uint32_t before = found;
    for (std::uint32_t i = start_[under]; i < start_[under + 1]; i++) {
      const std::uint32_t k = broken_[i];
      if (joints_[k].breakTime < joints_[found].breakTime && holdsUp(k, under) && isEarlier(k, before)) before = k;
    }
    if (before == found) break;
    found = before;
    under = joints_[found].bodyA == under ? joints_[found].bodyB : joints_[found].bodyA;
  }
  return found;
}

}  // namespace brickfall
