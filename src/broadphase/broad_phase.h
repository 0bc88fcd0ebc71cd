// Which shapes may touch: a dynamic AABB tree over bounds grown by a margin, so that what rests or moves little costs
// nothing.
#pragma once
#include <cstdint>
#include <string>
#include <utility>
#include <vector>

#include "base/function_ref.h"
#include "brickfall/math.h"

namespace brickfall {

using ProxyIndex = std::int32_t;
constexpr ProxyIndex kNoProxy = -1;

class BroadPhase {
 public:
  // `user` comes back in pairs and queries; unique per proxy. `grow`: margin in m, scaled to the body by the caller.
  ProxyIndex add(const Aabb& tight, double grow, std::uint32_t user);
  void remove(ProxyIndex proxy);
  // New bounds; the proxy is re-inserted, and its pairs searched, only if they left the kept ones (or shrank to under a
  // fourth of their size). Returns true if it was.
  bool update(ProxyIndex proxy, const Aabb& tight, double grow);
  const Aabb& kept(ProxyIndex proxy) const;

  // All pairs (user a < user b) whose kept bounds overlap and of which one was added or re-inserted since the last
  // call; sorted, each once. May repeat a pair found earlier: the caller knows those. `wanted` filters (same body,
  // filters).
  void newPairs(FunctionRef<bool(std::uint32_t, std::uint32_t)> wanted,
                std::vector<std::pair<std::uint32_t, std::uint32_t>>& out);

  // Calls visit(user) for every proxy whose kept bounds overlap `box`; stops when it returns false. Order unspecified.
  void query(const Aabb& box, FunctionRef<bool(std::uint32_t)> visit) const;
  // Calls visit(user, limit) for proxies whose kept bounds the ray meets before `limit`; visit returns the new limit
  // (distance along the unit direction), so that a hit shortens the search.
  void queryRay(Vec3 origin, Vec3 direction, double maxDistance,
                FunctionRef<double(std::uint32_t user, double limit)> visit) const;

  int count() const;
  int height() const;                         // of the tree; balanced: O(log n)
  std::vector<std::string> validate() const;  // empty = all invariants hold

 private:
  struct Node {
    Aabb box;
    ProxyIndex parent = kNoProxy;                // free nodes: the next free one
    ProxyIndex child[2] = {kNoProxy, kNoProxy};  // leaf: kNoProxy
    std::int32_t height = 0;                     // leaf 0, free -1
    std::uint32_t user = 0;
    bool moved = false;
  };

  ProxyIndex allocateNode();
  void freeNode(ProxyIndex index);
  void insertLeaf(ProxyIndex leaf);
  void removeLeaf(ProxyIndex leaf);
  ProxyIndex findSibling(const Aabb& box) const;
  void refitUpwards(ProxyIndex index);
  void refit(ProxyIndex index);
  void restoreBalance(ProxyIndex index);
  void improve(ProxyIndex index);
  void swapWithNephew(ProxyIndex index, int side, int nephew);
  void markMoved(ProxyIndex leaf);
  void validateNode(ProxyIndex index, std::vector<std::string>& faults, int& leaves, int& inner) const;

  std::vector<Node> nodes_;
  std::vector<ProxyIndex> moved_;  // may hold removed or repeated entries; newPairs sorts that out
  ProxyIndex root_ = kNoProxy;
  ProxyIndex free_ = kNoProxy;
  int count_ = 0;
};

}  // namespace brickfall
