// Whether energy was made from nothing: what is there now against all that was ever put in.
#pragma once
#include <algorithm>

namespace brickfall::cli {

// Energies are kinetic plus potential above the scene's lowest place (see docs/summary.md), so that none is negative.
class EnergyLedger {
 public:
  // What the world had at the start, and what each launch added.
  void supply(double joules) { supplied_ += joules; }
  // What the world has now.
  void measure(double joules) {
    if (supplied_ > 0) ratioMax_ = std::max(ratioMax_, joules / supplied_);
  }
  double supplied() const { return supplied_; }
  // Above 1: energy was made. 0 if nothing was ever put in.
  double ratioMax() const { return ratioMax_; }

 private:
  double supplied_ = 0;
  double ratioMax_ = 0;
};

}  // namespace brickfall::cli
