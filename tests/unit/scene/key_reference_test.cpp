// The documentation and the JSON schema say what the parser knows, key by key. After a change of the table of keys, run
// this test with BRICKFALL_UPDATE_DOCS=1 in the environment to write both anew.
#include "unit/scene/key_reference.h"

#include <algorithm>
#include <cstdlib>
#include <fstream>
#include <nlohmann/json.hpp>

#include "scene/keys.h"
#include "scene/node.h"
#include "unit/scene/scene_support.h"

namespace brickfall {
namespace {

const std::string kDocs = std::string(BRICKFALL_SOURCE_DIR) + "/docs/";

std::string contentOf(const std::string& path) {
  std::ifstream file(path, std::ios::binary);
  return std::string((std::istreambuf_iterator<char>(file)), std::istreambuf_iterator<char>());
}

void writeIfAsked(const std::string& path, const std::string& content) {
  if (std::getenv("BRICKFALL_UPDATE_DOCS")) std::ofstream(path, std::ios::binary) << content;
}

// The page with the tables between its marks as they should be.
std::string updatedPage(std::string page) {
  for (const std::string& table : scene::tablesOfKeys()) {
    std::string begin = "<!-- keys: " + (table.empty() ? "top level" : table) + " -->\n", end = "<!-- end of keys -->";
    std::size_t from = page.find(begin);
    EXPECT_NE(from, std::string::npos) << "the page has no mark " << begin;
    if (from == std::string::npos) continue;
    from += begin.size();
    std::size_t to = page.find(end, from);
    EXPECT_NE(to, std::string::npos) << "the page has no end of the keys of " << table;
    if (to != std::string::npos) page = page.substr(0, from) + scene::keyMarkdown(table) + page.substr(to);
  }
  return page;
}

TEST(KeyReference, DocumentationHasEveryKey) {
  std::string path = kDocs + "scene-file.md", page = contentOf(path);
  ASSERT_GT(page.size(), 1000u);
  std::string wanted = updatedPage(page);
  writeIfAsked(path, wanted);
  EXPECT_EQ(contentOf(path), wanted);
}

TEST(KeyReference, SchemaHasEveryKey) {
  std::string path = kDocs + "scene.schema.json";
  writeIfAsked(path, scene::keySchema());
  EXPECT_EQ(contentOf(path), scene::keySchema());
  EXPECT_TRUE(nlohmann::json::accept(scene::keySchema()));
}

TEST(KeyReference, EveryKeyHasAMeaningAndASensibleRange) {
  for (const scene::KeySpec& spec : scene::keySpecs()) {
    EXPECT_STRNE(spec.meaning, "") << spec.key;
    EXPECT_LE(spec.minimum, spec.maximum) << spec.key;
    EXPECT_EQ(scene::findKey(spec.table, spec.key), &spec) << spec.table << "." << spec.key << " is there twice";
  }
}

// A table with every key that has a default set to it, as the table of keys states it.
std::string allDefaults(const std::string& table) {
  std::string text;
  for (const scene::KeySpec& spec : scene::keySpecs()) {
    std::string fallback = spec.fallback;
    if (spec.table == table && !fallback.empty() && fallback != "-")
      text += std::string(spec.key) + " = " + fallback + "\n";
  }
  return text;
}

void expectSameBody(const SceneBody& a, const SceneBody& b) {
  EXPECT_EQ(a.material, b.material);
  EXPECT_EQ(a.def.type, b.def.type);
  EXPECT_EQ(a.def.position, b.def.position);
  EXPECT_EQ(a.def.rotation, b.def.rotation);
  EXPECT_EQ(a.def.linearVelocity, b.def.linearVelocity);
  EXPECT_EQ(a.def.angularVelocity, b.def.angularVelocity);
  EXPECT_EQ(a.def.gravityScale, b.def.gravityScale);
  EXPECT_EQ(a.def.linearDamping, b.def.linearDamping);
  EXPECT_EQ(a.def.angularDamping, b.def.angularDamping);
  EXPECT_EQ(a.def.dragArea, b.def.dragArea);
  EXPECT_EQ(a.def.surfaceVelocity, b.def.surfaceVelocity);
  EXPECT_EQ(a.def.allowSleep, b.def.allowSleep);
  EXPECT_EQ(a.launchTime, b.launchTime);
  ASSERT_EQ(a.def.shapes.size(), b.def.shapes.size());
  EXPECT_EQ(a.def.shapes[0].type, b.def.shapes[0].type);
  EXPECT_EQ(a.def.shapes[0].halfExtents, b.def.shapes[0].halfExtents);
  EXPECT_EQ(a.def.shapes[0].radius, b.def.shapes[0].radius);
}

void expectSameWorld(const SceneDescription& a, const SceneDescription& b) {
  EXPECT_EQ(a.world.gravity, b.world.gravity);
  EXPECT_EQ(a.seconds, b.seconds);
  EXPECT_EQ(a.timeStep, b.timeStep);
  EXPECT_EQ(a.substeps, b.substeps);
  EXPECT_EQ(a.framesPerSecond, b.framesPerSecond);
  EXPECT_EQ(a.seed, b.seed);
  EXPECT_EQ(a.world.enableSleep, b.world.enableSleep);
  EXPECT_EQ(a.world.sleepDelay, b.world.sleepDelay);
  EXPECT_EQ(a.world.airDensity, b.world.airDensity);
  EXPECT_EQ(a.world.hitEventSpeed, b.world.hitEventSpeed);
  EXPECT_EQ(a.world.hitEventImpulse, b.world.hitEventImpulse);
  EXPECT_EQ(a.world.solver.restingStiffness, b.world.solver.restingStiffness);
  EXPECT_EQ(a.world.solver.impactStiffness, b.world.solver.impactStiffness);
  EXPECT_EQ(a.world.solver.restingApproachSpeed, b.world.solver.restingApproachSpeed);
  EXPECT_EQ(a.world.solver.contactMargin, b.world.solver.contactMargin);
  EXPECT_EQ(a.world.solver.restSpeed, b.world.solver.restSpeed);
  EXPECT_EQ(a.world.solver.restTolerance, b.world.solver.restTolerance);
  EXPECT_EQ(a.world.solver.cycleTolerance, b.world.solver.cycleTolerance);
  EXPECT_EQ(a.world.solver.minCycles, b.world.solver.minCycles);
  EXPECT_EQ(a.world.solver.maxCycles, b.world.solver.maxCycles);
  EXPECT_EQ(a.world.solver.maxCyclesSmall, b.world.solver.maxCyclesSmall);
  EXPECT_EQ(a.world.solver.maxHitParts, b.world.solver.maxHitParts);
}

void expectSameMachines(const SceneDescription& a, const SceneDescription& b) {
  ASSERT_EQ(a.joints.size(), 1u + 10);
  ASSERT_EQ(b.joints.size(), 1u + 10);
  for (std::size_t i = 0; i < a.joints.size(); i++) {
    const JointDef &one = a.joints[i].def, &other = b.joints[i].def;
    EXPECT_EQ(one.type, other.type);
    EXPECT_EQ(one.anchor, other.anchor);
    EXPECT_EQ(one.axis, other.axis);
    EXPECT_EQ(one.collide, other.collide);
    EXPECT_EQ(one.limit.has_value() || one.motor.has_value(), other.limit.has_value() || other.motor.has_value());
    EXPECT_EQ(one.breakForce, other.breakForce);
  }
  EXPECT_EQ(a.tilts.at(0).tilt.axis, b.tilts.at(0).tilt.axis);
  EXPECT_EQ(a.tilts[0].tilt.pivot, b.tilts[0].tilt.pivot);
  EXPECT_EQ(a.tilts[0].tilt.angle.keys, b.tilts[0].tilt.angle.keys);
  const Shake &one = a.shakes.at(0).shake, &other = b.shakes.at(0).shake;
  EXPECT_EQ(one.direction, other.direction);
  EXPECT_EQ(one.signal, other.signal);
  for (auto field : {&Shake::start, &Shake::amplitude, &Shake::frequency, &Shake::seconds, &Shake::ramp})
    EXPECT_EQ(one.*field, other.*field);
  for (auto field : {&Wind::from, &Wind::until, &Wind::ramp, &Wind::dragCoefficient})
    EXPECT_EQ(a.winds.at(0).*field, b.winds.at(0).*field);
  EXPECT_EQ(a.winds[0].shelter, b.winds[0].shelter);
  EXPECT_EQ(a.blasts.at(0).time, b.blasts.at(0).time);
  EXPECT_EQ(a.blasts[0].occlusion, b.blasts[0].occlusion);
}

// The documented defaults are the real ones: a scene that states them all is the scene that states none.
TEST(KeyReference, DocumentedDefaultsAreTheRealOnes) {
  std::string bare =
      "[[wall]]\n[[wall.opening]]\nfrom = 0.5\nwidth = 0.5\nheight = 0.3\n[[body]]\n[[ball]]\nposition = "
      "[0, 9, 0]\n[[array]]\n[[material]]\nname = \"own\"\n[[camera]]\n[[arch]]\n[[tilt]]\nrate_degrees = "
      "2\nto_degrees = 3\n"
      "[[joint]]\nbody_b = \"body1\"\nanchor = [0, 0, 0]\n[[chain]]\nfrom = [0, 9, 3]\nto = [3, 9, 3]\n"
      "[[shake]]\n[[wind]]\nvelocity = [1, 0, 0]\n[[blast]]\ncentre = [1, 2, 3]\nimpulse = 4\nradius = 5\n";
  auto without = [](std::string text, const std::string& key) {
    std::size_t from = text.find("\n" + key + " = ");
    return from == std::string::npos ? text : text.erase(from, text.find('\n', from + 1) - from);
  };
  // Keys of other shapes and arrangements are refused where they would do nothing.
  std::string body =
      without(without(without(without("\n" + allDefaults("body"), "radius"), "height"), "size"), "top_radius");
  std::string array =
      without(without(without(without("\n" + allDefaults("array"), "radius"), "height"), "base"), "top_radius");
  std::string shake = "\n" + allDefaults("shake");
  for (const char* key : {"time_unit", "column", "scale", "baseline"}) shake = without(shake, key);
  std::string joint = without(without("\n" + allDefaults("joint"), "stiffness"), "damping");
  std::string chain = without(without("\n" + allDefaults("chain"), "thickness"), "width");
  std::string ground = without("\n" + allDefaults("ground"), "size");
  std::string full =
      "[world]\n" + allDefaults("world") + "[solver]\n" + allDefaults("solver") + "[report]\n" + allDefaults("report") +
      "[ground]" + ground + "[[wall]]\n" + allDefaults("wall") +
      "[[wall.opening]]\nfrom = 0.5\nwidth = 0.5\nheight = 0.3\n" + allDefaults("wall.opening") +
      "[[body]]\nsize = [1, 1, 1]" + body + "[[ball]]\nposition = [0, 9, 0]\n" + allDefaults("ball") + "[[array]]" +
      array + "[[material]]\nname = \"own\"\n" + allDefaults("material") + "[[camera]]\n" + allDefaults("camera") +
      "[[arch]]\n" + allDefaults("arch") + "[[tilt]]\nrate_degrees = 2\nto_degrees = 3\n" + allDefaults("tilt") +
      "[[joint]]\nbody_b = \"body1\"\nanchor = [0, 0, 0]" + joint + "[[chain]]\nfrom = [0, 9, 3]\nto = [3, 9, 3]" +
      chain + "[[shake]]" + shake + "[[wind]]\nvelocity = [1, 0, 0]\n" + allDefaults("wind") +
      "[[blast]]\ncentre = [1, 2, 3]\nimpulse = 4\nradius = 5\n" + allDefaults("blast");
  SceneDescription a = sound(bare), b = sound(full);
  expectSameWorld(a, b);
  ASSERT_EQ(a.bodies.size(), 4u + 21 + 10);
  ASSERT_EQ(b.bodies.size(), 4u + 21 + 10);
  for (std::size_t i = 0; i < a.bodies.size(); i++) expectSameBody(a.bodies[i], b.bodies[i]);
  expectSameMachines(a, b);
  const WallDef &wallA = a.walls[0].wall, &wallB = b.walls[0].wall;
  EXPECT_EQ(wallA.bond, wallB.bond);
  EXPECT_EQ(wallA.bondShift, wallB.bondShift);
  EXPECT_EQ(wallA.courses, wallB.courses);
  EXPECT_EQ(wallA.bricksPerCourse, wallB.bricksPerCourse);
  EXPECT_EQ(wallA.brick.size, wallB.brick.size);
  EXPECT_EQ(wallA.halfBats, wallB.halfBats);
  EXPECT_EQ(wallA.headJoint, wallB.headJoint);
  EXPECT_EQ(wallA.bedJoint, wallB.bedJoint);
  EXPECT_EQ(wallA.position, wallB.position);
  EXPECT_EQ(wallA.yawDegrees, wallB.yawDegrees);
  EXPECT_EQ(wallA.disorder, wallB.disorder);
  EXPECT_EQ(wallA.shuffle, wallB.shuffle);
  EXPECT_EQ(a.walls[0].material, b.walls[0].material);
  EXPECT_EQ(a.walls[0].lintelMaterial, b.walls[0].lintelMaterial);
  EXPECT_EQ(a.walls[0].densityScatter, b.walls[0].densityScatter);
  EXPECT_EQ(wallA.openings[0].sill, wallB.openings[0].sill);
  EXPECT_EQ(wallA.openings[0].lintelBearing, wallB.openings[0].lintelBearing);
  EXPECT_EQ(wallA.openings[0].lintelHeight, wallB.openings[0].lintelHeight);
  const MaterialDef &materialA = a.materials.back(), &materialB = b.materials.back();
  EXPECT_EQ(materialA.material.density, materialB.material.density);
  EXPECT_EQ(materialA.material.friction, materialB.material.friction);
  EXPECT_EQ(materialA.material.restitution, materialB.material.restitution);
  EXPECT_EQ(materialA.material.rollingResistance, materialB.material.rollingResistance);
  EXPECT_EQ(materialA.material.frictionRule, materialB.material.frictionRule);
  EXPECT_EQ(materialA.material.restitutionRule, materialB.material.restitutionRule);
  EXPECT_EQ(materialA.colour, materialB.colour);
  EXPECT_EQ(a.cameras[0].name, b.cameras[0].name);
  EXPECT_EQ(a.cameras[0].position, b.cameras[0].position);
  EXPECT_EQ(a.cameras[0].target, b.cameras[0].target);
  EXPECT_EQ(a.cameras[0].fieldOfViewDegrees, b.cameras[0].fieldOfViewDegrees);
  EXPECT_TRUE(a.cameras[0].path.empty());
}

}  // namespace
}  // namespace brickfall
