// make_replay FOLDER: the synthetic wall as wall.take, replay.html and wall.glb, for the tests that open them.
#include <cstdio>
#include <string>

#include "brickfall/output.h"
#include "support/synthetic_take.h"

int main(int argc, char** argv) {
  using namespace brickfall;
  if (argc != 2) {
    std::fprintf(stderr, "usage: make_replay FOLDER\n");
    return 2;
  }
  std::string folder = argv[1];
  std::string fault = test::writeTake(test::makeSyntheticTake({}), folder + "/wall.take");
  if (fault.empty()) {
    Result<TakeReader> take = TakeReader::open(folder + "/wall.take");
    Status page = take ? writeReplayHtml(*take, folder + "/replay.html") : Status(take.error());
    Status glb = take ? writeGlb(*take, folder + "/wall.glb") : Status(take.error());
    fault = !page ? page.error().message : !glb ? glb.error().message : "";
  }
  if (!fault.empty()) std::fprintf(stderr, "%s\n", fault.c_str());
  return fault.empty() ? 0 : 1;
}
