#include "obb_cases.h"

#include <algorithm>
#include <cmath>
#include <fstream>
#include <nlohmann/json.hpp>

namespace brickfall::test {

namespace {

using Json = nlohmann::json;

Vec3 vector(const Json& json) { return {json[0], json[1], json[2]}; }
std::optional<Vec3> maybeVector(const Json& json) {
  return json.is_array() ? std::optional<Vec3>(vector(json)) : std::nullopt;
}
std::optional<double> number(const Json& json) { return json.is_null() ? std::nullopt : std::optional<double>(json); }
std::optional<int> row(const Json& json) { return json.is_null() ? std::nullopt : std::optional<int>(json); }

Obb box(const Json& json) {
  const Json& axes = json["axes"];
  return {vector(json["center"]), {{vector(axes[0]), vector(axes[1]), vector(axes[2])}}, vector(json["half"])};
}

}  // namespace

double ObbCase::tolerance(double rel) const {
  Vec3 furthest = max(abs(motion.a.centre), abs(motion.b.centre));
  return rel * size + 4e-15 * std::max({furthest.x, furthest.y, furthest.z});
}

std::vector<ObbCase> obbCases() {
  std::ifstream file(BRICKFALL_SOURCE_DIR "/tests/support/obb_vectors.json");
  const Json json = Json::parse(file);
  std::vector<ObbCase> out;
  for (const Json& entry : json["cases"]) {
    const Json& expected = entry["expected"];
    ObbCase c;
    c.id = entry["id"], c.category = entry["category"];
    c.degenerate = entry["degenerate"], c.float32Ok = entry["float32_ok"];
    c.motion.a = box(entry["box0"]), c.motion.b = box(entry["box1"]);
    c.motion.velocityB = vector(entry["rel_velocity"]);
    c.maxTime = entry["t_max"];
    c.size = expected["size"];
    c.overlap = expected["overlap"], c.touching = expected["touching"], c.borderline = expected["borderline"];
    c.illConditioned = expected["ill_conditioned"];
    c.separatingRow = row(expected["separating_axis"]);
    c.penetrationRow = row(expected["pen_axis"]);
    c.contactRow = row(expected["contact_axis"]);
    c.separatingRows = expected["separating_axes_all"].get<std::vector<int>>();
    c.penetrationRows = expected["pen_axes_ok"].get<std::vector<int>>();
    c.contactRows = expected["contact_axes_ok"].get<std::vector<int>>();
    c.contactRowsNear = expected["contact_axes_near"].get<std::vector<int>>();
    c.gap = number(expected["separation_gap"]), c.distance = number(expected["distance"]);
    c.depth = number(expected["pen_depth"]);
    c.time = number(expected["toi"]), c.timeUnbounded = number(expected["toi_unbounded"]);
    c.penetrationNormal = maybeVector(expected["pen_normal"]);
    c.contactNormal = maybeVector(expected["contact_normal"]);
    c.contactPoint = maybeVector(expected["contact_point"]);
    c.contactNotUnique = expected["contact_point"] == "non-unique";
    for (const Json& corner : expected["contact_hull"]) c.contactHull.push_back(vector(corner));
    out.push_back(std::move(c));
  }
  return out;
}

}  // namespace brickfall::test
