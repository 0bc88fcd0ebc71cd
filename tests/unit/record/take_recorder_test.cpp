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
  scene.cameras[0].path = {{0, {3, 2, 5}, {}, 45}, {1, {2, 2, 5}, {}, 45}};
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
  ASSERT_EQ(take->bodies().size(), 3u);
  EXPECT_EQ(take->bodies()[0].role, BodyRole::ground);
  EXPECT_EQ(take->bodies()[0].mass, 0);
  EXPECT_EQ(take->bodies()[1].name, "cube");
  EXPECT_GT(take->bodies()[1].mass, 0);
  EXPECT_EQ(take->bodies()[2].role, BodyRole::ball);
  EXPECT_GT(take->bodies()[2].mass, 0) << "of a body that is held at first, too";
  ASSERT_EQ(header.cameras.size(), 1u);
  EXPECT_EQ(header.cameras[0].path.size(), 2u);
  EXPECT_EQ(take->summaryJson(), "{}");
}

TEST_F(TakeRecording, bodiesKeepTheNamesOfTheirMaterials) {
  SceneDescription scene = smallScene();
  scene.bodies[1].def.shapes.resize(3, scene.bodies[1].def.shapes[0]);
  scene.bodies[1].shapeMaterials = {"dull", "steel"};
  scene.bodies[1].colour = 0x123456;          // its own, not its steel's
  scene.bodies[2].shapeMaterials = {"dull"};  // as the body: nothing to tell apart
  record(scene, 1);
  const Result<TakeReader> take = TakeReader::open(path_);
  ASSERT_TRUE(take) << take.error().message;
  EXPECT_EQ(take->bodies()[0].material, "dull");
  EXPECT_EQ(take->bodies()[1].material, "dull");
  EXPECT_EQ(take->bodies()[1].shapeMaterials, (std::vector<std::string>{"dull", "steel", "dull"}));
  EXPECT_EQ(take->bodies()[1].shapeColours, (std::vector<std::uint32_t>{0x123456, 0x70757A, 0x123456}));
  EXPECT_EQ(take->bodies()[2].material, "dull");
  EXPECT_TRUE(take->bodies()[2].shapeMaterials.empty());
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
  const double weight = take->bodies()[1].mass * 9.81;
  EXPECT_NEAR(last->poses[1].contactForce, weight, 0.05 * weight);
  EXPECT_LT(last->poses[1].speed, 0.01);
}

