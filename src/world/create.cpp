// Worlds, bodies and shapes: making and removing them.
#include <algorithm>
#include <atomic>
#include <cmath>
#include <span>

#include "brickfall/geometry/mesh_tree.h"
#include "geometry/mass_properties.h"
#include "math/free_turn.h"
#include "world/checks.h"
#include "world/solver_fields.h"
#include "world/world_impl.h"

namespace brickfall {

namespace {

void checkMaterial(Checks& check, const std::string& at, const Material& m) {
  check.above(at + ".density", m.density, 0, limits::kLargestDensity);
  check.range(at + ".friction", m.friction, 0, limits::kLargestFriction);
  check.range(at + ".restitution", m.restitution, 0, 1);
  check.condition(m.frictionRule <= CombineRule::maximum,
                  at + ".frictionRule: found " + std::to_string(int(m.frictionRule)) + ", expected a CombineRule");
  check.condition(
      m.restitutionRule <= CombineRule::maximum,
      at + ".restitutionRule: found " + std::to_string(int(m.restitutionRule)) + ", expected a CombineRule");
}

void checkMesh(Checks& check, const std::string& at, const ShapeDef& s, BodyType type) {
  check.condition(type != BodyType::dynamic,
                  at + ".type: found a mesh on a dynamic body, expected BodyType::fixed or kinematic");
  check.condition(s.mesh != nullptr, at + ".mesh: found none, expected a MeshTree");
  if (check.failed()) return;
  check.vector(at + ".mesh.bounds.lower", s.mesh->bounds().lower, limits::kLargestSize);
  check.vector(at + ".mesh.bounds.upper", s.mesh->bounds().upper, limits::kLargestSize);
}

}  // namespace

void checkShape(Checks& check, const std::string& at, const ShapeDef& s, BodyType type) {
  checkMaterial(check, at + ".material", s.material);
  check.vector(at + ".local.position", s.local.position, limits::kLargestSize);
  check.rotation(at + ".local.rotation", s.local.rotation);
  switch (s.type) {
    case ShapeType::box:
      check.range(at + ".halfExtents.x", s.halfExtents.x, limits::kSmallestSize, limits::kLargestSize);
      check.range(at + ".halfExtents.y", s.halfExtents.y, limits::kSmallestSize, limits::kLargestSize);
      check.range(at + ".halfExtents.z", s.halfExtents.z, limits::kSmallestSize, limits::kLargestSize);
      return;
    case ShapeType::capsule:
      check.range(at + ".halfHeight", s.halfHeight, limits::kSmallestSize, limits::kLargestSize);
      [[fallthrough]];
    case ShapeType::sphere:
      check.range(at + ".radius", s.radius, limits::kSmallestSize, limits::kLargestSize);
      return;
    case ShapeType::hull:
      for (std::size_t i = 0; i < s.vertices.size() && !check.failed(); i++)
        check.vector(at + ".vertices[" + std::to_string(i) + "]", s.vertices[i], limits::kLargestSize);
      return;
    case ShapeType::plane:
      check.condition(type == BodyType::fixed,
                      at + ".type: found a plane on a body that can move, expected BodyType::fixed");
      return;
    case ShapeType::mesh:
      checkMesh(check, at, s, type);
      return;
  }
  check.condition(false, at + ".type: found " + std::to_string(int(s.type)) + ", expected a ShapeType");
}

void checkMotionSettings(Checks& check, double gravityScale, double linearDamping, double angularDamping,
                         double dragArea) {
  check.range("gravityScale", gravityScale, -limits::kLargestGravityScale, limits::kLargestGravityScale);
  check.range("linearDamping", linearDamping, 0, limits::kLargestDamping);
  check.range("angularDamping", angularDamping, 0, limits::kLargestDamping);
  check.range("dragArea", dragArea, 0, limits::kLargestDragArea);
}

namespace {

void checkBody(Checks& check, const BodyDef& def) {
  check.condition(!def.shapes.empty(), "shapes: found none, expected at least one");
  check.condition(def.shapes.size() <= limits::kMostShapes, "shapes: found " + std::to_string(def.shapes.size()) +
                                                                ", expected at most " +
                                                                std::to_string(limits::kMostShapes));
  check.condition(def.type == BodyType::fixed || def.type == BodyType::kinematic || def.type == BodyType::dynamic,
                  "type: found " + std::to_string(int(def.type)) + ", expected a BodyType");
  check.vector("position", def.position, limits::kLargestCoordinate);
  check.rotation("rotation", def.rotation);
  check.vector("linearVelocity", def.linearVelocity, limits::kLargestSpeed);
  check.vector("angularVelocity", def.angularVelocity, limits::kLargestSpeed);
  checkMotionSettings(check, def.gravityScale, def.linearDamping, def.angularDamping, def.dragArea);
  for (std::size_t i = 0; i < def.shapes.size() && !check.failed(); i++)
    checkShape(check, "shapes[" + std::to_string(i) + "]", def.shapes[i], def.type);
}

Shape geometryOf(const ShapeDef& def, const Hull* hull) {
  Shape g;
  g.type = def.type;
  g.halfExtents = def.halfExtents;
  g.radius = def.radius;
  g.halfHeight = def.halfHeight;
  g.hull = hull;
  g.mesh = def.mesh.get();
  return g;
}

double massOf(const BodyDef& def, const std::vector<std::unique_ptr<Hull>>& hulls) {
  double mass = 0;
  for (std::size_t i = 0; i < def.shapes.size(); i++)
    mass += shapeMass(geometryOf(def.shapes[i], hulls[i].get()), def.shapes[i].material.density).mass;
  return mass;
}

}  // namespace

World::World(std::unique_ptr<Impl> impl) : impl_(std::move(impl)) {}
World::World(World&&) noexcept = default;
World& World::operator=(World&&) noexcept = default;
World::~World() = default;

Status checkWorld(const WorldDef& def) {
  Checks check;
  check.vector("gravity", def.gravity, limits::kLargestGravity);
  check.range("airDensity", def.airDensity, 0, limits::kLargestAirDensity);
  check.above("sleepDelay", def.sleepDelay, 0, limits::kLongestDelay);
  check.range("hitEventSpeed", def.hitEventSpeed, 0, lost::kSpeed);
  check.range("hitEventImpulse", def.hitEventImpulse, 0, limits::kLargestPush);
  check.range("threads", def.threads, 1, limits::kMostThreads);
  check.range("maxBodies", def.maxBodies, 1, limits::kMostBodies);
  check.range("broadPhase", int(def.broadPhase), 0, kBroadPhaseMethodCount - 1);
  eachSetting(def.solver, [&](const char* name, auto value, auto least, auto most) {
    check.range(std::string("solver.") + name, value, least, most);
  });
  check.range("integrator", int(def.integrator), 0, kIntegratorCount - 1);
  return check.failed() ? Status(check.error()) : Status();
}

Result<World> World::create(const WorldDef& def) {
  if (Status fine = checkWorld(def); !fine) return fine.error();
  static std::atomic<std::uint16_t> next{1};
  auto impl = std::make_unique<Impl>();
  impl->def = def;
  impl->worldNumber = next++;
  if (impl->worldNumber == 0) impl->worldNumber = next++;
  impl->broadPhase = makeBroadPhase(def.broadPhase);
  impl->pool = std::make_unique<WorkerPool>(def.threads);
  return World(std::move(impl));
}

Result<BodyIndex> World::Impl::find(BodyId id) const {
  BodyIndex body = id.index - 1;
  if (id.index == 0) return Error{ErrorCode::staleId, "body: the id is null"};
  if (id.world != worldNumber) return Error{ErrorCode::staleId, "body: the id is of another world"};
  if (!bodies.alive(body) || bodies.data[body].generation != id.generation)
    return Error{ErrorCode::staleId, "body: id " + std::to_string(id.index) + " was destroyed"};
  return body;
}

Result<ShapeIndex> World::Impl::find(ShapeId id) const {
  ShapeIndex shape = id.index - 1;
  if (id.index == 0) return Error{ErrorCode::staleId, "shape: the id is null"};
  if (id.world != worldNumber) return Error{ErrorCode::staleId, "shape: the id is of another world"};
  if (!shapes.alive(shape) || shapes.data[shape].generation != id.generation)
    return Error{ErrorCode::staleId, "shape: id " + std::to_string(id.index) + " was destroyed"};
  return shape;
}

BodyId World::Impl::idOf(BodyIndex body) const { return {body + 1, bodies.data[body].generation, worldNumber}; }
ShapeId World::Impl::idOfShape(ShapeIndex shape) const {
  return {shape + 1, shapes.data[shape].generation, worldNumber};
}

// Mass, centre and radii from the shapes; keeps the body's origin where it is.
void World::Impl::updateMass(BodyIndex body, Vec3 origin) {
  BodyData& data = bodies.data[body];
  BodyMass& mass = bodies.mass[body];
  BodyMotion& m = bodies.motion[body];
  std::vector<MassProperties> parts;
  for (ShapeIndex shape : bodies.shapes[body]) {
    const ShapeData& s = shapes.data[shape];
    parts.push_back(transformed(shapeMass(s.geometry, s.def.material.density), s.def.local));
  }
  data.bodyFrameMass = combined(parts);
  data.localCentre = data.bodyFrameMass.mass > 0 ? data.bodyFrameMass.centre : Vec3{};
  m.position = origin + m.orientation * data.localCentre;
  mass = {};
  mass.innerRadius = 1e30;
  std::size_t part = 0;
  for (ShapeIndex shape : bodies.shapes[body]) {
    ShapeData& s = shapes.data[shape];
    s.inCentreFrame = {s.def.local.position - data.localCentre, s.def.local.rotation};
    s.middle = parts[part++].centre - data.localCentre;
    mass.innerRadius = std::min(mass.innerRadius, s.innerRadius);
    Vec3 centreInShape = transformPoint(inverse(s.inCentreFrame), Vec3{});
    mass.outerRadius = std::max(mass.outerRadius, outerRadius(s.geometry, centreInShape));
  }
  if (bodies.shapes[body].size() == 1) {
    const ShapeData& only = shapes.data[bodies.shapes[body][0]];
    mass.round = only.geometry.type == ShapeType::sphere;
    if (only.geometry.type == ShapeType::capsule) mass.symmetryAxis = rotate(only.def.local.rotation, Vec3{0, 1, 0});
  }
  if (data.type != BodyType::dynamic) return;
  mass.mass = data.bodyFrameMass.mass;
  mass.invMass = 1 / mass.mass;
  mass.inertia = data.bodyFrameMass.inertia;
  mass.invInertia = inverse(mass.inertia);
  PrincipalInertia principal = principalInertia(mass.inertia);
  mass.principalAxes = principal.axes;
  mass.principalInvInertia = principal.inverse;
  const Mat3& I = mass.inertia;
  double size = I.row[0].x, slack = 1e-9 * size;
  mass.isotropic = std::fabs(I.row[1].y - size) < slack && std::fabs(I.row[2].z - size) < slack &&
                   std::fabs(I.row[0].y) < slack && std::fabs(I.row[0].z) < slack && std::fabs(I.row[1].z) < slack;
}

void World::Impl::enlist(BodyIndex body) {
  auto insert = [&](std::vector<BodyIndex>& list) {
    list.insert(std::lower_bound(list.begin(), list.end(), body), body);
  };
  BodyData& data = bodies.data[body];
  data.activity = data.type == BodyType::dynamic ? BodyActivity::awake : BodyActivity::fixed;
  if (data.type == BodyType::dynamic) insert(awake);
  const BodyMotion& m = bodies.motion[body];
  bool moves = lengthSquared(m.linearVelocity) > 0 || lengthSquared(m.angularVelocity) > 0;
  bodies.still[body] = 0;
  if (data.type == BodyType::kinematic && moves) insert(moving);
  if (data.type != BodyType::dynamic) countAsMoved(body);
  membershipChanged = true;
}

// Its pairs are looked at in the next step, though neither side may move.
void World::Impl::countAsMoved(BodyIndex body) {
  bodies.still[body] = 0;
  auto place = std::lower_bound(unsettled.begin(), unsettled.end(), body);
  if (place == unsettled.end() || *place != body) unsettled.insert(place, body);
}

void World::Impl::delist(BodyIndex body) {
  std::erase(awake, body);
  std::erase(moving, body);
  std::erase(unsettled, body);
  std::erase(pushed, body);
  bodies.data[body].force = bodies.data[body].torque = {};
  bodies.still[body] = 1;
  bodies.data[body].activity = BodyActivity::fixed;
  membershipChanged = true;
}

Result<BodyId> World::createBody(const BodyDef& def) {
  Impl& w = *impl_;
  if (Status open = w.openForChange("createBody"); !open) return open.error();
  if (w.bodies.count() >= w.def.maxBodies)
    return Error{ErrorCode::limitExceeded,
                 "createBody: the world has maxBodies = " + std::to_string(w.def.maxBodies) + " bodies"};
  Checks check;
  checkBody(check, def);
  std::vector<std::unique_ptr<Hull>> hulls(def.shapes.size());
  for (std::size_t i = 0; i < def.shapes.size() && !check.failed(); i++) {
    if (def.shapes[i].type != ShapeType::hull) continue;
    Result<Hull> hull = buildHull(std::span<const Vec3>(def.shapes[i].vertices));
    if (hull)
      hulls[i] = std::make_unique<Hull>(std::move(hull).value());
    else
      check.take({hull.error().code, "shapes[" + std::to_string(i) + "].vertices: " + hull.error().message});
  }
  // A body with a mesh never becomes dynamic: it may weigh nothing.
  bool hasMesh =
      std::any_of(def.shapes.begin(), def.shapes.end(), [](const ShapeDef& s) { return s.type == ShapeType::mesh; });
  if (!check.failed() && def.type != BodyType::fixed && !hasMesh) checkMass(check, massOf(def, hulls));
  if (check.failed()) return check.error();

  BodyIndex body = w.bodies.create();
  BodyData& data = w.bodies.data[body];
  data.type = def.type;
  data.gravityScale = def.gravityScale;
  data.linearDamping = def.linearDamping;
  data.angularDamping = def.angularDamping;
  data.dragArea = def.dragArea;
  data.allowSleep = def.allowSleep;
  data.userData = def.userData;
  w.bodies.setRotation(body, normalized(def.rotation));
  if (def.type != BodyType::fixed) {
    w.bodies.motion[body].linearVelocity = data.lastLinearVelocity = def.linearVelocity;
    w.bodies.motion[body].angularVelocity = data.lastAngularVelocity = def.angularVelocity;
  }
  for (std::size_t i = 0; i < def.shapes.size(); i++) {
    ShapeIndex shape = w.shapes.create();
    ShapeData& s = w.shapes.data[shape];
    s.def = def.shapes[i];
    s.def.local.rotation = normalized(s.def.local.rotation);
    s.body = body;
    s.hull = std::move(hulls[i]);
    s.geometry = geometryOf(s.def, s.hull.get());
    s.innerRadius = innerRadius(s.geometry);
    w.bodies.shapes[body].push_back(shape);
  }
  w.updateMass(body, def.position);
  for (ShapeIndex shape : w.bodies.shapes[body]) w.addProxy(shape);
  w.enlist(body);
  w.dynamicBodies += def.type == BodyType::dynamic;
  return w.idOf(body);
}

void World::Impl::removeContactsOf(BodyIndex body) {
  wakeTouching(body);
  auto drop = [&](std::vector<CandidatePair>& list) {
    std::erase_if(list, [&](const CandidatePair& pair) {
      if (pair.bodyA != body && pair.bodyB != body) return false;
      if (pair.contact != kNoIndex) contacts.destroy(pair.contact);
      return true;
    });
  };
  drop(contacts.pairs);
  drop(contacts.asleep);
  std::erase_if(touchingBefore, [&](const auto& pair) {
    if (pair.first != body && pair.second != body) return false;
    BodyPair ordered = byCreation(pair);
    heard().end.push_back({idOf(ordered.first), idOf(ordered.second)});
    return true;
  });
  membershipChanged = true;
}

Status World::destroyBody(BodyId id) {
  Impl& w = *impl_;
  if (Status open = w.openForChange("destroyBody"); !open) return open;
  Result<BodyIndex> body = w.find(id);
  if (!body) return body.error();
  if (w.bodies.data[*body].activity == BodyActivity::asleep) w.wakeIslandOf(*body);
  w.removeContactsOf(*body);
  for (ShapeIndex shape : w.bodies.shapes[*body]) {
    if (w.shapes.data[shape].proxy != kNoProxy) w.broadPhase->remove(w.shapes.data[shape].proxy);
    w.shapes.destroy(shape);
  }
  w.delist(*body);
  w.forgetIslandsOf(*body);
  w.dynamicBodies -= w.bodies.data[*body].type == BodyType::dynamic;
  w.bodies.destroy(*body);
  return {};
}

// Islands name bodies by slot: those that name this one are built anew at the next step, the others are kept.
void World::Impl::forgetIslandsOf(BodyIndex body) {
  std::erase_if(islands.awake, [&](const IslandPointer& island) {
    return std::binary_search(island->bodies.begin(), island->bodies.end(), body) ||
           std::find(island->partners.begin(), island->partners.end(), body) != island->partners.end();
  });
  std::erase(islands.single, body);
  islandOf.clear();
  membershipChanged = true;
}

}  // namespace brickfall
