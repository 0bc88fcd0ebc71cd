// Takes whose bodies and header hold odd but allowed things (from damage that the checks let pass): both outputs give a file or an
// error, and both are still readable as JSON.
#include <nlohmann/json.hpp>
#include <random>

#include "output_helpers.h"
#include "record/body_codec.h"
#include "record/header_codec.h"
#include "record/take_record.h"

namespace brickfall {
namespace {

TEST(OddTakes, GiveAFileOrAnError) {
  test::OutputFolder folder;
  test::SyntheticTake take = test::makeSyntheticTake({.courses = 1, .bricksPerCourse = 2, .frames = 3, .hitFrame = 1});
  const Bytes header = encodeHeader(take.header), bodies = encodeChange(take.change(0));
  std::mt19937_64 random(11);
  int written = 0;
  for (int round = 0; round < 150; round++) {
    const auto damaged = [&](Bytes bytes) {
      for (std::uint64_t c = 1 + random() % 3; c > 0; c--) bytes[random() % bytes.size()] = std::uint8_t(random());
      return bytes;
    };
    Result<DecodedHeader> odd = decodeHeader(damaged(header), kTakeVersion);
    Result<TakeChange> others = decodeChange(damaged(bodies), kTakeVersion);
    if (odd) take.header = odd->header;
    if (others && others->births.size() == take.bodies.size()) take.bodies = others->births;
    if (!odd && !others) continue;
    TakeReader reader = test::opened(take, folder.file("a.take"));
    ASSERT_TRUE(writeReplayHtml(reader, folder.file("a.html")));
    Status glb = writeGlb(reader, folder.file("a.glb"));
    ASSERT_TRUE(glb) << glb.error().message;
    std::string page = test::contentOf(folder.file("a.html"));
    std::size_t from = page.find("id=\"meta\">") + 10;
    EXPECT_TRUE(nlohmann::json::accept(page.substr(from, page.find("</script>", from) - from)));
    written++;
  }
  EXPECT_GT(written, 30);
}

TEST(OddTakes, FarFastAndLateOnesAreWritten) {
  test::OutputFolder folder;
  test::SyntheticTake take = test::makeSyntheticTake({.courses = 1, .bricksPerCourse = 2, .frames = 4, .hitFrame = 1});
  take.frames[1].poses[2].position = {1e9, -1e9, 1e9};
  take.frames[2].poses[2].rotation = {-1, 0, 0, 0};
  for (std::size_t f = 0; f < 4; f++) take.frames[f].time = 1e6 + double(f);
  take.frames[3].events.assign(30000, {TakeEventType::hit, 2, 0, {1e9, 0, 0}, 1});
  TakeReader reader = test::opened(take, folder.file("a.take"));
  EXPECT_TRUE(writeReplayHtml(reader, folder.file("a.html")));
  EXPECT_TRUE(writeGlb(reader, folder.file("a.glb")));
}

}  // namespace
}  // namespace brickfall
