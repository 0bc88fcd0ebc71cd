// [[dome]]: rings of wedge-shaped stones about a vertical axis, and a drum under them.
#include <cmath>
#include <numbers>

#include "scene/scene_build.h"

namespace brickfall::scene {

namespace {

struct DomeDef {
  int rings = 8, stones = 16, drumRings = 0;
  double radius = 1, thickness = 0.15, angle = std::numbers::pi / 2, oculus = 0;
  double drumHeight = 0.5, drumThickness = 0.15;
  Vec3 position;
  Quat yaw;
  SceneBody model;

  bool closed() const { return oculus == 0; }
  // The angle, from the crown, at which ring `r` begins, counted from the springing. A keystone is half as wide as the
  // rings, on either side of the crown.
  double from(int r) const {
    const double step = closed() ? angle / (rings + 0.5) : (angle - oculus) / rings;
    return angle - step * r;
  }
};

// One ring's stone, its corners turned so that its middle looks along +x: between two radii from the axis at its lower
// edge, and two at its upper one. Each face is flat: joints between rings are parts of planes through the centre.
struct RingStone {
  double lowerInner, lowerOuter, upperInner, upperOuter;      // m, from the axis
  double lowerInnerY, lowerOuterY, upperInnerY, upperOuterY;  // m, above the centre
};

RingStone stoneBetween(const DomeDef& def, double lower, double upper) {
  const double inner = def.radius - def.thickness / 2, outer = def.radius + def.thickness / 2;
  double sineL, cosineL, sineU, cosineU;
  sinCos(lower, sineL, cosineL);
  sinCos(upper, sineU, cosineU);
  return {inner * sineL,   outer * sineL,   inner * sineU,   outer * sineU,
          inner * cosineL, outer * cosineL, inner * cosineU, outer * cosineU};
}

// About a point `middle` from the axis, `height` above the centre.
ShapeDef wedgeOf(const RingStone& s, int stones, double middle, double height) {
  ShapeDef shape;
  shape.type = ShapeType::hull;
  double sine, cosine;
  sinCos(std::numbers::pi / stones, sine, cosine);
  for (auto [radius, y] : {std::pair(s.lowerInner, s.lowerInnerY), std::pair(s.lowerOuter, s.lowerOuterY),
                           std::pair(s.upperInner, s.upperInnerY), std::pair(s.upperOuter, s.upperOuterY)})
    for (double side : {-1.0, 1.0})
      shape.vertices.push_back({radius * cosine - middle, y - height, side * radius * sine});
  return shape;
}

// `upon`: of the dome's centre.
void layRing(const DomeDef& def, const std::string& name, const RingStone& stone, Vec3 upon, SceneBuild& build) {
  const double middle = (stone.lowerInner + stone.lowerOuter + stone.upperInner + stone.upperOuter) / 4;
  const double height = (stone.lowerInnerY + stone.lowerOuterY + stone.upperInnerY + stone.upperOuterY) / 4;
  const ShapeDef shape = wedgeOf(stone, def.stones, middle, height);
  for (int k = 0; k < def.stones; k++) {
    const Quat turn = def.yaw * quatFromAxisAngle({0, 1, 0}, 2 * std::numbers::pi * k / def.stones);
    SceneBody body = def.model;
    body.name = name + "/" + std::to_string(k);
    body.def.shapes = {shape};
    body.def.position = upon + rotate(turn, Vec3{middle, height, 0});
    body.def.rotation = normalized(turn);
    build.scene.bodies.push_back(std::move(body));
  }
}

void layKeystone(const DomeDef& def, Vec3 upon, SceneBuild& build) {
  double sine, cosine;
  sinCos(def.from(def.rings), sine, cosine);
  ShapeDef shape;
  shape.type = ShapeType::hull;
  for (int k = 0; k < def.stones; k++) {
    const Quat turn = quatFromAxisAngle({0, 1, 0}, 2 * std::numbers::pi * (k + 0.5) / def.stones);
    for (double radius : {def.radius - def.thickness / 2, def.radius + def.thickness / 2})
      shape.vertices.push_back(rotate(turn, Vec3{radius * sine, (radius - def.radius) * cosine, 0}));
  }
  SceneBody body = def.model;
  body.name += "/key";
  body.def.shapes = {shape};
  body.def.position = upon + Vec3{0, def.radius * cosine, 0};
  body.def.rotation = def.yaw;
  build.scene.bodies.push_back(std::move(body));
}

void layDome(const DomeDef& def, SceneBuild& build) {
  double sine, cosine;
  sinCos(def.angle, sine, cosine);
  const double drum = def.drumRings > 0 ? def.drumHeight : 0;
  const double middle = def.radius * sine, half = def.drumThickness / 2;
  for (int r = 0; r < def.drumRings; r++) {
    const double lower = drum * r / def.drumRings, upper = drum * (r + 1) / def.drumRings;
    layRing(def, def.model.name + "/drum/" + std::to_string(r),
            {middle - half, middle + half, middle - half, middle + half, lower, lower, upper, upper}, def.position,
            build);
  }
  // The foot stands with its inner edge at the drum's top, where it is not level.
  const Vec3 upon = def.position + Vec3{0, drum - (def.radius - def.thickness / 2) * cosine, 0};
  for (int r = 0; r < def.rings; r++)
    layRing(def, def.model.name + "/" + std::to_string(r), stoneBetween(def, def.from(r), def.from(r + 1)), upon,
            build);
  if (def.closed()) layKeystone(def, upon, build);
}

void readDome(TableReader& reader, DomeDef& def) {
  double degrees = 90, oculus = 0, yaw = 0;
  reader.integer("rings", def.rings);
  reader.integer("stones", def.stones);
  reader.number("radius", def.radius);
  reader.number("thickness", def.thickness);
  reader.number("angle_degrees", degrees);
  reader.number("oculus_degrees", oculus);
  reader.integer("drum_rings", def.drumRings);
  reader.number("drum_height", def.drumHeight);
  def.drumThickness = def.thickness;
  reader.number("drum_thickness", def.drumThickness);
  reader.vector("position", def.position);
  reader.number("yaw_degrees", yaw);
  reader.material("material", def.model.material);
  readColour(reader, def.model);
  def.angle = degrees * kRadians;
  def.oculus = oculus * kRadians;
  def.yaw = quatFromAxisAngle({0, 1, 0}, yaw * kRadians);
  if (!(def.thickness < 2 * def.radius))
    reader.error("thickness", "found " + numberText(def.thickness) +
                                  " m, expected less than twice the radius = " + numberText(2 * def.radius) + " m");
  if (!(oculus < degrees))
    reader.error("oculus_degrees",
                 "found " + numberText(oculus) + ", expected less than angle_degrees = " + numberText(degrees));
  if (def.drumRings > 0 && degrees < 90)
    reader.error("drum_rings", "found a drum under a dome of angle_degrees = " + numberText(degrees) +
                                   ", whose foot is not level, expected it only with 90");
  if (def.drumRings > 0 && !(def.drumThickness < 2 * def.radius))
    reader.error("drum_thickness", "found " + numberText(def.drumThickness) +
                                       " m, expected less than twice the radius = " + numberText(2 * def.radius) +
                                       " m");
}

}  // namespace

void readDomes(SceneBuild& build, TableReader& top) {
  std::size_t index = 0;
  for (TableReader& reader : top.tables("dome")) {
    DomeDef def;
    const std::size_t before = build.context.diagnostics.size();
    def.model.name = build.nameOf(reader, "dome", index++);
    def.model.material = "brick";
    def.model.place = placeOf(reader);
    readDome(reader, def);
    build.scene.masonryMaterials.insert(def.model.material);
    if (build.context.diagnostics.size() != before) continue;
    const std::size_t first = build.scene.bodies.size();
    const int all = def.stones * (def.rings + def.drumRings) + def.closed();
    if (!build.roomFor(reader, "stones", all)) continue;
    layDome(def, build);
    for (std::size_t k = first; k < build.scene.bodies.size() && build.context.diagnostics.size() == before; k++)
      if (k == first ||
          !(build.scene.bodies[k].def.shapes[0].vertices == build.scene.bodies[k - 1].def.shapes[0].vertices))
        build.checkBuildable(reader, build.scene.bodies[k]);
  }
}

}  // namespace brickfall::scene
