// [[joint]] and [[chain]].
#include <algorithm>
#include <cmath>

#include "scene/scene_build.h"

namespace brickfall::scene {

namespace {

const SceneBody* bodyNamed(const SceneBuild& build, const std::string& name) {
  for (const SceneBody& body : build.scene.bodies)
    if (body.name == name) return &body;
  return nullptr;
}

// Bricks have their names only when the wall is laid: those are asked for when the scene is built.
bool mayBeBrick(const SceneBuild& build, const std::string& name) {
  return std::any_of(build.scene.walls.begin(), build.scene.walls.end(),
                     [&](const SceneWall& wall) { return name.starts_with(wall.wall.name + "/"); });
}

// What a key does nothing with is refused.
bool reads(JointType type, std::string_view key) {
  const auto oneOf = [&](std::initializer_list<JointType> types) {
    return std::find(types.begin(), types.end(), type) != types.end();
  };
  using T = JointType;
  if (key == "axis" || key == "lower_degrees" || key == "upper_degrees")
    return oneOf({T::spherical, T::revolute}) || (key == "axis" && type == T::prismatic);
  if (key == "lower" || key == "upper") return type == T::prismatic;
  if (key == "cone_degrees") return type == T::spherical;
  if (key == "motor_speed" || key == "motor_strength") return oneOf({T::revolute, T::prismatic});
  if (key == "anchor_b" || key == "length") return oneOf({T::distance, T::rope, T::spring});
  if (key == "stiffness" || key == "damping") return type == T::spring;
  return true;
}

void readLimits(TableReader& reader, JointDef& def) {
  const bool way = def.type == JointType::prismatic;
  const char *lower = way ? "lower" : "lower_degrees", *upper = way ? "upper" : "upper_degrees";
  if (!reader.has(lower) && !reader.has(upper)) return;
  JointDef::Limit limit;
  reader.number(lower, limit.lower);
  reader.number(upper, limit.upper);
  if (!reader.has(lower) || !reader.has(upper))
    reader.error(reader.has(lower) ? lower : upper, "found one end of the range alone, expected both");
  if (!(limit.lower <= 0 && limit.upper >= 0))
    reader.error(limit.lower > 0 ? lower : upper,
                 "found a range without 0, expected the joint's place as it is made in it");
  const double unit = way ? 1 : kRadians;
  def.limit = {limit.lower * unit, limit.upper * unit};
}

void readJointNumbers(TableReader& reader, JointDef& def) {
  reader.vector("anchor", def.anchor);
  Vec3 other = def.anchor;
  if (reader.vector("anchor_b", other)) def.anchorB = other;
  if (reader.vector("axis", def.axis) && !(lengthSquared(def.axis) > 1e-12))
    reader.error("axis", "found a vector of length 0, expected the direction of an axis");
  readLimits(reader, def);
  double cone = 0, length = 0;
  if (reader.number("cone_degrees", cone)) def.cone = cone * kRadians;
  JointDef::Motor motor;
  const bool driven = reader.number("motor_speed", motor.speed);
  const bool strong = reader.number("motor_strength", motor.strength);
  if (driven != strong)
    reader.error(driven ? "motor_speed" : "motor_strength",
                 "found one of motor_speed and motor_strength alone, expected both");
  if (driven && strong) def.motor = motor;
  if (reader.number("length", length)) def.length = length;
  reader.number("stiffness", def.stiffness);
  reader.number("damping", def.damping);
}

void readBreaking(TableReader& reader, JointDef& def) {
  reader.number("break_force", def.breakForce);
  reader.number("break_torque", def.breakTorque);
}

// A stand-in of a body in the trial world.
BodyDef trialBody(const SceneBuild& build, const std::string& name) {
  BodyDef def;
  if (const SceneBody* body = bodyNamed(build, name)) def = body->def;
  if (def.shapes.empty()) def.shapes.resize(1);
  return def;
}

// What only the engine can tell of a joint, as an error at the table.
void checkJoinable(SceneBuild& build, TableReader& reader, const SceneJoint& joint) {
  if (!build.trial) build.trial = std::make_unique<World>(std::move(World::create({})).value());
  World& trial = *build.trial;
  JointDef def = joint.def;
  const Result<BodyId> a = trial.createBody(trialBody(build, joint.bodyA)),
                       b = trial.createBody(trialBody(build, joint.bodyB));
  if (a && b) {
    def.bodyA = *a;
    def.bodyB = *b;
    if (joint.bodyA == joint.bodyB) def.bodyB = *a;
    if (const Result<JointId> made = trial.createJoint(def); !made) reader.error("", made.error().message);
  }
  for (const Result<BodyId>& body : {a, b})
    if (body) (void)trial.destroyBody(*body).ok();
}

struct ChainDef {
  SceneBody link;
  std::string bodyA, bodyB;
  bool free = false;  // its end
  Vec3 from, to;
  int links = 10;
  bool boards = false;
  double radius = 0.02, thickness = 0.05, width = 0.5, sag = 0;
  bool hinged = false;
  Vec3 axis;
  double friction = 0;  // N m, of a hinge
  JointDef joint;

