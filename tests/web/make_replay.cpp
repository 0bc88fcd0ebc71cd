// make_replay FOLDER: the synthetic wall as wall.take, replay.html, wall.glb, and poses.json with what the take says of
// some frames and of where its moving camera is; two bricks of which one breaks as breaking.html and breaking.glb; and a ball that
// rolls far down a tilted plane, past bodies of odd materials, as slope.html; and one that rolls over the edge of a slab, away from
// two bodies that stay on it, as slab.html: for the tests that open these in other programs.
#include <cstdio>
#include <fstream>
#include <nlohmann/json.hpp>
#include <string>

#include "brickfall/output.h"
#include "support/synthetic_take.h"

namespace {

using namespace brickfall;
using nlohmann::json;

// Where the moving camera is in some frames, by the rule that films go by.
json writeMoves(const TakeReader& take) {
  json out = json::array();
  for (int f : {30, 75, 110, 135, 230}) {
    const Camera at = cameraAt(take.header().cameras[1], f / 60.0);
    out.push_back({{"frame", f},
                   {"position", {at.position.x, at.position.y, at.position.z}},
                   {"target", {at.target.x, at.target.y, at.target.z}},
                   {"fieldOfView", at.fieldOfViewDegrees}});
  }
  return out;
}

std::string writePoses(const TakeReader& take, const std::string& path) {
  json bodies = json::array(), samples = json::array();
  for (const TakeBody& body : take.bodies()) bodies.push_back(body.name);
  for (std::size_t f : {0, 59, 70, 101, 239}) {
    Result<TakeFrame> frame = take.frame(f);
    if (!frame) return frame.error().message;
    json positions = json::array(), rotations = json::array();
    for (const TakePose& pose : frame->poses) {
      positions.push_back({pose.position.x, pose.position.y, pose.position.z});
      rotations.push_back({pose.rotation.x, pose.rotation.y, pose.rotation.z, pose.rotation.w});
    }
    samples.push_back({{"frame", f}, {"positions", positions}, {"rotations", rotations}});
  }
  std::ofstream(path) << json{{"framesPerSecond", int(take.header().framesPerSecond)},
                              {"bodies", bodies},
                              {"cameras", take.header().cameras.size()},
                              {"moving", writeMoves(take)},
                              {"samples", samples}};
  return {};
}

// The second camera moves: with a key to pass, a rest, and an end before the take's.
const std::vector<CameraKey> kMoves = {{0.25, {-3.5, 1, 0.8}, {0, 0.3, 0}, 40},  {1, {-3, 1.4, 2}, {0, 0.4, 0}, 45},
                                       {1.5, {-1.5, 1.2, 2.8}, {0, 0.3, 0}, 38}, {2, {-1.5, 1.2, 2.8}, {0, 0.3, 0}, 38},
                                       {2.5, {0.4, 0.9, 3}, {0.1, 0.2, 0}, 35},  {3.25, {2, 1.2, 2}, {0, 0, 0}, 35}};

std::string makeBreaking(const std::string& folder) {
  const test::SyntheticOptions options{
      .courses = 1, .bricksPerCourse = 2, .frames = 150, .otherShapes = false, .breaking = true, .mortared = true};
  std::string fault = test::writeTake(test::makeSyntheticTake(options), folder + "/breaking.take");
  if (!fault.empty()) return fault;
  Result<TakeReader> take = TakeReader::open(folder + "/breaking.take");
  if (!take) return take.error().message;
  if (Status page = writeReplayHtml(*take, folder + "/breaking.html"); !page) return page.error().message;
  Status glb = writeGlb(*take, folder + "/breaking.glb");
  return glb ? std::string() : glb.error().message;
}

// `path`: without what the names of take and page end with.
std::string writePage(const test::SyntheticTake& out, const std::string& path) {
  std::string fault = test::writeTake(out, path + ".take");
  if (!fault.empty()) return fault;
  Result<TakeReader> take = TakeReader::open(path + ".take");
  if (!take) return take.error().message;
  Status page = writeReplayHtml(*take, path + ".html");
  return page ? std::string() : page.error().message;
}

constexpr double kSlope = 0.2;  // rad

TakeBody smallBody(const std::string& name, BodyRole role, const std::string& material) {
  TakeBody body;
  body.name = name;
  body.role = role;
  body.material = material;
  body.colour = 0xB5543A;
  body.mass = role == BodyRole::ground ? 0 : 1;
  body.shapes.resize(1);
  body.shapes[0].halfExtents = {0.1, 0.1, 0.1};
  return body;
}

// Down along x; beside the way a body without a material, and one of wood with a head of steel.
std::string makeSlope(const std::string& folder) {
  TakeBody ground = smallBody("ground", BodyRole::ground, ""), ball = smallBody("ball", BodyRole::ball, ""),
           plain = smallBody("plain", BodyRole::body, ""), hammer = smallBody("hammer", BodyRole::body, "oak");
  ground.shapes[0].type = ShapeType::plane;
  ball.shapes[0].type = ShapeType::sphere;
  ball.shapes[0].radius = 0.25;
  hammer.shapes.push_back(hammer.shapes[0]);
  hammer.shapes[1].local.position = {0, 0.2, 0};
  hammer.shapeMaterials = {"oak", "steel"};
  test::SyntheticTake out;
  out.header.scene = out.header.title = "slope";
  out.header.engineVersion = "test";
  out.bodies = {ground, ball, plain, hammer};
  out.lives.assign(4, {0, SIZE_MAX});
  const Quat tilt = quatFromAxisAngle({0, 0, 1}, -kSlope);
  const Vec3 along = rotate(tilt, {1, 0, 0}), up = rotate(tilt, {0, 1, 0});
  for (int f = 0; f < 120; f++) {
    TakeFrame frame;
    frame.time = f / 60.0;
    const Vec3 places[] = {{},
                           along * (f * 0.15) + up * 0.25,
                           along * 2.0 + up * 0.1 + Vec3{0, 0, 0.8},
                           along * 3.0 + up * 0.1 + Vec3{0, 0, 0.8}};
    for (const Vec3& place : places) {
      TakePose pose;
      pose.position = place;
      pose.rotation = tilt;
      frame.poses.push_back(pose);
    }
    out.frames.push_back(std::move(frame));
  }
  return writePage(out, folder + "/slope");
}

// 40 m wide. One body slides nearly to its edge; the ball leaves it after a second and falls 50 m.
std::string makeSlab(const std::string& folder) {
  TakeBody ground = smallBody("ground", BodyRole::ground, ""), ball = smallBody("ball", BodyRole::ball, ""),
           left = smallBody("left", BodyRole::body, ""), right = smallBody("right", BodyRole::body, "");
  ground.shapes[0].halfExtents = {20, 0.5, 20};
  ball.shapes[0].type = ShapeType::sphere;
  ball.shapes[0].radius = 0.25;
  test::SyntheticTake out;
  out.header.scene = out.header.title = "slab";
  out.header.cameras.push_back({"after", {8, 3, 8}, {-1, 0, 0}, 45});
  out.header.cameras[0].follow = "left";
  out.header.engineVersion = "test";
  out.bodies = {ground, ball, left, right};
  out.lives.assign(4, {0, SIZE_MAX});
  for (int f = 0; f < 240; f++) {
    TakeFrame frame;
    frame.time = f / 60.0;
    const double falling = std::max(0.0, frame.time - 1);
    const Vec3 places[] = {{0, -0.5, 0},
                           {0, 0.25 - 5.5 * falling * falling, 1 - 21 * frame.time},
                           {-1, 0.1, -4 * frame.time},
                           {1, 0.1, 0}};
    for (const Vec3& place : places) {
      TakePose pose;
      pose.position = place;
      frame.poses.push_back(pose);
    }
    out.frames.push_back(std::move(frame));
  }
  return writePage(out, folder + "/slab");
}

std::string makeAll(const std::string& folder) {
  test::SyntheticTake wall = test::makeSyntheticTake({});
  wall.header.cameras[1].path = kMoves;
  // Figures over time: of all that the page could show, one.
  json series;
  for (const TakeFrame& frame : wall.frames) {
    series["time_s"].push_back(frame.time);
    series["largest_force_n"].push_back(frame.time < 2 ? 0 : 1234);
  }
  std::string fault = test::writeTake(wall, folder + "/wall.take", json{{"series", series}}.dump());
  if (!fault.empty()) return fault;
  Result<TakeReader> take = TakeReader::open(folder + "/wall.take");
  if (!take) return take.error().message;
  if (Status page = writeReplayHtml(*take, folder + "/replay.html"); !page) return page.error().message;
  if (Status glb = writeGlb(*take, folder + "/wall.glb"); !glb) return glb.error().message;
  return writePoses(*take, folder + "/poses.json");
}

}  // namespace

int main(int argc, char** argv) {
  if (argc != 2) {
    std::fprintf(stderr, "usage: make_replay FOLDER\n");
    return 2;
  }
  std::string fault = makeAll(argv[1]);
  if (fault.empty()) fault = makeBreaking(argv[1]);
  if (fault.empty()) fault = makeSlope(argv[1]);
  if (fault.empty()) fault = makeSlab(argv[1]);
  if (!fault.empty()) std::fprintf(stderr, "%s\n", fault.c_str());
  return fault.empty() ? 0 : 1;
}
