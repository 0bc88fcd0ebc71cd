// Which shapes may touch. Bounds are kept a little larger than they are, so that what rests or moves little costs nothing.
// What is kept, and so which pairs there are, is the same for every implementation.
#pragma once
#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "base/function_ref.h"
#include "brickfall/broad_phase.h"
#include "brickfall/math.h"

namespace brickfall {

using ProxyIndex = std::int32_t;
constexpr ProxyIndex kNoProxy = -1;

// New bounds of a proxy: `tight`, and by how much more it may keep.
struct BoundsUpdate {
  ProxyIndex proxy = kNoProxy;
  Aabb tight;
  double grow = 0;  // m
};

class BroadPhase {
 public:
  using PairFilter = FunctionRef<bool(std::uint32_t, std::uint32_t)>;
  using Pairs = std::vector<std::pair<std::uint32_t, std::uint32_t>>;

  virtual ~BroadPhase() = default;

  // `user` comes back in pairs and queries; unique per proxy. `grow`: margin in m, scaled to the body by the caller.
  virtual ProxyIndex add(const Aabb& tight, double grow, std::uint32_t user) = 0;
  virtual void remove(ProxyIndex proxy) = 0;
  // New bounds; the proxy is re-inserted, and its pairs searched, only if they left the kept ones (or shrank to under a
  // fourth of their size: `mustMove`). Returns true if it was.
  virtual bool update(ProxyIndex proxy, const Aabb& tight, double grow) = 0;
  // Many at once, before newPairs(): as if one by one.
  virtual void updateAll(std::span<const BoundsUpdate> updates) {
    for (const BoundsUpdate& u : updates) update(u.proxy, u.tight, u.grow);
  }
  virtual const Aabb& kept(ProxyIndex proxy) const = 0;

  // All pairs (user a < user b) whose kept bounds overlap and of which one was added or re-inserted since the last
  // call; sorted, each once. May repeat a pair found earlier: the caller knows those. `wanted` filters (same body,
  // filters).
  virtual void newPairs(PairFilter wanted, Pairs& out) = 0;

  // Calls visit(user) for every proxy whose kept bounds overlap `box`; stops when it returns false. Order unspecified.
  virtual void query(const Aabb& box, FunctionRef<bool(std::uint32_t)> visit) const = 0;
  // Calls visit(user, limit) for proxies whose kept bounds the ray meets before `limit`; visit returns the new limit
  // (distance along the unit direction), so that a hit shortens the search.
  virtual void queryRay(Vec3 origin, Vec3 direction, double maxDistance,
                        FunctionRef<double(std::uint32_t user, double limit)> visit) const = 0;

  virtual int count() const = 0;
  virtual std::vector<std::string> validate() const = 0;  // empty = all invariants hold
};

std::unique_ptr<BroadPhase> makeBroadPhase(BroadPhaseMethod method);

// Whether bounds kept for what now has the bounds `tight`, `fresh` with margin, must be given up.
bool mustMove(const Aabb& kept, const Aabb& tight, const Aabb& fresh);
// Where the ray enters the box: >= 0, or infinity if it misses it up to `limit`.
double rayEntry(const Aabb& box, Vec3 origin, Vec3 direction, double limit);

}  // namespace brickfall
