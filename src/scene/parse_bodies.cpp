// [[body]], [[body.part]] and [[ball]].
#include <algorithm>
#include <cmath>

#include "scene/scene_build.h"
#include "scene/shape_choices.h"

namespace brickfall::scene {

namespace {

// True if some four of the points span a tetrahedron that is not flat.
bool spansVolume(const std::vector<Vec3>& points) {
  Vec3 lower = points[0], upper = points[0];
  for (Vec3 p : points) lower = min(lower, p), upper = max(upper, p);
  double scale = length(upper - lower);
  if (!(scale > 0)) return false;
  Vec3 farthest = points[0], normal;
  for (Vec3 p : points)
    if (lengthSquared(p - points[0]) > lengthSquared(farthest - points[0])) farthest = p;
  for (Vec3 p : points) {
    Vec3 candidate = cross(farthest - points[0], p - points[0]);
    if (lengthSquared(candidate) > lengthSquared(normal)) normal = candidate;
  }
  double height = 0;
  for (Vec3 p : points) height = std::max(height, std::fabs(dot(normalized(normal), p - points[0])));
  return height > 1e-6 * scale && lengthSquared(normal) > 1e-12 * scale * scale * scale * scale;
}

constexpr const char* kShapeKeys[] = {"size", "radius", "height", "top_radius", "vertices", "file", "scale"};

bool hasKey(ShapeType shape, std::string_view key) {
  switch (shape) {
    case ShapeType::box:
      return key == "size";
    case ShapeType::sphere:
      return key == "radius";
    case ShapeType::capsule:
    case ShapeType::cylinder:
      return key == "radius" || key == "height";
    case ShapeType::cone:
      return key == "radius" || key == "height" || key == "top_radius";
    case ShapeType::hull:
      return key == "vertices";
    case ShapeType::mesh:
      return key == "file" || key == "scale";
    case ShapeType::plane:
      return false;
  }
  return false;
}

// A key that belongs to another shape than the one chosen would silently do nothing.
void refuseKeysOfOtherShapes(TableReader& reader, const ShapeChoice& shape) {
  for (const char* key : kShapeKeys)
    if (reader.has(key) && !hasKey(shape.type, key))
      reader.error(
          key, "found a key that a " + std::string(shape.name) + " does not have, expected it only with another shape");
}

}  // namespace

ShapeDef readShape(SceneBuild& build, TableReader& reader) {
  ShapeDef shape;
  int index = 0;
  bool known = !reader.has("shape") || reader.choice("shape", index);
  shape.type = kShapes[index].type;
  if (known) refuseKeysOfOtherShapes(reader, kShapes[index]);
  Vec3 size{1, 1, 1};
  double height = 1;
  reader.vector("size", size);
  reader.number("radius", shape.radius);
  reader.number("height", height);
  reader.number("top_radius", shape.topRadius);
  shape.halfExtents = size * 0.5;
  shape.halfHeight = height * 0.5;
  bool points = reader.points("vertices", shape.vertices);
  if (shape.type == ShapeType::mesh) shape.mesh = readMesh(build, reader);
  if (shape.type != ShapeType::hull) return shape;
  if (!reader.has("vertices"))
    reader.error("vertices", "not given, expected the points of the hull");
  else if (points && !spansVolume(shape.vertices))
    reader.error("vertices", "found points in one plane, expected points that span a volume");
  return shape;
}

namespace {

void readParts(SceneBuild& build, TableReader& reader, SceneBody& body) {
  std::vector<TableReader> parts = reader.tables("part");
  if (parts.empty()) {
    body.def.shapes.push_back(readShape(build, reader));
    return;
  }
  for (const char* key : {"shape", "size", "radius", "height", "top_radius", "vertices", "file", "scale"})
    if (reader.has(key)) reader.error(key, "found beside [[body.part]], expected the shape in the parts only");
  for (TableReader& part : parts) {
    ShapeDef shape = readShape(build, part);
    part.vector("position", shape.local.position);
    part.rotation("rotation_degrees", shape.local.rotation);
    std::string material = body.material;
    part.material("material", material);
    body.shapeMaterials.push_back(material);
    body.def.shapes.push_back(std::move(shape));
  }
}

// A ball with values of its own gets a material of its own.
void readBallMaterial(SceneBuild& build, TableReader& reader, SceneBody& ball) {
  reader.material("material", ball.material);
  MaterialDef own;
  for (const MaterialDef& material : build.scene.materials)
    if (material.name == ball.material) own = material;
  bool density = reader.number("density", own.material.density);
  bool friction = reader.number("friction", own.material.friction);
  bool restitution = reader.number("restitution", own.material.restitution);
  bool rolling = reader.number("rolling_resistance", own.material.rollingResistance);
  if (!density && !friction && !restitution && !rolling) return;
  own.name = ball.material + " of " + ball.name;
  ball.material = own.name;
  build.scene.materials.push_back(std::move(own));
}

}  // namespace

void readMotion(TableReader& reader, BodyDef& def) {
  reader.vector("velocity", def.linearVelocity);
  reader.vector("angular_velocity", def.angularVelocity);
  reader.number("gravity_scale", def.gravityScale);
  reader.number("linear_damping", def.linearDamping);
  reader.number("angular_damping", def.angularDamping);
  reader.number("drag_area", def.dragArea);
  reader.boolean("allow_sleep", def.allowSleep);
}

void readBodies(SceneBuild& build, TableReader& top) {
  std::size_t index = 0;
  for (TableReader& reader : top.tables("body")) {
    SceneBody body;
    body.place = placeOf(reader);
    std::size_t before = build.context.diagnostics.size();
    body.name = build.nameOf(reader, "body", index++);
    body.material = "brick";
    reader.choice("type", body.def.type);
    reader.material("material", body.material);
    readColour(reader, body);
    reader.vector("position", body.def.position);
    reader.rotation("rotation_degrees", body.def.rotation);
    readParts(build, reader, body);
    bool mesh = std::any_of(body.def.shapes.begin(), body.def.shapes.end(),
                            [](const ShapeDef& shape) { return shape.type == ShapeType::mesh; });
    if (mesh && body.def.type == BodyType::dynamic)
      reader.error("type", std::string(reader.has("type") ? "found" : "not given, which means") +
                               " \"dynamic\" on a body with a mesh, expected \"fixed\" or \"kinematic\"");
    readMotion(reader, body.def);
    bool moves = lengthSquared(body.def.linearVelocity) + lengthSquared(body.def.angularVelocity) > 0;
    if (body.def.type == BodyType::fixed && moves)
      reader.error(reader.has("velocity") ? "velocity" : "angular_velocity",
                   "found a velocity on a fixed body, expected type \"kinematic\" or \"dynamic\"");
    reader.vector("surface_velocity", body.def.surfaceVelocity);
    if (body.def.type == BodyType::dynamic && body.def.surfaceVelocity != Vec3{})
      reader.error("surface_velocity", "found one on a dynamic body, expected type \"fixed\" or \"kinematic\"");
    readLaunch(build, reader, body);
    readPath(reader, body);
    if (build.context.diagnostics.size() == before) build.checkBuildable(reader, body);
    build.roomFor(reader, "", std::int64_t(std::max<std::size_t>(1, body.shots.size())));
    build.scene.bodies.push_back(std::move(body));
  }
}

void readBalls(SceneBuild& build, TableReader& top) {
  std::size_t index = 0;
  for (TableReader& reader : top.tables("ball")) {
    SceneBody ball;
    ball.place = placeOf(reader);
    std::size_t before = build.context.diagnostics.size();
    ball.name = build.nameOf(reader, "ball", index++);
    ball.role = BodyRole::ball;
    ball.material = "steel";
    ShapeDef shape;
    shape.type = ShapeType::sphere;
    shape.radius = 0.1;
    reader.number("radius", shape.radius);
    readBallMaterial(build, reader, ball);
    readColour(reader, ball);
    reader.vector("position", ball.def.position);
    readMotion(reader, ball.def);
    readLaunch(build, reader, ball);
    ball.def.shapes.push_back(std::move(shape));
    if (build.context.diagnostics.size() == before) build.checkBuildable(reader, ball);
    build.roomFor(reader, "", std::int64_t(std::max<std::size_t>(1, ball.shots.size())));
    build.scene.bodies.push_back(std::move(ball));
  }
}

}  // namespace brickfall::scene
