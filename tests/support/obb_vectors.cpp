#include "support/obb_vectors.h"

#include <algorithm>
#include <cmath>
#include <fstream>
#include <nlohmann/json.hpp>

namespace brickfall::test {

namespace {

using Json = nlohmann::json;

Vec3 vector(const Json& json) { return {json[0], json[1], json[2]}; }

// Quaternion of right-handed unit axes, by its largest component.
Quat rotationOf(Vec3 x, Vec3 y, Vec3 z) {
  double four[4] = {1 + x.x - y.y - z.z, 1 - x.x + y.y - z.z, 1 - x.x - y.y + z.z, 1 + x.x + y.y + z.z};
  Quat q;
  switch (std::max_element(four, four + 4) - four) {
    case 0:
      q = {four[0], x.y + y.x, z.x + x.z, y.z - z.y};
      break;
    case 1:
      q = {x.y + y.x, four[1], y.z + z.y, z.x - x.z};
      break;
    case 2:
      q = {z.x + x.z, y.z + z.y, four[2], x.y - y.x};
      break;
    default:
      q = {y.z - z.y, z.x - x.z, x.y - y.x, four[3]};
  }
  return normalized(q);
}

void readBox(const Json& json, Vec3& half, Transform& pose) {
  half = vector(json["half"]);
  const Json& axes = json["axes"];
  pose = {vector(json["center"]), rotationOf(vector(axes[0]), vector(axes[1]), vector(axes[2]))};
}

std::optional<double> number(const Json& json) { return json.is_null() ? std::nullopt : std::optional<double>(json); }

}  // namespace

std::vector<ObbVector> obbVectors() {
  std::ifstream file(BRICKFALL_SOURCE_DIR "/tests/support/obb_vectors.json");
  Json json = Json::parse(file);
  std::vector<ObbVector> out;
  for (const Json& entry : json["cases"]) {
    const Json& expected = entry["expected"];
    ObbVector v;
    v.id = entry["id"];
    v.category = entry["category"];
    v.degenerate = entry["degenerate"], v.borderline = expected["borderline"], v.float32Ok = entry["float32_ok"];
    readBox(entry["box0"], v.halfA, v.poseA);
    readBox(entry["box1"], v.halfB, v.poseB);
    v.relativeVelocity = vector(entry["rel_velocity"]);
    v.maxTime = entry["t_max"];
    v.size = expected["size"];
    Vec3 furthest = max(abs(v.poseA.position), abs(v.poseB.position));
    v.tolerance = 1e-7 * v.size + 4e-15 * std::max({furthest.x, furthest.y, furthest.z});
    v.overlap = expected["overlap"], v.touching = expected["touching"];
    v.distance = number(expected["distance"]);
    v.penetration = number(expected["pen_depth"]);
    v.timeOfImpact = number(expected["toi"]);
    if (!expected["pen_normal"].is_null()) v.penetrationNormal = vector(expected["pen_normal"]);
    out.push_back(v);
  }
  return out;
}

}  // namespace brickfall::test
