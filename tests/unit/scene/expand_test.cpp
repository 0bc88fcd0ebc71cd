// repeat, let, groups, copies and includes: the plain tables that they become, and where their mistakes are told.
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <numbers>

#include "unit/scene/scene_support.h"

namespace brickfall {
namespace {

std::vector<std::string> namesOfBodies(const SceneDescription& scene) {
  std::vector<std::string> names;
  for (const SceneBody& body : scene.bodies)
    if (body.role != BodyRole::ground) names.push_back(body.name);
  return names;
}

TEST(Expand, RepeatsALineAGridAndARing) {
  const SceneDescription line =
      sound("[[ball]]\nposition = [1, \"1 + $i\", 0]\nrepeat = { count = 3, step = [0.5, 0, 0] }\n");
  ASSERT_EQ(line.bodies.size(), 4u);
  EXPECT_EQ(line.bodies[3].def.position, (Vec3{2, 3, 0}));
  const SceneDescription grid = sound(
      "[[body]]\nname = \"post\"\nrepeat = { grid = [2, 1, 2], step = [3, 0, 5] }\nposition = [0, \"$i_x\", 0]\n");
  EXPECT_EQ(namesOfBodies(grid), (std::vector<std::string>{"post/0", "post/1", "post/2", "post/3"}));
  EXPECT_EQ(grid.bodies[4].def.position, (Vec3{3, 1, 5}));
  const SceneDescription ring =
      sound("[[body]]\nposition = [3, 0, 0]\nvelocity = [1, 0, 0]\nrepeat = { count = 4, about = [1, 0, 0] }\n");
  EXPECT_EQ(ring.bodies[2].def.position, (Vec3{1, 0, -2}));
  EXPECT_EQ(ring.bodies[2].def.linearVelocity, (Vec3{0, 0, -1}));
  EXPECT_NEAR(ring.bodies[2].def.rotation.y, std::sqrt(0.5), 1e-12);
  EXPECT_EQ(ring.bodies[3].def.position, (Vec3{-1, 0, 0}));
  EXPECT_EQ(sound("[[ball]]\nposition = [0, 1, 0]\n[[ball]]\nposition = [0, 1, 0]\nrepeat = 0\n").bodies.size(), 2u);
}

TEST(Expand, NamesAndLetsAreOfEachRepetition) {
  const SceneDescription scene = sound(
      "[[body]]\nname = \"post $k\"\nrepeat = { count = 2, index = \"k\" }\nlet = { a = \"$k * 2\", b = \"$a + 1\" }\n"
      "position = [\"$b\", 0, 0]\n[[body.part]]\nrepeat = { count = 2, step = [0, 1, 0] }\n");
  EXPECT_EQ(namesOfBodies(scene), (std::vector<std::string>{"post 0", "post 1"}));
  EXPECT_EQ(scene.bodies[2].def.position.x, 3);
  ASSERT_EQ(scene.bodies[2].def.shapes.size(), 2u);
  EXPECT_EQ(scene.bodies[2].def.shapes[1].local.position, (Vec3{0, 1, 0}));
}

constexpr const char* kGroup = R"(
[[group]]
name = "table"
position = [10, 0, 0]
yaw_degrees = 90
let = { high = 2 }
[[group.body]]
name = "leg"
position = [1, "$high", 0]
[[group.body]]
name = "top"
[[group.joint]]
body_a = "leg"
body_b = "top"
anchor = [1, 0, 0]
[[copy]]
of = "table"
position = [0, 0, 20]
let = { high = 3 }
[[copy]]
of = "table/leg"
name = "spare"
position = [7, 7, 7]
material = "steel"
)";

TEST(Expand, GroupsArePlacedAndCopied) {
  const SceneDescription scene = sound(kGroup);
  EXPECT_EQ(namesOfBodies(scene),
            (std::vector<std::string>{"table/leg", "table/top", "table copy/leg", "table copy/top", "spare"}));
  EXPECT_EQ(scene.bodies[1].def.position, (Vec3{10, 2, -1}));
  EXPECT_EQ(scene.bodies[3].def.position, (Vec3{0, 3, 19}));
  EXPECT_EQ(scene.bodies[5].def.position, (Vec3{7, 7, 7}));
  EXPECT_EQ(scene.bodies[5].material, "steel");
  ASSERT_EQ(scene.joints.size(), 2u);
  EXPECT_EQ(scene.joints[1].bodyA, "table copy/leg");
  EXPECT_EQ(scene.joints[0].def.anchor, (Vec3{10, 0, -1}));
}

TEST(Expand, MistakesAreToldOnceAtTheirLine) {
  SceneLoad load = parseScene("[[wall]]\nrepeat = 3\nbricks = \"$i - 9\"\nbond = \"englsh\"\n", "a.toml");
  ASSERT_EQ(load.diagnostics.size(), 2u) << allOf(load.diagnostics);
  EXPECT_EQ(load.diagnostics[0].line, 3);
  EXPECT_EQ(load.diagnostics[0].key, "wall[0] with i = 0.bricks");
  EXPECT_EQ(load.diagnostics[1].line, 4);
  load = parseScene("[[body]]\n[[copy]]\nof = \"bodi\"\n[[group]]\nname = \"g\"\n[[group.wal]]\n", "a.toml");
  ASSERT_EQ(load.diagnostics.size(), 2u) << allOf(load.diagnostics);
  EXPECT_EQ(load.diagnostics[0].line, 3);
  EXPECT_NE(load.diagnostics[1].message.find("did you mean \"wall\""), std::string::npos) << allOf(load.diagnostics);
  const char* wrong[] = {"repeat = { count = 2, grid = [1, 1, 1] }",
                         "repeat = {}",
                         "repeat = -1",
                         "repeat = { count = 2, turn_degrees = 3 }",
                         "repeat = { grid = [10000, 10000, 1] }",
                         "repeat = { count = 1, index = \"1x\" }",
                         "let = 3",
                         "let = { a = \"$b\" }"};
  for (const char* text : wrong)
    EXPECT_FALSE(parseScene(std::string("[[body]]\n") + text + "\n", "a.toml").scene) << text;
}

TEST(Expand, NeitherCopiesOfThemselvesNorMillionsAreMade) {
  EXPECT_FALSE(parseScene("[[group]]\nname = \"g\"\n[[group.copy]]\nof = \"g\"\n", "a.toml").scene);
  std::string many = "[[body]]\nrepeat = 100000\nlet = { a0 = 1";
  for (int k = 1; k < 20; k++) many += ", a" + std::to_string(k) + " = 1";
  many += " }\n";
  EXPECT_FALSE(parseScene(many, "a.toml").scene);
}

TEST(Expand, RandomNumbersFollowFromTheSeedAndTheKey) {
  const std::string text = "[[body]]\nposition = [\"random(1, 3)\", \"random(1, 3)\", 0]\nrepeat = 2\n";
  const SceneDescription a = sound(text), b = sound(text), c = sound(text + "[world]\nseed = 7\n");
  for (int k : {1, 2})
    for (int i : {0, 1}) {
      const double x = a.bodies[std::size_t(k)].def.position[i];
      EXPECT_TRUE(x >= 1 && x < 3) << x;
      EXPECT_EQ(x, b.bodies[std::size_t(k)].def.position[i]);
      EXPECT_NE(x, c.bodies[std::size_t(k)].def.position[i]);
    }
  EXPECT_NE(a.bodies[1].def.position.x, a.bodies[1].def.position.y);
  EXPECT_NE(a.bodies[1].def.position.x, a.bodies[2].def.position.x);
  EXPECT_FALSE(parseScene("[parameters]\ns = \"random(0, 9)\"\n[world]\nseed = \"$s\"\n[[body]]\n", "a.toml").scene);
}

TEST(Expand, IncludedTablesComeFirstAndKeepTheirFile) {
  const std::string folder = testing::TempDir() + "/brickfall_include";
  std::filesystem::create_directories(folder);
  std::ofstream(folder + "/part.toml") << "title = \"part\"\n[world]\nseconds = 3\nseed = 5\n[[wall]]\nname = \"a\"\n";
  std::ofstream(folder + "/bad.toml") << "[[wall]]\n\ncourses = 0\n";
  std::ofstream(folder + "/self.toml") << "include = \"self.toml\"\n[[wall]]\n";
  const std::string main = folder + "/main.toml";
  const SceneLoad load =
      parseScene("include = \"part.toml\"\ntitle = \"main\"\n[world]\nseconds = 4\n[[wall]]\nname = \"b\"\n", main);
  ASSERT_TRUE(load.scene) << allOf(load.diagnostics);
  EXPECT_EQ(load.scene->title, "main");
  EXPECT_EQ(load.scene->seconds, 4);
  EXPECT_EQ(load.scene->seed, 5u);
  ASSERT_EQ(load.scene->walls.size(), 2u);
  EXPECT_EQ(load.scene->walls[0].wall.name, "a");
  const SceneLoad bad = parseScene("include = [\"bad.toml\"]\n", main);
  ASSERT_EQ(bad.diagnostics.size(), 1u);
  EXPECT_TRUE(bad.diagnostics[0].file.ends_with("bad.toml")) << bad.diagnostics[0].file;
  EXPECT_EQ(bad.diagnostics[0].line, 3);
  EXPECT_FALSE(loadSceneFile(folder + "/self.toml").scene);
  EXPECT_FALSE(parseScene("include = \"nowhere.toml\"\n[[wall]]\n", main).scene);
  std::filesystem::remove_all(folder);
}

TEST(Expand, SettingsAddAndRemoveTables) {
  const std::string text = "[[wall]]\nname = \"a\"\n[[wall]]\nname = \"b\"\n[[ball]]\nposition = [0, 1, 2]\n";
  EXPECT_EQ(sound(text, {{"wall[0]", "none"}}).walls[0].wall.name, "b");
  EXPECT_EQ(sound(text, {{"ball", "none"}}).bodies.size(), 1u);
  EXPECT_EQ(sound(text, {{"ball[+]", "{ position = [1, 1, 1] }"}, {"ball[1].radius", "0.3"}}).bodies.size(), 3u);
  EXPECT_EQ(sound(text, {{"body[+].material", "wood"}}).bodies.size(), 3u);
  EXPECT_EQ(sound(text, {{"wall[0].mortar", "none"}}).walls.size(), 2u);
  for (const char* key : {"camera", "wall[7]", "world"})
    EXPECT_FALSE(parseScene(text, "a.toml", {{key, "none"}}).scene) << key;
  EXPECT_FALSE(parseScene(text, "a.toml", {{"include", "x.toml"}}).scene);
}

// The tower as it was written out, wall by wall.
TEST(Expand, TheTowerIsWhatItWas) {
  SceneLoad load = loadSceneFile(findScene("tower"));
  ASSERT_TRUE(load.scene);
  const double pitch = 0.225, thick = 0.1025, high = 17 * 0.065 + 0.12, left = -(5 * pitch + thick) / 2,
               near = 5 * pitch / 2;
  ASSERT_EQ(load.scene->walls.size(), 20u);
  const Vec3 places[] = {{left, 0, near},
                         {left + 5 * pitch + thick / 2, 0, near + thick / 2},
                         {left + 5 * pitch + thick, 0, near - 5 * pitch},
                         {left + thick / 2, 0, near - 5 * pitch - thick / 2}};
  for (std::size_t k = 0; k < 20; k++) {
    const WallDef& wall = load.scene->walls[k].wall;
    EXPECT_NEAR(length(wall.position - (places[k % 4] + Vec3{0, double(k / 4) * high, 0})), 0, 1e-12) << wall.name;
    EXPECT_EQ(wall.yawDegrees, double(k % 4) * 90);
    EXPECT_FALSE(wall.halfBats);
  }
}

TEST(Expand, ATableThatDoesNotExistSaysWhatThereIs) {
  const SceneLoad load = parseScene("[[wall]]\n[[sphere]]\nradius = 1\n[[wals]]\n", "a.toml");
  ASSERT_EQ(load.diagnostics.size(), 2u);
  EXPECT_NE(load.diagnostics[0].message.find("did you mean [[ball]]"), std::string::npos) << allOf(load.diagnostics);
  EXPECT_NE(load.diagnostics[0].message.find("[[dome]]"), std::string::npos);
  EXPECT_NE(load.diagnostics[1].message.find("did you mean [[wall]]"), std::string::npos);
}

}  // namespace
}  // namespace brickfall
