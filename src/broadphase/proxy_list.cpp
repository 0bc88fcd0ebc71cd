#include "broadphase/proxy_list.h"

#include <algorithm>

#include "base/assert.h"

namespace brickfall {

void ProxyList::markMoved(ProxyIndex proxy) {
  if (!proxies_[proxy].moved) moved_.push_back(proxy);
  proxies_[proxy].moved = true;
}

ProxyIndex ProxyList::add(const Aabb& tight, double grow, std::uint32_t user) {
  ProxyIndex proxy = ProxyIndex(proxies_.size());
  if (free_.empty()) {
    proxies_.emplace_back();
    moved_.reserve(proxies_.capacity());  // all may move in one step
    free_.reserve(proxies_.capacity());
  } else {
    proxy = free_.back();
    free_.pop_back();
  }
  proxies_[proxy].box = grown(tight, grow);
  proxies_[proxy].user = user;
  proxies_[proxy].alive = true;
  markMoved(proxy);
  placed(proxy);
  count_++;
  return proxy;
}

void ProxyList::remove(ProxyIndex proxy) {
  BRICKFALL_ASSERT(proxy >= 0 && proxy < ProxyIndex(proxies_.size()) && proxies_[proxy].alive, "not a live proxy");
  proxies_[proxy].alive = false;  // stays marked as moved, if it was: it is in that list
  free_.push_back(proxy);
  count_--;
}

bool ProxyList::update(ProxyIndex proxy, const Aabb& tight, double grow) {
  BRICKFALL_ASSERT(proxy >= 0 && proxy < ProxyIndex(proxies_.size()) && proxies_[proxy].alive, "not a live proxy");
  Aabb fresh = grown(tight, grow);
  if (!mustMove(proxies_[proxy].box, tight, fresh)) return false;
  proxies_[proxy].box = fresh;
  markMoved(proxy);
  placed(proxy);
  return true;
}

void ProxyList::newPairs(PairFilter wanted, Pairs& out) {
  out.clear();
  std::erase_if(moved_, [&](ProxyIndex proxy) {
    if (!proxies_[proxy].alive) proxies_[proxy].moved = false;
    return !proxies_[proxy].alive;
  });
  if (moved_.empty()) return;
  findOverlaps(moved_, [&](ProxyIndex a, ProxyIndex b) {
    std::uint32_t userA = proxies_[a].user, userB = proxies_[b].user;
    if (wanted(std::min(userA, userB), std::max(userA, userB)))
      out.emplace_back(std::min(userA, userB), std::max(userA, userB));
  });
  for (ProxyIndex proxy : moved_) proxies_[proxy].moved = false;
  moved_.clear();
  std::sort(out.begin(), out.end());
}

void ProxyList::query(const Aabb& box, FunctionRef<bool(std::uint32_t)> visit) const {
  for (const Proxy& proxy : proxies_)
    if (proxy.alive && overlaps(proxy.box, box) && !visit(proxy.user)) return;
}

void ProxyList::queryRay(Vec3 origin, Vec3 direction, double maxDistance,
                         FunctionRef<double(std::uint32_t user, double limit)> visit) const {
  double limit = maxDistance;
  for (const Proxy& proxy : proxies_)
    if (proxy.alive && rayEntry(proxy.box, origin, direction, limit) <= limit)
      limit = std::min(limit, visit(proxy.user, limit));
}

std::vector<std::string> ProxyList::validate() const {
  std::vector<std::string> faults;
  int alive = 0, moved = 0;
  for (const Proxy& proxy : proxies_) {
    alive += proxy.alive;
    moved += proxy.moved;
  }
  if (alive != count_)
    faults.push_back("found " + std::to_string(alive) + " proxies, expected " + std::to_string(count_));
  if (alive + int(free_.size()) != int(proxies_.size())) faults.push_back("proxies are lost");
  if (moved != int(moved_.size())) faults.push_back("the list of moved proxies is not what is marked");
  validateMore(faults);
  return faults;
}

}  // namespace brickfall
