// A world in which bodies are created and destroyed while it runs: recorded, read back, and told by both outputs.
#include <nlohmann/json.hpp>

#include "brickfall/take_recorder.h"
#include "output_helpers.h"

namespace brickfall {
namespace {

using nlohmann::json;

BodyDef cube(Vec3 position, double half) {
  BodyDef def;
  def.shapes.resize(1);
  def.shapes[0].halfExtents = {half, half, half};
  def.position = position;
  return def;
}

// A cube falls; with step 20 it becomes eight smaller ones, of which one goes with step 40.
void recordBreaking(const std::string& path) {
  World world = World::create({}).value();
  BodyDef ground = cube({0, -1, 0}, 1);
  ground.type = BodyType::fixed;
  ASSERT_TRUE(world.createBody(ground));
  const BodyId whole = world.createBody(cube({0, 1, 0}, 0.1)).value();
  TakeHeader header;
  header.scene = "breaking";
  header.framesPerSecond = 60;
  Result<TakeRecorder> recorder = TakeRecorder::create(path, header, world);
  ASSERT_TRUE(recorder) << recorder.error().message;
  BodyId piece;
  for (int step = 1; step <= 60; step++) {
    if (step == 20) {
      const BodyState state = world.state(whole).value();
      ASSERT_TRUE(world.destroyBody(whole));
      for (int k = 0; k < 8; k++) {
        BodyDef def =
            cube(state.position + Vec3{k & 1 ? 0.05 : -0.05, k & 2 ? 0.05 : -0.05, k & 4 ? 0.05 : -0.05}, 0.05);
        def.linearVelocity = state.linearVelocity;
        piece = world.createBody(def).value();
      }
    }
    if (step == 40) {
      ASSERT_TRUE(world.destroyBody(piece));
    }
    const Result<StepReport> report = world.step(1.0 / 60);
    ASSERT_TRUE(report) << report.error().message;
    ASSERT_TRUE(recorder->afterStep(world, *report));
  }
  ASSERT_TRUE(recorder->finish(""));
}

json metaOf(const std::string& page) {
  const std::size_t from = page.find("id=\"meta\">") + 10;
  return json::parse(page.substr(from, page.find("</script>", from) - from));
}

json rootOf(const std::string& glb) {
  std::size_t size = 0;
  for (std::size_t k = 0; k < 4; k++) size |= std::size_t(std::uint8_t(glb[12 + k])) << (8 * k);
  return json::parse(glb.substr(20, size));
}

TEST(RecordedLives, AreToldByTakeAndOutputs) {
  test::OutputFolder folder;
  recordBreaking(folder.file("a.take"));
  Result<TakeReader> take = TakeReader::open(folder.file("a.take"));
  ASSERT_TRUE(take) << take.error().message;
  ASSERT_EQ(take->frameCount(), 61u);
  ASSERT_EQ(take->bodies().size(), 10u);
  EXPECT_EQ(take->lives()[1].end, 20u);
  EXPECT_EQ(take->lives()[2].birth, 20u);
  EXPECT_EQ(take->lives()[9].end, 40u);
  // Where the cube was there are the pieces now: their middle goes on as it did.
  const TakeFrame before = take->frame(19).value(), after = take->frame(20).value();
  ASSERT_EQ(after.poses.size(), 9u);
  Vec3 middle;
  for (std::size_t k = 1; k < 9; k++) middle += after.poses[k].position * 0.125;
  EXPECT_NEAR(middle.x, before.poses[1].position.x, 0.01);
  EXPECT_LT(middle.y, before.poses[1].position.y);
  EXPECT_GT(middle.y, before.poses[1].position.y - 0.08);

  ASSERT_TRUE(writeReplayHtml(*take, folder.file("a.html")));
  const json bodies = metaOf(test::contentOf(folder.file("a.html")))["bodies"];
  ASSERT_EQ(bodies.size(), 10u);
  EXPECT_EQ(bodies[1]["end"], 20);
  EXPECT_EQ(bodies[9]["birth"], 20);
  EXPECT_EQ(bodies[9]["end"], 40);

  ASSERT_TRUE(writeGlb(*take, folder.file("a.glb")));
  const json root = rootOf(test::contentOf(folder.file("a.glb")));
  ASSERT_EQ(root["nodes"].size(), 11u);
  int scaled = 0;
  for (const json& channel : root["animations"][0]["channels"]) scaled += channel["target"]["path"] == "scale";
  EXPECT_EQ(scaled, 9) << "all but the ground";
}

}  // namespace
}  // namespace brickfall
