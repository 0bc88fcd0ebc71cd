// What other tables call by name: a body, a brick, or what many bodies are called after (a wall, an arch, a group).
#include <algorithm>

#include "scene/body_bounds.h"
#include "scene/scene_build.h"

namespace brickfall::scene {

namespace {

// m2, from a point to a box around a body.
double squaredTo(const Aabb& box, Vec3 point) { return lengthSquared(point - min(max(point, box.lower), box.upper)); }

// Those of the name itself, or of what has it before a slash: visit(name, middle, bounds). false: there is none.
template <class Visit> bool forEachNamed(const SceneBuild& build, const std::string& name, Visit visit) {
  const std::string inside = name + "/";
  bool found = false;
  for (const SceneBody& body : build.scene.bodies) {
    if (body.name != name && !body.name.starts_with(inside)) continue;
    visit(body.name, body.def.position, bodyBounds(body.def));
    found = true;
  }
  for (const SceneWall& wall : build.scene.walls) {
    const std::string& own = wall.wall.name;
    const bool whole = own == name || own.starts_with(inside);
    if (!whole && !name.starts_with(own + "/")) continue;
    const Result<std::vector<BrickPlacement>> bricks = layBricks(wall.wall, build.scene.seed);
    if (!bricks) found = found || whole;  // its own mistake is told
    for (std::size_t k = 0; bricks && k < bricks->size(); k++) {
      const BrickPlacement& brick = (*bricks)[k];
      if (!whole && brick.name != name) continue;
      BodyDef def;
      def.position = brick.centre;
      def.rotation = brick.rotation;
      def.shapes = shapesOf(brick);
      visit(brick.name, brick.centre, bodyBounds(def));
      found = true;
    }
  }
  return found;
}

}  // namespace

std::optional<Vec3> middleOf(SceneBuild& build, TableReader& reader, const char* key, const std::string& name) {
  Vec3 sum;
  int count = 0;
  const bool found = forEachNamed(build, name, [&](const std::string&, Vec3 middle, const Aabb&) {
    sum += middle;
    count++;
  });
  if (count > 0) return sum * (1.0 / count);
  std::vector<std::string> known;
  for (const auto& [one, line] : build.names) known.push_back(one);
  for (const SceneBody& body : build.scene.bodies) known.push_back(body.name);
  if (!found)
    reader.error(key,
                 "found \"" + name + "\", expected the name of a body, a wall, a group, ..." + didYouMean(name, known));
  return std::nullopt;
}

std::string nearestOf(const SceneBuild& build, const std::string& name, Vec3 point) {
  std::string nearest;
  double least = 0,
         leastMiddle = 0;  // of bodies that all have the point in their bounds, the one whose middle is nearest
  forEachNamed(build, name, [&](const std::string& one, Vec3 middle, const Aabb& bounds) {
    const double away = squaredTo(bounds, point), toMiddle = lengthSquared(middle - point);
    const bool nearer = nearest.empty() || away < least || (away == least && toMiddle < leastMiddle);
    if (!nearer) return;
    nearest = one;
    least = away;
    leastMiddle = toMiddle;
  });
  return nearest;
}

}  // namespace brickfall::scene
