// Sweep and prune (Baraff 1992): bounds sorted by where they begin along one axis; from each one on, only those that begin
// before it ends are looked at. The order is kept from step to step: what moved is taken out and merged in again.
#pragma once
#include "broadphase/proxy_list.h"

namespace brickfall {

class SweepAndPrune final : public ProxyList {
 private:
  void findOverlaps(const std::vector<ProxyIndex>& moved, FunctionRef<void(ProxyIndex, ProxyIndex)> visit) override;
  void validateMore(std::vector<std::string>& faults) const override;
  bool before(ProxyIndex a, ProxyIndex b) const;
  int widestAxis() const;
  void sort(const std::vector<ProxyIndex>& moved);

  int axis_ = 0;
  std::vector<ProxyIndex> order_;   // at the last search, by beginning along the axis
  std::vector<ProxyIndex> merged_;  // scratch
  std::vector<ProxyIndex> fresh_;   // scratch
};

}  // namespace brickfall
