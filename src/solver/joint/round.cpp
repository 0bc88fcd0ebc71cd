#include "solver/joint/round.h"

namespace brickfall {

//! of what joints would still do, J | too small: steps run out before rounds do: joints that are struck gape
//! | too large: multipliers follow forces that are met on the way
constexpr double kRoundEnd = 0.1;  // beside contacts a round of joints ends with less left to gain

bool endsRound(double gain, const Island& island) {
  return gain < kRoundEnd * island.rows.joints.apart(island.motion.data());
}

// What the next round would add to multipliers tells it, limits that are reached included.
double JointRows::apart(const SolveMotion* motion) const {
  double sum = 0;
  for (std::size_t k = 0; k < size(); k++) {
    const JointStart& start = starts[k];
    JointRecord r = records[k];
    if (timePasses_ && start.arcs != JointArcs::none) joint::takeArc(arcNow(k, motion) - start.arc, r.way);
    const joint::Forces f = joint::forcesAt(r, motion);
    auto look = [&](int lane, float force, float firm) {
      if (!(start.follows & start.hard & 1u << lane) || !(firm > 0)) return;
      const double more = double(force) - double(start.held[lane]);
      sum += 0.5 * more * more / double(firm);
    };
    for (int i = 0; i < kJointLanes; i++) {
      look(i, f.way[i], r.way.k[i]);
      look(i + kJointLanes, f.turn[i], r.turn.k[i]);
    }
  }
  return sum;
}

bool JointRound::offer(const Island& island) {
  const double apart = island.rows.joints.apart(island.motion.data());
  if (!(apart < apart_)) return kTrifle * apart <= apart_;
  apart_ = apart;
  motion_ = island.motion;
  masses_ = island.masses;
  records_ = island.rows.joints.records;
  starts_ = island.rows.joints.starts;
  return true;
}

bool JointRound::isLeft(const Island& island) const {
  return !motion_.empty() && !(kTrifle * island.rows.joints.apart(island.motion.data()) <= apart_);
}

void JointRound::restore(Island& island) const {
  island.motion = motion_;
  island.masses = masses_;
  island.rows.joints.records = records_;
  island.rows.joints.starts = starts_;
}

}  // namespace brickfall
