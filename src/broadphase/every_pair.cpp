#include "broadphase/every_pair.h"

namespace brickfall {

void EveryPair::placed(ProxyIndex proxy) {
  if (!spheresFirst_) return;
  if (spheres_.size() < proxies_.size()) spheres_.resize(proxies_.size());
  const Aabb& box = proxies_[proxy].box;
  Vec3 far = max(abs(box.lower), abs(box.upper));
  // A little larger than computed, so that rounding loses no pair of boxes.
  double radius = 0.5 * length(box.upper - box.lower) * (1 + 1e-12) + 1e-15 * (far.x + far.y + far.z);
  spheres_[proxy] = {(box.lower + box.upper) * 0.5, radius};
}

void EveryPair::findOverlaps(const std::vector<ProxyIndex>& moved, FunctionRef<void(ProxyIndex, ProxyIndex)> visit) {
  ProxyIndex end = ProxyIndex(proxies_.size());
  for (ProxyIndex a : moved)
    for (ProxyIndex b = 0; b < end; b++) {
      if (spheresFirst_) {
        double reach = spheres_[a].radius + spheres_[b].radius;
        if (lengthSquared(spheres_[a].centre - spheres_[b].centre) > reach * reach) continue;
      }
      const Proxy &first = proxies_[a], &second = proxies_[b];
      if (!overlaps(first.box, second.box) || !second.alive) continue;
      if (a != b && !(second.moved && b < a)) visit(a, b);  // of two moved ones, the lower reports
    }
}

}  // namespace brickfall
