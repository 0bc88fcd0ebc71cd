// [[brick_kind]]: sizes and hollows of bricks.
#include <set>

#include "scene/scene_build.h"

namespace brickfall::scene {

namespace {

void readHollows(TableReader& reader, BrickFormat& format) {
  Frog frog;
  const bool frogged = reader.pair("frog", frog.length, frog.width);
  frog.floorLength = frog.length, frog.floorWidth = frog.width;
  reader.pair("frog_floor", frog.floorLength, frog.floorWidth);
  reader.number("frog_depth", frog.depth);
  if (reader.has("frog") != reader.has("frog_depth"))
    reader.error(reader.has("frog") ? "frog" : "frog_depth", "found one of frog and frog_depth, expected both");
  if (reader.has("frog_floor") && !reader.has("frog"))
    reader.error("frog_floor", "found a floor without a frog, expected `frog` and `frog_depth`");
  if (frogged) format.frog = frog;
  double along = 0, across = 0;
  Perforation holes;
  const bool perforated = reader.pair("holes", along, across);
  reader.number("hole_radius", holes.radius);
  if (reader.has("holes") != reader.has("hole_radius"))
    reader.error(reader.has("holes") ? "holes" : "hole_radius", "found one of holes and hole_radius, expected both");
  holes.along = int(along), holes.across = int(across);
  if (perforated) format.holes = holes;
}

// "brick.frog.length" -> "frog"
std::string keyOfHollow(const std::string& field) {
  if (field == "brick.frog.depth") return "frog_depth";
  if (field.starts_with("brick.frog.floor")) return "frog_floor";
  if (field.starts_with("brick.frog")) return "frog";
  return field == "brick.holes.radius" ? "hole_radius" : "holes";
}

}  // namespace

void readBrickKinds(SceneBuild& build, TableReader& top) {
  std::vector<BrickKind>& kinds = build.context.brickKinds;
  kinds = predefinedBricks();
  std::set<std::string> own;
  for (TableReader& reader : top.tables("brick_kind")) {
    BrickKind kind;
    const std::size_t before = reader.mistakes();
    if (!reader.text("name", kind.name)) continue;
    if (!own.insert(kind.name).second)
      reader.error("name", "found the name \"" + kind.name + "\" a second time, expected different names");
    reader.vector("size", kind.format.size);
    readHollows(reader, kind.format);
    reader.material("material", kind.material);
    if (reader.mistakes() == before) {
      WallDef wall;
      wall.brick = kind.format;
      for (const WallProblem& problem : checkWall(wall)) reader.error(keyOfHollow(problem.field), problem.message);
    }
    // One of a predefined name takes its place.
    std::erase_if(kinds, [&](const BrickKind& known) { return known.name == kind.name; });
    kinds.push_back(std::move(kind));
  }
}

}  // namespace brickfall::scene
