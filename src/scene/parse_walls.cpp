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
  if (field == "higher" || field == "at") return field;
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

void readPiers(std::vector<TableReader>& tables, WallDef& wall) {
  for (TableReader& reader : tables) {
    Pier& pier = wall.piers.emplace_back();
    reader.number("at", pier.at);
    reader.number("width", pier.width);
    reader.number("depth", pier.depth);
    reader.integer("higher", pier.higher);
  }
}

void readCourse(TableReader& reader, SceneWall& out) {
  WallDef& wall = out.wall;
  reader.planPoints("path", wall.path);
  reader.boolean("closed", wall.closed);
  reader.number("radius", wall.radius);
  reader.number("arc_degrees", wall.arcDegrees);
  reader.number("gable_degrees", wall.gableDegrees);
  reader.numbers("gable_sides", wall.gableSides);
  reader.texts("tied_to", out.tiedTo);
  std::uint32_t colour = 0;
  if (reader.colour("colour", colour)) out.colour = colour;
  for (const auto& [key, given] : {std::pair{"path", !wall.path.empty()}, {"radius", wall.radius > 0}})
    if (given && reader.has("bricks"))
      reader.error("bricks", std::string("found beside ") + key + ", which sets the length, expected one of the two");
}

// The values together: only asked if each by itself is sound.
void checkTogether(TableReader& reader, std::vector<TableReader>& openings, std::vector<TableReader>& piers,
                   const WallDef& wall) {
  for (const WallProblem& problem : checkWall(wall)) {
    const bool ofPier = problem.field.starts_with("piers[");
    if (!ofPier && !problem.field.starts_with("openings[")) {
      reader.error(keyOfField(problem.field), problem.message);
      continue;
    }
    std::vector<TableReader>& tables = ofPier ? piers : openings;
    const std::string key = keyOfField(problem.field.substr(problem.field.find('.') + 1));
    // Without tables the pier is the wall: a [[pier]].
    TableReader& where =
        tables.empty() ? reader : tables[std::stoul(problem.field.substr(problem.field.find('[') + 1))];
    where.error(key, problem.message);
  }
}

void checkReach(TableReader& reader, const WallDef& wall) {
  double length = std::max(wall.bricksPerCourse * (wall.brick.size.x + wall.headJoint), wallLength(wall));
  double height = wall.courses * (wall.brick.size.y + wall.bedJoint + wall.disorder);
  Vec3 p = wall.position;
  double sideways = std::max(std::fabs(p.x), std::fabs(p.z)) + length, up = std::fabs(p.y) + height;
  if (!(sideways <= limits::kLargestCoordinate && up <= limits::kLargestCoordinate))
    reader.error(sideways > up ? "bricks" : "courses", "the wall reaches " + numberText(std::max(sideways, up)) +
                                                           " m from the origin, expected at most " +
                                                           numberText(limits::kLargestCoordinate) + " m");
}

struct SideOfWall {
  Vec3 origin, along, across;  // m, world; unit vectors
  double length = 0;
};

std::vector<SideOfWall> sidesOf(const WallDef& wall) {
  std::vector<Vec3> corners = wall.path;
  if (corners.empty()) corners = {Vec3{}, Vec3{wallLength(wall), 0, 0}};
  if (wall.closed) corners.push_back(corners[0]);
  std::vector<SideOfWall> sides;
  for (std::size_t k = 0; k + 1 < corners.size(); k++) {
    SideOfWall side;
    const Vec3 way = corners[k + 1] - corners[k];
    side.length = length(way);
    side.origin = wall.position + turned(corners[k], wall.yawDegrees);
    side.along = turned(way * (1 / side.length), wall.yawDegrees);
    side.across = cross(side.along, Vec3{0, 1, 0});
    sides.push_back(side);
  }
  return sides;
}

// One end of a wall at a side of another: how far it reaches into it, and what the other leaves out. False: it is elsewhere.
bool tieEnd(const WallDef& wall, Vec3 end, Vec3 outwards, double (&reach)[2], WallDef& other) {
  const double thickness = wallThickness(wall), into = wallThickness(other);
  const std::vector<SideOfWall> sides = sidesOf(other);
  for (std::size_t k = 0; k < sides.size(); k++) {
    const SideOfWall& side = sides[k];
    const double along = dot(end - side.origin, side.along);
    double across = dot(end - side.origin, side.across);
    const double facing = dot(outwards, side.across);
    if (std::fabs(dot(outwards, side.along)) > 0.01) continue;
    if (along < -0.5 * into - thickness || along > side.length + 0.5 * into + thickness) continue;
    if (facing < 0) across = -across;
    if (std::fabs(across) > 0.5 * into + wall.brick.size.x) continue;
    const double joint = std::max(wall.headJoint, other.headJoint), pitch = wall.brick.size.y + wall.bedJoint;
    const int first = int(std::floor((wall.position.y - other.position.y) / pitch + 0.5));
    const int gable = wall.gableDegrees > 0 ? 1000 : 0;
    LetIn in;
    in.side = int(k);
    in.from = along - 0.5 * thickness - joint;
    in.to = along + 0.5 * thickness + joint;
    in.firstCourse = std::max(0, first);
    in.endCourse = first + wall.courses + gable;
    in.parity = (1 + std::abs(first)) % 2;
    other.letIn.push_back(in);
    reach[0] = -0.5 * into - across - joint;
    reach[1] = 0.5 * into - across;
    return true;
  }
  return false;
}

