// Once a scene has run for a second, a step takes nothing from operator new: a frame never stutters because the heap does.
#include "allocation_counter.h"
#include "busy_scenes.h"

namespace brickfall {
namespace {

using namespace test;

struct Seen {
  std::uint64_t early = 0, late = 0;  // allocations in steps of the first second, and of all after it
  int worstStep = -1;
  int contactChanges = 0, islandChanges = 0, sleepChanges = 0, mostPoints = 0;  // steps; after the first second
};

Seen watch(BusyScene& scene, double seconds) {
  Seen seen;
  int points = -1, islands = -1;
  std::uint64_t worst = 0;
  int steps = int(std::lround(seconds / kDt)), second = 60;
  for (int i = 0; i < steps; i++) {
    scene.before(scene.world, i);
    std::uint64_t before = allocations();
    Result<StepReport> report = scene.world.step(kDt);
    std::uint64_t taken = allocations() - before;
    EXPECT_TRUE(report.ok());
    if (!report) break;
    if (i < second) {
      seen.early += taken;
      continue;
    }
    seen.late += taken;
    if (taken > worst) {
      worst = taken;
      seen.worstStep = i;
    }
    seen.contactChanges += report->contactPoints != points;
    seen.islandChanges += report->islands != islands;
    const Events& e = scene.world.events();
    seen.sleepChanges += !e.fellAsleep.empty() || !e.woke.empty();
    seen.mostPoints = std::max(seen.mostPoints, report->contactPoints);
    points = report->contactPoints;
    islands = report->islands;
  }
  std::printf(
      "  first second %llu, after it %llu (worst step %d); changes: contacts %d, islands %d, sleep %d; points %d\n",
      (unsigned long long)seen.early, (unsigned long long)seen.late, seen.worstStep, seen.contactChanges,
      seen.islandChanges, seen.sleepChanges, seen.mostPoints);
  EXPECT_EQ(seen.late, 0u) << "worst in step " << seen.worstStep;
  expectSound(scene.world);
  return seen;
}

TEST(StepAllocation, TheCounterCounts) {
  std::uint64_t before = allocations();
  std::vector<int> one(100);
  one.reserve(1000);
  EXPECT_EQ(allocations() - before, 2u);
}

TEST(StepAllocation, StandingWall) {
  BusyScene scene = standingWall(false);
  EXPECT_GT(watch(scene, 4).mostPoints, 500);
}

TEST(StepAllocation, WallFallsAsleep) {
  BusyScene scene = standingWall(true);
  EXPECT_GT(watch(scene, 4).sleepChanges, 0);
}

TEST(StepAllocation, HeapAtRest) {
  BusyScene scene = heapAtRest();
  EXPECT_GT(watch(scene, 6).mostPoints, 100);
}

TEST(StepAllocation, PileLandsAfterTheFirstSecond) {
  BusyScene scene = fallingPile(false);
  Seen seen = watch(scene, 5);
  EXPECT_GT(seen.contactChanges, 100);
  EXPECT_GT(seen.islandChanges, 30);
  EXPECT_GT(seen.mostPoints, 150);
}

TEST(StepAllocation, PileLandsAndSleepsWithThreads) {
  BusyScene scene = fallingPile(true, 3);
  Seen seen = watch(scene, 8);
  EXPECT_GT(seen.islandChanges, 30);
  EXPECT_GT(seen.sleepChanges, 0);
}

TEST(StepAllocation, StirredPileSleepsAndWakes) {
  BusyScene scene = stirredPile();
  Seen seen = watch(scene, 20);
  EXPECT_GT(seen.contactChanges, 200);
  EXPECT_GT(seen.sleepChanges, 0);
}

TEST(StepAllocation, PileLandsOnHills) {
  BusyScene scene = fallingOnHills();
  Seen seen = watch(scene, 4);
  EXPECT_GT(seen.contactChanges, 100);
}

TEST(StepAllocation, WallIsHit) {
  BusyScene scene = wallHitLate();
  Seen seen = watch(scene, 4);
  EXPECT_GT(seen.contactChanges, 60);
  EXPECT_GT(seen.islandChanges, 10);
}

TEST(StepAllocation, SwarmOfFastBodies) {
  BusyScene scene = swarm();
  Seen seen = watch(scene, 5);
  EXPECT_GT(seen.islandChanges, 150);
}

}  // namespace
}  // namespace brickfall
