// A description becomes a world: who is in it, with what material, and when the held ones are let go.
#include <algorithm>
#include <set>

#include "unit/scene/scene_support.h"

namespace brickfall {
namespace {

SceneRun runOf(const SceneDescription& scene) {
  Result<SceneRun> run = SceneRun::create(scene);
  EXPECT_TRUE(run.ok()) << run.error().message;
  return std::move(*run);
}

const PlacedBody& bodyNamed(const SceneRun& run, const std::string& name) {
  auto found = std::find_if(run.bodies().begin(), run.bodies().end(), [&](auto& body) { return body.name == name; });
  EXPECT_NE(found, run.bodies().end()) << name;
  return *found;
}

TEST(SceneRun, PlacesGroundThenBricksThenTheRest) {
  SceneRun run = runOf(sound(R"(
[[ball]]
name = "shot"
position = [0, 1, 5]
[[wall]]
name = "w"
courses = 2
bricks = 3
material = "wood"
)"));
  ASSERT_EQ(run.bodies().size(), 1u + 3 + 4 + 1);
  EXPECT_EQ(run.bodies()[0].role, BodyRole::ground);
  EXPECT_EQ(run.bodies()[1].name, "w/0/0");
  EXPECT_EQ(run.bodies()[1].role, BodyRole::brick);
  EXPECT_EQ(run.bodies()[1].colour, 0xB8864Bu);
  EXPECT_EQ(run.bodies()[4].course, 1);
  EXPECT_EQ(run.bodies().back().role, BodyRole::ball);
  EXPECT_EQ(run.bodies().back().course, -1);
  EXPECT_NEAR(run.world().massProperties(run.bodies()[1].id)->mass, 600 * 0.215 * 0.065 * 0.1025, 1e-9);
  EXPECT_EQ(run.world().bodies().size(), run.bodies().size());
}

TEST(SceneRun, HoldsABallUntilItsLaunch) {
  SceneRun run = runOf(sound(R"(
[world]
time_step = 0.01
[[ball]]
position = [0, 5, 0]
velocity = [3, 0, 0]
angular_velocity = [0, 2, 0]
launch_time = 0.05
)"));
  BodyId ball = run.bodies()[1].id;
  EXPECT_EQ(run.bodies()[1].def.type, BodyType::dynamic);
  for (int i = 0; i < 5; i++) {
    ASSERT_TRUE(run.step().ok());
    EXPECT_EQ(run.world().state(ball)->position, (Vec3{0, 5, 0})) << i;
  }
  ASSERT_TRUE(run.step().ok());
  BodyState state = *run.world().state(ball);
  EXPECT_EQ(state.type, BodyType::dynamic);
  EXPECT_NEAR(state.position.x, 0.03, 1e-6);
  EXPECT_NEAR(state.linearVelocity.y, -0.0981, 1e-6);
  EXPECT_NEAR(state.angularVelocity.y, 2, 1e-6);
  EXPECT_GT(state.mass, 30);
}

TEST(SceneRun, PartsKeepTheirMaterials) {
  SceneRun run = runOf(sound(R"(
[[body]]
name = "hammer"
material = "wood"
position = [0, 2, 0]
[[body.part]]
size = [0.1, 1, 0.1]
[[body.part]]
size = [0.2, 0.2, 0.2]
material = "steel"
position = [0, 0.6, 0]
)"));
  double wood = 0.01 * 600, steel = 0.008 * 7800;
  MassProperties mass = *run.world().massProperties(bodyNamed(run, "hammer").id);
  EXPECT_NEAR(mass.mass, wood + steel, 1e-9);
  EXPECT_NEAR(mass.centre.y, steel * 0.6 / (wood + steel), 1e-9);
}

TEST(SceneRun, DensityScatterDiffersBrickByBrickButNotWithTheOrder) {
  std::string text = "[[wall]]\nname = \"w\"\ndensity_scatter = 0.2\n";
  SceneRun plain = runOf(sound(text)), shuffled = runOf(sound(text + "shuffle = true\n"));
  std::set<double> densities;
  for (const PlacedBody& body : plain.bodies()) {
    if (body.role != BodyRole::brick) continue;
    double density = body.def.shapes[0].material.density;
    EXPECT_GE(density, 1900 * 0.8);
    EXPECT_LE(density, 1900 * 1.2);
    densities.insert(density);
    EXPECT_EQ(bodyNamed(shuffled, body.name).def.shapes[0].material.density, density);
  }
  EXPECT_EQ(densities.size(), 105u);
  EXPECT_GT(*densities.rbegin() - *densities.begin(), 1900 * 0.3);
}

TEST(SceneRun, TheSameSceneGivesTheSameBits) {
  SceneDescription scene = sound(
      "[[wall]]\ncourses = 4\nbricks = 4\ndisorder = 1e-4\n[[ball]]\nposition = [0.4, 0.15, "
      "0.5]\nvelocity = [0, 0, -8]\n");
  SceneRun a = runOf(scene), b = runOf(scene);
  for (int i = 0; i < 30; i++) {
    ASSERT_TRUE(a.step().ok());
    ASSERT_TRUE(b.step().ok());
  }
  EXPECT_EQ(a.world().stateHash(), b.world().stateHash());
  scene.seed = 2;
  SceneRun other = runOf(scene);
  for (int i = 0; i < 30; i++) ASSERT_TRUE(other.step().ok());
  EXPECT_NE(other.world().stateHash(), a.world().stateHash());
}

TEST(SceneRun, DescriptionsMadeInCodeAreChecked) {
  SceneDescription scene;
  scene.walls.emplace_back();
  scene.walls[0].material = "cheese";
  Result<SceneRun> run = SceneRun::create(scene);
  ASSERT_FALSE(run.ok());
  EXPECT_TRUE(has(run.error().message, "found \"cheese\", expected the name of a material"));
  scene.walls[0].material = "brick";
  scene.walls[0].wall.courses = 0;
  EXPECT_TRUE(has(SceneRun::create(scene).error().message, "courses: found 0"));
  scene.walls.clear();
  scene.bodies.emplace_back();
  scene.bodies[0].name = "empty";
  scene.bodies[0].material = "wood";
  EXPECT_TRUE(has(SceneRun::create(scene).error().message, "body \"empty\""));
}

TEST(CheckScene, WarnsOfBodiesThatOverlapAtTheStart) {
  SceneDescription scene = sound(R"(
[[body]]
name = "a"
position = [0, 0.5, 0]
[[body]]
name = "b"
position = [0.99, 0.5, 0]
[[body]]
name = "c"
position = [0, 2.49, 0]
rotation_degrees = [0, 0, 45]
[[body]]
name = "far"
position = [9, 0.5, 0]
[[ball]]
name = "sunk"
radius = 0.5
position = [5, 0.3, 0]
)");
  std::string text = allOf(checkScene(scene));
  // At the table of the one that comes later, with the line of the other.
  EXPECT_TRUE(has(text,
                  "test.toml:5:1: warning: b: found it 10 mm inside \"a\" (line 2) at the start, expected bodies that "
                  "touch at most"))
      << text;
  EXPECT_TRUE(has(text, "test.toml:15:1: warning: sunk: found it 200 mm inside \"ground\" at the start")) << text;
  EXPECT_FALSE(has(text, "far")) << text;
  EXPECT_FALSE(has(text, "\"c\"")) << text;
  EXPECT_EQ(std::count(text.begin(), text.end(), '\n'), 2) << text;
}

TEST(CheckScene, TouchingBodiesAreNoMistake) {
  EXPECT_EQ(
      allOf(checkScene(sound("[[wall]]\n[[wall]]\nbond = \"flemish\"\nyaw_degrees = 37\nposition = [0, 0, 3]\n"))), "");
}

TEST(CheckScene, ManyOverlapsAreSummedUp) {
  SceneDescription scene = sound("[[array]]\ncount = [50, 1, 1]\nspacing = [0.9, 1, 1]\n");
  std::vector<Diagnostic> found = checkScene(scene);
  EXPECT_EQ(found.size(), 21u);
  EXPECT_TRUE(has(found.back().message, "found 29 more pairs"));
}

TEST(CheckScene, WarnsOfLateLaunchesAndBareOpenings) {
  std::string text = allOf(checkScene(sound(R"(
[world]
seconds = 2
[[wall]]
name = "w"
[[wall.opening]]
from = 0.6
width = 0.6
height = 0.3
lintel_height = 0
[[ball]]
name = "late"
position = [0, 1, 3]
launch_time = 2
)")));
  EXPECT_TRUE(
      has(text, "test.toml:11:1: warning: late: found launch_time 2, expected it before the end of the run at 2 s"))
      << text;
  EXPECT_TRUE(has(text, "test.toml:6:1: warning: w.opening[0]: found bricks above an opening without a lintel"))
      << text;
}

TEST(CheckScene, ShippedScenesHaveNothingToWarnOf) {
  for (const ShippedScene& shipped : shippedScenes()) {
    SceneLoad load = loadSceneFile(shipped.path);
    ASSERT_TRUE(load.scene.has_value()) << shipped.name;
    EXPECT_EQ(allOf(checkScene(*load.scene)), "") << shipped.name;
  }
}

TEST(SceneRun, BodiesComeAndGoByName) {
  Result<SceneRun> run =
      SceneRun::create(sound("[[ball]]\nname = \"a\"\nposition = [0, 1, 0]\n"
                             "[[ball]]\nname = \"b\"\nposition = [2, 1, 0]\nlaunch_time = 0.1\n"));
  ASSERT_TRUE(run.ok()) << run.error().message;
  const std::size_t before = run->bodies().size();
  const PlacedBody a = run->bodies()[before - 2], b = run->bodies()[before - 1];
  ASSERT_EQ(a.name, "a");
  ASSERT_TRUE(run->destroyBody(a.id).ok());
  EXPECT_FALSE(run->world().isValid(a.id));
  EXPECT_EQ(run->bodies().size(), before - 1);
  EXPECT_EQ(run->find(a.id), nullptr);
  ASSERT_TRUE(run->find(b.id));
  EXPECT_EQ(run->find(b.id)->name, "b");
  EXPECT_EQ(run->destroyBody(a.id).error().code, ErrorCode::staleId);

  PlacedBody c = a;
  c.name = "c";
  Result<BodyId> id = run->createBody(c);
  ASSERT_TRUE(id.ok()) << id.error().message;
  EXPECT_EQ(run->find(*id)->name, "c");
  EXPECT_EQ(run->find(*id)->id, *id);
  c.name = "later";
  c.def.position = {4, 1, 0};
  c.launchTime = 0.2;
  const BodyId later = run->createBody(c).value();
  // A held one that is destroyed, here and behind the scene's back, is not launched and stops nothing.
  ASSERT_TRUE(run->world().destroyBody(b.id).ok());
  for (int i = 0; i < 10; i++) ASSERT_TRUE(run->step().ok());
  EXPECT_EQ(run->world().state(later)->type, BodyType::fixed);
  for (int i = 0; i < 10; i++) ASSERT_TRUE(run->step().ok());
  EXPECT_EQ(run->world().state(later)->type, BodyType::dynamic);
  c.def.shapes.clear();
  EXPECT_NE(run->createBody(c).error().message.find("body \"later\""), std::string::npos);
}

}  // namespace
}  // namespace brickfall
