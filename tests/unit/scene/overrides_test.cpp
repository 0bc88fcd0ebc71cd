// --set: what it changes, and what it refuses.
#include "unit/scene/scene_support.h"

namespace brickfall {
namespace {

const char* const kScene = R"(
[parameters]
n = 4
[[wall]]
name = "a"
courses = "$n"
[[wall]]
name = "b"
[[wall.opening]]
from = 0.5
width = 0.5
height = 0.3
[[ball]]
position = [0, 1, 3]
velocity = [0, 0, -5]
)";

TEST(Overrides, ChangeValuesByPath) {
  SceneDescription scene = sound(kScene, {{"world.time_step", "0.00416"},
                                          {"world.seconds", "20"},
                                          {"wall[1].courses", "7"},
                                          {"wall[1].opening[0].width", "0.6"},
                                          {"ball.velocity[2]", "-9"},
                                          {"ball[0].radius", "0.05"},
                                          {"title", "\"My own\""}});
  EXPECT_EQ(scene.timeStep, 0.00416);
  EXPECT_EQ(scene.seconds, 20);
  EXPECT_EQ(scene.walls[1].wall.courses, 7);
  EXPECT_EQ(scene.walls[1].wall.openings[0].width, 0.6);
  EXPECT_EQ(scene.bodies[1].def.linearVelocity, (Vec3{0, 0, -9}));
  EXPECT_EQ(scene.bodies[1].def.shapes[0].radius, 0.05);
  EXPECT_EQ(scene.title, "My own");
}

TEST(Overrides, ChangeParametersByPathOrByNameAlone) {
  EXPECT_EQ(sound(kScene, {{"parameters.n", "9"}}).walls[0].wall.courses, 9);
  EXPECT_EQ(sound(kScene, {{"n", "3 * 4"}}).walls[0].wall.courses, 12);
}

TEST(Overrides, TextsNeedNoQuotes) {
  SceneDescription scene = sound(kScene, {{"wall[0].bond", "english"}, {"ball.material", "rubber"}});
  EXPECT_EQ(scene.walls[0].wall.bond, Bond::english);
  EXPECT_EQ(scene.bodies[1].material, "rubber");
}

TEST(Overrides, LaterOnesWin) { EXPECT_EQ(sound(kScene, {{"n", "5"}, {"n", "6"}}).walls[0].wall.courses, 6); }

TEST(Overrides, ReplaceWholeValues) {
  EXPECT_EQ(sound(kScene, {{"ball.velocity", "[1, 2, 3]"}}).bodies[1].def.linearVelocity, (Vec3{1, 2, 3}));
  EXPECT_EQ(sound(kScene, {{"world", "{ seconds = 3 }"}}).seconds, 3);
}

struct Refusal {
  const char* key;
  const char* value;
  const char* part;
};

TEST(Overrides, MistakesAreNamed) {
  const Refusal refusals[] = {
      {"world.secnds", "3",
       "--set: error: world.secnds: found an unknown key \"secnds\", expected a key of [world] (did you mean "
       "\"seconds\"?)"},
      {"wrld.seconds", "3", "(did you mean \"world\"?)"},
      {"wall.courses", "3", "the scene has 2 of \"wall\", expected an index: wall[0] .. wall[1]"},
      {"wall[2].courses", "3", "found index [2] of \"wall\", expected [0] .. [1]"},
      {"body[0].size", "[1, 1, 1]", "the scene has no \"body\""},
      {"parameters.m", "3", "found an unknown parameter \"m\", expected a parameter of [parameters]"},
      {"m", "3", "found an unknown key \"m\""},
      {"launch_time", "3", "(\"launch_time\" is a key of [[body]])"},
      {"world.seconds", "x", "world.seconds: found the text \"x\", expected a number"},
      {"world.seconds", "nan", "found nan, expected a number 0.001 .. 86400 s"},
      {"world.seconds", "-inf", "found -inf"},
      {"world.seconds", "", "found no value"},
      {"world.seconds[0]", "3", "expected a path to what it has"},
      {"ball.velocity[3]", "3", "found index [3] of \"velocity\", expected [0] .. [2]"},
      {"ball.radius[0].x", "3", "expected a path to what it has"},
      {"ball.velocity.x", "3", "found an array of 3 at \"velocity\", expected a table"},
      {"", "3", "found a malformed path"},
      {"world..seconds", "3", "found a malformed path"},
      {"wall[x].courses", "3", "found a malformed path"},
      {"wall[0.courses", "3", "found a malformed path"},
      {"wall[99999999999999999999].courses", "3", "found a malformed path"},
      {"n", "0", "wall[0].courses: found the text \"$n\" = 0, expected a whole number 1 .. 10000"},
      {"wall[0].courses", "1\nseed = 3", "expected a whole number"},
  };
  for (const Refusal& refusal : refusals) {
    std::string text = faults(kScene, {{refusal.key, refusal.value}});
    EXPECT_TRUE(has(text, refusal.part)) << refusal.key << "=" << refusal.value << "\n" << text;
  }
}

TEST(Overrides, AllMistakesAtOnce) {
  SceneLoad load = parseScene(kScene, "test.toml", {{"a.b", "1"}, {"wall[0].courses", "0"}, {"world.seed", "-1"}});
  EXPECT_EQ(load.diagnostics.size(), 3u) << allOf(load.diagnostics);
  for (const Diagnostic& diagnostic : load.diagnostics) {
    EXPECT_EQ(diagnostic.file, "--set");
    EXPECT_EQ(diagnostic.line, 0);
  }
}

}  // namespace
}  // namespace brickfall
