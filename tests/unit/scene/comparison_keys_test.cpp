// The keys that choose what a scene is compared with: the report's system and its parts, integrators, broad phases.
#include "unit/scene/scene_support.h"

namespace brickfall {
namespace {

constexpr const char* kWall = R"(
[world]
method = "report"
broad_phase = "sweep_and_prune"
integrator = "velocity_verlet"
[report]
all_axes = true
last_axis = true
restitution = true
friction = true
manifold = true
warm_starting = true
impulse_factor = 1.25
damping = 2.5
sweeps = 7
integrator = "runge_kutta_4"
[[wall]]
courses = 2
bricks = 2
)";

TEST(ComparisonKeys, AllReachTheWorld) {
  SceneDescription scene = sound(kWall);
  const WorldDef& def = scene.world;
  EXPECT_EQ(scene.method, SceneMethod::report);
  EXPECT_EQ(def.broadPhase, BroadPhaseMethod::sweepAndPrune);
  EXPECT_EQ(def.integrator, Integrator::velocityVerlet);
  const ReportSettings& r = scene.report;
  for (bool part : {r.allAxes, r.lastAxis, r.restitution, r.friction, r.manifold, r.warmStarting}) EXPECT_TRUE(part);
  EXPECT_EQ(r.impulseFactor, 1.25);
  EXPECT_EQ(r.damping, 2.5);
  EXPECT_EQ(r.sweeps, 7);
  EXPECT_EQ(r.integrator, Integrator::rungeKutta4);
}

constexpr const char* kBall = "[[ball]]\nposition = [0, 1, 0]\n";

TEST(ComparisonKeys, NamesAreThoseOfTheLibrary) {
  for (int i = 0; i < kIntegratorCount; i++) {
    std::string name(integratorName(Integrator(i)));
    SceneDescription scene = sound(kBall, {{"world.integrator", name}, {"report.integrator", name}});
    EXPECT_EQ(scene.world.integrator, Integrator(i));
    EXPECT_EQ(scene.report.integrator, Integrator(i));
  }
  for (int i = 0; i < kBroadPhaseMethodCount; i++) {
    std::string name(broadPhaseName(BroadPhaseMethod(i)));
    EXPECT_EQ(sound(kBall, {{"world.broad_phase", name}}).world.broadPhase, BroadPhaseMethod(i));
  }
}

TEST(ComparisonKeys, DefaultsAreTheLibrarys) {
  SceneDescription def = sound(std::string("[report]\n") + kBall), own;
  EXPECT_EQ(def.method, SceneMethod::clusters);
  EXPECT_EQ(def.world.broadPhase, own.world.broadPhase);
  EXPECT_EQ(def.world.integrator, own.world.integrator);
  EXPECT_EQ(def.report.impulseFactor, own.report.impulseFactor);
  EXPECT_EQ(def.report.damping, own.report.damping);
  EXPECT_EQ(def.report.sweeps, own.report.sweeps);
  EXPECT_EQ(def.report.integrator, own.report.integrator);
  for (bool part : {def.report.allAxes, def.report.lastAxis, def.report.manifold}) EXPECT_FALSE(part);
}

TEST(ComparisonKeys, MistakesAreNamed) {
  EXPECT_TRUE(has(faults("[world]\nmethod = \"reprot\"\n"), "report"));
  EXPECT_TRUE(has(faults("[world]\nbroad_phase = \"bvh\"\n"), "sweep_and_prune"));
  EXPECT_TRUE(has(faults("[report]\nsweeps = 0\n"), "1 .. 1000"));
  EXPECT_TRUE(has(faults("[report]\nimpulse_facto = 1\n"), "impulse_factor"));
}

TEST(ComparisonKeys, AReportedWallRuns) {
  Result<SceneRun> run = SceneRun::create(sound(kWall));
  ASSERT_TRUE(run.ok()) << run.error().message;
  std::uint64_t start = run->world().stateHash();
  for (int i = 0; i < 30; i++) ASSERT_TRUE(run->step().ok());
  EXPECT_NE(run->world().stateHash(), start);
  EXPECT_TRUE(run->world().validate().empty());
  EXPECT_EQ(run->stepCount(), 30u);
  EXPECT_NEAR(run->time(), 0.5, 1e-12);
}

}  // namespace
}  // namespace brickfall
