// Mortar in scene files: kinds, walls, feet, corners, arches, bodies by name; and what a file can get wrong.
#include <cmath>
#include <map>
#include <set>

#include "masonry/scatter.h"
#include "scene/mortar_run.h"
#include "unit/scene/scene_support.h"

namespace brickfall {
namespace {

SceneRun mortaredRun(const std::string& text) {
  Result<SceneRun> run = SceneRun::create(sound(text));
  EXPECT_TRUE(run.ok()) << (run.ok() ? "" : run.error().message);
  return std::move(run).value();
}

std::string refusal(const std::string& text) {
  Result<SceneRun> run = SceneRun::create(sound(text));
  EXPECT_FALSE(run.ok());
  return run.ok() ? "" : run.error().message;
}

TEST(MortarScene, WallsAreDryUnlessToldOtherwise) {
  EXPECT_FALSE(sound("[[wall]]\n").walls[0].mortar.has_value());
  EXPECT_FALSE(sound("[[wall]]\nmortar = \"none\"\n").walls[0].mortar.has_value());
  EXPECT_TRUE(mortaredRun("[[wall]]\n").mortars().empty());
}

TEST(MortarScene, KindsAreChangedKeyByKey) {
  const SceneDescription scene = sound(
      "[[mortar_kind]]\nname = \"lime\"\nscatter = 0.3\n[[mortar_kind]]\nname = \"mine\"\ntension = 1e5\n"
      "head_filling = 0.5\n[[wall]]\nmortar = \"lime\"\nfoot = true\n[[wall]]\nmortar = \"mine\"\nposition = [0, 0, "
      "3]\n"
      "[[wall]]\nposition = [0, 0, 6]\n[wall.mortar]\nkind = \"lime\"\ncohesion = 123456\n");
  const MortarKind &lime = *scene.walls[0].mortar, &mine = *scene.walls[1].mortar, &own = *scene.walls[2].mortar;
  EXPECT_EQ(lime.strength.tension, 0.05e6);
  EXPECT_EQ(lime.scatter, 0.3);
  EXPECT_TRUE(scene.walls[0].foot);
  EXPECT_EQ(mine.strength.tension, 1e5);
  EXPECT_EQ(mine.strength.cohesion, 0.35e6);
  EXPECT_EQ(mine.headFilling, 0.5);
  EXPECT_EQ(own.strength.cohesion, 123456);
  EXPECT_EQ(own.strength.tension, 0.05e6);
  EXPECT_EQ(own.scatter, 0.3);
}

TEST(MortarScene, ANameCanBeSetFromOutside) {
  EXPECT_EQ(sound("[[wall]]\n", {{"wall.mortar", "lime"}}).walls[0].mortar->strength.tension, 0.05e6);
  EXPECT_EQ(sound("[[wall]]\n", {{"wall.mortar.tension", "2e5"}}).walls[0].mortar->strength.tension, 2e5);
}

TEST(MortarScene, BricksGrowIntoTheirJointsAndWeighWhatBrickAndMortarDo) {
  SceneRun run = mortaredRun(
      "[[wall]]\ncourses = 6\nbricks = 5\nhead_joint = 0.01\nbed_joint = 0.01\nmortar = {density = 1700}\n");
  EXPECT_EQ(run.mortars().size(), 3u * 4 + 3u * 5 + 5u * 10);
  double mass = 0, bricks = 0;
  for (const PlacedBody& body : run.bodies())
    if (body.role == BodyRole::brick) mass += run.world().state(body.id)->mass;
  WallDef wall = run.scene().walls[0].wall;
  for (const BrickPlacement& brick : *layBricks(wall, 1)) bricks += brick.size.x * brick.size.y * brick.size.z;
  const double all = wallLength(wall) * (6 * 0.075 - 0.01) * 0.1025;
  EXPECT_NEAR(mass, 1900 * bricks + 1700 * (all - bricks), 1e-9 * mass);
  EXPECT_TRUE(checkScene(run.scene()).empty());
}

TEST(MortarScene, BricksAreDrawnAsTheyAreLaid) {
  const SceneRun run =
      mortaredRun("[[wall]]\ncourses = 3\nbricks = 4\nhead_joint = 0.01\nbed_joint = 0.01\nmortar = \"lime\"\n");
  for (const PlacedBody& body : run.bodies()) {
    const DrawnBody* drawn = run.drawn(body.id);
    ASSERT_EQ(drawn != nullptr, body.role == BodyRole::brick);
    if (!drawn) continue;
    EXPECT_EQ(drawn->materials.size(), drawn->shapes.size());
    EXPECT_EQ(drawn->materials[0], "brick");
    EXPECT_NEAR(drawn->shapes[0].halfExtents.y, 0.0325, 1e-12);
    EXPECT_LE(drawn->shapes.size(), 3u);
    for (std::size_t k = 1; k < drawn->shapes.size(); k++) EXPECT_EQ(drawn->materials[k], "mortar");
    const Aabb inside = grown(bounds(body.def.shapes[0], Transform{}), 0.00501);
    for (const ShapeDef& shape : drawn->shapes) EXPECT_TRUE(contains(inside, bounds(shape, Transform{})));
  }
}

double areaOfMortar(const SceneRun& run) {
  double area = 0;
  for (MortarId id : run.mortars()) area += run.world().state(id)->area;
  return area;
}

TEST(MortarScene, TheFootStandsOnGroundsAndTables) {
  const std::string wall = "[[wall]]\ncourses = 2\nbricks = 4\nmortar = \"cement\"\n";
  const double dry = areaOfMortar(mortaredRun(wall)), face = 4 * 0.215 * 0.1025;
  const std::size_t joints = mortaredRun(wall).mortars().size();
  SceneRun onGround = mortaredRun(wall + "foot = true\n");
  EXPECT_EQ(onGround.mortars().size(), joints + 4);
  EXPECT_NEAR(areaOfMortar(onGround), dry + face, 1e-8);
  // Turned, on a slab as wide as two and a half bricks, which stands on nothing that counts.
  SceneRun onSlab = mortaredRun(
      "[[body]]\nname = \"slab\"\ntype = \"fixed\"\nsize = [0.5375, 0.1, 0.4]\n"
      "position = [0.26875, 0.5, 0]\n" +
      wall + "foot = true\nposition = [0, 0.55, 0]\n");
  EXPECT_EQ(onSlab.mortars().size(), joints + 3);
  EXPECT_NEAR(areaOfMortar(onSlab), dry + 0.5375 * 0.1025, 1e-8);
  for (MortarId id : onSlab.mortars()) {
    const MortarState state = *onSlab.world().state(id);
    if (state.bodyB == onSlab.bodies()[0].id || state.bodyB == onSlab.bodies().back().id) {
      EXPECT_NEAR(state.normal.y, -1, 1e-8);
    }
  }
  EXPECT_TRUE(has(refusal(wall + "foot = true\nposition = [0, 0.3, 0]\n"), "foot: found nothing"));
}

TEST(MortarScene, WallsThatMeetAreJoinedByTheWeaker) {
  const auto house = [](const std::string& front, const std::string& side) {
    return "[[wall]]\nname = \"front\"\nhalf_bats = false\nhead_joint = 0.01\ncourses = 6\nbricks = 4\n" + front +
           "[[wall]]\nname = \"side\"\nhalf_bats = false\nhead_joint = 0.01\ncourses = 6\nbricks = 4\n"
           "yaw_degrees = 90\nposition = [0.95125, 0, 0.05125]\n" +
           side;
  };
  const std::string cement = "mortar = \"cement\"\n", lime = "mortar = \"lime\"\n";
  const SceneRun both = mortaredRun(house(cement, lime)), one = mortaredRun(house(cement, ""));
  EXPECT_EQ(both.mortars().size(), 2 * one.mortars().size() + 6 + 5);
}

TEST(MortarScene, EachJointHasItsOwnStrength) {
  MortarKind kind = predefinedMortars()[1];
  kind.scatter = 0.4;
  double sum = 0, squares = 0;
  const int n = 4000;
  for (int k = 0; k < n; k++) {
    const std::string name = "wall/" + std::to_string(k);
    const MortarStrength s = scene::scattered(kind, true, 7, name, "other");
    const double factor = s.tension / kind.strength.tension;
    sum += factor, squares += factor * factor;
    EXPECT_GT(s.cohesion, s.tension * s.friction);
    EXPECT_NEAR(s.shearEnergy / kind.strength.shearEnergy, factor, 1e-12);
    EXPECT_EQ(s.tension, scene::scattered(kind, true, 7, "other", name).tension);
    EXPECT_NE(s.tension, scene::scattered(kind, true, 8, name, "other").tension);
  }
  const double mean = sum / n, deviation = std::sqrt(squares / n - mean * mean);
  EXPECT_NEAR(mean, 1, 4 * 0.4 / std::sqrt(n));
  EXPECT_NEAR(deviation, 0.4, 0.03);
  kind.scatter = 0;
  kind.headFilling = 0.5;
  EXPECT_EQ(scene::scattered(kind, false, 7, "a", "b").tension, 0.5 * kind.strength.tension);
  EXPECT_EQ(scene::scattered(kind, true, 7, "a", "b").tension, kind.strength.tension);
  // Whatever it is multiplied by, a world takes it.
  kind.strength = {1, 1.1, 0, 1e-6, 1e-6, 1, 1e-6, 1e6};
  const MortarStrength weak = scene::scattered(kind, false, 7, "a", "b");
  EXPECT_GE(weak.tension, 1);
  EXPECT_GE(weak.tensionEnergy, 1e-6);
  EXPECT_GE(weak.crushingEnergy, 1e-6);
}

TEST(MortarScene, OpenHeadJointsAreNone) {
  const SceneRun run = mortaredRun("[[wall]]\ncourses = 4\nbricks = 5\nmortar = {head_filling = 0}\n");
  EXPECT_EQ(run.mortars().size(), 3u * 10);
}

TEST(MortarScene, ArchesAreJoinedAtTheirStonesAndFeet) {
  const std::string arch = "[[arch]]\nstones = 9\nmortar = \"lime\"\nyaw_degrees = 30\n";
  const SceneRun run = mortaredRun(arch), footed = mortaredRun(arch + "foot = true\n");
  ASSERT_EQ(run.mortars().size(), 8u);
  EXPECT_EQ(footed.mortars().size(), 10u);
  EXPECT_NEAR(areaOfMortar(footed), 10 * 0.2 * 0.3, 1e-6);
  for (MortarId id : footed.mortars()) {
    const MortarState state = *footed.world().state(id);
    const Vec3 way = footed.world().state(state.bodyB)->centreOfMass - state.centre;
    if (footed.find(state.bodyB)->role != BodyRole::ground) {
      EXPECT_GT(dot(way, state.normal), 0);
    }
    EXPECT_NEAR(state.area, 0.06, 1e-6);
  }
}

TEST(MortarScene, BodiesAreJoinedByName) {
  const std::string bodies =
      "[[body]]\nname = \"a\"\nposition = [0, 0.5, 0]\n[[body]]\nname = \"b\"\nposition = [0.5, 1.5, 0]\n";
  const SceneRun one = mortaredRun(bodies + "[[mortar]]\nbody_a = \"a\"\nbody_b = \"b\"\n");
  ASSERT_EQ(one.mortars().size(), 1u);
  EXPECT_NEAR(areaOfMortar(one), 0.5, 1e-12);
  // To all that it lies on, and to none twice.
  const SceneRun all =
      mortaredRun(bodies + "[[mortar]]\nbody_a = \"a\"\nkind = \"lime\"\n[[mortar]]\nbody_a = \"b\"\n");
  EXPECT_EQ(all.mortars().size(), 2u);
  EXPECT_NEAR(areaOfMortar(all), 1.5, 1e-12);
  EXPECT_TRUE(has(refusal("[[ball]]\nname = \"b\"\nposition = [0, 0.1, 0]\n[[mortar]]\nbody_a = \"b\"\n"),
                  "mortar of \"b\" (line 4): found nothing that lies face to face"));
}

TEST(MortarScene, MistakesAreNamedAtTheirPlace) {
  EXPECT_TRUE(has(faults("[[wall]]\nmortar = \"cemment\"\n"),
                  "test.toml:2:10: error: wall[0].mortar: found the text \"cemment\", expected the name of a kind of "
                  "mortar, \"none\", or a table: write [wall.mortar] (did you mean \"cement\"?)"));
  EXPECT_TRUE(has(faults("[[wall]]\nmortar = 3\n"), "wall[0].mortar: found 3, expected the name"));
  EXPECT_TRUE(
      has(faults("[[wall]]\nmortar = {tension = -1}\n"), "wall[0].mortar.tension: found -1, expected a number 1"));
  EXPECT_TRUE(has(faults("[[wall]]\nmortar = {tension = 0}\n"), "wall[0].mortar.tension: found 0"));
  EXPECT_TRUE(has(faults("[[wall]]\nmortar = {tension_energy = 0}\n"), "wall[0].mortar.tension_energy: found 0"));
  EXPECT_TRUE(has(faults("[[wall]]\nmortar = {tension = nan}\n"), "wall[0].mortar.tension: found nan"));
  EXPECT_TRUE(has(faults("[[wall]]\nmortar = {scatter = 1.5}\n"), "wall[0].mortar.scatter: found 1.5"));
  EXPECT_TRUE(has(faults("[[wall]]\nmortar = {tensile = 1e5}\n"), "(did you mean \"tension\"?)"));
  EXPECT_TRUE(has(faults("[[wall]]\nmortar = {kind = \"none\"}\n"), "wall[0].mortar.kind: found the text \"none\""));
  EXPECT_TRUE(has(faults("[[wall]]\nmortar = {\n"), "error"));
  EXPECT_TRUE(has(faults("[[wall]]\n[wall.mortar]\ncohesion = 1e5\n"),
                  "test.toml:3:12: error: wall[0].mortar.cohesion: found a cohesion of 100000 Pa, expected more than "
                  "tension x friction = 187500 Pa"));
  EXPECT_TRUE(has(faults("[[wall]]\nmortar = {friction = 9}\n"), "wall[0].mortar.friction: found a cohesion"));
  EXPECT_TRUE(has(faults("[[wall]]\nfoot = true\n"), "wall[0].foot: found true without mortar"));
  EXPECT_TRUE(has(faults("[[wall]]\nmortar = \"lime\"\ndisorder = 0.001\n"), "wall[0].disorder: found 0.001 m"));
  EXPECT_TRUE(has(faults("[[mortar_kind]]\n[[wall]]\n"), "mortar_kind[0].name: not given"));
  EXPECT_TRUE(has(faults("[[mortar_kind]]\nname = \"none\"\n[[wall]]\n"), "mortar_kind[0].name: found \"none\""));
  EXPECT_TRUE(has(faults("[[mortar_kind]]\nname = \"x\"\n[[mortar_kind]]\nname = \"x\"\n[[wall]]\n"), "a second time"));
  EXPECT_TRUE(has(faults("[[mortar]]\n[[body]]\nname = \"b\"\n"), "mortar[0].body_a: not given"));
  EXPECT_TRUE(has(faults("[[mortar]]\nbody_a = \"bb\"\n[[body]]\nname = \"b\"\n"), "mortar[0].body_a: found \"bb\""));
  EXPECT_TRUE(has(faults("[[mortar]]\nbody_a = \"b\"\nbody_b = \"b\"\n[[body]]\nname = \"b\"\n"),
                  "mortar[0].body_b: found the same body"));
  EXPECT_TRUE(has(faults("[[mortar]]\nbody_a = \"b\"\ngap = -1\n[[body]]\nname = \"b\"\n"), "mortar[0].gap: found -1"));
}

// The seed decides, and nothing else: not the order in which bricks are made.
TEST(MortarScene, ScatterDoesNotDependOnTheOrderOfCreation) {
  const std::string wall = "[[wall]]\ncourses = 4\nbricks = 5\nmortar = {scatter = 0.3}\n";
  const auto areas = [](const SceneRun& run) {
    std::map<std::set<std::string>, double> out;
    for (MortarId id : run.mortars()) {
      const MortarState s = *run.world().state(id);
      out[{run.find(s.bodyA)->name, run.find(s.bodyB)->name}] = s.area;
    }
    return out;
  };
  const auto one = areas(mortaredRun(wall)), other = areas(mortaredRun(wall + "shuffle = true\n"));
  ASSERT_EQ(one.size(), other.size());
  for (const auto& [pair, area] : one) EXPECT_NEAR(other.at(pair), area, 1e-12);
}

double bricksWeigh(const SceneRun& run) {
  double mass = 0;
  for (const PlacedBody& body : run.bodies())
    if (body.role == BodyRole::brick) mass += run.world().state(body.id)->mass;
  return mass;
}

TEST(BrickKinds, WeighWhatIsThere) {
  const double solid = bricksWeigh(mortaredRun("[[wall]]\n"));
  EXPECT_NEAR(bricksWeigh(mortaredRun("[[wall]]\nbrick = \"uk_perforated\"\n")) / solid, 1 - 0.171, 0.001);
  const std::string slotted =
      "[[material]]\nname = \"clinker\"\ndensity = 2200\n[[brick_kind]]\nname = \"mine\"\nfrog = [0.1, 0.05]\n"
      "frog_depth = 0.02\nmaterial = \"clinker\"\n[[wall]]\nbrick = \"mine\"\n";
  const double share = 0.1 * 0.05 * 0.02 / (0.215 * 0.065 * 0.1025);
  EXPECT_NEAR(bricksWeigh(mortaredRun(slotted)) / solid, (1 - share) * 2200 / 1900, 1e-8);
  EXPECT_NEAR(bricksWeigh(mortaredRun(slotted + "material = \"brick\"\n")) / solid, 1 - share, 1e-8);
  // Mortar of the bricks' density fills the frogs, and all is as if they were solid.
  EXPECT_NEAR(bricksWeigh(mortaredRun(slotted + "material = \"brick\"\nmortar = \"cement\"\n")) / solid, 1, 1e-8);
}

TEST(BrickKinds, DifferInsideByTheirNames) {
  const std::string wall = "[[wall]]\ndensity_gradient = 0.1\ndensity_noise = 0.1\n";
  const SceneRun one = mortaredRun(wall), shuffled = mortaredRun(wall + "shuffle = true\n");
  std::map<std::string, Vec3> centres;
  for (const PlacedBody& body : one.bodies())
    if (body.role == BodyRole::brick) centres[body.name] = one.world().massProperties(body.id)->centre;
  std::set<double> different;
  for (const PlacedBody& body : shuffled.bodies()) {
    if (body.role != BodyRole::brick) continue;
    EXPECT_EQ(shuffled.world().massProperties(body.id)->centre, centres.at(body.name));
    different.insert(centres.at(body.name).x);
  }
  EXPECT_EQ(different.size(), centres.size());
}

TEST(BrickKinds, MistakesAreNamedAtTheirPlace) {
  const std::string kind = "[[brick_kind]]\nname = \"x\"\n", wall = "[[wall]]\n";
  EXPECT_TRUE(
      has(faults(kind + "frog = [0.1, 0.05]\n" + wall), "brick_kind[0].frog: found one of frog and frog_depth"));
  EXPECT_TRUE(has(faults(kind + "frog = [0.3, 0.05]\nfrog_depth = 0.02\n" + wall), "brick_kind[0].frog: found 0.3"));
  EXPECT_TRUE(has(faults(kind + "frog = [0.1]\nfrog_depth = 0.02\n" + wall), "expected two numbers [a, b]"));
  EXPECT_TRUE(has(faults(kind + "frog_floor = [0.1, 0.1]\n" + wall), "found a floor without a frog"));
  EXPECT_TRUE(has(faults(kind + "holes = [3, 1.5]\nhole_radius = 0.01\n" + wall), "brick_kind[0].holes[1]: found 1.5"));
  EXPECT_TRUE(
      has(faults(kind + "holes = [3, 1]\nhole_radius = 0.05\n" + wall), "brick_kind[0].hole_radius: found 0.05"));
  EXPECT_TRUE(has(faults(kind + "frog = [0.1, 0.05]\nfrog_depth = 0.02\nholes = [3, 1]\nhole_radius = 0.01\n" + wall),
                  "brick_kind[0].holes: found holes and a frog"));
  EXPECT_TRUE(has(faults(kind + kind + wall), "a second time"));
  EXPECT_TRUE(has(faults("[[wall]]\nbrick = \"uk_froged\"\n"), "(did you mean \"uk_frogged\"?)"));
  EXPECT_TRUE(has(faults("[[wall]]\ndensity_noise = 0.3\n"), "wall[0].density_noise: found 0.3"));
}

TEST(Scatter, KnowsExponentialsAndLogarithms) {
  for (double x : {1e-300, 1e-9, 0.3, 0.7071, 0.70711, 1.0, 1.5, 2.0, 1e7, 1e300})
    EXPECT_NEAR(naturalLog(x), std::log(x), 1e-15 + 4e-16 * std::fabs(std::log(x))) << x;
  for (double x : {-700.0, -30.5, -1.0, -1e-9, 0.0, 0.34657, 0.34658, 1.0, 10.0, 700.0})
    EXPECT_NEAR(exponential(x) / std::exp(x), 1, 1e-15) << x;
}

}  // namespace
}  // namespace brickfall
