// Takes that were written whole: what comes back, how exactly, and at what size.
#include <gtest/gtest.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cmath>
#include <csignal>
#include <filesystem>
#include <fstream>
#include <limits>

#include "record/crc32.h"
#include "record/frame_codec.h"
#include "support/synthetic_take.h"

namespace brickfall {
namespace {

using test::makeSyntheticTake;
using test::SyntheticOptions;
using test::SyntheticTake;

std::string temporaryFile(const std::string& name) {
  return (std::filesystem::temp_directory_path() / (std::to_string(::getpid()) + "_" + name)).string();
}

struct RemovedAtEnd {
  std::string path;
  ~RemovedAtEnd() { std::filesystem::remove(path); }
};

double angleBetween(Quat a, Quat b) {
  Quat d = conjugate(a) * b;
  return 2 * std::atan2(std::sqrt(d.x * d.x + d.y * d.y + d.z * d.z), std::fabs(d.w));
}

void expectSame(const TakeFrame& want, const TakeFrame& got, const std::string& where) {
  ASSERT_EQ(want.poses.size(), got.poses.size()) << where;
  EXPECT_EQ(want.time, got.time) << where;
  for (std::size_t k = 0; k < want.poses.size(); k++) {
    const TakePose &a = want.poses[k], &b = got.poses[k];
    EXPECT_LE(length(a.position - b.position), 1e-5) << where << " body " << k;
    EXPECT_LE(angleBetween(a.rotation, b.rotation), 1e-4) << where << " body " << k;
    EXPECT_NEAR(a.speed, b.speed, 5.1e-4 + 1e-6 * a.speed) << where << " body " << k;
    EXPECT_NEAR(a.contactForce, b.contactForce, 0.004 * a.contactForce) << where << " body " << k;
  }
  ASSERT_EQ(want.events.size(), got.events.size()) << where;
  for (std::size_t k = 0; k < want.events.size(); k++) {
    EXPECT_EQ(want.events[k].type, got.events[k].type);
    EXPECT_EQ(want.events[k].bodyA, got.events[k].bodyA);
    EXPECT_EQ(want.events[k].bodyB, got.events[k].bodyB);
    EXPECT_EQ(want.events[k].impulse, got.events[k].impulse);
    EXPECT_LE(length(want.events[k].pointWorld - got.events[k].pointWorld), 1e-4);
  }
  ASSERT_EQ(want.mortar.size(), got.mortar.size()) << where;
  for (std::size_t k = 0; k < want.mortar.size(); k++) {
    EXPECT_NEAR(want.mortar[k].utilisation, got.mortar[k].utilisation, 0.002) << where << " joint " << k;
    EXPECT_NEAR(want.mortar[k].damage, got.mortar[k].damage, 0.002) << where << " joint " << k;
    EXPECT_EQ(want.mortar[k].damage == 1, got.mortar[k].damage == 1);
  }
  ASSERT_EQ(want.breaks.size(), got.breaks.size()) << where;
  for (std::size_t k = 0; k < want.breaks.size(); k++) {
    const TakeBreak &a = want.breaks[k], &b = got.breaks[k];
    EXPECT_EQ(a.mortar, b.mortar);
    EXPECT_EQ(a.crackTime, b.crackTime);
    EXPECT_EQ(a.breakTime, b.breakTime);
    EXPECT_EQ(a.mode, b.mode);
    EXPECT_EQ(a.tensionShare, b.tensionShare);
    EXPECT_EQ(a.shearShare, b.shearShare);
    EXPECT_EQ(a.force, b.force);
    ASSERT_EQ(a.takers.size(), b.takers.size());
    for (std::size_t t = 0; t < a.takers.size(); t++) {
      EXPECT_EQ(a.takers[t].mortar, b.takers[t].mortar);
      EXPECT_EQ(a.takers[t].bodyA, b.takers[t].bodyA);
      EXPECT_EQ(a.takers[t].bodyB, b.takers[t].bodyB);
      EXPECT_EQ(a.takers[t].before, b.takers[t].before);
      EXPECT_EQ(a.takers[t].after, b.takers[t].after);
    }
  }
}

TEST(Take, FramesComeBackAsWritten) {
  RemovedAtEnd file{temporaryFile("roundtrip.take")};
  SyntheticTake take = makeSyntheticTake({});
  ASSERT_EQ(test::writeTake(take, file.path), "");
  Result<TakeReader> reader = TakeReader::open(file.path);
  ASSERT_TRUE(reader) << reader.error().message;
  EXPECT_TRUE(reader->complete());
  EXPECT_EQ(reader->summaryJson(), "{\"scene\": \"synthetic\"}");
  ASSERT_EQ(reader->frameCount(), take.frames.size());
  for (std::size_t f = 0; f < take.frames.size(); f++) {
    Result<TakeFrame> frame = reader->frame(f);
    ASSERT_TRUE(frame) << frame.error().message;
    expectSame(take.frames[f], *frame, "frame " + std::to_string(f));
  }
}

TEST(Take, HeaderComesBackAsWritten) {
  RemovedAtEnd file{temporaryFile("header.take")};
  SyntheticTake take = makeSyntheticTake({.frames = 1});
  take.header.cameras[1].follow = "ball";
  ShapeDef &drum = take.bodies[3].shapes[0], &cone = take.bodies[4].shapes[0];
  drum.type = ShapeType::cylinder, drum.radius = 0.08, drum.halfHeight = 0.1;
  cone.type = ShapeType::cone, cone.radius = 0.09, cone.halfHeight = 0.2, cone.topRadius = 0.03;
  ASSERT_EQ(test::writeTake(take, file.path), "");
  Result<TakeReader> reader = TakeReader::open(file.path);
  ASSERT_TRUE(reader) << reader.error().message;
  const TakeHeader &want = take.header, &got = reader->header();
  const std::vector<TakeBody>& bodies = reader->bodies();
  EXPECT_EQ(want.scene, got.scene);
  EXPECT_EQ(want.title, got.title);
  EXPECT_EQ(want.engineVersion, got.engineVersion);
  EXPECT_EQ(want.seed, got.seed);
  EXPECT_EQ(want.framesPerSecond, got.framesPerSecond);
  ASSERT_EQ(want.cameras.size(), got.cameras.size());
  for (std::size_t k = 0; k < got.cameras.size(); k++) EXPECT_EQ(want.cameras[k].follow, got.cameras[k].follow);
  ASSERT_EQ(take.bodies.size(), bodies.size());
  for (std::size_t k = 0; k < bodies.size(); k++) {
    const TakeBody &a = take.bodies[k], &b = bodies[k];
    EXPECT_EQ(a.name, b.name);
    EXPECT_EQ(a.role, b.role);
    EXPECT_EQ(a.colour, b.colour);
    EXPECT_EQ(a.mass, b.mass);
    EXPECT_EQ(a.material, b.material);
    EXPECT_EQ(a.shapeMaterials, b.shapeMaterials);
    EXPECT_EQ(a.shapeColours, b.shapeColours);
    ASSERT_EQ(a.shapes.size(), b.shapes.size());
    for (std::size_t s = 0; s < a.shapes.size(); s++) {
      EXPECT_EQ(a.shapes[s].type, b.shapes[s].type);
      EXPECT_EQ(a.shapes[s].local.position, b.shapes[s].local.position);
      EXPECT_EQ(a.shapes[s].local.rotation, b.shapes[s].local.rotation);
      EXPECT_EQ(a.shapes[s].vertices, b.shapes[s].vertices);
      if (a.shapes[s].type == ShapeType::box) {
        EXPECT_EQ(a.shapes[s].halfExtents, b.shapes[s].halfExtents);
      }
      const ShapeType type = a.shapes[s].type;
      if (type == ShapeType::capsule || type == ShapeType::cylinder || type == ShapeType::cone) {
        EXPECT_EQ(a.shapes[s].radius, b.shapes[s].radius);
        EXPECT_EQ(a.shapes[s].halfHeight, b.shapes[s].halfHeight);
      }
      if (type == ShapeType::cone) {
        EXPECT_EQ(a.shapes[s].topRadius, b.shapes[s].topRadius);
      }
    }
  }
  ASSERT_EQ(got.cameras.size(), 2u);
  EXPECT_EQ(got.cameras[1].name, "side");
  EXPECT_EQ(got.cameras[1].position, want.cameras[1].position);
  EXPECT_EQ(got.cameras[1].fieldOfViewDegrees, 40);
  EXPECT_TRUE(got.cameras[0].path.empty());
  ASSERT_EQ(got.cameras[1].path.size(), 2u);
  EXPECT_EQ(got.cameras[1].path[1].time, 2.5);
  EXPECT_EQ(got.cameras[1].path[1].position, want.cameras[1].path[1].position);
  EXPECT_EQ(got.cameras[1].path[1].target, want.cameras[1].path[1].target);
  EXPECT_EQ(got.cameras[1].path[1].fieldOfViewDegrees, 35);
  EXPECT_EQ(bodies[2].material, "brick");
  EXPECT_EQ(bodies.back().shapeMaterials, (std::vector<std::string>{"brick", "steel"}));
  EXPECT_EQ(bodies.back().shapeColours, (std::vector<std::uint32_t>{0x6F8F4F, 0x222426}));
}

TEST(Take, AnyOrderGivesTheSameFrames) {
  RemovedAtEnd file{temporaryFile("seek.take")};
  SyntheticTake take = makeSyntheticTake({.frames = 200});
  ASSERT_EQ(test::writeTake(take, file.path), "");
  Result<TakeReader> reader = TakeReader::open(file.path);
  ASSERT_TRUE(reader);
  for (std::size_t f : {199, 0, 64, 63, 65, 130, 128, 127, 199, 198, 10, 10, 11}) {
    Result<TakeFrame> frame = reader->frame(f);
    ASSERT_TRUE(frame) << frame.error().message;
    expectSame(take.frames[f], *frame, "frame " + std::to_string(f));
  }
  Result<TakeFrame> beyond = reader->frame(200);
  ASSERT_FALSE(beyond);
  EXPECT_EQ(beyond.error().code, ErrorCode::invalidArgument);
}

TEST(Take, BodiesComeAndGo) {
  RemovedAtEnd file{temporaryFile("lives.take")};
  SyntheticTake take = makeSyntheticTake({.courses = 3, .bricksPerCourse = 3, .frames = 200, .breaking = true});
  ASSERT_EQ(test::writeTake(take, file.path), "");
  Result<TakeReader> reader = TakeReader::open(file.path);
  ASSERT_TRUE(reader) << reader.error().message;
  EXPECT_TRUE(reader->complete());
  ASSERT_EQ(reader->bodies().size(), 17u);  // ground, ball, nine bricks, three others, three pieces
  ASSERT_EQ(reader->lives().size(), 17u);
  for (std::size_t k = 0; k < 17; k++) {
    EXPECT_EQ(reader->bodies()[k].name, take.bodies[k].name);
    EXPECT_EQ(reader->lives()[k].birth, k < 14 ? 0u : 60u) << k;
    EXPECT_EQ(reader->lives()[k].end, k == 2 ? 60u : k == 15 ? 130u : 200u) << k;
  }
  // In any order, in and out of the groups of 64 frames, the right bodies with the right poses.
  for (std::size_t f : {199, 0, 59, 60, 61, 130, 129, 128, 131, 60, 64, 63, 62, 127, 130, 10, 199, 70}) {
    std::vector<std::uint32_t> there;
    for (std::uint32_t k = 0; k < 17; k++)
      if (take.lives[k].holds(f)) there.push_back(k);
    EXPECT_EQ(reader->bodiesAt(f), there) << f;
    Result<TakeFrame> frame = reader->frame(f);
    ASSERT_TRUE(frame) << frame.error().message;
    expectSame(take.frames[f], *frame, "frame " + std::to_string(f));
  }
  for (std::size_t f = 0; f < 200; f++) expectSame(take.frames[f], *reader->frame(f), "frame " + std::to_string(f));
}

TEST(Take, WrongChangesAreRefusedAndSpoilNothing) {
  RemovedAtEnd file{temporaryFile("changes.take")};
  SyntheticTake take = makeSyntheticTake({.courses = 1, .bricksPerCourse = 2, .frames = 2, .otherShapes = false});
  Result<TakeWriter> writer = TakeWriter::create(file.path, take.header);
  ASSERT_TRUE(writer);
  const double nan = std::numeric_limits<double>::quiet_NaN();
  auto refused = [&](auto spoil, const std::string& named) {
    TakeChange change = take.change(0);
    spoil(change);
    Status written = writer->write(take.frames[0], change);
    ASSERT_FALSE(written) << named;
    EXPECT_EQ(written.error().code, ErrorCode::invalidArgument);
    EXPECT_NE(written.error().message.find(named), std::string::npos) << written.error().message;
  };
  refused([&](TakeChange& c) { c.births[2].mass = nan; }, "body 2 \"brick 0\": mass");
  refused([&](TakeChange& c) { c.births[2].shapes[0].halfExtents.x = 0; }, "halfExtents");
  refused([&](TakeChange& c) { c.births[1].shapes[0].radius = -1; }, "radius");
  refused([&](TakeChange& c) { c.births[1].shapeMaterials = {"steel", "brick"}; }, "2 shapeMaterials, expected none");
  refused([&](TakeChange& c) { c.births[1].shapeColours = {1, 2}; }, "2 shapeColours, expected none");
  refused([&](TakeChange& c) { c.births.pop_back(); }, "4 poses, expected one for each of the 3");
  refused([&](TakeChange& c) { c.ends = {0}; }, "body 0 ends, but is not there");
  ASSERT_TRUE(writer->write(take.frames[0], take.change(0)));
  TakeFrame less = take.frames[1];
  less.poses.erase(less.poses.begin() + 2);
  EXPECT_FALSE(writer->write(less));
  EXPECT_FALSE(writer->write(less, {{}, {2, 1}})) << "not in order";
  EXPECT_FALSE(writer->write(less, {{}, {2, 2}}));
  ASSERT_TRUE(writer->write(less, {{}, {2}}));
  EXPECT_FALSE(writer->write(less, {{}, {2}})) << "it is gone already";
  ASSERT_TRUE(writer->finish(""));
  Result<TakeReader> reader = TakeReader::open(file.path);
  ASSERT_TRUE(reader);
  EXPECT_EQ(reader->bodiesAt(1), (std::vector<std::uint32_t>{0, 1, 3}));
  expectSame(less, *reader->frame(1), "frame 1");
}

// version1.take was written by the last program that wrote this version, from the same synthetic take.
TEST(Take, VersionOneStillOpens) {
  SyntheticTake take = makeSyntheticTake({.courses = 2, .bricksPerCourse = 2, .frames = 70, .hitFrame = 2});
  Result<TakeReader> reader = TakeReader::open(BRICKFALL_SOURCE_DIR "/tests/unit/record/version1.take");
  ASSERT_TRUE(reader) << reader.error().message;
  EXPECT_TRUE(reader->complete());
  EXPECT_EQ(reader->summaryJson(), "{\"scene\": \"synthetic\"}");
  EXPECT_EQ(reader->header().title, take.header.title);
  EXPECT_EQ(reader->header().cameras.size(), take.header.cameras.size());
  ASSERT_EQ(reader->bodies().size(), take.bodies.size());
  for (std::size_t k = 0; k < take.bodies.size(); k++) {
    EXPECT_EQ(reader->bodies()[k].name, take.bodies[k].name);
    EXPECT_EQ(reader->bodies()[k].shapes.size(), take.bodies[k].shapes.size());
    EXPECT_EQ(reader->bodies()[k].mass, take.bodies[k].mass);
    EXPECT_EQ(reader->lives()[k].birth, 0u);
    EXPECT_EQ(reader->lives()[k].end, 70u);
  }
  ASSERT_EQ(reader->frameCount(), 70u);
  for (std::size_t f : {69, 0, 63, 64, 30}) expectSame(take.frames[f], *reader->frame(f), "frame " + std::to_string(f));
}

// So was version2.take: no materials, no paths of cameras.
TEST(Take, VersionTwoStillOpens) {
  SyntheticTake take =
      makeSyntheticTake({.courses = 2, .bricksPerCourse = 2, .frames = 70, .hitFrame = 2, .breaking = true});
  Result<TakeReader> reader = TakeReader::open(BRICKFALL_SOURCE_DIR "/tests/unit/record/version2.take");
  ASSERT_TRUE(reader) << reader.error().message;
  EXPECT_TRUE(reader->complete());
  ASSERT_EQ(reader->header().cameras.size(), 2u);
  EXPECT_EQ(reader->header().cameras[1].name, "side");
  EXPECT_TRUE(reader->header().cameras[1].path.empty());
  ASSERT_EQ(reader->bodies().size(), take.bodies.size());
  for (std::size_t k = 0; k < take.bodies.size(); k++) {
    EXPECT_EQ(reader->bodies()[k].name, take.bodies[k].name);
    EXPECT_EQ(reader->bodies()[k].shapes.size(), take.bodies[k].shapes.size());
    EXPECT_EQ(reader->bodies()[k].material, "");
    EXPECT_EQ(reader->lives()[k].birth, take.lives[k].birth);
  }
  ASSERT_EQ(reader->frameCount(), 70u);
  for (std::size_t f : {69, 0, 63, 64, 30}) expectSame(take.frames[f], *reader->frame(f), "frame " + std::to_string(f));
}

// So was version3.take: no mortar.
TEST(Take, VersionThreeStillOpens) {
  SyntheticTake take =
      makeSyntheticTake({.courses = 2, .bricksPerCourse = 2, .frames = 70, .hitFrame = 2, .breaking = true});
  Result<TakeReader> reader = TakeReader::open(BRICKFALL_SOURCE_DIR "/tests/unit/record/version3.take");
  ASSERT_TRUE(reader) << reader.error().message;
  EXPECT_TRUE(reader->complete());
  EXPECT_EQ(reader->header().cameras[1].path.size(), 2u);
  ASSERT_EQ(reader->bodies().size(), take.bodies.size());
  EXPECT_EQ(reader->bodies()[2].material, "brick");
  EXPECT_TRUE(reader->mortar().empty());
  ASSERT_EQ(reader->frameCount(), 70u);
  for (std::size_t f : {69, 0, 63, 64, 30}) expectSame(take.frames[f], *reader->frame(f), "frame " + std::to_string(f));
}

// So was version4.take: looks go by the number in the take.
TEST(Take, VersionFourStillOpens) {
  SyntheticTake take = makeSyntheticTake(
      {.courses = 2, .bricksPerCourse = 3, .frames = 70, .hitFrame = 40, .breaking = true, .mortared = true});
  Result<TakeReader> reader = TakeReader::open(BRICKFALL_SOURCE_DIR "/tests/unit/record/version4.take");
  ASSERT_TRUE(reader) << reader.error().message;
  EXPECT_TRUE(reader->complete());
  EXPECT_EQ(reader->mortar().size(), take.mortar.size());
  ASSERT_EQ(reader->bodies().size(), take.bodies.size());
  for (std::size_t k = 0; k < take.bodies.size(); k++) EXPECT_EQ(reader->bodies()[k].look, std::uint32_t(k));
  ASSERT_EQ(reader->frameCount(), 70u);
  for (std::size_t f : {69, 0, 63, 64, 30}) expectSame(take.frames[f], *reader->frame(f), "frame " + std::to_string(f));
}

// So was version5.take: no camera turns after a body.
TEST(Take, VersionFiveStillOpens) {
  SyntheticTake take = makeSyntheticTake(
      {.courses = 2, .bricksPerCourse = 3, .frames = 70, .hitFrame = 40, .breaking = true, .mortared = true});
  Result<TakeReader> reader = TakeReader::open(BRICKFALL_SOURCE_DIR "/tests/unit/record/version5.take");
  ASSERT_TRUE(reader) << reader.error().message;
  EXPECT_TRUE(reader->complete());
  ASSERT_EQ(reader->header().cameras.size(), take.header.cameras.size());
  for (const Camera& camera : reader->header().cameras) EXPECT_EQ(camera.follow, "");
  for (std::size_t k = 0; k < take.bodies.size(); k++) EXPECT_EQ(reader->bodies()[k].look, std::uint32_t(k + 7));
  for (std::size_t f : {69, 0, 30}) expectSame(take.frames[f], *reader->frame(f), "frame " + std::to_string(f));
}

// So was version6.take: shapes have no colours.
TEST(Take, VersionSixStillOpens) {
  SyntheticTake take = makeSyntheticTake(
      {.courses = 2, .bricksPerCourse = 3, .frames = 70, .hitFrame = 40, .breaking = true, .mortared = true});
  Result<TakeReader> reader = TakeReader::open(BRICKFALL_SOURCE_DIR "/tests/unit/record/version6.take");
  ASSERT_TRUE(reader) << reader.error().message;
  EXPECT_TRUE(reader->complete());
  EXPECT_EQ(reader->header().cameras[0].follow, "ball");
  for (const TakeBody& body : reader->bodies()) EXPECT_TRUE(body.shapeColours.empty());
  for (std::size_t f : {69, 0, 30}) expectSame(take.frames[f], *reader->frame(f), "frame " + std::to_string(f));
}

TEST(Take, LooksComeBackAsWritten) {
  RemovedAtEnd file{temporaryFile("looks.take")};
  SyntheticTake take = makeSyntheticTake({.courses = 1, .bricksPerCourse = 2, .frames = 2, .hitFrame = 1});
  take.bodies[0].look = 0xffffffffu;
  take.bodies[1].look = 0;
  ASSERT_EQ(test::writeTake(take, file.path), "");
  Result<TakeReader> reader = TakeReader::open(file.path);
  ASSERT_TRUE(reader) << reader.error().message;
  EXPECT_EQ(reader->bodies()[0].look, 0xffffffffu);
  EXPECT_EQ(reader->bodies()[1].look, 0u);
  EXPECT_EQ(reader->bodies()[2].look, 2u) << "none was written";
}

TEST(Take, MortarComesBackAsWritten) {
  RemovedAtEnd file{temporaryFile("mortar.take")};
  SyntheticTake take = makeSyntheticTake(
      {.courses = 2, .bricksPerCourse = 3, .frames = 100, .hitFrame = 40, .breaking = true, .mortared = true});
  ASSERT_EQ(test::writeTake(take, file.path), "");
  Result<TakeReader> reader = TakeReader::open(file.path);
  ASSERT_TRUE(reader) << reader.error().message;
  ASSERT_EQ(reader->mortar().size(), take.mortar.size());
  for (std::size_t k = 0; k < take.mortar.size(); k++) {
    EXPECT_EQ(reader->mortar()[k].bodyA, take.mortar[k].bodyA);
    EXPECT_LE(length(reader->mortar()[k].centre - take.mortar[k].centre), 1e-7);
    EXPECT_LE(length(reader->mortar()[k].along2 - take.mortar[k].along2), 1e-7);
  }
  EXPECT_EQ(reader->mortarLives()[0].end, 40u) << "with its brick";
  EXPECT_EQ(reader->mortarAt(50), (std::vector<std::uint32_t>{1, 2, 3, 4}));
  for (std::size_t f : {99, 0, 39, 40, 41, 63, 64, 5, 80})
    expectSame(take.frames[f], *reader->frame(f), "frame " + std::to_string(f));

  auto refused = [&](auto spoil, const std::string& names) {
    SyntheticTake bad = take;
    spoil(bad);
    const std::string error = test::writeTake(bad, file.path + ".bad");
    std::remove((file.path + ".bad").c_str());
    EXPECT_NE(error.find(names), std::string::npos) << error;
  };
  refused([](SyntheticTake& t) { t.frames[1].mortar.pop_back(); },
          "frame 1: 4 states of mortar, expected one for each");
  refused([](SyntheticTake& t) { t.frames[1].mortar[0].damage = 1.5f; }, "not 0 .. 1");
  refused([](SyntheticTake& t) { t.frames[1].mortar[0].utilisation = std::nanf(""); }, "not 0 .. 1");
  refused([](SyntheticTake& t) { t.mortar[1].centre.x = std::nan(""); }, "a joint's place");
  refused([](SyntheticTake& t) { t.frames[40].breaks[0].mortar = 99; }, "names joint 99");
  refused([](SyntheticTake& t) { t.frames[40].breaks[0].takers[0].bodyA = 99; }, "names body 99");
  refused([](SyntheticTake& t) { t.frames[40].breaks[0].takers.resize(5); }, "5 bear the load");
  refused([](SyntheticTake& t) { t.frames[40].breaks[0].breakTime = std::nan(""); }, "time is not finite");
}

TEST(Take, FarAndFastBodiesKeepTheirPlace) {
  RemovedAtEnd file{temporaryFile("far.take")};
  SyntheticTake take = makeSyntheticTake({.courses = 1, .bricksPerCourse = 1, .frames = 3, .otherShapes = false});
  take.frames[0].poses[1].position = {5000.0000149, -3000.5, 1e-6};
  take.frames[1].poses[1].position = {-7999.99999, 123456.789, 0.5};
  take.frames[1].poses[1].rotation = normalized(Quat{-0.5, 0.1, 0.2, -0.7});
  take.frames[2].poses[1].position = {1e8, -1e8, 1e8};
  take.frames[2].poses[1].speed = 80000;
  ASSERT_EQ(test::writeTake(take, file.path), "");
  Result<TakeReader> reader = TakeReader::open(file.path);
  ASSERT_TRUE(reader);
  for (std::size_t f = 0; f < 3; f++) expectSame(take.frames[f], *reader->frame(f), "frame " + std::to_string(f));
}

TEST(Take, RestingBodiesCostNextToNothing) {
  RemovedAtEnd still{temporaryFile("still.take")}, one{temporaryFile("one.take")};
  SyntheticTake take = makeSyntheticTake({.courses = 40, .bricksPerCourse = 25, .frames = 1, .otherShapes = false});
  ASSERT_EQ(test::writeTake(take, one.path), "");
  for (int f = 1; f < 64; f++) {
    take.frames.push_back(take.frames[0]);
    take.frames.back().time = f / 60.0;
  }
  ASSERT_EQ(test::writeTake(take, still.path), "");
  auto more = std::filesystem::file_size(still.path) - std::filesystem::file_size(one.path);
  EXPECT_LE(more, 63u * 64u);  // a thousand resting bricks: at most 64 bytes a frame
}

TEST(Take, WrongFramesAreRefusedByName) {
  RemovedAtEnd file{temporaryFile("refused.take")};
  SyntheticTake take = makeSyntheticTake({.courses = 1, .bricksPerCourse = 2, .frames = 1, .otherShapes = false});
  Result<TakeWriter> writer = TakeWriter::create(file.path, take.header);
  ASSERT_TRUE(writer);
  auto refused = [&](auto change, const std::string& named) {
    TakeFrame frame = take.frames[0];
    change(frame);
    Status written = writer->write(frame, take.change(0));
    EXPECT_FALSE(written) << named;
    EXPECT_EQ(written.error().code, ErrorCode::invalidArgument);
    EXPECT_NE(written.error().message.find(named), std::string::npos) << written.error().message;
  };
  const double nan = std::numeric_limits<double>::quiet_NaN(), infinite = std::numeric_limits<double>::infinity();
  refused([&](TakeFrame& f) { f.poses[2].position.y = nan; }, "body 2 \"brick 0\": position");
  refused([&](TakeFrame& f) { f.poses[2].position.y = infinite; }, "position");
  refused([&](TakeFrame& f) { f.poses[2].rotation.w = nan; }, "rotation");
  refused([&](TakeFrame& f) { f.poses[2].rotation = {0, 0, 0, 0}; }, "rotation");
  refused([&](TakeFrame& f) { f.poses[1].speed = float(nan); }, "speed");
  refused([&](TakeFrame& f) { f.poses[1].contactForce = -1; }, "contactForce");
  refused([&](TakeFrame& f) { f.time = nan; }, "time");
  refused([&](TakeFrame& f) { f.poses.pop_back(); }, "3 poses");
  refused([&](TakeFrame& f) { f.events.push_back({TakeEventType::hit, 9, 0, {}, 1}); }, "body 9");
  // None of these spoilt what follows.
  EXPECT_TRUE(writer->write(take.frames[0], take.change(0)));
  EXPECT_TRUE(writer->finish(""));
  EXPECT_EQ(writer->write(take.frames[0]).error().code, ErrorCode::wrongState);
  Result<TakeReader> reader = TakeReader::open(file.path);
  ASSERT_TRUE(reader);
  ASSERT_EQ(reader->frameCount(), 1u);
  expectSame(take.frames[0], *reader->frame(0), "frame 0");
}

TEST(Take, WrongHeadersAreRefusedByName) {
  RemovedAtEnd file{temporaryFile("badheader.take")};
  auto refused = [&](auto change, const std::string& named) {
    TakeHeader header = makeSyntheticTake({.frames = 1}).header;
    change(header);
    Result<TakeWriter> writer = TakeWriter::create(file.path, header);
    ASSERT_FALSE(writer) << named;
    EXPECT_NE(writer.error().message.find(named), std::string::npos) << writer.error().message;
  };
  const double nan = std::numeric_limits<double>::quiet_NaN();
  refused([&](TakeHeader& h) { h.framesPerSecond = 0; }, "framesPerSecond");
  refused([&](TakeHeader& h) { h.framesPerSecond = nan; }, "framesPerSecond");
  refused([&](TakeHeader& h) { h.cameras[0].target.x = nan; }, "camera \"front\"");
  refused([&](TakeHeader& h) { h.cameras[1].path[1].time = 0; }, "camera \"side\": path: its times do not ascend");
  refused([&](TakeHeader& h) { h.cameras[1].path[1].position.y = nan; }, "path: a position");
  EXPECT_FALSE(std::filesystem::exists(file.path));
}

TEST(Take, FullDiskIsAnInputOutputError) {
  if (!std::filesystem::exists("/dev/full")) GTEST_SKIP() << "missing: the device /dev/full";
  Result<TakeWriter> writer = TakeWriter::create("/dev/full", makeSyntheticTake({.frames = 1}).header);
  ASSERT_FALSE(writer);
  EXPECT_EQ(writer.error().code, ErrorCode::inputOutput);
  EXPECT_NE(writer.error().message.find("/dev/full: cannot write"), std::string::npos) << writer.error().message;
}

TEST(Take, MissingFilesAndFoldersAreInputOutputErrors) {
  Result<TakeReader> missing = TakeReader::open("/nowhere/at/all.take");
  ASSERT_FALSE(missing);
  EXPECT_EQ(missing.error().code, ErrorCode::inputOutput);
  EXPECT_NE(missing.error().message.find("/nowhere/at/all.take"), std::string::npos);
  Result<TakeReader> folder = TakeReader::open("/tmp");
  ASSERT_FALSE(folder);
  EXPECT_EQ(folder.error().code, ErrorCode::inputOutput);
  Result<TakeWriter> nowhere = TakeWriter::create("/nowhere/at/all.take", {});
  ASSERT_FALSE(nowhere);
  EXPECT_EQ(nowhere.error().code, ErrorCode::inputOutput);
}

// The disk fills up in the middle of a frame: the frames before it stay readable, and the writer says so from then on.
TEST(Take, DiskThatFillsUpKeepsWholeFrames) {
  RemovedAtEnd file{temporaryFile("filling.take")};
  SyntheticTake take = makeSyntheticTake({});
  pid_t child = ::fork();
  ASSERT_GE(child, 0);
  if (child == 0) {
    std::signal(SIGXFSZ, SIG_IGN);
    rlimit limit{40000, 40000};
    ::setrlimit(RLIMIT_FSIZE, &limit);
    Result<TakeWriter> writer = TakeWriter::create(file.path, take.header);
    int written = 0;
    Status last;
    for (const TakeFrame& frame : take.frames) {
      last = writer->write(frame, take.change(std::size_t(written)));
      if (!last) break;
      written++;
    }
    bool stays = !writer->write(take.frames[0]) && !writer->finish("");
    ::_exit(last.error().code == ErrorCode::inputOutput && stays ? written : 0);
  }
  int status = 0;
  ASSERT_EQ(::waitpid(child, &status, 0), child);
  ASSERT_TRUE(WIFEXITED(status));
  int written = WEXITSTATUS(status);
  ASSERT_GT(written, 60);
  Result<TakeReader> reader = TakeReader::open(file.path);
  ASSERT_TRUE(reader) << reader.error().message;
  EXPECT_FALSE(reader->complete());
  ASSERT_EQ(reader->frameCount(), std::size_t(written));
  expectSame(take.frames[written - 1], *reader->frame(written - 1), "last frame");
}

// Killed without warning: every frame that write() returned from is in the file.
TEST(Take, KilledWriterLeavesItsFrames) {
  RemovedAtEnd file{temporaryFile("killed.take")};
  SyntheticTake take = makeSyntheticTake({});
  pid_t child = ::fork();
  ASSERT_GE(child, 0);
  if (child == 0) {
    Result<TakeWriter> writer = TakeWriter::create(file.path, take.header);
    for (int f = 0; f < 100; f++) (void)writer->write(take.frames[f], take.change(std::size_t(f))).ok();
    ::kill(::getpid(), SIGKILL);
  }
  int status = 0;
  ASSERT_EQ(::waitpid(child, &status, 0), child);
  ASSERT_TRUE(WIFSIGNALED(status));
  Result<TakeReader> reader = TakeReader::open(file.path);
  ASSERT_TRUE(reader) << reader.error().message;
  EXPECT_FALSE(reader->complete());
  ASSERT_EQ(reader->frameCount(), 100u);
  expectSame(take.frames[99], *reader->frame(99), "frame 99");
}

TEST(Take, ChecksumIsTheStandardOne) {
  const char* digits = "123456789";
  std::span<const std::uint8_t> bytes(reinterpret_cast<const std::uint8_t*>(digits), 9);
  EXPECT_EQ(crc32(bytes), 0xCBF43926u);
  EXPECT_EQ(crc32(bytes.subspan(4), crc32(bytes.first(4))), 0xCBF43926u);
}

}  // namespace
}  // namespace brickfall
