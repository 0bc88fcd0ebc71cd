// The figures of a run: how far bricks moved, how deep bodies overlap, what energy did, what a step cost. Fed after every
// step; docs/summary.md says what each figure means. Bodies may come and go meanwhile.
#pragma once
#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "brickfall/scene.h"
#include "brickfall/world.h"
#include "cli/energy_ledger.h"
#include "cli/statistics.h"

namespace brickfall::cli {

struct RunFigures {
  int bodies = 0;  // all that move by forces, those still to be launched included
  int bricks = 0;
  std::uint64_t steps = 0;
  double simulatedSeconds = 0;
  Distribution stepMilliseconds;
  std::array<double, kStageCount> stageMilliseconds{};  // mean of a step
  double displacementMax = 0;                           // m
  int bricksMoved50mm = 0;
  double sagMax = 0;            // m
  double creepMax = 0;          // m
  double penetrationMax = 0;    // m
  double penetrationMean = 0;   // m
  double kineticEnergyMax = 0;  // J
  double kineticEnergyEnd = 0;  // J
  double energyRatioMax = 0;
  double contactsMean = 0;
  int asleepEnd = 0;
  int quarantined = 0;
};

class RunMetrics {
 public:
  // plannedSteps spreads the samples; the run may end earlier.
  RunMetrics(const World& world, std::span<const PlacedBody> bodies, std::uint64_t plannedSteps);
  void afterStep(const World& world, const StepReport& report);
  // After the last step. J, of what moves by forces: above the scene's lowest place; what was put in and is gone.
  double potentialNow(const World& world) const { return world.energy().potential - weight_ * lowestHeight_; }
  double lostNow() const { return ledger_.supplied() - energy_; }
  int movedNow(const World& world) const;  // bricks further than 50 mm from their place
  // The figures up to the last step.
  RunFigures finish(const World& world);

 private:
  struct Tracked {
    BodyId id;
    Vec3 start;  // m, centre of mass
    Vec3 last;   // m, where it was last measured: one that is gone stays there
  };
  struct Weighed {
    BodyId id;
    double weight = 0;  // N
  };
  struct Pending {  // a body that is held until it is launched
    BodyId id;
    BodyDef def;
  };
  struct Sample {
    double time = 0;
    std::vector<Vec3> centres;  // of tracked_
  };
  Sample sample(const World& world, double time);
  struct Overlap {
    double max = 0, mean = 0;
  };

  double heightOf(Vec3 point) const { return dot(point, up_); }
  void findLowestPlace(const World& world, std::span<const PlacedBody> bodies);
  double countWeight(const World& world, BodyId id, double gravityScale);
  void know(BodyId id);
  bool isKnown(BodyId id) const;
  bool followBodies(const World& world);
  double energyNow(const World& world) const;
  void bookLaunches(const World& world);
  void measureCentres(const World& world);
  Overlap measureOverlap(const World& world) const;

  std::vector<Tracked> tracked_;  // bricks, or whatever moves where there are none
  std::vector<Pending> pending_;
  std::vector<Sample> samples_;
  std::uint64_t sampleEvery_ = 1;
  Vec3 up_{0, 1, 0};
  double gravity_ = 0;                // m/s2
  double lowestHeight_ = 0;           // m along up_
  double weight_ = 0;                 // N, of all bodies that move by forces
  double energy_ = 0;                 // J, after the last step
  std::vector<Weighed> weighed_;      // those bodies
  std::vector<BodyId> knownByIndex_;  // by BodyId::index: bodies of the start, and those that came and were weighed
  EnergyLedger ledger_;
  RunFigures figures_;
  std::vector<double> stepMilliseconds_;
  double contactPoints_ = 0;
};

}  // namespace brickfall::cli
