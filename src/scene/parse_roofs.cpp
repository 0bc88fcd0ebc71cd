// [[roof]]: trusses that lie on walls, and boards on them along the ridge.
#include <cmath>
#include <numbers>

#include "scene/scene_build.h"

namespace brickfall::scene {

namespace {

struct RoofDef {
  double length = 4, span = 3, pitch = 20 * kRadians, overhang = 0.15, inset = 0.3;
  double width = 0.05, height = 0.1, board = 0.025, nailForce = 0;
  int trusses = 4, boards = 8;
  Vec3 position;
  Quat yaw;
  SceneBody model;
};

// Boards on one slope: how far from the eaves they go, how wide they are, and where the middle of a rafter lies.
struct Slope {
  double sine, cosine;
  double reach;   // m, from the ridge to the eaves in plan
  double middle;  // m, height of a rafter's middle line over the ridge's foot point, at the eaves
  explicit Slope(const RoofDef& def) {
    sinCos(def.pitch, sine, cosine);
    reach = 0.5 * def.span + def.overhang;
    // A rafter's underside goes into the tie beam by half of it, over the wall's outer face.
    middle = 0.5 * def.height + 0.5 * def.height / cosine - def.overhang * sine / cosine;
  }
  // m along the slope that boards may take: those of both sides meet at the ridge.
  double boarded(const RoofDef& def) const { return reach / cosine - (0.5 * def.height + def.board) * sine / cosine; }
};

SceneBody truss(const RoofDef& def, const Slope& slope, int k) {
  SceneBody body = def.model;
  body.name += "/truss/" + std::to_string(k);
  const double first = -0.5 * def.length + def.inset, step = (def.length - 2 * def.inset) / (def.trusses - 1);
  body.def.position = def.position + rotate(def.yaw, Vec3{first + k * step, 0.5 * def.height, 0});
  body.def.rotation = def.yaw;
  ShapeDef tie;
  tie.halfExtents = {0.5 * def.width, 0.5 * def.height, 0.5 * def.span};
  body.def.shapes.push_back(tie);
  for (double side : {1.0, -1.0}) {
    ShapeDef rafter;
    rafter.halfExtents = {0.5 * def.width, 0.5 * def.height, 0.5 * slope.reach / slope.cosine};
    rafter.local.position = {0, slope.middle - 0.5 * def.height + 0.5 * slope.reach * slope.sine / slope.cosine,
                             0.5 * side * slope.reach};
    rafter.local.rotation = quatFromAxisAngle({1, 0, 0}, side * def.pitch);
    body.def.shapes.push_back(rafter);
  }
  return body;
}

SceneBody board(const RoofDef& def, const Slope& slope, double side, int k) {
  SceneBody body = def.model;
  body.name += (side > 0 ? "/front/" : "/back/") + std::to_string(k);
  constexpr double kGap = 0.004;  // of a board's width: neighbours do not touch
  const double wide = slope.boarded(def) / def.boards, along = (k + 0.5) * wide, over = 0.5 * (def.height + def.board);
  ShapeDef shape;
  shape.halfExtents = {0.5 * def.length + def.overhang, 0.5 * def.board, 0.5 * wide * (1 - kGap)};
  const Vec3 place{0, slope.middle + along * slope.sine + over * slope.cosine,
                   side * (slope.reach - along * slope.cosine + over * slope.sine)};
  body.def.shapes = {shape};
  body.def.position = def.position + rotate(def.yaw, place);
  body.def.rotation = normalized(def.yaw * quatFromAxisAngle({1, 0, 0}, side * def.pitch));
  return body;
}

void nail(const RoofDef& def, const SceneBody& truss, const SceneBody& board, SceneBuild& build) {
  SceneJoint joint;
  joint.name = board.name + " nail " + truss.name.substr(truss.name.find_last_of('/') + 1);
  joint.bodyA = truss.name;
  joint.bodyB = board.name;
  joint.place = def.model.place;
  joint.def.type = JointType::fixed;
  const double across = dot(truss.def.position - board.def.position, rotate(def.yaw, Vec3{1, 0, 0}));
  joint.def.anchor = board.def.position + rotate(def.yaw, Vec3{across, 0, 0});
  joint.def.breakForce = def.nailForce;
  joint.def.collide = true;
  build.scene.joints.push_back(std::move(joint));
}

void readRoof(TableReader& reader, RoofDef& def) {
  double pitch = 20, yaw = 0;
  reader.number("length", def.length);
  reader.number("span", def.span);
  reader.number("pitch_degrees", pitch);
  reader.number("overhang", def.overhang);
  reader.integer("trusses", def.trusses);
  reader.number("inset", def.inset);
  reader.pair("timber", def.width, def.height);
  reader.integer("boards", def.boards);
  reader.number("board_thickness", def.board);
  reader.number("nail_force", def.nailForce);
  reader.vector("position", def.position);
  reader.number("yaw_degrees", yaw);
  reader.material("material", def.model.material);
  readColour(reader, def.model);
  def.pitch = pitch * kRadians;
  def.yaw = quatFromAxisAngle({0, 1, 0}, yaw * kRadians);
}

}  // namespace

void readRoofs(SceneBuild& build, TableReader& top) {
  std::size_t index = 0;
  for (TableReader& reader : top.tables("roof")) {
    RoofDef def;
    const std::size_t before = build.context.diagnostics.size();
    def.model.name = build.nameOf(reader, "roof", index++);
    def.model.material = "wood";
    def.model.place = placeOf(reader);
    readRoof(reader, def);
    if (build.context.diagnostics.size() != before) continue;
    const Slope slope(def);
    const double room = (def.length - 2 * def.inset) / (def.trusses - 1);
    if (!(room > 1.2 * def.width))
      reader.error("trusses", "found trusses " + numberText(room) + " m from middle to middle, expected more than " +
                                  numberText(1.2 * def.width) + " m");
    if (!(slope.boarded(def) / def.boards > 2 * def.board))
      reader.error("boards", "found boards " + numberText(slope.boarded(def) / def.boards) +
                                 " m wide, expected more than twice their thickness");
    if (build.context.diagnostics.size() != before) continue;
    if (!build.roomFor(reader, "boards", def.trusses + 2 * def.boards)) continue;
    std::vector<SceneBody> trusses;
    for (int k = 0; k < def.trusses; k++) trusses.push_back(truss(def, slope, k));
    build.checkBuildable(reader, trusses[0]);
    for (const SceneBody& one : trusses) build.scene.bodies.push_back(one);
    for (double side : {1.0, -1.0})
      for (int k = 0; k < def.boards; k++) {
        const SceneBody one = board(def, slope, side, k);
        if (k == 0) build.checkBuildable(reader, one);
        for (const SceneBody& under : trusses)
          if (def.nailForce > 0) nail(def, under, one, build);
        build.scene.bodies.push_back(one);
      }
  }
}

}  // namespace brickfall::scene
