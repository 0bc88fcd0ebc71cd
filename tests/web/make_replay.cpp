// make_replay FOLDER: the synthetic wall as wall.take, replay.html, wall.glb, and poses.json with what the take says of
// some frames; and two bricks of which one breaks as breaking.html and breaking.glb: for the tests that open these in other
// programs.
#include <cstdio>
#include <fstream>
#include <nlohmann/json.hpp>
#include <string>

#include "brickfall/output.h"
#include "support/synthetic_take.h"

namespace {

using namespace brickfall;
using nlohmann::json;

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
                              {"samples", samples}};
  return {};
}

std::string makeBreaking(const std::string& folder) {
  const test::SyntheticOptions options{
      .courses = 1, .bricksPerCourse = 2, .frames = 150, .otherShapes = false, .breaking = true};
  std::string fault = test::writeTake(test::makeSyntheticTake(options), folder + "/breaking.take");
  if (!fault.empty()) return fault;
  Result<TakeReader> take = TakeReader::open(folder + "/breaking.take");
  if (!take) return take.error().message;
  if (Status page = writeReplayHtml(*take, folder + "/breaking.html"); !page) return page.error().message;
  Status glb = writeGlb(*take, folder + "/breaking.glb");
  return glb ? std::string() : glb.error().message;
}

std::string makeAll(const std::string& folder) {
  std::string fault = test::writeTake(test::makeSyntheticTake({}), folder + "/wall.take");
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
  if (!fault.empty()) std::fprintf(stderr, "%s\n", fault.c_str());
  return fault.empty() ? 0 : 1;
}