  Vec3 point(int k) const {
    const double s = double(k) / links;
    return from + (to - from) * s - Vec3{0, 4 * sag * s * (1 - s), 0};
  }
};

// The rotation with these columns.
Quat rotationOf(Vec3 x, Vec3 y, Vec3 z) {
  // Each component by its square; the largest is safe to divide by.
  const double w = 1 + x.x + y.y + z.z, i = 1 + x.x - y.y - z.z, j = 1 - x.x + y.y - z.z, k = 1 - x.x - y.y + z.z;
  const double most = std::max({w, i, j, k});
  if (most == w) return normalized(Quat{y.z - z.y, z.x - x.z, x.y - y.x, w});
  if (most == i) return normalized(Quat{i, x.y + y.x, z.x + x.z, y.z - z.y});
  if (most == j) return normalized(Quat{x.y + y.x, j, y.z + z.y, z.x - x.z});
  return normalized(Quat{z.x + x.z, y.z + z.y, k, x.y - y.x});
}

void layLinks(const ChainDef& def, SceneBuild& build) {
  for (int k = 0; k < def.links; k++) {
    const Vec3 begin = def.point(k), end = def.point(k + 1), along = normalized(end - begin);
    const Vec3 side = normalized(def.axis - along * dot(def.axis, along));
    SceneBody link = def.link;
    link.name += "/" + std::to_string(k);
    link.def.position = (begin + end) * 0.5;
    ShapeDef shape;
    if (def.boards) {
      shape.halfExtents = Vec3{length(end - begin), def.thickness, def.width} * 0.5;
      link.def.rotation = rotationOf(along, cross(side, along), side);
    } else {
      shape.type = ShapeType::capsule;
      shape.radius = def.radius;
      shape.halfHeight = 0.5 * length(end - begin) - def.radius;
      link.def.rotation = rotationOf(cross(along, side), along, side);
    }
    link.def.shapes = {shape};
    build.scene.bodies.push_back(std::move(link));
  }
  const auto nameOf = [&](int k) {
    if (k < 0) return def.bodyA;
    return k < def.links ? def.link.name + "/" + std::to_string(k) : def.bodyB;
  };
  for (int k = 0; k <= def.links - (def.free ? 1 : 0); k++) {
    SceneJoint joint{def.link.name + "." + std::to_string(k), nameOf(k - 1), nameOf(k), def.joint, def.link.place};
    joint.def.anchor = def.point(k);
    build.scene.joints.push_back(std::move(joint));
  }
}

void readChainNumbers(TableReader& reader, ChainDef& def) {
  reader.vector("from", def.from);
  reader.vector("to", def.to);
  reader.integer("links", def.links);
  reader.choice("link", def.boards);
  reader.number("radius", def.radius);
  reader.number("thickness", def.thickness);
  reader.number("width", def.width);
  reader.number("sag", def.sag);
  reader.material("material", def.link.material);
  def.hinged = reader.vector("hinge_axis", def.axis);
  reader.number("hinge_friction", def.friction);
  if (!def.hinged && def.friction > 0)
    reader.error("hinge_friction", "found on a chain of ball joints, expected hinge_axis, too");
  for (const char* key : {"thickness", "width"})
    if (!def.boards && reader.has(key)) reader.error(key, "found on links that are no boards, expected link \"board\"");
  if (def.boards && reader.has("radius")) reader.error("radius", "found on boards, expected thickness and width");
  readBreaking(reader, def.joint);
}

// What the numbers are together.
void checkChain(TableReader& reader, ChainDef& def) {
  const Vec3 way = def.to - def.from;
  if (!(length(way) / def.links >= 1e-3))
    return reader.error("to",
                        "found links of " + numberText(length(way) / def.links) + " m, expected at least 0.001 m");
  // Boards lie flat and rods have no side: any axis across will do for them.
  if (!def.hinged) def.axis = cross(way, Vec3{0, 1, 0});
  if (!def.hinged && !(length(def.axis) > 1e-6 * length(way))) def.axis = {0, 0, 1};
  for (int k = 0; k < def.links; k++) {
    const Vec3 part = def.point(k + 1) - def.point(k);
    if (!(length(cross(part, def.axis)) > 0.1 * length(part) * length(def.axis)))
      return reader.error("hinge_axis", "found one along the chain, expected one across it");
    if (!def.boards && !(length(part) > 2.01 * def.radius))
      return reader.error("radius", "found " + numberText(def.radius) + " m with links of " + numberText(length(part)) +
                                        " m, expected less than half of their length");
  }
  def.joint.type = def.hinged ? JointType::revolute : JointType::spherical;
  if (def.hinged) def.joint.axis = def.axis;
  if (def.hinged && def.friction > 0) def.joint.motor = JointDef::Motor{0, def.friction};
}

}  // namespace

bool readJoined(SceneBuild& build, TableReader& reader, const char* key, std::string& name, const Vec3* point) {
  if (!reader.text(key, name)) {
    if (reader.has(key)) return false;
    name = "ground";
  }
  if (bodyNamed(build, name) || mayBeBrick(build, name)) return true;
  if (const std::string nearest = point ? nearestOf(build, name, *point) : std::string(); !nearest.empty()) {
    name = nearest;
    return true;
  }
  std::vector<std::string> known;
  for (const SceneBody& body : build.scene.bodies) known.push_back(body.name);
  reader.error(key, reader.has(key) ? "found \"" + name + "\", expected the name of a body" + didYouMean(name, known)
                                    : std::string("not given, expected the name of a body: there is no ground"));
  return false;
}

void readJoints(SceneBuild& build, TableReader& top) {
  std::size_t index = 0;
  for (TableReader& reader : top.tables("joint")) {
    const std::size_t before = build.context.diagnostics.size();
    SceneJoint joint;
    joint.name = build.nameOf(reader, "joint", index++);
    joint.place = placeOf(reader);
    const bool known = !reader.has("type") || reader.choice("type", joint.def.type);
    for (const KeySpec& spec : keySpecs())
      if (known && std::string_view(spec.table) == "joint" && reader.has(spec.key) && !reads(joint.def.type, spec.key))
        reader.error(spec.key, "found a key that this type of joint does not have, expected it only with another type");
    readJointNumbers(reader, joint.def);
    readJoined(build, reader, "body_a", joint.bodyA, &joint.def.anchor);
    const Vec3 other = joint.def.anchorB.value_or(joint.def.anchor);
    if (reader.has("body_b"))
      readJoined(build, reader, "body_b", joint.bodyB, &other);
    else
      reader.text("body_b", joint.bodyB);  // says that it must be given
    readBreaking(reader, joint.def);
    reader.boolean("collide", joint.def.collide);
    if (build.context.diagnostics.size() == before) checkJoinable(build, reader, joint);
    build.scene.joints.push_back(std::move(joint));
  }
}

void readChains(SceneBuild& build, TableReader& top) {
  std::size_t index = 0;
  for (TableReader& reader : top.tables("chain")) {
    const std::size_t before = build.context.diagnostics.size();
    ChainDef def;
    def.link.name = build.nameOf(reader, "chain", index++);
    def.link.material = "steel";
    def.link.place = placeOf(reader);
    readChainNumbers(reader, def);
    readJoined(build, reader, "body_a", def.bodyA, &def.from);
    def.free = !reader.has("body_b");
    if (!def.free) readJoined(build, reader, "body_b", def.bodyB, &def.to);
    if (build.context.diagnostics.size() == before) checkChain(reader, def);
    if (build.context.diagnostics.size() == before && build.roomFor(reader, "links", def.links)) layLinks(def, build);
  }
}

}  // namespace brickfall::scene
