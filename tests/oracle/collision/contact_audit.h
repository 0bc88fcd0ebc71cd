// What a solver needs of a manifold, asked of one pair after the other; keeps how often each thing was asked, the worst
// value and what went over its limit.
#pragma once
#include <map>
#include <string>

#include "narrowphase/manifold.h"
#include "pair_families.h"

namespace brickfall::oracle {

struct Finding {
  long asked = 0, over = 0;
  double worst = 0;     // as a share of the limit's unit, see `limit`
  double limit = 0;     // the largest that was asked for
  std::string example;  // the worst one
};

class ContactAudit {
 public:
  void look(const Pair& pair, Family family, long number);
  const std::map<std::string, Finding>& findings() const { return findings_; }
  long seen(const std::string& what) const;  // a count of what happened
  const std::map<std::string, long>& counts() const { return counts_; }

 private:
  void note(const std::string& what, double value, double limit);
  void count(const std::string& what) { counts_[what]++; }
  bool found(const Manifold& m, const Separation& truth);
  void shape(const Manifold& m, const Solid& a, const Solid& b, const Separation& truth);
  void depth(const Manifold& m, const Solid& a, const Solid& b, const Separation& truth);
  void symmetry(const Manifold& m, const Separation& truth);
  void frames(const Manifold& m, Random& random);
  void continuity(const Manifold& m, const Solid& a, const Solid& b, Random& random);
  void queries(const Separation& truth);

  std::map<std::string, Finding> findings_;
  std::map<std::string, long> counts_;
  const Pair* pair_ = nullptr;
  std::string where_;
  double bias_ = 0, slack_ = 0, rounding_ = 0;  // m
};

// How much deeper than the least the overlap along the normal may be, m: the engine keeps to faces, and to lines of
// contact between round shapes, unless something else is better by this.
double allowedBias(const Pair& pair);

}  // namespace brickfall::oracle
