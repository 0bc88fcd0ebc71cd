// Worlds, bodies and shapes: making and removing them.
#include <algorithm>
#include <atomic>
#include <span>

#include "brickfall/geometry/mesh_tree.h"
#include "geometry/mass_properties.h"
#include "world/checks.h"
#include "world/notes.h"
#include "world/solver_fields.h"
#include "world/world_impl.h"

namespace brickfall {

namespace {

void checkMesh(Checks& check, const std::string& at, const ShapeDef& s, BodyType type) {
  check.condition(type != BodyType::dynamic,
                  at + ".type: found a mesh on a dynamic body, expected BodyType::fixed or kinematic");
  check.condition(s.mesh != nullptr, at + ".mesh: found none, expected a MeshTree");
  if (check.failed()) return;
  check.vector(at + ".mesh.bounds.lower", s.mesh->bounds().lower, limits::kLargestSize);
  check.vector(at + ".mesh.bounds.upper", s.mesh->bounds().upper, limits::kLargestSize);
}

void checkShapeSize(Checks& check, const std::string& at, const ShapeDef& s, BodyType type) {
  checkMaterial(check, at + ".material", s.material);
  check.vector(at + ".local.position", s.local.position, limits::kLargestSize);
  check.rotation(at + ".local.rotation", s.local.rotation);
  switch (s.type) {
    case ShapeType::box:
      check.vector(at + ".halfExtents", s.halfExtents, limits::kSmallestSize, limits::kLargestSize);
      return;
    case ShapeType::cone:
      if (s.topRadius != 0) check.range(at + ".topRadius", s.topRadius, limits::kSmallestSize, limits::kLargestSize);
      [[fallthrough]];
    case ShapeType::cylinder:
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

void checkDistribution(Checks& check, const std::string& at, const ShapeDef& s) {
  check.condition(s.type == ShapeType::box || s.type == ShapeType::hull,
                  at + ": found one on another shape, expected a box or a hull");
  if (check.failed()) return;
  ShapeDef own = s;
  own.local = {};
  const std::string wrong = impossibleMass(*s.distribution, bounds(own, Transform{}));
  check.condition(wrong.empty(), at + "." + wrong + ", expected mass that can lie so in the shape");
}

void checkBody(Checks& check, const BodyDef& def) {
  check.condition(!def.shapes.empty(), "shapes: found none, expected at least one");
  check.condition(def.shapes.size() <= limits::kMostShapes, "shapes: found " + std::to_string(def.shapes.size()) +
                                                                ", expected at most " +
                                                                std::to_string(limits::kMostShapes));
  check.bodyType(def.type);
  check.vector("position", def.position, limits::kLargestCoordinate);
  check.rotation("rotation", def.rotation);
  check.vector("linearVelocity", def.linearVelocity, limits::kLargestSpeed);
  check.vector("angularVelocity", def.angularVelocity, limits::kLargestSpeed);
  checkMotionSettings(check, def.gravityScale, def.linearDamping, def.angularDamping, def.dragArea);
  check.vector("surfaceVelocity", def.surfaceVelocity, limits::kLargestSpeed);
  check.condition(def.type != BodyType::dynamic || def.surfaceVelocity == Vec3{},
                  "surfaceVelocity: found one on a dynamic body, expected BodyType::fixed or kinematic");
  for (std::size_t i = 0; i < def.shapes.size() && !check.failed(); i++)
    checkShape(check, "shapes[" + std::to_string(i) + "]", def.shapes[i], def.type);
  if (def.massProperties && !check.failed()) checkGivenMass(check, *def.massProperties, def.shapes);
}

double massOf(const BodyDef& def, const std::vector<std::unique_ptr<Hull>>& hulls) {
  if (def.massProperties) return def.massProperties->mass;
  double mass = 0;
  for (std::size_t i = 0; i < def.shapes.size(); i++)
    if (!def.shapes[i].sensor)
      mass += shapeMass(geometryOf(def.shapes[i], hulls[i].get()), def.shapes[i].material.density,
                        def.shapes[i].distribution.get())
                  .mass;
  return mass;
}

Result<BodyPlan> planned(const BodyDef& def) {
  Checks check;
  checkBody(check, def);
  BodyPlan plan;
  plan.def = &def;
  for (std::size_t i = 0; i < def.shapes.size() && !check.failed(); i++) {
    Result<std::unique_ptr<Hull>> hull = hullOf(def.shapes[i]);
    if (hull)
      plan.hulls.push_back(std::move(hull).value());
    else
      check.take({hull.error().code, "shapes[" + std::to_string(i) + "].vertices: " + hull.error().message});
  }
  // A body with a mesh never becomes dynamic: it may weigh nothing.
  bool hasMesh =
      std::any_of(def.shapes.begin(), def.shapes.end(), [](const ShapeDef& s) { return s.type == ShapeType::mesh; });
  if (!check.failed() && def.type != BodyType::fixed && !hasMesh) checkMass(check, massOf(def, plan.hulls));
  if (check.failed()) return check.error();
  return plan;
}

Error tooManyBodies(const std::string& call, int most) {
  return {ErrorCode::limitExceeded, call + ": the world has maxBodies = " + std::to_string(most) + " bodies"};
}

}  // namespace

void checkMaterial(Checks& check, const std::string& at, const Material& m) {
  check.above(at + ".density", m.density, 0, limits::kLargestDensity);
  check.range(at + ".friction", m.friction, 0, limits::kLargestFriction);
  check.range(at + ".restitution", m.restitution, 0, 1);
  check.range(at + ".rollingResistance", m.rollingResistance, 0, limits::kLargestFriction);
  check.range(at + ".hardness", m.hardness, limits::kLeastHardness, limits::kLargestHardness);
  auto checkRule = [&](const std::string& field, CombineRule rule) {
    check.condition(rule <= CombineRule::maximum,
                    field + ": found " + std::to_string(int(rule)) + ", expected a CombineRule");
  };
  checkRule(at + ".frictionRule", m.frictionRule);
  checkRule(at + ".restitutionRule", m.restitutionRule);
}

Status checkMaterial(const Material& material) {
  Checks check;
  checkMaterial(check, "material", material);
  return check.error();
}

void checkShape(Checks& check, const std::string& at, const ShapeDef& s, BodyType type) {
  checkShapeSize(check, at, s, type);
  if (s.distribution && !check.failed()) checkDistribution(check, at + ".distribution", s);
}

// A plane has no box around it: whatever is on it is fixed, and its mass is never read.
void checkGivenMass(Checks& check, const MassProperties& given, std::span<const ShapeDef> shapes) {
  check.range("massProperties.mass", given.mass, limits::kSmallestMass, limits::kLargestMass);
  check.vector("massProperties.centre", given.centre, limits::kLargestSize);
  if (check.failed()) return;
  Aabb around = bounds(shapes[0], Transform{});
  for (const ShapeDef& shape : shapes) around = merged(around, bounds(shape, Transform{}));
  const std::string wrong = impossibleMass(given, around);
  check.condition(wrong.empty(), "massProperties." + wrong + ", expected mass that can lie so in the body");
}

void checkMotionSettings(Checks& check, double gravityScale, double linearDamping, double angularDamping,
                         double dragArea) {
  check.range("gravityScale", gravityScale, -limits::kLargestGravityScale, limits::kLargestGravityScale);
  check.range("linearDamping", linearDamping, 0, limits::kLargestDamping);
  check.range("angularDamping", angularDamping, 0, limits::kLargestDamping);
  check.range("dragArea", dragArea, 0, limits::kLargestDragArea);
}

const char* versionString() { return BRICKFALL_VERSION; }

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
  return check.error();
}

Result<World> World::create(const WorldDef& def) {
  if (Status fine = checkWorld(def); !fine) return fine.error();
  static std::atomic<std::uint16_t> next{1};
  auto impl = std::make_unique<Impl>();
  impl->def = def;
  impl->registry.worldNumber = next++;
  if (impl->registry.worldNumber == 0) impl->registry.worldNumber = next++;
  impl->proximity.open(def.broadPhase, def.solver.contactMargin);
  impl->solve.memory.takeFrom(def.memory);
  impl->solve.workers = std::make_unique<WorkerPool>(def.threads, def.tasks);
  return World(std::move(impl));
}

Result<BodyId> World::createBody(const BodyDef& def) {
  Impl& w = *impl_;
  if (Status open = w.openForChange("createBody"); !open) return open.error();
  if (w.registry.bodies.count() >= w.def.maxBodies) return tooManyBodies("createBody", w.def.maxBodies);
  Result<BodyPlan> plan = planned(def);
  if (!plan) return plan.error();
  return w.registry.idOf(w.upkeep().create(std::move(plan).value()));
}

Status World::destroyBody(BodyId id) {
  Impl& w = *impl_;
  if (Status open = w.openForChange("destroyBody"); !open) return open;
  Result<BodyIndex> body = w.registry.find(id);
  if (!body) return body.error();
  noteTiesOf(*body, w.registry, w.ties, w.clock.stepCount);
  w.upkeep().destroy(*body);
  return {};
}

Result<std::vector<BodyId>> World::replaceBody(BodyId id, std::span<const BodyDef> pieces) {
  Impl& w = *impl_;
  Result<BodyIndex> body = w.openForChange(id, {});
  if (!body) return body.error();
  if (pieces.empty()) return Error{ErrorCode::invalidArgument, "pieces: found none, expected at least one"};
  if (pieces.size() > std::size_t(w.def.maxBodies - w.registry.bodies.count() + 1))
    return tooManyBodies("replaceBody", w.def.maxBodies);
  std::vector<BodyPlan> plans;
  for (std::size_t i = 0; i < pieces.size(); i++) {
    Result<BodyPlan> plan = planned(pieces[i]);
    if (!plan) return Error{plan.error().code, "pieces[" + std::to_string(i) + "]." + plan.error().message};
    plans.push_back(std::move(plan).value());
  }
  std::vector<BodyId> out;
  for (BodyIndex piece : w.upkeep().replace(*body, std::move(plans))) out.push_back(w.registry.idOf(piece));
  return out;
}

}  // namespace brickfall
