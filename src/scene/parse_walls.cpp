// [[wall]] and [[wall.opening]].
#include <algorithm>
#include <cmath>

#include "scene/scene_build.h"

namespace brickfall::scene {

namespace {

// A field of WallDef as it is called in the file: "bricksPerCourse" -> "bricks", "brick.size.x" -> "brick".
std::string keyOfField(const std::string& field) {
  if (field == "bricksPerCourse") return "bricks";
  if (field.starts_with("brick.")) return "brick";
  std::string key;
  for (char c : field.substr(0, field.find('.'))) {
    if (c >= 'A' && c <= 'Z') key += '_';
    key += char(c >= 'A' && c <= 'Z' ? c - 'A' + 'a' : c);
  }
  return key;
}

void readOpening(TableReader& reader, Opening& opening) {
  reader.number("from", opening.from);
  reader.number("sill", opening.sill);
  reader.number("width", opening.width);
  reader.number("height", opening.height);
  reader.number("lintel_bearing", opening.lintelBearing);
  reader.number("lintel_height", opening.lintelHeight);
}

void readWallNumbers(TableReader& reader, SceneWall& out) {
  WallDef& wall = out.wall;
  reader.choice("bond", wall.bond);
  reader.number("bond_shift", wall.bondShift);
  reader.integer("courses", wall.courses);
  reader.integer("bricks", wall.bricksPerCourse);
  BrickKind kind;
  if (reader.brick("brick", kind)) {
    wall.brick = kind.format;
    out.material = kind.material;
  }
  reader.boolean("half_bats", wall.halfBats);
  reader.number("head_joint", wall.headJoint);
  reader.number("bed_joint", wall.bedJoint);
  reader.vector("position", wall.position);
  reader.number("yaw_degrees", wall.yawDegrees);
  reader.material("material", out.material);
  reader.material("lintel_material", out.lintelMaterial);
  reader.number("density_scatter", out.densityScatter);
  reader.number("density_gradient", out.uneven.gradient);
  reader.number("density_noise", out.uneven.noise);
  reader.number("disorder", wall.disorder);
  reader.boolean("shuffle", wall.shuffle);
}

// What the values mean together: only asked if each by itself is sound.
void checkTogether(TableReader& reader, std::vector<TableReader>& openings, const WallDef& wall) {
  for (const WallProblem& problem : checkWall(wall)) {
    std::size_t index = 0;
    if (problem.field.starts_with("openings[")) {
      index = std::size_t(std::stoul(problem.field.substr(9)));
      openings[index].error(keyOfField(problem.field.substr(problem.field.find('.') + 1)), problem.message);
    } else {
      reader.error(keyOfField(problem.field), problem.message);
    }
  }
}

void checkReach(TableReader& reader, const WallDef& wall) {
  double length = wall.bricksPerCourse * (wall.brick.size.x + wall.headJoint);
  double height = wall.courses * (wall.brick.size.y + wall.bedJoint + wall.disorder);
  Vec3 p = wall.position;
  double sideways = std::max(std::fabs(p.x), std::fabs(p.z)) + length, up = std::fabs(p.y) + height;
  if (!(sideways <= limits::kLargestCoordinate && up <= limits::kLargestCoordinate))
    reader.error(sideways > up ? "bricks" : "courses", "the wall reaches " + numberText(std::max(sideways, up)) +
                                                           " m from the origin, expected at most " +
                                                           numberText(limits::kLargestCoordinate) + " m");
}

}  // namespace

void readWalls(SceneBuild& build, TableReader& top) {
  std::size_t index = 0;
  for (TableReader& reader : top.tables("wall")) {
    SceneWall out;
    out.wall.name = build.nameOf(reader, "wall", index++);
    std::size_t before = build.context.diagnostics.size();
    readWallNumbers(reader, out);
    out.mortar = readOwnMortar(build, reader, out.foot);
    if (out.mortar && out.wall.disorder > 0)
      reader.error("disorder", "found " + numberText(out.wall.disorder) +
                                   " m in a mortared wall, expected 0: mortar joins faces that are parallel");
    std::vector<TableReader> openings = reader.tables("opening");
    out.place = placeOf(reader);
    for (TableReader& opening : openings) {
      readOpening(opening, out.wall.openings.emplace_back());
      out.openingPlaces.push_back(placeOf(opening));
    }
    if (build.context.diagnostics.size() == before) checkTogether(reader, openings, out.wall);
    if (build.context.diagnostics.size() == before) checkReach(reader, out.wall);
    if (build.context.diagnostics.size() == before) build.roomFor(reader, "courses", brickCount(out.wall));
    build.scene.walls.push_back(std::move(out));
  }
}

}  // namespace brickfall::scene
