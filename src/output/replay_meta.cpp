#include "output/replay_meta.h"

#include <map>
#include <nlohmann/json.hpp>

#include "brickfall/export.h"
#include "brickfall/geometry/shape_mesh.h"
#include "output/replay_tracks.h"
#include "output/role_name.h"

namespace brickfall {
namespace {

using nlohmann::json;

json toJson(Vec3 v) { return json::array({v.x, v.y, v.z}); }

json shapeJson(const ShapeDef& shape) {
  switch (shape.type) {
    case ShapeType::box:
      return {{"type", "box"}, {"half", toJson(shape.halfExtents)}};
    case ShapeType::sphere:
      return {{"type", "sphere"}, {"radius", shape.radius}};
    case ShapeType::capsule:
      return {{"type", "capsule"}, {"radius", shape.radius}, {"halfHeight", shape.halfHeight}};
    case ShapeType::cylinder:
      return {{"type", "cylinder"}, {"radius", shape.radius}, {"halfHeight", shape.halfHeight}};
    case ShapeType::cone:
      return {
          {"type", "cone"}, {"radius", shape.radius}, {"topRadius", shape.topRadius}, {"halfHeight", shape.halfHeight}};
    case ShapeType::plane:
      return {{"type", "plane"}};
    case ShapeType::hull:
    case ShapeType::mesh:
      break;
  }
  Result<ShapeMesh> made = makeShapeMesh(shape);
  ShapeMesh mesh = made ? std::move(*made) : ShapeMesh{};
  json positions = json::array(), normals = json::array();
  for (const auto& p : mesh.positions) positions.insert(positions.end(), {p[0], p[1], p[2]});
  for (const auto& n : mesh.normals) normals.insert(normals.end(), {n[0], n[1], n[2]});
  // For the page both are triangles to draw.
  return {{"type", "hull"}, {"positions", positions}, {"normals", normals}, {"indices", mesh.indices}};
}

}  // namespace

std::string replayMeta(const TakeReader& take, double positionStep) {
  const TakeHeader& header = take.header();
  const std::size_t frames = take.frameCount();
  std::map<std::string, std::size_t> known;  // shapes by their text
  json shapes = json::array(), bodies = json::array(), cameras = json::array();
  for (std::size_t k = 0; k < take.bodies().size(); k++) {
    const TakeBody& body = take.bodies()[k];
    const TakeLife& life = take.lives()[k];
    json parts = json::array();
    for (const ShapeDef& shape : body.shapes) {
      json description = shapeJson(shape);
      auto [at, added] = known.try_emplace(description.dump(), shapes.size());
      if (added) shapes.push_back(std::move(description));
      json part = {{"shape", at->second}};
      const Transform& local = shape.local;
      if (!(local.position == Vec3{} && local.rotation == Quat{})) {
        part["position"] = toJson(local.position);
        part["rotation"] = {local.rotation.x, local.rotation.y, local.rotation.z, local.rotation.w};
      }
      parts.push_back(std::move(part));
    }
    bodies.push_back({{"name", body.name},
                      {"role", roleName(body.role)},
                      {"colour", body.colour},
                      {"mass", body.mass},
                      {"parts", std::move(parts)}});
    if (!body.material.empty()) bodies.back()["material"] = body.material;
    if (!body.shapeMaterials.empty()) bodies.back()["partMaterials"] = body.shapeMaterials;
    if (life.birth > 0) bodies.back()["birth"] = life.birth;
    if (life.end < frames) bodies.back()["end"] = life.end;
  }
  for (const Camera& camera : header.cameras) {
    cameras.push_back({{"name", camera.name},
                       {"position", toJson(camera.position)},
                       {"target", toJson(camera.target)},
                       {"fieldOfView", camera.fieldOfViewDegrees}});
    for (const CameraKey& key : camera.path)
      cameras.back()["path"].push_back({{"time", key.time},
                                        {"position", toJson(key.position)},
                                        {"target", toJson(key.target)},
                                        {"fieldOfView", key.fieldOfViewDegrees}});
  }
  json meta = {{"format", 2},
               {"scene", header.scene},
               {"title", header.title},
               {"engineVersion", header.engineVersion},
               {"seed", std::to_string(header.seed)},
               {"framesPerSecond", header.framesPerSecond},
               {"frames", frames},
               {"positionStep", positionStep},
               {"turnStep", kReplayTurnStep},
               {"forceSteps", kReplayForceSteps},
               {"shapes", std::move(shapes)},
               {"bodies", std::move(bodies)},
               {"cameras", std::move(cameras)}};
  for (const TakeColumn& column : seriesOf(take.summaryJson())) {
    json& values = meta["series"][column.name] = json::array();
    for (double value : column.values) values.push_back(value);
  }
  // Pure ASCII, bytes that are no UTF-8 replaced, and no "<": nothing a name holds can end the script element.
  std::string text = meta.dump(-1, ' ', true, json::error_handler_t::replace), safe;
  for (char c : text) safe += c == '<' ? std::string("\\u003c") : std::string(1, c);
  return safe;
}

}  // namespace brickfall
