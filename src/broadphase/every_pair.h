// Every moved proxy against every other: n^2, with nothing to keep up to date. With spheres first, as the report has it: one
// distance instead of up to six comparisons, but a sphere around a brick holds much air, so the boxes decide afterwards.
#pragma once
#include "broadphase/proxy_list.h"

namespace brickfall {

class EveryPair final : public ProxyList {
 public:
  explicit EveryPair(bool spheresFirst) : spheresFirst_(spheresFirst) {}

 private:
  struct Sphere {
    Vec3 centre;
    double radius = 0;
  };
  void findOverlaps(const std::vector<ProxyIndex>& moved, FunctionRef<void(ProxyIndex, ProxyIndex)> visit) override;
  void placed(ProxyIndex proxy) override;

  bool spheresFirst_;
  std::vector<Sphere> spheres_;  // by proxy, around the kept bounds
};

}  // namespace brickfall
