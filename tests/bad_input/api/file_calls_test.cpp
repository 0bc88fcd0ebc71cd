// Wrong calls of what lies above the engine: walls, scenes built in code, takes, outputs.
#include <cstdio>
#include <filesystem>

#include "brickfall/output.h"
#include "brickfall/scene.h"
#include "brickfall/take.h"
#include "refusal.h"

namespace brickfall {
namespace {

using namespace test;

void expectNames(const Error& error, ErrorCode code, const std::string& word) {
  EXPECT_EQ(int(error.code), int(code)) << error.message;
  EXPECT_NE(error.message.find(word), std::string::npos) << "\"" << error.message << "\" does not name " << word;
}

TEST(FileCalls, EveryNumberOfAWallIsChecked) {
  struct Field {
    const char* name;
    double& (*of)(WallDef&);
  };
  const Field fields[] = {
      {"brick.size.x", [](WallDef& w) -> double& { return w.brick.size.x; }},
      {"brick.size.y", [](WallDef& w) -> double& { return w.brick.size.y; }},
      {"brick.size.z", [](WallDef& w) -> double& { return w.brick.size.z; }},
      {"headJoint", [](WallDef& w) -> double& { return w.headJoint; }},
      {"bedJoint", [](WallDef& w) -> double& { return w.bedJoint; }},
      {"bondShift", [](WallDef& w) -> double& { return w.bondShift; }},
      {"position.x", [](WallDef& w) -> double& { return w.position.x; }},
      {"position.y", [](WallDef& w) -> double& { return w.position.y; }},
      {"position.z", [](WallDef& w) -> double& { return w.position.z; }},
      {"yawDegrees", [](WallDef& w) -> double& { return w.yawDegrees; }},
      {"disorder", [](WallDef& w) -> double& { return w.disorder; }},
      {"openings[0].from", [](WallDef& w) -> double& { return w.openings[0].from; }},
      {"openings[0].sill", [](WallDef& w) -> double& { return w.openings[0].sill; }},
      {"openings[0].width", [](WallDef& w) -> double& { return w.openings[0].width; }},
      {"openings[0].height", [](WallDef& w) -> double& { return w.openings[0].height; }},
      {"openings[0].lintelBearing", [](WallDef& w) -> double& { return w.openings[0].lintelBearing; }},
      {"openings[0].lintelHeight", [](WallDef& w) -> double& { return w.openings[0].lintelHeight; }}};
  WallDef sound;
  sound.courses = 20;
  sound.openings.push_back({0.5, 0.13, 0.6, 0.39, 0.15, 0.065});
  ASSERT_TRUE(layBricks(sound, 1).ok()) << layBricks(sound, 1).error().message;
  for (const Field& f : fields)
    for (double bad : {kNan, kInf, -kInf, -1e300, 1e300}) {
      SCOPED_TRACE(bad);
      WallDef wall = sound;
      f.of(wall) = bad;
      Result<std::vector<BrickPlacement>> bricks = layBricks(wall, 1);
      ASSERT_FALSE(bricks.ok()) << f.name;
      expectNames(bricks.error(), ErrorCode::invalidArgument, f.name);
      EXPECT_FALSE(checkWall(wall).empty());
    }
  for (int bad : {0, -1, 10001, 1 << 30}) {
    WallDef wall = sound;
    wall.courses = bad;
    expectNames(layBricks(wall, 1).error(), ErrorCode::invalidArgument, "courses");
    wall = sound;
    wall.bricksPerCourse = bad;
    expectNames(layBricks(wall, 1).error(), ErrorCode::invalidArgument, "bricksPerCourse");
  }
  WallDef wall = sound;
  wall.bond = Bond(77);
  expectNames(layBricks(wall, 1).error(), ErrorCode::invalidArgument, "bond");
  wall = sound;
  wall.courses = wall.bricksPerCourse = 10000;  // each fine, a hundred million together
  wall.openings.clear();
  EXPECT_FALSE(layBricks(wall, 1).ok());
}

SceneDescription oneBox() {
  SceneDescription scene;
  SceneBody body;
  body.name = "box";
  body.material = "brick";
  body.def = bodyOf(boxOf({0.1, 0.1, 0.1}), {0, 1, 0});
  scene.bodies.push_back(body);
  return scene;
}

TEST(FileCalls, ScenesBuiltInCodeAreChecked) {
  ASSERT_TRUE(SceneRun::create(oneBox()).ok());
  auto refused = [](const SceneDescription& scene, const std::string& word) {
    Result<SceneRun> run = SceneRun::create(scene);
    ASSERT_FALSE(run.ok()) << word;
    EXPECT_NE(run.error().message.find(word), std::string::npos) << run.error().message;
  };
  SceneDescription scene = oneBox();
  scene.bodies[0].material = "chocolate";
  refused(scene, "chocolate");
  scene = oneBox();
  scene.bodies[0].def.position.y = kNan;
  refused(scene, "position.y");
  scene = oneBox();
  scene.bodies[0].def.shapes[0].halfExtents.x = 0;
  refused(scene, "\"box\"");
  scene = oneBox();
  scene.world.gravity.y = kInf;
  refused(scene, "gravity.y");
  scene = oneBox();
  scene.walls.emplace_back();
  scene.walls[0].wall.courses = 0;
  refused(scene, "courses");
  scene = oneBox();
  scene.walls.emplace_back();
  scene.walls[0].densityScatter = kNan;
  refused(scene, "densityScatter");
}

TEST(FileCalls, AStepOfABadTimeChangesNothing) {
  for (double bad : {0.0, -1.0, 1.0, kNan, kInf}) {
    SceneDescription scene = oneBox();
    scene.timeStep = bad;
    Result<SceneRun> run = SceneRun::create(scene);
    if (!run) continue;  // just as well
    Unchanged unchanged(run->world());
    unchanged.refusesValue(run->step(), "dt");
  }
  SceneDescription scene = oneBox();
  scene.substeps = 0;
  Result<SceneRun> run = SceneRun::create(scene);
  EXPECT_FALSE(run && run->step().ok());
}

struct TakeFile {
  std::string path = (std::filesystem::temp_directory_path() / "brickfall_api_misuse.take").string();
  ~TakeFile() { std::remove(path.c_str()); }
};

TakeChange oneBody() {
  TakeChange change;
  TakeBody body;
  body.name = "box";
  body.mass = 1;
  body.shapes.push_back(boxOf({0.1, 0.1, 0.1}));
  change.births.push_back(body);
  return change;
}

TEST(FileCalls, TakesRefuseWhatTheyCouldNotGiveBack) {
  TakeFile file;
  for (double bad : {0.0, -1.0, kNan, kInf}) {
    TakeHeader header;
    header.framesPerSecond = bad;
    expectNames(TakeWriter::create(file.path, header).error(), ErrorCode::invalidArgument, "framesPerSecond");
  }
  EXPECT_FALSE(std::filesystem::exists(file.path)) << "nothing is left of a refused take";
  Result<TakeWriter> writer = TakeWriter::create(file.path, {});
  ASSERT_TRUE(writer.ok());
  TakeFrame good;
  good.poses.resize(1);
  for (double bad : {0.0, -1.0, kNan, kInf}) {
    TakeChange change = oneBody();
    change.births[0].shapes[0].halfExtents.y = bad;
    expectNames(writer->write(good, change).error(), ErrorCode::invalidArgument, "body 0 \"box\": halfExtents");
  }
  expectNames(writer->write(good, {{}, {0}}).error(), ErrorCode::invalidArgument, "body 0 ends, but is not there");
  ASSERT_TRUE(writer->write(good, oneBody()).ok());
  expectNames(writer->write(good, {{}, {0, 0}}).error(), ErrorCode::invalidArgument, "ascending order");
  auto refused = [&](const std::function<void(TakeFrame&)>& spoil) {
    TakeFrame frame = good;
    spoil(frame);
    Status written = writer->write(frame);
    ASSERT_FALSE(written.ok());
    expectNames(written.error(), ErrorCode::invalidArgument, "frame 1");
  };
  refused([](TakeFrame& f) { f.poses.clear(); });
  refused([](TakeFrame& f) { f.poses.resize(2); });
  refused([](TakeFrame& f) { f.time = kNan; });
  refused([](TakeFrame& f) { f.poses[0].position.x = kInf; });
  refused([](TakeFrame& f) { f.poses[0].rotation = {0, 0, 0, 0}; });
  refused([](TakeFrame& f) { f.poses[0].rotation.w = kNan; });
  refused([](TakeFrame& f) { f.poses[0].speed = float(kNan); });
  refused([](TakeFrame& f) { f.events.push_back({TakeEventType::hit, 0, 7, {}, 0}); });
  refused([](TakeFrame& f) { f.events.push_back({TakeEventType(9), 0, 0, {}, 0}); });
  good.time = 1;
  ASSERT_TRUE(writer->write(good).ok()) << "it goes on after refusals";
  ASSERT_TRUE(writer->finish("").ok());
  expectNames(writer->write(good).error(), ErrorCode::wrongState, "finished");
  expectNames(writer->finish("").error(), ErrorCode::wrongState, "finished");

  Result<TakeReader> reader = TakeReader::open(file.path);
  ASSERT_TRUE(reader.ok());
  EXPECT_TRUE(reader->complete());
  ASSERT_EQ(reader->frameCount(), 2u);
  expectNames(reader->frame(2).error(), ErrorCode::invalidArgument, "frame 2");
  expectNames(reader->frame(std::size_t(-1)).error(), ErrorCode::invalidArgument, "frame");
  EXPECT_TRUE(reader->frame(1).ok());
  std::string nowhere = file.path + ".none/out";
  expectNames(writeReplayHtml(*reader, nowhere).error(), ErrorCode::inputOutput, nowhere);
  expectNames(writeGlb(*reader, nowhere).error(), ErrorCode::inputOutput, nowhere);
  expectNames(writeGlb(*reader, "").error(), ErrorCode::inputOutput, "create");
  expectNames(TakeReader::open(nowhere).error(), ErrorCode::inputOutput, nowhere);
  expectNames(TakeWriter::create(nowhere, {}).error(), ErrorCode::inputOutput, nowhere);
  EXPECT_EQ(TakeReader::openBytes({}).error().code, ErrorCode::badFormat);
}

}  // namespace
}  // namespace brickfall
