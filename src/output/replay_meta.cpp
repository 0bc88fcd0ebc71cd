#include "output/replay_meta.h"

#include <algorithm>
#include <map>
#include <nlohmann/json.hpp>

#include "brickfall/export.h"
#include "brickfall/fall.h"
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

json mortarJson(const TakeReader& take) {
  json joints = json::array();
  for (std::size_t k = 0; k < take.mortar().size(); k++) {
    const TakeMortar& joint = take.mortar()[k];
    const TakeLife& life = take.mortarLives()[k];
    joints.push_back({{"a", joint.bodyA},
                      {"b", joint.bodyB},
                      {"centre", toJson(joint.centre)},
                      {"along1", toJson(joint.along1)},
                      {"along2", toJson(joint.along2)}});
    if (life.birth > 0) joints.back()["birth"] = life.birth;
    if (life.end < take.frameCount()) joints.back()["end"] = life.end;
  }
  return joints;
}

const char* modeName(MortarMode mode) {
  switch (mode) {
    case MortarMode::none:
      return "none";
    case MortarMode::tension:
      return "tension";
    case MortarMode::shear:
      return "shear";
    case MortarMode::crushing:
      return "crushing";
  }
  return "none";
}

json breaksJson(const std::vector<TakeBreak>& breaks) {
  json all = json::array();
  for (const TakeBreak& broken : breaks) {
    json takers = json::array();
    for (const TakeLoadTaker& taker : broken.takers)
      takers.push_back({{"joint", taker.mortar == TakeLoadTaker::kContacts ? -1.0 : double(taker.mortar)},
                        {"a", taker.bodyA},
                        {"b", taker.bodyB},
                        {"before", taker.before},
                        {"after", taker.after}});
    all.push_back({{"joint", broken.mortar},
                   {"crackTime", broken.crackTime},
                   {"time", broken.breakTime},
                   {"mode", modeName(broken.mode)},
                   {"tension", broken.tensionShare},
                   {"shear", broken.shearShare},
                   {"force", length(broken.force)},
                   {"takers", std::move(takers)}});
  }
  return all;
}

// [body, which of the breaks gave way first] of all that fell because of one.
json fallsJson(const TakeReader& take, const std::vector<TakeBreak>& breaks) {
  const std::size_t frames = take.frameCount();
  std::vector<FallJoint> joints;
  std::vector<std::size_t> breakOf;  // by FallJoint
  std::vector<std::size_t> of(take.mortar().size(), breaks.size());
  for (std::size_t k = 0; k < breaks.size(); k++) of[breaks[k].mortar] = k;
  for (std::size_t k = 0; k < take.mortar().size(); k++) {
    FallJoint joint{take.mortar()[k].bodyA, take.mortar()[k].bodyB};
    if (of[k] == breaks.size() && take.mortarLives()[k].end < frames) continue;  // it ended with a body
    if (of[k] < breaks.size()) {
      joint.breakTime = breaks[of[k]].breakTime;
      joint.lift = breaks[of[k]].force.y;
    }
    joints.push_back(joint);
    breakOf.push_back(of[k]);
  }
  std::vector<bool> moves;
  for (const TakeBody& body : take.bodies()) moves.push_back(body.mass > 0);
  const FallFinder finder(joints, moves);
  json falls = json::array();
  for (std::uint32_t body = 0; body < moves.size(); body++)
    if (const std::optional<std::uint32_t> first = finder.first(body); first && breakOf[*first] < breaks.size())
      falls.push_back({body, breakOf[*first]});
  return falls;
}

}  // namespace

std::string replayMeta(const TakeReader& take, const std::vector<TakeBreak>& breaks, double positionStep) {
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
    if (!body.shapeColours.empty()) bodies.back()["partColours"] = body.shapeColours;
    if (body.look.value_or(k) != k) bodies.back()["look"] = *body.look;
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
    const auto followed = std::find_if(take.bodies().begin(), take.bodies().end(),
                                       [&](const TakeBody& body) { return body.name == camera.follow; });
    if (!camera.follow.empty() && followed != take.bodies().end())
      cameras.back()["turnsAfter"] = followed - take.bodies().begin();
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
  if (!take.mortar().empty()) {
    meta["mortar"] = mortarJson(take);
    meta["breaks"] = breaksJson(breaks);
    meta["falls"] = fallsJson(take, breaks);
  }
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
