#include "broadphase/sweep_and_prune.h"

#include <algorithm>

namespace brickfall {

bool SweepAndPrune::before(ProxyIndex a, ProxyIndex b) const {
  double startA = proxies_[a].box.lower[axis_], startB = proxies_[b].box.lower[axis_];
  return startA != startB ? startA < startB : a < b;
}

// Along which the centres lie furthest apart; endless bounds don't count.
int SweepAndPrune::widestAxis() const {
  Vec3 sum, squares;
  double n = 0;
  for (const Proxy& proxy : proxies_) {
    Vec3 size = proxy.box.upper - proxy.box.lower;
    if (!proxy.alive || !(size.x + size.y + size.z < 1e6)) continue;
    Vec3 centre = (proxy.box.lower + proxy.box.upper) * 0.5;
    sum += centre;
    squares += scaled(centre, centre);
    n++;
  }
  if (n == 0) return axis_;
  Vec3 spread = squares - scaled(sum, sum) * (1 / n);
  int best = spread.y > spread.x ? 1 : 0;
  return spread.z > spread[best] ? 2 : best;
}

void SweepAndPrune::sort(const std::vector<ProxyIndex>& moved) {
  auto earlier = [&](ProxyIndex a, ProxyIndex b) { return before(a, b); };
  fresh_.assign(moved.begin(), moved.end());
  if (2 * moved.size() > std::size_t(count())) {  // as good as new
    axis_ = widestAxis();
    fresh_.clear();
    for (ProxyIndex i = 0; i < ProxyIndex(proxies_.size()); i++)
      if (proxies_[i].alive) fresh_.push_back(i);
    order_.clear();
  }
  std::erase_if(order_, [&](ProxyIndex i) { return !proxies_[i].alive || proxies_[i].moved; });
  std::sort(fresh_.begin(), fresh_.end(), earlier);
  merged_.resize(order_.size() + fresh_.size());
  std::merge(order_.begin(), order_.end(), fresh_.begin(), fresh_.end(), merged_.begin(), earlier);
  order_.swap(merged_);
}

void SweepAndPrune::findOverlaps(const std::vector<ProxyIndex>& moved,
                                 FunctionRef<void(ProxyIndex, ProxyIndex)> visit) {
  sort(moved);
  for (std::size_t i = 0; i < order_.size(); i++) {
    const Proxy& first = proxies_[order_[i]];
    double end = first.box.upper[axis_];
    for (std::size_t j = i + 1; j < order_.size(); j++) {
      const Proxy& second = proxies_[order_[j]];
      if (second.box.lower[axis_] > end) break;
      if ((first.moved || second.moved) && overlaps(first.box, second.box)) visit(order_[i], order_[j]);
    }
  }
}

void SweepAndPrune::validateMore(std::vector<std::string>& faults) const {
  std::size_t current = 0;  // that have not changed since they were sorted
  for (ProxyIndex i : order_) {
    if (i < 0 || i >= ProxyIndex(proxies_.size())) {
      faults.push_back("the order names no proxy");
      return;
    }
    current += proxies_[i].alive && !proxies_[i].moved;
  }
  std::size_t expected = 0;
  for (const Proxy& proxy : proxies_) expected += proxy.alive && !proxy.moved;
  if (current != expected) faults.push_back("the order does not hold every proxy that rests once");
  std::vector<ProxyIndex> resting = order_;
  std::erase_if(resting, [&](ProxyIndex i) { return !proxies_[i].alive || proxies_[i].moved; });
  if (!std::is_sorted(resting.begin(), resting.end(), [&](ProxyIndex a, ProxyIndex b) { return before(a, b); }))
    faults.push_back("the order is not sorted");
}

}  // namespace brickfall
