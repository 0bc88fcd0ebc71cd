// [world], [solver], [ground], [[material]] and [[camera]].
#include <set>

#include "scene/scene_build.h"

namespace brickfall::scene {

namespace {

void readSolver(TableReader& top, SolverSettings& solver) {
  TableReader reader = top.table("solver");
  reader.number("resting_stiffness", solver.restingStiffness);
  reader.number("impact_stiffness", solver.impactStiffness);
  reader.number("resting_approach_speed", solver.restingApproachSpeed);
  reader.number("restitution_speed", solver.restitutionSpeed);
  reader.number("contact_margin", solver.contactMargin);
  reader.number("rest_speed", solver.restSpeed);
  reader.number("rest_tolerance", solver.restTolerance);
  reader.number("cycle_tolerance", solver.cycleTolerance);
  reader.integer("min_cycles", solver.minCycles);
  reader.integer("max_cycles", solver.maxCycles);
  const char* const alone = reader.has("max_cycles_small") ? "max_cycles_small" : "max_cycles_alone";
  reader.integer(alone, solver.maxCyclesSmall);
  if (reader.has("max_cycles_small")) reader.warning(alone, "found an old name, expected max_cycles_alone");
  reader.integer("max_hit_parts", solver.maxHitParts);
  if (!(solver.impactStiffness <= solver.restingStiffness))
    reader.error(reader.has("impact_stiffness") ? "impact_stiffness" : "resting_stiffness",
                 "found impact_stiffness " + numberText(solver.impactStiffness) +
                     ", expected at most resting_stiffness = " + numberText(solver.restingStiffness));
  if (!(solver.minCycles <= solver.maxCycles))
    reader.error(reader.has("min_cycles") ? "min_cycles" : "max_cycles",
                 "found min_cycles " + std::to_string(solver.minCycles) +
                     ", expected at most max_cycles = " + std::to_string(solver.maxCycles));
  if (!(solver.minCycles <= solver.maxCyclesSmall))
    reader.error(reader.has(alone) ? alone : "min_cycles",
                 "found " + std::string(alone) + " " + std::to_string(solver.maxCyclesSmall) +
                     ", expected at least min_cycles = " + std::to_string(solver.minCycles));
}

void readReport(TableReader& top, ReportSettings& report) {
  TableReader reader = top.table("report");
  reader.boolean("all_axes", report.allAxes);
  reader.boolean("last_axis", report.lastAxis);
  reader.boolean("restitution", report.restitution);
  reader.boolean("friction", report.friction);
  reader.boolean("manifold", report.manifold);
  reader.boolean("warm_starting", report.warmStarting);
  reader.number("impulse_factor", report.impulseFactor);
  reader.number("damping", report.damping);
  reader.integer("sweeps", report.sweeps);
  reader.choice("integrator", report.integrator);
}

}  // namespace

void readWorld(SceneBuild& build, TableReader& top) {
  SceneDescription& scene = build.scene;
  TableReader reader = top.table("world");
  reader.gravity("gravity", scene.world.gravity);
  reader.number("seconds", scene.seconds);
  reader.number("time_step", scene.timeStep);
  enum class StopWhen { time, rest } stop = StopWhen::time;
  if (reader.choice("stop_when", stop)) scene.stopAtRest = stop == StopWhen::rest;
  double lowest = 0;
  if (reader.number("remove_below", lowest)) scene.removeBelow = lowest;
  reader.integer("substeps", scene.substeps);
  reader.number("frames_per_second", scene.framesPerSecond);
  reader.integer("seed", scene.seed);
  reader.boolean("sleep", scene.world.enableSleep);
  reader.number("sleep_delay", scene.world.sleepDelay);
  reader.number("air_density", scene.world.airDensity);
  reader.number("hit_event_speed", scene.world.hitEventSpeed);
  reader.number("hit_event_impulse", scene.world.hitEventImpulse);
  reader.choice("broad_phase", scene.world.broadPhase);
  reader.choice("method", scene.method);
  reader.choice("integrator", scene.world.integrator);
  if (scene.stopAtRest && !scene.world.enableSleep)
    reader.error("stop_when", "found \"rest\" with sleep = false, expected bodies that may fall asleep");
  readSolver(top, scene.world.solver);
  readReport(top, scene.report);
}

void readGround(SceneBuild& build, TableReader& top) {
  enum class GroundType { plane, box };
  bool enabled = true;
  GroundType type = GroundType::plane;
  double height = 0, tilt = 0;
  Vec3 size{100, 1, 100}, axis{0, 0, 1};
  SceneBody ground;
  ground.name = "ground";
  ground.role = BodyRole::ground;
  ground.material = "concrete";
  ground.def.type = BodyType::fixed;
  TableReader reader = top.table("ground");
  reader.boolean("enabled", enabled);
  reader.choice("type", type);
  reader.number("height", height);
  reader.vector("size", size);
  reader.number("tilt_degrees", tilt);
  reader.vector("tilt_axis", axis);
  reader.material("material", ground.material);
  if (!(lengthSquared(axis) > 1e-12))
    reader.error("tilt_axis", "found a vector of length 0, expected the direction of an axis");
  if (!enabled) return;
  ground.def.rotation = quatFromAxisAngle(normalized(axis), tilt * kRadians);
  ShapeDef shape;
  shape.type = type == GroundType::plane ? ShapeType::plane : ShapeType::box;
  shape.halfExtents = size * 0.5;
  double below = type == GroundType::plane ? 0 : size.y * 0.5;
  ground.def.position = Vec3{0, height, 0} - rotate(ground.def.rotation, Vec3{0, below, 0});
  ground.def.shapes = {shape};
  build.names[ground.name] = reader.node().line;
  build.scene.bodies.push_back(std::move(ground));
}

void readMaterials(SceneBuild& build, TableReader& top) {
  std::vector<MaterialDef>& materials = build.scene.materials;
  materials = predefinedMaterials();
  std::set<std::string> own;
  for (TableReader& reader : top.tables("material")) {
    MaterialDef material;
    if (!reader.text("name", material.name)) continue;
    if (!own.insert(material.name).second) {
      reader.error("name", "found the name \"" + material.name + "\" a second time, expected different names");
      continue;
    }
    // A predefined material is changed key by key.
    MaterialDef* target = nullptr;
    for (MaterialDef& known : materials)
      if (known.name == material.name) target = &known;
    if (target) material = *target;
    reader.number("density", material.material.density);
    reader.number("friction", material.material.friction);
    reader.number("restitution", material.material.restitution);
    reader.number("rolling_resistance", material.material.rollingResistance);
    reader.number("hardness", material.material.hardness);
    reader.choice("friction_rule", material.material.frictionRule);
    reader.choice("restitution_rule", material.material.restitutionRule);
    reader.colour("colour", material.colour);
    if (target)
      *target = material;
    else
      materials.push_back(material);
  }
  for (const MaterialDef& material : materials) build.context.materialNames.push_back(material.name);
}

namespace {

void readCameraPath(TableReader& reader, Camera& camera) {
  for (TableReader& at : reader.tables("key")) {
    CameraKey key{0, camera.position, camera.target, camera.fieldOfViewDegrees};
    if (!at.number("time", key.time)) continue;
    at.vector("position", key.position);
    at.vector("target", key.target);
    at.number("field_of_view_degrees", key.fieldOfViewDegrees);
    if (!camera.path.empty() && !(key.time > camera.path.back().time)) {
      at.error("time", "found " + numberText(key.time) + " s after a key at " + numberText(camera.path.back().time) +
                           " s, expected times that ascend");
      continue;
    }
    if (!(length(key.position - key.target) > 1e-6))
      at.error("target", "found the camera's own position, expected a point that it looks at");
    camera.path.push_back(key);
  }
}

}  // namespace

void readCameras(SceneBuild& build, TableReader& top) {
  std::set<std::string> names;
  for (TableReader& reader : top.tables("camera")) {
    Camera camera;
    reader.text("name", camera.name);
    if (!names.insert(camera.name).second)
      reader.error("name", "found the name \"" + camera.name + "\" a second time, expected different names");
    reader.vector("position", camera.position);
    reader.vector("target", camera.target);
    std::string lookAt;
    if (reader.text("look_at", lookAt)) {
      if (reader.has("target"))
        reader.error("look_at", "found beside target, expected one of the two");
      else
        camera.target = middleOf(build, reader, "look_at", lookAt).value_or(camera.target);
    }
    bool follow = false;
    if (reader.boolean("follow", follow) && follow) {
      if (lookAt.empty())
        reader.error("follow", "found without look_at, expected the name of a body in look_at");
      else if (nearestOf(build, lookAt, camera.target) != lookAt)
        reader.error("follow", "found beside \"" + lookAt + "\", which many are called after, expected one body");
      else
        camera.follow = lookAt;
    }
    reader.number("field_of_view_degrees", camera.fieldOfViewDegrees);
    if (!(length(camera.position - camera.target) > 1e-6))
      reader.error("target", "found the camera's own position, expected a point that it looks at");
    readCameraPath(reader, camera);
    build.scene.cameras.push_back(camera);
  }
}

}  // namespace brickfall::scene
