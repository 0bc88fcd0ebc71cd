#include "brickfall/take_recorder.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include <cstdio>

namespace brickfall {
namespace {

// A cube that falls onto a ground plane, and a ball that is launched at 0.1 s.
SceneDescription smallScene() {
  SceneDescription scene;
  scene.name = "small";
  scene.title = "Small";
  scene.seed = 3;
  scene.materials = {{"dull", Material{}, 0x808080}};
  SceneBody ground;
  ground.name = "ground";
  ground.role = BodyRole::ground;
  ground.material = "dull";
  ground.def.type = BodyType::fixed;
  ground.def.shapes.resize(1);
  ground.def.shapes[0].type = ShapeType::plane;
  SceneBody cube;
  cube.name = "cube";
  cube.material = "dull";
  cube.def.shapes.resize(1);
  cube.def.shapes[0].halfExtents = {0.1, 0.1, 0.1};
  cube.def.position = {0, 0.6, 0};
  SceneBody ball;
  ball.name = "ball";
  ball.role = BodyRole::ball;
  ball.material = "dull";
  ball.def.shapes.resize(1);
  ball.def.shapes[0].type = ShapeType::sphere;
  ball.def.shapes[0].radius = 0.1;
  ball.def.position = {3, 2, 0};
  ball.def.linearVelocity = {1, 0, 0};
  ball.launchTime = 0.1;
  scene.bodies = {ground, cube, ball};
  scene.cameras.resize(1);
  return scene;
}

class TakeRecording : public testing::Test {
 protected:
  void SetUp() override {
    path_ = testing::TempDir() + "brickfall_" + testing::UnitTest::GetInstance()->current_test_info()->name() + "_" +
            std::to_string(getpid()) + ".take";
  }
  void TearDown() override { std::remove(path_.c_str()); }
  void record(const SceneDescription& scene, int steps) {
    Result<SceneRun> run = SceneRun::create(scene);
    ASSERT_TRUE(run) << run.error().message;
    Result<TakeRecorder> recorder = TakeRecorder::create(path_, *run);
    ASSERT_TRUE(recorder) << recorder.error().message;
    for (int i = 0; i < steps; i++) {
      const Result<StepReport> report = run->step();
      ASSERT_TRUE(report) << report.error().message;
      ASSERT_TRUE(recorder->afterStep(*run, *report));
    }
    ASSERT_TRUE(recorder->finish("{}"));
  }
  std::string path_;
};

TEST_F(TakeRecording, headerTellsTheScene) {
  record(smallScene(), 1);
  const Result<TakeReader> take = TakeReader::open(path_);
  ASSERT_TRUE(take) << take.error().message;
  const TakeHeader& header = take->header();
  EXPECT_EQ(header.scene, "small");
  EXPECT_EQ(header.title, "Small");
  EXPECT_EQ(header.seed, 3u);
  EXPECT_EQ(header.engineVersion, versionString());
  ASSERT_EQ(header.bodies.size(), 3u);
  EXPECT_EQ(header.bodies[0].role, BodyRole::ground);
  EXPECT_EQ(header.bodies[0].mass, 0);
  EXPECT_EQ(header.bodies[1].name, "cube");
  EXPECT_GT(header.bodies[1].mass, 0);
  EXPECT_EQ(header.bodies[2].role, BodyRole::ball);
  EXPECT_GT(header.bodies[2].mass, 0) << "of a body that is held at first, too";
  EXPECT_EQ(header.cameras.size(), 1u);
  EXPECT_EQ(take->summaryJson(), "{}");
}

TEST_F(TakeRecording, framesStartBeforeTheFirstStepAndFollowTheirRate) {
  SceneDescription scene = smallScene();
  scene.timeStep = 1.0 / 120;
  scene.framesPerSecond = 30;
  record(scene, 120);
  const Result<TakeReader> take = TakeReader::open(path_);
  ASSERT_TRUE(take) << take.error().message;
  ASSERT_EQ(take->frameCount(), 31u);
  for (std::size_t i = 0; i < take->frameCount(); i++) EXPECT_NEAR(take->frame(i)->time, double(i) / 30, 1e-6);
  EXPECT_NEAR(take->frame(0)->poses[1].position.y, 0.6, 1e-4);
  EXPECT_NEAR(take->frame(30)->poses[1].position.y, 0.1, 0.01);
}

TEST_F(TakeRecording, noMoreFramesThanSteps) {
  SceneDescription scene = smallScene();
  scene.timeStep = 1.0 / 60;
  scene.framesPerSecond = 240;
  record(scene, 30);
  const Result<TakeReader> take = TakeReader::open(path_);
  ASSERT_TRUE(take) << take.error().message;
  EXPECT_EQ(take->frameCount(), 31u);
  EXPECT_NEAR(take->header().framesPerSecond, 60, 1e-9);
}

TEST_F(TakeRecording, eventsOfStepsBetweenFramesAreKept) {
  SceneDescription scene = smallScene();
  scene.timeStep = 1.0 / 60;
  scene.framesPerSecond = 10;
  record(scene, 60);
  const Result<TakeReader> take = TakeReader::open(path_);
  ASSERT_TRUE(take) << take.error().message;
  int launches = 0, hits = 0;
  for (std::size_t i = 0; i < take->frameCount(); i++) {
    const TakeFrame frame = take->frame(i).value();
    for (const TakeEvent& event : frame.events) {
      if (event.type == TakeEventType::launch) {
        launches++;
        EXPECT_EQ(event.bodyA, 2u);
        EXPECT_NEAR(frame.time, 0.2, 1e-6);  // launched at 0.1 s: in the step that ends after it
      }
      if (event.type == TakeEventType::hit && event.bodyA + event.bodyB == 1) {
        hits++;
        EXPECT_GT(event.impulse, 0);
        EXPECT_NEAR(event.pointWorld.y, 0, 0.02);
      }
    }
  }
  EXPECT_EQ(launches, 1);
  EXPECT_GE(hits, 1);
}

TEST_F(TakeRecording, restingBodiesCarryTheirWeightAsContactForce) {
  SceneDescription scene = smallScene();
  scene.world.enableSleep = false;
  record(scene, 120);
  const Result<TakeReader> take = TakeReader::open(path_);
  ASSERT_TRUE(take) << take.error().message;
  const Result<TakeFrame> last = take->frame(take->frameCount() - 1);
  const double weight = take->header().bodies[1].mass * 9.81;
  EXPECT_NEAR(last->poses[1].contactForce, weight, 0.05 * weight);
  EXPECT_LT(last->poses[1].speed, 0.01);
}

}  // namespace
}  // namespace brickfall