// Its ends go into the walls that it names, where they meet them at right angles.
void tieWall(SceneBuild& build, TableReader& reader, std::size_t index) {
  SceneWall& own = build.scene.walls[index];
  WallDef& wall = own.wall;
  if (wall.closed || wall.radius > 0)
    return reader.error("tied_to", "found on a wall without ends, expected a straight wall or an open path");
  const std::vector<SideOfWall> sides = sidesOf(wall);
  const Vec3 start = sides.front().origin, end = sides.back().origin + sides.back().along * sides.back().length;
  for (const std::string& name : own.tiedTo) {
    SceneWall* other = nullptr;
    std::vector<std::string> names;
    for (SceneWall& one : build.scene.walls) {
      if (one.wall.name == name) other = &one;
      names.push_back(one.wall.name);
    }
    if (!other || other == &own)
      return reader.error("tied_to",
                          "found \"" + name + "\", expected the name of another wall" + didYouMean(name, names));
    const double pitch = wall.brick.size.y + wall.bedJoint, rise = (wall.position.y - other->wall.position.y) / pitch;
    const bool same = other->wall.brick.size.y == wall.brick.size.y && other->wall.bedJoint == wall.bedJoint &&
                      std::fabs(rise - std::floor(rise + 0.5)) < 1e-6 && other->wall.radius == 0;
    if (!same)
      return reader.error("tied_to", "found \"" + name +
                                         "\", whose courses lie at other heights or which is round, expected a "
                                         "straight wall or a path with the same bricks and beds");
    const bool atStart = tieEnd(wall, start, sides.front().along * -1.0, wall.startReach, other->wall);
    const bool atEnd = tieEnd(wall, end, sides.back().along, wall.endReach, other->wall);
    if (!atStart && !atEnd)
      reader.error("tied_to", "found neither end at \"" + name +
                                  "\", expected an end of its middle line in that wall, at right angles to it");
  }
  for (const WallProblem& problem : checkWall(wall)) reader.error("tied_to", problem.message);
}

}  // namespace

void readWalls(SceneBuild& build, TableReader& top) {
  std::size_t index = 0;
  std::vector<std::pair<std::size_t, TableReader*>> tied;
  std::vector<TableReader> tables = top.tables("wall");
  for (TableReader& reader : tables) {
    SceneWall out;
    out.wall.name = build.nameOf(reader, "wall", index++);
    std::size_t before = build.context.diagnostics.size();
    readWallNumbers(reader, out);
    out.mortar = readOwnMortar(build, reader, out.foot);
    if (out.mortar && out.wall.disorder > 0)
      reader.error("disorder", "found " + numberText(out.wall.disorder) +
                                   " m in a mortared wall, expected 0: mortar joins faces that are parallel");
    readCourse(reader, out);
    std::vector<TableReader> openings = reader.tables("opening"), piers = reader.tables("pier");
    readPiers(piers, out.wall);
    out.place = placeOf(reader);
    for (TableReader& opening : openings) {
      readOpening(opening, out.wall.openings.emplace_back());
      out.openingPlaces.push_back(placeOf(opening));
    }
    if (build.context.diagnostics.size() == before) checkTogether(reader, openings, piers, out.wall);
    if (build.context.diagnostics.size() == before) checkReach(reader, out.wall);
    if (build.context.diagnostics.size() == before) build.roomFor(reader, "courses", brickCount(out.wall));
    const bool sound = build.context.diagnostics.size() == before;
    build.scene.walls.push_back(std::move(out));
    if (sound && reader.has("tied_to")) tied.push_back({build.scene.walls.size() - 1, &reader});
  }
  for (const auto& [wall, reader] : tied) tieWall(build, *reader, wall);
}

// A pier by itself.
void readPiers(SceneBuild& build, TableReader& top) {
  std::size_t index = 0;
  for (TableReader& reader : top.tables("pier")) {
    SceneWall out;
    WallDef& wall = out.wall;
    wall.name = build.nameOf(reader, "pier", index++);
    const std::size_t before = build.context.diagnostics.size();
    wall.pierAlone = true;
    wall.headJoint = 0;
    Pier& pier = wall.piers.emplace_back();
    reader.number("width", pier.width);
    reader.number("depth", pier.depth);
    reader.integer("courses", wall.courses);
    BrickKind kind;
    if (reader.brick("brick", kind)) {
      wall.brick = kind.format;
      out.material = kind.material;
    }
    reader.number("head_joint", wall.headJoint);
    reader.number("bed_joint", wall.bedJoint);
    reader.vector("position", wall.position);
    reader.number("yaw_degrees", wall.yawDegrees);
    reader.material("material", out.material);
    reader.number("density_scatter", out.densityScatter);
    reader.number("disorder", wall.disorder);
    std::uint32_t colour = 0;
    if (reader.colour("colour", colour)) out.colour = colour;
    out.mortar = readOwnMortar(build, reader, out.foot);
    if (out.mortar && wall.disorder > 0)
      reader.error("disorder", "found it in mortar, expected 0: mortar joins faces that are parallel");
    out.place = placeOf(reader);
    std::vector<TableReader> none;
    if (build.context.diagnostics.size() == before) checkTogether(reader, none, none, wall);
    if (build.context.diagnostics.size() == before) checkReach(reader, wall);
    if (build.context.diagnostics.size() == before) build.roomFor(reader, "courses", brickCount(wall));
    build.scene.walls.push_back(std::move(out));
  }
}

}  // namespace brickfall::scene