// A cube is replaced by two halves after 0.25 s, another comes after 0.5 s and goes after 0.75 s, when the next takes its slot.
TEST_F(TakeRecording, bodiesThatComeAndGoAreFollowed) {
  SceneDescription scene = smallScene();
  scene.timeStep = 1.0 / 60;
  scene.framesPerSecond = 30;
  Result<SceneRun> run = SceneRun::create(scene);
  ASSERT_TRUE(run) << run.error().message;
  Result<TakeRecorder> recorder = TakeRecorder::create(path_, *run);
  ASSERT_TRUE(recorder) << recorder.error().message;
  const BodyId cube = run->bodies()[1].id;
  PlacedBody half = run->bodies()[1];
  half.def.shapes[0].halfExtents.x = 0.05;
  BodyId late, passing;
  for (int i = 1; i <= 60; i++) {
    if (i == 15) {
      ASSERT_TRUE(run->destroyBody(cube));
      for (int side : {-1, 1}) {
        half.name = side < 0 ? "left" : "right";
        half.def.position = {side * 0.3, 0.6, 0};
        ASSERT_TRUE(run->createBody(half));
      }
    }
    if (i == 30) {
      half.name = "late";
      half.def.position = {0, 3, 0};
      late = run->createBody(half).value();
    }
    if (i == 33) {
      passing = run->world().createBody(half.def).value();
    }
    if (i == 34) {
      ASSERT_TRUE(run->world().destroyBody(passing));
    }
    if (i == 45) {
      ASSERT_TRUE(run->destroyBody(late));
      ASSERT_TRUE(run->world().createBody(half.def));
    }
    const Result<StepReport> report = run->step();
    ASSERT_TRUE(report) << report.error().message;
    ASSERT_TRUE(recorder->afterStep(*run, *report));
  }
  ASSERT_TRUE(recorder->finish("{}"));

  const Result<TakeReader> take = TakeReader::open(path_);
  ASSERT_TRUE(take) << take.error().message;
  ASSERT_EQ(take->frameCount(), 31u);
  // What was there only between two frames left no trace.
  ASSERT_EQ(take->bodies().size(), 7u);
  struct Want {
    const char* name;
    std::size_t birth, end;
  };
  const Want wanted[] = {{"ground", 0, 31}, {"cube", 0, 8},   {"ball", 0, 31},
                         {"left", 8, 31},   {"right", 8, 31}, {"late", 15, 23}};
  for (std::size_t k = 0; k < 6; k++) {
    EXPECT_EQ(take->bodies()[k].name, wanted[k].name);
    EXPECT_EQ(take->lives()[k].birth, wanted[k].birth) << k;
    EXPECT_EQ(take->lives()[k].end, wanted[k].end) << k;
  }
  EXPECT_EQ(take->lives()[6].birth, 23u) << "of the world alone, and in the slot of the one before";
  EXPECT_NEAR(take->bodies()[3].mass, take->bodies()[1].mass / 2, 1e-9);
  EXPECT_EQ(take->bodiesAt(7), (std::vector<std::uint32_t>{0, 1, 2}));
  EXPECT_EQ(take->bodiesAt(30), (std::vector<std::uint32_t>{0, 2, 3, 4, 6}));
  const TakeFrame frame = take->frame(8).value();
  EXPECT_NEAR(frame.poses[2].position.x, -0.3, 1e-3);
  EXPECT_NEAR(frame.poses[3].position.x, 0.3, 1e-3);
  // The halves hit the ground under their own numbers.
  int hits = 0;
  for (std::size_t f = 8; f < take->frameCount(); f++) {
    const TakeFrame later = take->frame(f).value();
    for (const TakeEvent& event : later.events)
      hits += event.type == TakeEventType::hit && event.bodyA + event.bodyB >= 3 && event.bodyA + event.bodyB <= 4;
  }
  EXPECT_GE(hits, 2);
}

TEST_F(TakeRecording, aWorldWithoutASceneIsRecorded) {
  World world = std::move(World::create({})).value();
  BodyDef def;
  def.shapes.resize(1);
  def.position = {0, 5, 0};
  const BodyId first = world.createBody(def).value();
  for (int i = 0; i < 30; i++) ASSERT_TRUE(world.step(1.0 / 60));
  TakeHeader header;
  header.framesPerSecond = 60;
  Result<TakeRecorder> recorder = TakeRecorder::create(path_, header, world);
  ASSERT_TRUE(recorder) << recorder.error().message;
  for (int i = 0; i < 6; i++) {
    if (i == 3) {
      ASSERT_TRUE(world.destroyBody(first));
      ASSERT_TRUE(world.createBody(def));
    }
    const Result<StepReport> report = world.step(1.0 / 60);
    ASSERT_TRUE(recorder->afterStep(world, *report, [](BodyId) {
      return TakeBody{"second", BodyRole::ball, 1, 2, {}};
    }));
  }
  ASSERT_TRUE(recorder->finish(""));
  const Result<TakeReader> take = TakeReader::open(path_);
  ASSERT_TRUE(take) << take.error().message;
  ASSERT_EQ(take->frameCount(), 7u);
  EXPECT_NEAR(take->frame(0)->time, 0.5, 1e-6);
  ASSERT_EQ(take->bodies().size(), 2u);
  EXPECT_EQ(take->bodies()[0].name, "body 0");
  EXPECT_NEAR(take->bodies()[0].mass, 1900, 1e-9);
  EXPECT_EQ(take->bodies()[1].name, "second");
  EXPECT_EQ(take->bodies()[1].role, BodyRole::ball);
  EXPECT_EQ(take->bodies()[1].shapes.size(), 1u);
  EXPECT_EQ(take->lives()[0].end, 4u);
  EXPECT_EQ(take->lives()[1].birth, 4u);
  EXPECT_EQ(take->bodies()[1].look, 0u) << "it has the place of the first, by which the window colours it";
}

}  // namespace
}  // namespace brickfall
