// What the broad phases without a tree have in common: kept bounds in a list.
#pragma once
#include "broadphase/broad_phase.h"

namespace brickfall {

class ProxyList : public BroadPhase {
 public:
  ProxyIndex add(const Aabb& tight, double grow, std::uint32_t user) override;
  void remove(ProxyIndex proxy) override;
  bool update(ProxyIndex proxy, const Aabb& tight, double grow) override;
  const Aabb& kept(ProxyIndex proxy) const override { return proxies_[proxy].box; }
  void newPairs(PairFilter wanted, Pairs& out) override;
  void query(const Aabb& box, FunctionRef<bool(std::uint32_t)> visit) const override;
  void queryRay(Vec3 origin, Vec3 direction, double maxDistance,
                FunctionRef<double(std::uint32_t user, double limit)> visit) const override;
  int count() const override { return count_; }
  std::vector<std::string> validate() const override;

 protected:
  struct Proxy {
    Aabb box;
    std::uint32_t user = 0;
    bool alive = false, moved = false;
  };
  // Calls visit(a, b) for each pair of live proxies that overlap and of which one is in `moved`, once.
  virtual void findOverlaps(const std::vector<ProxyIndex>& moved, FunctionRef<void(ProxyIndex, ProxyIndex)> visit) = 0;
  virtual void placed(ProxyIndex) {}  // has new bounds
  virtual void validateMore(std::vector<std::string>&) const {}

  std::vector<Proxy> proxies_;  // of which some are free

 private:
  void markMoved(ProxyIndex proxy);

  std::vector<ProxyIndex> free_;
  std::vector<ProxyIndex> moved_;  // each once; may hold removed ones, also under their next name
  int count_ = 0;
};

}  // namespace brickfall
