// A dynamic tree of boxes over the kept bounds: tree.cpp asks it, tree_shape.cpp keeps its shape.
#pragma once
#include "broadphase/broad_phase.h"

namespace brickfall {

class BoxTree final : public BroadPhase {
 public:
  ProxyIndex add(const Aabb& tight, double grow, std::uint32_t user) override;
  void remove(ProxyIndex proxy) override;
  bool update(ProxyIndex proxy, const Aabb& tight, double grow) override;
  void updateAll(std::span<const BoundsUpdate> updates) override;
  const Aabb& kept(ProxyIndex proxy) const override { return nodes_[proxy].box; }
  void newPairs(PairFilter wanted, Pairs& out) override;
  void query(const Aabb& box, FunctionRef<bool(std::uint32_t)> visit) const override;
  void queryRay(Vec3 origin, Vec3 direction, double maxDistance,
                FunctionRef<double(std::uint32_t user, double limit)> visit) const override;
  int count() const override { return count_; }
  std::vector<std::string> validate() const override;

  int height() const;  // balanced: O(log n)

 private:
  struct Node {
    Aabb box;
    ProxyIndex parent = kNoProxy;                // free nodes: the next free one
    ProxyIndex child[2] = {kNoProxy, kNoProxy};  // leaf: kNoProxy
    std::int32_t height = 0;                     // leaf 0, free -1
    std::uint32_t user = 0;
    bool moved = false;
  };

  // What building asks of a leaf, in one place: it is compared some log n times.
  struct BuildLeaf {
    Vec3 middle2;  // m, twice the middle of its box
    ProxyIndex index = kNoProxy;
    bool endless = false;
  };

  ProxyIndex allocateNode();
  void freeNode(ProxyIndex index);
  bool manyMoved();
  void rebuild();
  ProxyIndex build(std::size_t from, std::size_t to);
  void insertLeaf(ProxyIndex leaf);
  void removeLeaf(ProxyIndex leaf);
  ProxyIndex findSibling(const Aabb& box) const;
  void refitUpwards(ProxyIndex index);
  void refit(ProxyIndex index);
  void restoreBalance(ProxyIndex index);
  void improve(ProxyIndex index);
  void swapWithNephew(ProxyIndex index, int side, int nephew);
  template <class Found> void eachOverlapOf(ProxyIndex leaf, Found&& found) const;
  template <class Found> void eachOverlap(Found&& found) const;  // of which one leaf moved
  void markMoved(ProxyIndex leaf);
  void placeAgain(ProxyIndex leaf, const Aabb& box);
  void validateNode(ProxyIndex index, std::vector<std::string>& faults, int& leaves, int& inner) const;

  std::vector<Node> nodes_;
  std::vector<ProxyIndex> moved_;                     // may hold removed or repeated entries; newPairs sorts that out
  std::vector<BuildLeaf> leaves_;                     // scratch
  std::vector<std::pair<ProxyIndex, Aabb>> leaving_;  // scratch: leaves with their next boxes
  bool rebuilt_ = false;                              // nothing changed since the whole tree was built
  ProxyIndex root_ = kNoProxy;
  ProxyIndex free_ = kNoProxy;
  int count_ = 0;
};

}  // namespace brickfall
