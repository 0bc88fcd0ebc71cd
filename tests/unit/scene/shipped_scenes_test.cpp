// The scenes that come with Brickfall: all sound, found by name, and built as their descriptions say.
#include <algorithm>
#include <cstdlib>

#include "unit/scene/scene_support.h"

namespace brickfall {
namespace {

SceneDescription shipped(const std::string& name, const Overrides& overrides = {}) {
  SceneLoad load = loadSceneFile(findScene(name), overrides);
  EXPECT_TRUE(load.scene.has_value()) << name << "\n" << allOf(load.diagnostics);
  return load.scene.value_or(SceneDescription{});
}

std::vector<BrickPlacement> bricksOf(const SceneDescription& scene) {
  std::vector<BrickPlacement> all;
  for (const SceneWall& wall : scene.walls) {
    auto bricks = layBricks(wall.wall, scene.seed);
    EXPECT_TRUE(bricks.ok()) << bricks.error().message;
    if (bricks) all.insert(all.end(), bricks->begin(), bricks->end());
  }
  return all;
}

TEST(ShippedScenes, AreAllSoundTitledAndFoundByName) {
  std::vector<ShippedScene> scenes = shippedScenes();
  std::vector<std::string> wanted = {
      "arch",          "blast",         "bridge",          "cradle",      "dome",      "dominoes",    "pendulum-wall",
      "wrecking-ball", "shake-table",   "tilt-table",      "cube",        "hole",      "house",       "mass_ratio",
      "pile",          "pyramid",       "tower",           "wall",        "wall_hit",  "wall_stand",  "wall_stand_tall",
      "mortar-wall",   "wall-hits",     "mortar-strength", "garden-wall", "house-hit", "garden-gate", "round-tower",
      "roof",          "domino-spiral", "arch-load",       "column-crush"};
  for (const std::string& name : wanted)
    EXPECT_TRUE(std::any_of(scenes.begin(), scenes.end(), [&](auto& scene) { return scene.name == name; })) << name;
  for (const ShippedScene& scene : scenes) {
    EXPECT_FALSE(scene.title.empty()) << scene.name;
    EXPECT_EQ(findScene(scene.name), scene.path);
    EXPECT_EQ(findScene(scene.path), scene.path);
    EXPECT_FALSE(shipped(scene.name).cameras.empty());
  }
  std::string message = unknownSceneMessage("piramid", "a scene file");
  EXPECT_TRUE(
      message.starts_with("scene: found \"piramid\", expected a scene file or one of: arch, arch-load, blast, bridge, "
                          "column, column-crush, cradle, cube, "))
      << message;
  EXPECT_TRUE(message.ends_with("(did you mean \"pyramid\"?)")) << message;
  EXPECT_EQ(findScene("no such scene"), "");
  EXPECT_EQ(findScene(""), "");
  EXPECT_EQ(findScene("../scenes/wall"), "");
}

TEST(ShippedScenes, HaveTheSizesTheyAreKnownFor) {
  EXPECT_EQ(bricksOf(shipped("wall")).size(), 105u);  // 100 bricks, ten of them as half bats
  double volume = 0;
  for (const BrickPlacement& brick : bricksOf(shipped("wall"))) volume += brick.size.x * brick.size.y * brick.size.z;
  EXPECT_NEAR(volume, 100 * 0.215 * 0.065 * 0.1025, 1e-12);
  EXPECT_EQ(bricksOf(shipped("wall_stand")).size(), 100u);
  EXPECT_EQ(bricksOf(shipped("wall_stand_tall")).size(), 1000u);
  EXPECT_EQ(bricksOf(shipped("hole")).size(), 1020u);
  EXPECT_EQ(shipped("pyramid").bodies.size(), 1u + 5050);
  EXPECT_EQ(shipped("pile").bodies.size(), 1u + 4 + 8000);
  EXPECT_EQ(shipped("mass_ratio").bodies.size(), 1u + 11);
}

TEST(ShippedScenes, WallHitTakesItsSizeAsAParameter) {
  SceneDescription small = shipped("wall_hit"), large = shipped("wall_hit", {{"n", "10000"}});
  EXPECT_EQ(bricksOf(small).size(), 1000u);
  EXPECT_EQ(small.walls[0].wall.courses, 20);
  EXPECT_EQ(bricksOf(large).size(), 10000u);
  EXPECT_EQ(large.walls[0].wall.courses, 50);
  EXPECT_EQ(large.walls[0].wall.bricksPerCourse, 200);
  const SceneBody& ball = small.bodies.back();
  EXPECT_EQ(ball.def.shapes[0].radius, 0.5);
  EXPECT_EQ(ball.def.position, (Vec3{0, 0.65, 3}));
  EXPECT_EQ(ball.def.linearVelocity, (Vec3{0, 0, -20}));
}

TEST(ShippedScenes, BenchScenesAreAsTheirTableSays) {
  for (const char* name : {"wall_stand", "wall_stand_tall", "wall_hit", "pyramid", "pile", "mass_ratio"}) {
    SceneDescription scene = shipped(name);
    EXPECT_FALSE(scene.world.enableSleep) << name;
    EXPECT_EQ(scene.timeStep, 1.0 / 60) << name;
    EXPECT_EQ(scene.bodies[0].def.shapes[0].type, ShapeType::box) << name;
    auto used = [&](const std::string& material) {
      for (const SceneWall& wall : scene.walls)
        if (wall.material == material) return true;
      return std::any_of(scene.bodies.begin(), scene.bodies.end(),
                         [&](auto& body) { return body.material == material; });
    };
    for (const MaterialDef& material : scene.materials) {
      if (!used(material.name)) continue;
      EXPECT_EQ(material.material.friction, 0.6) << name << " " << material.name;
      EXPECT_EQ(material.material.restitution, 0) << name << " " << material.name;
    }
  }
}

TEST(ShippedScenes, HouseInterlocksWithoutOverlaps) {
  std::vector<BrickPlacement> bricks = bricksOf(shipped("house"));
  std::vector<Aabb> boxes;
  for (const BrickPlacement& brick : bricks) {
    Mat3 r = toMatrix(brick.rotation);  // turned by quarters only
    Vec3 half;
    for (int i = 0; i < 3; i++) half[i] = 0.5 * dot(abs(r.row[i]), brick.size);
    boxes.push_back({brick.centre - half, brick.centre + half});
  }
  int lintels = 0, tipping = 0;
  for (std::size_t a = 0; a < boxes.size(); a++) {
    lintels += bricks[a].lintel;
    double support[4] = {1e9, -1e9, 1e9, -1e9};
    for (std::size_t b = 0; b < boxes.size(); b++) {
      Aabb shrunk = grown(boxes[b], -1e-9);
      if (a != b) {
        EXPECT_FALSE(overlaps(boxes[a], shrunk)) << bricks[a].name << " " << bricks[b].name;
      }
      bool below = std::fabs(boxes[b].upper.y - boxes[a].lower.y) < 1e-9;
      if (!below || !overlaps(grown(boxes[a], 1e-6), shrunk)) continue;
      support[0] = std::min(support[0], std::max(boxes[a].lower.x, boxes[b].lower.x));
      support[1] = std::max(support[1], std::min(boxes[a].upper.x, boxes[b].upper.x));
      support[2] = std::min(support[2], std::max(boxes[a].lower.z, boxes[b].lower.z));
      support[3] = std::max(support[3], std::min(boxes[a].upper.z, boxes[b].upper.z));
    }
    Vec3 c = bricks[a].centre;
    bool carried = support[0] < c.x && c.x < support[1] && support[2] < c.z && c.z < support[3];
    if (boxes[a].lower.y > 1e-9 && !carried) tipping++;
  }
  EXPECT_EQ(lintels, 3);
  EXPECT_EQ(tipping, 0);
}

}  // namespace
}  // namespace brickfall
