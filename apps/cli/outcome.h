// How a run ended, to be compared with the same scene's at another time step.
#pragma once
#include <map>
#include <set>
#include <string>

#include "brickfall/scene.h"

namespace brickfall::cli {

struct Outcome {
  std::set<std::string> moved;       // bodies that ended further from where they stood than half of their least extent
  std::set<std::string> broken;      // joints, and mortar by its number
  std::map<std::string, Vec3> ends;  // of all dynamic bodies, m
  double seconds = 0;                // of computing
};

// 0 .. 1: how many of those in either are in both; 1 if there are none.
double overlapOf(const std::set<std::string>& a, const std::set<std::string>& b);
// m: the mean distance of the places where those that moved in either ended.
double apartOf(const Outcome& a, const Outcome& b);

// Joints and mortar that broke so far are noted while it runs.
class OutcomeWatch {
 public:
  explicit OutcomeWatch(const SceneRun& run);
  void afterStep(const SceneRun& run);
  Outcome outcomeOf(const SceneRun& run) const;

 private:
  std::map<JointId, std::string> joints_;
  std::map<MortarId, std::string> mortars_;
  std::set<std::string> broken_;
};

}  // namespace brickfall::cli
