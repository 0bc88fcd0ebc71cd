// How bodies are let go and led: launches, shots, paths.
#include <algorithm>
#include <map>
#include <optional>

#include "scene/scene_build.h"

namespace brickfall::scene {

namespace {

void shootAt(SceneBuild& build, TableReader& reader, SceneBody& body, Vec3 target, double speed, bool high) {
  const Vec3 gravity = build.scene.world.gravity * body.def.gravityScale;
  const Result<Vec3> velocity = aim(body.def.position, target, speed, gravity, !high);
  if (velocity)
    body.def.linearVelocity = *velocity;
  else
    reader.error(velocity.error().message.starts_with("speed") ? "speed"
                 : reader.has("target")                        ? "target"
                                                               : "aim_at",
                 velocity.error().message.substr(velocity.error().message.find("found")));
}

void readAim(SceneBuild& build, TableReader& reader, SceneBody& body) {
  Vec3 target;
  double speed = 0;
  bool high = false;
  std::string at;
  const bool named = reader.text("aim_at", at);
  const bool aimed = reader.vector("target", target) || named, fast = reader.number("speed", speed);
  reader.boolean("high_shot", high);
  if (reader.has("target") && reader.has("aim_at"))
    return reader.error("aim_at", "found beside target, expected one of the two");
  const bool meant = reader.has("target") || reader.has("aim_at");
  if (!meant && !reader.has("speed")) {
    if (high) reader.error("high_shot", "found without a target, expected target and speed");
    return;
  }
  if (reader.has("velocity"))
    return reader.error("velocity", "found beside a target, expected either velocity or target and speed");
  if (!meant || !reader.has("speed"))
    return reader.error("", "found one of target (or aim_at) and speed alone, expected both");
  if (!aimed || !fast) return;
  if (named)
    build.aims.push_back({reader, body.name, at, speed, high});
  else
    shootAt(build, reader, body, target, speed, high);
}

}  // namespace

void takeAims(SceneBuild& build) {
  if (build.aims.empty()) return;
  std::map<std::string, SceneBody*> bodies;
  std::map<std::string, std::optional<Vec3>> middles;  // there may be many shots at one thing
  for (SceneBody& body : build.scene.bodies) bodies.emplace(body.name, &body);
  for (NamedAim& one : build.aims) {
    const auto known = middles.find(one.at);
    const auto target =
        known != middles.end() ? known : middles.emplace(one.at, middleOf(build, one.reader, "aim_at", one.at)).first;
    if (target->second)
      shootAt(build, one.reader, *bodies.at(one.body), *target->second, one.speed, one.high);
    else if (known != middles.end())
      one.reader.error("aim_at", "found \"" + one.at + "\", expected the name of a body, a wall, a group, ...");
  }
}

void readLaunch(SceneBuild& build, TableReader& reader, SceneBody& body) {
  reader.number("launch_time", body.launchTime);
  reader.times("launch_times", body.shots);
  if (reader.has("launch_time") && reader.has("launch_times"))
    reader.error("launch_times", "found beside launch_time, expected one of the two");
  for (const char* key : {"launch_times", "target", "aim_at"})
    if (reader.has(key) && body.def.type != BodyType::dynamic)
      reader.error(key, "found on a body that is not dynamic, expected type \"dynamic\"");
  if (body.launchTime > 0 && body.def.type != BodyType::dynamic)
    reader.error("launch_time", "found on a body that is not dynamic, expected type \"dynamic\"");
  if (body.def.type == BodyType::dynamic) readAim(build, reader, body);
}

// It starts as the body lies; a key at the time 0 says so anew.
void readPath(TableReader& reader, SceneBody& body) {
  reader.choice("interpolation", body.path.interpolation);
  std::vector<TableReader> tables = reader.tables("key");
  if (tables.empty()) {
    if (body.path.interpolation != Interpolation::smooth)
      reader.error("interpolation", "found without [[body.key]], expected keys to pass through");
    return;
  }
  if (body.def.type != BodyType::kinematic)
    return reader.error("key", "found on a body that is not kinematic, expected type \"kinematic\"");
  for (const char* key : {"velocity", "angular_velocity"})
    if (reader.has(key)) reader.error(key, "found beside [[body.key]], expected the motion in the keys only");
  std::vector<MotionKey>& keys = body.path.keys;
  keys.push_back({0, body.def.position, body.def.rotation});
  for (TableReader& at : tables) {
    MotionKey key = keys.back();
    if (!at.number("time", key.time)) continue;
    at.vector("position", key.position);
    at.rotation("rotation_degrees", key.rotation);
    const bool first = keys.size() == 1 && key.time == 0;
    if (!first && !(key.time > keys.back().time)) {
      at.error("time", "found " + numberText(key.time) + " s after a key at " + numberText(keys.back().time) +
                           " s, expected times that ascend");
      continue;
    }
    const double span = key.time - keys.back().time, way = length(key.position - keys.back().position);
    if (!first && !(way <= scene_limits::kLargestSpeed * span))
      at.error("position", "found a move of " + numberText(way) + " m in " + numberText(span) +
                               " s, expected at most " + numberText(scene_limits::kLargestSpeed) + " m/s");
    if (first) keys.pop_back();
    keys.push_back(key);
  }
  body.def.position = keys.front().position;
  body.def.rotation = keys.front().rotation;
}

}  // namespace brickfall::scene
