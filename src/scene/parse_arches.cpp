// [[arch]]: rings of wedge-shaped stones.
#include <array>
#include <cmath>
#include <numbers>

#include "scene/scene_build.h"

namespace brickfall::scene {

namespace {

struct ArchDef {
  int stones = 21;
  double radius = 1, thickness = 0.2, depth = 0.3, angle = std::numbers::pi;
  Vec3 position;
  Quat yaw;
  std::array<double, 2> block{};  // m, width and height from the centre up; 0: its outer side is round
  std::optional<MortarKind> mortar;
  bool foot = false;
  SceneBody model;
};

// Where the arch ends in a direction from its centre, m.
double reach(const ArchDef& def, double x, double y) {
  if (def.block[1] == 0) return def.radius + def.thickness / 2;
  const double aside = 0.5 * def.block[0], up = def.block[1];
  return std::fabs(x) * up > y * aside ? aside / std::fabs(x) : up / y;
}

// Stone k of a block, as it lies; in its own frame, in which stands the middle of an arch's stone.
ShapeDef blockStone(const ArchDef& def, int k, const Quat& turn) {
  std::vector<Vec3> outline;
  double last[2] = {};
  for (int end : {0, 1}) {
    double sine, cosine;
    sinCos(def.angle * (0.5 - double(k + end) / def.stones), sine, cosine);
    const double x = -sine, y = k + end == 0 || k + end == def.stones ? 0 : cosine, far = reach(def, x, y);
    outline.push_back(Vec3{x, y, 0} * (def.radius - def.thickness / 2));
    outline.push_back(Vec3{x, y, 0} * far);
    if (end == 1)
      for (double side : {-0.5, 0.5}) {
        const Vec3 corner{side * def.block[0], def.block[1], 0};
        const bool after = last[0] * corner.y - last[1] * corner.x<0, before = x * corner.y - y * corner.x> 0;
        if (after && before) outline.push_back(corner);
      }
    last[0] = x;
    last[1] = y;
  }
  ShapeDef shape;
  shape.type = ShapeType::hull;
  for (const Vec3 corner : outline)
    for (double front : {-0.5, 0.5})
      shape.vertices.push_back(rotate(conjugate(turn), corner) + Vec3{0, -def.radius, front * def.depth});
  return shape;
}

// A stone at the top: its joints are radial, its long faces flat.
ShapeDef wedgeOf(const ArchDef& def) {
  ShapeDef shape;
  shape.type = ShapeType::hull;
  double sine, cosine;
  sinCos(def.angle / def.stones / 2, sine, cosine);
  for (double radius : {def.radius - def.thickness / 2, def.radius + def.thickness / 2})
    for (double side : {-1.0, 1.0})
      for (double front : {-0.5, 0.5})
        shape.vertices.push_back({side * radius * sine, radius * cosine - def.radius, front * def.depth});
  return shape;
}

void layStones(const ArchDef& def, SceneBuild& build) {
  for (int k = 0; k < def.stones; k++) {
    // From the left foot to the right.
    const double angle = def.angle * (0.5 - (k + 0.5) / def.stones);
    const Quat turn = quatFromAxisAngle({0, 0, 1}, angle);
    SceneBody stone = def.model;
    stone.name += "/" + std::to_string(k);
    if (def.block[1] > 0) stone.def.shapes = {blockStone(def, k, turn)};
    stone.def.position = def.position + rotate(def.yaw, rotate(turn, Vec3{0, def.radius, 0}));
    stone.def.rotation = normalized(def.yaw * turn);
    build.scene.bodies.push_back(std::move(stone));
  }
}

// Between stones k and k + 1, on the face that is theirs; at the feet on what is found there.
void layArchMortar(const ArchDef& def, SceneBuild& build) {
  SceneMortar mortar;
  mortar.kind = *def.mortar;
  mortar.place = def.model.place;
  const auto stone = [&](int k) { return def.model.name + "/" + std::to_string(k); };
  for (int k = 0; k + 1 < def.stones; k++) {
    double sine, cosine;
    sinCos(def.angle * (0.5 - (k + 1.0) / def.stones), sine, cosine);
    const double far = reach(def, -sine, cosine);
    const Vec3 out = rotate(def.yaw, Vec3{-sine, cosine, 0}), along = rotate(def.yaw, Vec3{0, 0, 0.5 * def.depth});
    const Vec3 inner = def.position + out * (def.radius - 0.5 * def.thickness);
    const Vec3 outer = def.position + out * far;
    mortar.bodyA = stone(k);
    mortar.bodyB = stone(k + 1);
    mortar.outline = {inner - along, outer - along, outer + along, inner + along};
    build.scene.mortars.push_back(mortar);
  }
  mortar.outline.clear();
  mortar.bodyB.clear();
  for (int k : {0, def.stones - 1}) {
    mortar.bodyA = stone(k);
    if (def.foot) build.scene.mortars.push_back(mortar);
  }
}

void readBlock(TableReader& reader, ArchDef& def) {
  if (!reader.has("block")) return;
  reader.pair("block", def.block[0], def.block[1]);
  const double inner = def.radius - def.thickness / 2, least = std::min(0.5 * def.block[0], def.block[1]);
  if (!(least > inner))
    reader.error("block", "found " + numberText(def.block[0]) + " x " + numberText(def.block[1]) +
                              " m, expected more than " + numberText(2 * inner) + " x " + numberText(inner) +
                              " m: what the opening under the arch takes");
  if (def.angle != std::numbers::pi)
    reader.error("angle_degrees", "expected 180 where there is a block: it stands on its feet");
}

}  // namespace

void readArches(SceneBuild& build, TableReader& top) {
  std::size_t index = 0;
  for (TableReader& reader : top.tables("arch")) {
    ArchDef def;
    const std::size_t before = build.context.diagnostics.size();
    def.model.name = build.nameOf(reader, "arch", index++);
    def.model.material = "brick";
    def.model.place = placeOf(reader);
    double degrees = 180, yaw = 0;
    reader.integer("stones", def.stones);
    reader.number("radius", def.radius);
    reader.number("thickness", def.thickness);
    reader.number("depth", def.depth);
    reader.number("angle_degrees", degrees);
    reader.vector("position", def.position);
    reader.number("yaw_degrees", yaw);
    reader.material("material", def.model.material);
    readColour(reader, def.model);
    build.scene.masonryMaterials.insert(def.model.material);
    def.mortar = readOwnMortar(build, reader, def.foot);
    def.angle = degrees * kRadians;
    def.yaw = quatFromAxisAngle({0, 1, 0}, yaw * kRadians);
    if (!(def.thickness < 2 * def.radius))
      reader.error("thickness", "found " + numberText(def.thickness) +
                                    " m, expected less than twice the radius = " + numberText(2 * def.radius) + " m");
    if (!(def.angle / def.stones <= 0.5 * std::numbers::pi))
      reader.error("stones", "found stones of " + numberText(degrees / def.stones) + " degrees, expected at most 90");
    readBlock(reader, def);
    if (build.context.diagnostics.size() != before) continue;
    def.model.def.shapes = {wedgeOf(def)};
    build.checkBuildable(reader, def.model);
    if (build.context.diagnostics.size() == before && build.roomFor(reader, "stones", def.stones)) {
      layStones(def, build);
      if (def.mortar) layArchMortar(def, build);
    }
  }
}

}  // namespace brickfall::scene
