// What a scene file says is what the description holds; mistakes come all at once, in order, each at its place.
#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>

#include "scene/node.h"
#include "unit/scene/scene_support.h"

namespace brickfall {
namespace {

TEST(ParseScene, AFileOfOneWallTakesAllDefaults) {
  SceneDescription scene = sound("[[wall]]\n");
  WallDef def;
  ASSERT_EQ(scene.walls.size(), 1u);
  EXPECT_EQ(scene.name, "test");
  EXPECT_EQ(scene.walls[0].wall.name, "wall1");
  EXPECT_EQ(scene.walls[0].wall.courses, def.courses);
  EXPECT_EQ(scene.walls[0].wall.brick.size, def.brick.size);
  EXPECT_EQ(scene.walls[0].material, "brick");
  EXPECT_EQ(scene.world.gravity, (Vec3{0, -9.81, 0}));
  EXPECT_EQ(scene.timeStep, 1.0 / 60);
  ASSERT_EQ(scene.bodies.size(), 1u);
  EXPECT_EQ(scene.bodies[0].role, BodyRole::ground);
  EXPECT_EQ(scene.bodies[0].def.shapes[0].type, ShapeType::plane);
  ASSERT_EQ(scene.cameras.size(), 1u);  // made up, looking at the wall
  EXPECT_NEAR(scene.cameras[0].target.x, 1.075, 1e-9);
}

// Half of the largest angle, over that of the picture's edge, in which a camera sees the corners of a wall of 2.15 x 0.65 m.
double shareOfPicture(const Camera& camera, const Vec3& left) {
  const Vec3 ahead = normalized(camera.target - camera.position), right = normalized(cross(ahead, {0, 1, 0}));
  const Vec3 up = cross(right, ahead);
  double most = 0;
  for (int corner = 0; corner < 4; corner++) {
    const Vec3 at = left + Vec3{corner & 1 ? 2.15 : 0, corner & 2 ? 0.65 : 0, 0} - camera.position;
    const double edge = (std::sqrt(2.0) - 1) * dot(at, ahead);
    most = std::max({most, std::fabs(dot(at, right)) / (1.6 * edge), std::fabs(dot(at, up)) / edge});
  }
  return most;
}

TEST(ParseScene, ACameraThatNobodySetFillsThePicture) {
  const char* const wall = "[[wall]]\ncourses = 10\nbricks = 10\n";
  const Camera alone = sound(wall).cameras[0];
  EXPECT_GT(shareOfPicture(alone, {}), 0.6);
  EXPECT_LT(shareOfPicture(alone, {}), 0.75);
  // A ball far off makes it no smaller, and is seen from its side.
  const Camera thrown =
      sound(wall + std::string("[[ball]]\nposition = [1, 1, -30]\nvelocity = [0, 0, 9]\n")).cameras[0];
  EXPECT_GT(shareOfPicture(thrown, {}), 0.6);
  EXPECT_LT(thrown.position.z, -1);
}

TEST(ParseScene, World) {
  SceneDescription scene = sound(R"(
title = "T"
description = "D"
[world]
gravity = [1, -2, 3]
seconds = 2.5
time_step = 0.005
substeps = 4
seed = 77
frames_per_second = 30
sleep = false
sleep_delay = 2
air_density = 1
hit_event_speed = 3
hit_event_impulse = 4
[solver]
resting_stiffness = 2000
impact_stiffness = 40
min_cycles = 5
max_cycles = 9
[[wall]]
)");
  EXPECT_EQ(scene.title, "T");
  EXPECT_EQ(scene.description, "D");
  EXPECT_EQ(scene.world.gravity, (Vec3{1, -2, 3}));
  EXPECT_EQ(scene.seconds, 2.5);
  EXPECT_EQ(scene.timeStep, 0.005);
  EXPECT_EQ(scene.substeps, 4);
  EXPECT_EQ(scene.seed, 77u);
  EXPECT_EQ(scene.framesPerSecond, 30);
  EXPECT_FALSE(scene.world.enableSleep);
  EXPECT_EQ(scene.world.sleepDelay, 2);
  EXPECT_EQ(scene.world.airDensity, 1);
  EXPECT_EQ(scene.world.hitEventSpeed, 3);
  EXPECT_EQ(scene.world.hitEventImpulse, 4);
  EXPECT_EQ(scene.world.solver.restingStiffness, 2000);
  EXPECT_EQ(scene.world.solver.impactStiffness, 40);
  EXPECT_EQ(scene.world.solver.minCycles, 5);
  EXPECT_EQ(scene.world.solver.maxCycles, 9);
}

TEST(ParseScene, AnOldNameOfAKeyIsReadWithAWarning) {
  const SceneLoad load = parseScene("[solver]\nmax_cycles_small = 40\n[[wall]]\n", "test.toml");
  ASSERT_TRUE(load.scene);
  EXPECT_EQ(load.scene->world.solver.maxCyclesSmall, 40);
  EXPECT_TRUE(has(allOf(load.diagnostics), "test.toml:2:")) << allOf(load.diagnostics);
  EXPECT_TRUE(
      has(allOf(load.diagnostics), "warning: solver.max_cycles_small: found an old name, expected max_cycles_alone"));
  const SceneLoad now = parseScene("[solver]\nmax_cycles_alone = 41\n[[wall]]\n", "test.toml");
  ASSERT_TRUE(now.scene);
  EXPECT_EQ(now.scene->world.solver.maxCyclesSmall, 41);
  EXPECT_TRUE(now.diagnostics.empty()) << allOf(now.diagnostics);
}

TEST(ParseScene, AKeyThatNoTableIsAroundNamesThoseThatThereAre) {
  const std::string told = faults("name = \"church\"\n[[wall]]\n");
  EXPECT_TRUE(
      has(told, "test.toml:1:1: error: name: found an unknown key, expected title, description, include or a table"))
      << told;
}

TEST(ParseScene, Wall) {
  SceneDescription scene = sound(R"(
[[material]]
name = "soft"
density = 1500
friction_rule = "minimum"
colour = "#10aBfF"
[[wall]]
name = "garden"
bond = "flemish"
courses = 12
bricks = 20
brick = "as3700"
half_bats = false
head_joint = 0.01
bed_joint = 0.002
position = [1, 2, 3]
yaw_degrees = 37
material = "soft"
lintel_material = "steel"
density_scatter = 0.05
disorder = 1e-4
shuffle = true
[[wall.opening]]
from = 1
sill = 0.3
width = 0.5
height = 0.2
lintel_bearing = 0.25
lintel_height = 0.1
[[wall]]
bond_shift = 0.25
brick = [0.4, 0.2, 0.15]
)");
  ASSERT_EQ(scene.walls.size(), 2u);
  const SceneWall& wall = scene.walls[0];
  EXPECT_EQ(wall.wall.name, "garden");
  EXPECT_EQ(wall.wall.bond, Bond::flemish);
  EXPECT_EQ(wall.wall.courses, 12);
  EXPECT_EQ(wall.wall.bricksPerCourse, 20);
  EXPECT_EQ(wall.wall.brick.size, (Vec3{0.230, 0.076, 0.110}));
  EXPECT_FALSE(wall.wall.halfBats);
  EXPECT_EQ(wall.wall.headJoint, 0.01);
  EXPECT_EQ(wall.wall.bedJoint, 0.002);
  EXPECT_EQ(wall.wall.position, (Vec3{1, 2, 3}));
  EXPECT_EQ(wall.wall.yawDegrees, 37);
  EXPECT_EQ(wall.material, "soft");
  EXPECT_EQ(wall.lintelMaterial, "steel");
  EXPECT_EQ(wall.densityScatter, 0.05);
  EXPECT_EQ(wall.wall.disorder, 1e-4);
  EXPECT_TRUE(wall.wall.shuffle);
  ASSERT_EQ(wall.wall.openings.size(), 1u);
  const Opening& opening = wall.wall.openings[0];
  EXPECT_EQ(opening.from, 1);
  EXPECT_EQ(opening.sill, 0.3);
  EXPECT_EQ(opening.width, 0.5);
  EXPECT_EQ(opening.height, 0.2);
  EXPECT_EQ(opening.lintelBearing, 0.25);
  EXPECT_EQ(opening.lintelHeight, 0.1);
  EXPECT_EQ(scene.walls[1].wall.name, "wall2");
  EXPECT_EQ(scene.walls[1].wall.bondShift, 0.25);
  EXPECT_EQ(scene.walls[1].wall.brick.size, (Vec3{0.4, 0.2, 0.15}));
  const MaterialDef& soft = scene.materials.back();
  EXPECT_EQ(soft.name, "soft");
  EXPECT_EQ(soft.material.density, 1500);
  EXPECT_EQ(soft.material.friction, 0.6);
  EXPECT_EQ(soft.material.frictionRule, CombineRule::minimum);
  EXPECT_EQ(soft.colour, 0x10ABFFu);
}

TEST(ParseScene, BodiesAndBalls) {
  SceneDescription scene = sound(R"(
ground = { enabled = false }
[[body]]
name = "post"
type = "kinematic"
shape = "capsule"
radius = 0.2
height = 1.5
position = [1, 2, 3]
rotation_degrees = [0, 0, 90]
angular_velocity = [0, 1, 0]
surface_velocity = [0, 0.5, 0]
[[body]]
shape = "hull"
vertices = [[0,0,0],[1,0,0],[0,1,0],[0,0,1]]
gravity_scale = 0.5
linear_damping = 0.1
angular_damping = 0.2
drag_area = 0.3
allow_sleep = false
[[body]]
name = "hammer"
material = "wood"
[[body.part]]
size = [0.1, 1, 0.1]
[[body.part]]
shape = "sphere"
radius = 0.2
material = "steel"
position = [0, 0.5, 0]
[[ball]]
radius = 0.3
density = 5000
rolling_resistance = 0.02
position = [0, 1, 2]
velocity = [0, 0, -5]
launch_time = 1.5
)");
  ASSERT_EQ(scene.bodies.size(), 4u);
  const SceneBody& post = scene.bodies[0];
  EXPECT_EQ(post.def.type, BodyType::kinematic);
  EXPECT_EQ(post.def.shapes[0].type, ShapeType::capsule);
  EXPECT_EQ(post.def.shapes[0].radius, 0.2);
  EXPECT_EQ(post.def.shapes[0].halfHeight, 0.75);
  Vec3 up = rotate(post.def.rotation, Vec3{0, 1, 0});
  EXPECT_NEAR(up.x, -1, 1e-15);
  EXPECT_EQ(post.def.angularVelocity, (Vec3{0, 1, 0}));
  EXPECT_EQ(post.def.surfaceVelocity, (Vec3{0, 0.5, 0}));
  const BodyDef& hull = scene.bodies[1].def;
  EXPECT_EQ(hull.shapes[0].vertices.size(), 4u);
  EXPECT_EQ(hull.gravityScale, 0.5);
  EXPECT_EQ(hull.linearDamping, 0.1);
  EXPECT_EQ(hull.angularDamping, 0.2);
  EXPECT_EQ(hull.dragArea, 0.3);
  EXPECT_FALSE(hull.allowSleep);
  const SceneBody& hammer = scene.bodies[2];
  ASSERT_EQ(hammer.def.shapes.size(), 2u);
  EXPECT_EQ(hammer.def.shapes[0].halfExtents, (Vec3{0.05, 0.5, 0.05}));
  EXPECT_EQ(hammer.shapeMaterials, (std::vector<std::string>{"wood", "steel"}));
  const SceneBody& ball = scene.bodies[3];
  EXPECT_EQ(ball.role, BodyRole::ball);
  EXPECT_EQ(ball.launchTime, 1.5);
  EXPECT_EQ(ball.def.linearVelocity, (Vec3{0, 0, -5}));
  EXPECT_EQ(scene.materials.back().name, ball.material);
  EXPECT_EQ(scene.materials.back().material.density, 5000);
  EXPECT_EQ(scene.materials.back().material.rollingResistance, 0.02);
  EXPECT_EQ(scene.materials.back().material.friction, 0.5);  // of steel
}

TEST(ParseScene, ADomeHasItsRingsAndItsKeystone) {
  SceneDescription scene = sound(R"(
[[dome]]
name = "dome"
rings = 3
stones = 6
radius = 2
thickness = 0.2
drum_rings = 2
drum_height = 1
position = [1, 0, 0]
[[dome]]
oculus_degrees = 30
yaw_degrees = 15
position = [9, 0, 0]
)");
  ASSERT_EQ(scene.bodies.size(), std::size_t(1 + 5 * 6 + 1 + 8 * 16));
  EXPECT_EQ(scene.bodies[1].name, "dome/drum/0/0");
  EXPECT_NEAR(scene.bodies[1].def.position.y, 0.25, 1e-12);
  EXPECT_EQ(scene.bodies[13].name, "dome/0/0");
  const SceneBody& key = scene.bodies[31];
  EXPECT_EQ(key.name, "dome/key");
  EXPECT_EQ(key.def.shapes[0].vertices.size(), 12u);
  EXPECT_NEAR(key.def.position.x, 1, 1e-12);
  EXPECT_NEAR(key.def.position.y, 1 + 2 * std::cos(3.14159265358979 / 14), 1e-9);
  EXPECT_TRUE(checkScene(scene).empty()) << allOf(checkScene(scene));
}

TEST(ParseScene, RotationTurnsAboutXThenYThenZ) {
  SceneDescription scene = sound("[[body]]\nrotation_degrees = [90, 90, 0]\n");
  Vec3 turned = rotate(scene.bodies[1].def.rotation, Vec3{0, 1, 0});  // y -> z by x, z -> x by y
  EXPECT_NEAR(turned.x, 1, 1e-15);
  EXPECT_NEAR(turned.y, 0, 1e-15);
}

TEST(ParseScene, GroundBoxHasItsTopAtItsHeightAndTiltsAboutTheOrigin) {
  SceneDescription level = sound("ground = { type = \"box\", height = 2, size = [10, 4, 10] }\n[[wall]]\n");
  EXPECT_EQ(level.bodies[0].def.position, (Vec3{0, 0, 0}));
  SceneDescription tilted = sound("ground = { tilt_degrees = 30 }\n[[wall]]\n");
  Vec3 normal = rotate(tilted.bodies[0].def.rotation, Vec3{0, 1, 0});
  EXPECT_NEAR(normal.x, -0.5, 1e-15);
  EXPECT_NEAR(normal.y, std::sqrt(0.75), 1e-15);
}

TEST(ParseScene, Arrays) {
  SceneDescription scene = sound(R"(
[[array]]
name = "cube"
arrangement = "pyramid"
base = 3
size = [0.5, 0.5, 0.5]
[[array]]
name = "pile"
count = [2, 3, 4]
size = [0.4, 0.4, 0.4]
size_min = [0.1, 0.1, 0.1]
spacing = [0.5, 0.6, 0.7]
position = [0, 10, 0]
[[array]]
name = "marble"
shape = "sphere"
radius = 0.1
count = [1, 2, 1]
velocity = [1, 0, 0]
)");
  ASSERT_EQ(scene.bodies.size(), 1u + 6 + 24 + 2);
  EXPECT_EQ(scene.bodies[1].name, "cube/0");
  EXPECT_EQ(scene.bodies[1].def.position, (Vec3{-0.5, 0.25, 0}));
  EXPECT_EQ(scene.bodies[4].def.position, (Vec3{-0.25, 0.75, 0}));
  EXPECT_EQ(scene.bodies[6].def.position, (Vec3{0, 1.25, 0}));
  double smallest = 1, largest = 0;
  for (std::size_t i = 7; i < 31; i++)
    for (int axis = 0; axis < 3; axis++) {
      double side = 2 * scene.bodies[i].def.shapes[0].halfExtents[axis];
      smallest = std::min(smallest, side);
      largest = std::max(largest, side);
    }
  EXPECT_GE(smallest, 0.1);
  EXPECT_LE(largest, 0.4);
  EXPECT_GT(largest - smallest, 0.2);
  EXPECT_LT(length(scene.bodies[7].def.position - Vec3{-0.25, 10.2, -1.05}), 1e-12);
  EXPECT_EQ(scene.bodies[32].def.position.y, 0.1 + 0.2);
  EXPECT_EQ(scene.bodies[32].def.linearVelocity, (Vec3{1, 0, 0}));
}

TEST(ParseScene, ParametersInAnyOrderAndInEveryNumber) {
  SceneDescription scene = sound(R"(
[parameters]
length = "$bricks * 0.215"
bricks = "2 * $half"
half = 6
[world]
seconds = "$half"
[[wall]]
bricks = "$bricks"
position = ["-$length / 2", 0, "1 / 4"]
)");
  EXPECT_EQ(scene.walls[0].wall.bricksPerCourse, 12);
  EXPECT_DOUBLE_EQ(scene.walls[0].wall.position.x, -1.29);
  EXPECT_EQ(scene.walls[0].wall.position.z, 0.25);
  EXPECT_EQ(scene.seconds, 6);
}

TEST(ParseScene, AnExpressionForAWholeNumberMustBeWhole) {
  EXPECT_EQ(sound("[[wall]]\ncourses = \"3 * (1 / 3) * 7\"\n").walls[0].wall.courses, 7);
  EXPECT_TRUE(
      has(faults("[[wall]]\ncourses = \"7 / 2\"\n"), "found the text \"7 / 2\" = 3.5, expected a whole number"));
}

TEST(ParseScene, AllMistakesAtOnceInTheOrderOfTheFile) {
  std::string text = faults(R"([world]
secnds = 3
gravity = "down"
[[wall]]
courses = 0
material = "brik"
[[ball]]
velocity = [1, 2]
)");
  EXPECT_EQ(
      text,
      "test.toml:2:1: error: world.secnds: found an unknown key, expected a key of [world] (did you mean "
      "\"seconds\"?)\n"
      "test.toml:3:11: error: world.gravity: found the text \"down\", expected a number or three numbers [x, "
      "y, z], each -1000 .. 1000 m/s2\n"
      "test.toml:5:11: error: wall[0].courses: found 0, expected a whole number 1 .. 10000\n"
      "test.toml:6:12: error: wall[0].material: found the text \"brik\", expected the name of a material (did you "
      "mean \"brick\"?)\n"
      "test.toml:7:1: error: ball[0].position: not given, expected three numbers [x, y, z], each -100000 .. 100000 "
      "m\n"
      "test.toml:8:12: error: ball[0].velocity: found an array of 2, expected three numbers [x, y, z], each -10000 "
      ".. 10000 m/s\n");
}

TEST(ParseScene, SyntaxErrorsDoNotHideTheOthers) {
  std::string text = faults("[world]\nseconds = = 3\nsubsteps = 0\n[[wall]]\ncourses = ten\n");
  EXPECT_TRUE(has(text, "test.toml:2:")) << text;
  EXPECT_TRUE(has(text, "test.toml:3:12: error: world.substeps: found 0")) << text;
  EXPECT_TRUE(has(text, "test.toml:5:")) << text;
}

TEST(ParseScene, FilesThatAreNone) {
  auto problem = [](const std::string& path) { return allOf(loadSceneFile(path).diagnostics); };
  EXPECT_EQ(problem("no/such/file.toml"), "no/such/file.toml: error: there is no such file, expected a scene file\n");
  EXPECT_TRUE(has(problem(testing::TempDir()), "found a folder"));
  std::string path = testing::TempDir() + "brickfall_empty_scene.toml";
  std::ofstream(path).close();
  EXPECT_TRUE(has(problem(path), "found an empty file"));
  std::ofstream(path) << "[[wall]]\n";
  EXPECT_TRUE(loadSceneFile(path).scene.has_value());
  std::filesystem::resize_file(path, 17u << 20);
  EXPECT_TRUE(has(problem(path), "over 16 MiB"));
  std::filesystem::remove(path);
}

TEST(ParseScene, EveryPrefixOfASceneIsAnswered) {
  std::ifstream file(std::string(BRICKFALL_SOURCE_DIR) + "/scenes/house.toml");
  std::string text((std::istreambuf_iterator<char>(file)), std::istreambuf_iterator<char>());
  ASSERT_GT(text.size(), 1000u);
  for (std::size_t length = 0; length < text.size(); length++) {
    SceneLoad load = parseScene(std::string_view(text).substr(0, length), "prefix.toml");
    EXPECT_NE(load.scene.has_value(), load.diagnostics.size() > 0) << length;
  }
}

TEST(ParseScene, BytesThatAreNoText) {
  std::string bytes;
  for (int i = 0; i < 4096; i++) bytes += char((i * 2654435761u) >> 13);
  EXPECT_TRUE(has(faults(bytes), "not TOML"));
  EXPECT_TRUE(has(faults("title = \"\xff\xfe\"\n"), "not TOML"));
}

TEST(SceneDiagnostics, NumbersReadWell) {
  EXPECT_EQ(scene::numberText(0.1), "0.1");
  EXPECT_EQ(scene::numberText(100000), "100000");
  EXPECT_EQ(scene::numberText(-0.00416), "-0.00416");
  EXPECT_EQ(scene::numberText(1e300), "1e+300");
}

}  // namespace
}  // namespace brickfall
