// Reading and changing bodies. Every setter checks first and changes nothing on an error.
#include <algorithm>
#include <string>

#include "world/checks.h"
#include "world/solver_fields.h"
#include "world/world_impl.h"

namespace brickfall {

namespace {

Error switchedOff(const std::string& call) {
  return {ErrorCode::wrongState, call + ": the body is switched off (setEnabled)"};
}

bool sameSolver(const SolverSettings& a, const SolverSettings& b) {
  std::vector<double> first, second;
  eachSetting(a, [&](auto, auto value, auto, auto) { first.push_back(double(value)); });
  eachSetting(b, [&](auto, auto value, auto, auto) { second.push_back(double(value)); });
  return first == second;
}

// Settings that were fixed when the world was made.
void checkKept(Checks& check, const WorldDef& now, const WorldDef& wanted) {
  const std::string end = ", as the world was made";
  check.condition(wanted.maxBodies == now.maxBodies, "maxBodies: found " + std::to_string(wanted.maxBodies) +
                                                         ", expected " + std::to_string(now.maxBodies) + end);
  check.condition(wanted.broadPhase == now.broadPhase,
                  "broadPhase: found " + std::string(broadPhaseName(wanted.broadPhase)) + ", expected " +
                      std::string(broadPhaseName(now.broadPhase)) + end);
  check.condition(wanted.tasks == now.tasks && wanted.memory == now.memory,
                  "tasks, memory: found others, expected those" + end);
  check.condition(wanted.solver.contactMargin == now.solver.contactMargin,
                  "solver.contactMargin: found " + numberText(wanted.solver.contactMargin) + ", expected " +
                      numberText(now.solver.contactMargin) + end);
}

// A body that never becomes dynamic may have any mass.
void checkMassWith(Checks& check, const Registry& registry, BodyIndex body, std::span<const Material> materials) {
  if (registry.bodies.data[body].type != BodyType::fixed && !registry.hasMesh(body))
    checkMass(check, registry.massWith(body, materials));
}

Checks forceCheck(Vec3 value, Vec3 point) {
  Checks check;
  check.vector("force", value, limits::kLargestPush);
  check.vector("pointWorld", point, limits::kLargestReach);
  return check;
}

}  // namespace

bool World::isValid(BodyId id) const { return impl_->registry.find(id).ok(); }

Result<BodyState> World::state(BodyId id) const {
  const Impl& w = *impl_;
  Result<BodyIndex> body = w.registry.find(id);
  if (!body) return body.error();
  const BodyData& data = w.registry.bodies.data[*body];
  const BodyMotion& m = w.registry.bodies.motion[*body];
  BodyState s;
  s.type = data.type;
  s.position = w.registry.bodies.origin(*body);
  s.rotation = m.rotation;
  s.centreOfMass = m.position;
  s.linearVelocity = m.linearVelocity;
  s.angularVelocity = m.angularVelocity;
  s.linearAcceleration = data.linearAcceleration;
  s.angularAcceleration = data.angularAcceleration;
  s.surfaceVelocity = data.surfaceVelocity;
  s.mass = w.registry.bodies.mass[*body].mass;
  s.awake = data.activity == BodyActivity::awake;
  s.enabled = data.enabled;
  s.locks = locksOf(data.locks);
  s.quarantined = data.quarantined;
  s.userData = data.userData;
  return s;
}

Result<MassProperties> World::massProperties(BodyId id) const {
  Result<BodyIndex> body = impl_->registry.find(id);
  if (!body) return body.error();
  return impl_->registry.bodies.data[*body].bodyFrameMass;
}

std::vector<BodyId> World::bodies() const {
  std::vector<BodyId> out;
  for (BodyIndex body : impl_->registry.bodies.inOrder()) out.push_back(impl_->registry.idOf(body));
  return out;
}

std::vector<ShapeId> World::shapes(BodyId id) const {
  std::vector<ShapeId> out;
  Result<BodyIndex> body = impl_->registry.find(id);
  if (!body) return out;
  for (ShapeIndex shape : impl_->registry.bodies.shapes[*body]) out.push_back(impl_->registry.idOfShape(shape));
  return out;
}

Result<ShapeDef> World::shape(ShapeId id) const {
  Result<ShapeIndex> shape = impl_->registry.find(id);
  if (!shape) return shape.error();
  return impl_->registry.shapes.data[*shape].def;
}

Status World::Impl::openForChange(const std::string& call) const {
  if (diary.inStep) return Error{ErrorCode::wrongState, call + ": the world is stepping"};
  if (visiting > 0)
    return Error{ErrorCode::wrongState, call + ": called from inside a callback of forEachContact, forEachIsland or " +
                                            "draw, expected after it has returned"};
  return {};
}

Result<BodyIndex> World::Impl::openForChange(BodyId id, const Error& bad) const {
  if (Status open = openForChange("body"); !open) return open.error();
  Result<BodyIndex> body = registry.find(id);
  if (!body) return body;
  if (bad.code != ErrorCode::none) return bad;
  if (registry.bodies.data[*body].quarantined)
    return Error{ErrorCode::wrongState, "body: it is quarantined; destroy it"};
  return body;
}

Status World::setType(BodyId id, BodyType type) {
  Impl& w = *impl_;
  Checks check;
  check.bodyType(type);
  Result<BodyIndex> body = w.openForChange(id, check.error());
  if (!body) return body.error();
  for (ShapeIndex shape : w.registry.bodies.shapes[*body])
    if (w.registry.shapes.data[shape].geometry.type == ShapeType::plane && type != BodyType::fixed)
      return Error{ErrorCode::invalidArgument, "type: a body with a plane stays BodyType::fixed"};
  bool hasMesh = w.registry.hasMesh(*body);
  if (hasMesh && type == BodyType::dynamic)
    return Error{ErrorCode::invalidArgument, "type: a body with a mesh stays BodyType::fixed or kinematic"};
  if (w.registry.bodies.data[*body].type == type) return {};
  if (type != BodyType::fixed && !hasMesh) {
    Checks mass;
    checkMass(mass, w.registry.bodies.data[*body].bodyFrameMass.mass);
    if (mass.failed()) return mass.error();
  }
  w.upkeep().setType(*body, type);
  return {};
}

Status World::setTransform(BodyId id, Vec3 position, Quat rotation) {
  Impl& w = *impl_;
  Checks check;
  check.vector("position", position, limits::kLargestCoordinate);
  check.rotation("rotation", rotation);
  Result<BodyIndex> body = w.openForChange(id, check.error());
  if (!body) return body.error();
  w.upkeep().setPose(*body, position, rotation);
  return {};
}

Status World::Impl::setVelocity(BodyId id, Vec3 velocity, Vec3 BodyMotion::*which, Vec3 BodyData::*last) {
  Checks check;
  check.vector("velocity", velocity, limits::kLargestSpeed);
  Result<BodyIndex> body = openForChange(id, check.error());
  if (!body) return body.error();
  if (registry.bodies.data[*body].type == BodyType::fixed)
    return Error{ErrorCode::wrongState, "velocity: the body is BodyType::fixed"};
  Upkeep keeper = upkeep();
  keeper.disturb(*body);
  registry.bodies.motion[*body].*which = velocity;
  // That of a kinematic body is a new speed of its way; of others a blow, and no acceleration.
  if (registry.bodies.data[*body].type == BodyType::dynamic) registry.bodies.data[*body].*last = velocity;
  registry.keepLocks(*body);
  keeper.relist(*body);
  return {};
}

Status World::setLinearVelocity(BodyId id, Vec3 velocity) {
  return impl_->setVelocity(id, velocity, &BodyMotion::linearVelocity, &BodyData::lastLinearVelocity);
}
Status World::setAngularVelocity(BodyId id, Vec3 velocity) {
  return impl_->setVelocity(id, velocity, &BodyMotion::angularVelocity, &BodyData::lastAngularVelocity);
}

// If `check` found nothing wrong with the arguments.
template <class Change> Status World::Impl::changeBody(BodyId id, const Checks& check, Change&& change) {
  Result<BodyIndex> body = openForChange(id, check.error());
  if (!body) return body.error();
  upkeep().disturb(*body);
  change(registry.bodies.data[*body]);
  return {};
}

Status World::setGravityScale(BodyId id, double scale) {
  Checks check;
  check.range("scale", scale, -limits::kLargestGravityScale, limits::kLargestGravityScale);
  return impl_->changeBody(id, check, [&](BodyData& data) { data.gravityScale = scale; });
}

Status World::setDamping(BodyId id, double linear, double angular) {
  Checks check;
  check.range("linear", linear, 0, limits::kLargestDamping);
  check.range("angular", angular, 0, limits::kLargestDamping);
  return impl_->changeBody(id, check, [&](BodyData& data) {
    data.linearDamping = linear;
    data.angularDamping = angular;
  });
}

Status World::setDragArea(BodyId id, double dragArea) {
  Checks check;
  check.range("dragArea", dragArea, 0, limits::kLargestDragArea);
  return impl_->changeBody(id, check, [&](BodyData& data) { data.dragArea = dragArea; });
}

Status World::setSurfaceVelocity(BodyId id, Vec3 velocity) {
  Checks check;
  check.vector("surfaceVelocity", velocity, limits::kLargestSpeed);
  Result<BodyIndex> body = impl_->openForChange(id, check.error());
  if (!body) return body.error();
  BodyData& data = impl_->registry.bodies.data[*body];
  if (data.type == BodyType::dynamic)
    return Error{ErrorCode::wrongState, "surfaceVelocity: the body is BodyType::dynamic"};
  if (data.surfaceVelocity == velocity) return {};
  impl_->upkeep().disturb(*body);
  data.surfaceVelocity = velocity;
  return {};
}

Status World::setMassProperties(BodyId id, const std::optional<MassProperties>& properties) {
  Impl& w = *impl_;
  Result<BodyIndex> body = w.openForChange(id, {});
  if (!body) return body.error();
  std::vector<ShapeDef> shapes;
  std::vector<Material> materials;
  for (ShapeIndex shape : w.registry.bodies.shapes[*body]) {
    shapes.push_back(w.registry.shapes.data[shape].def);
    materials.push_back(shapes.back().material);
  }
  Checks check;
  if (properties) {
    checkGivenMass(check, *properties, shapes);
  } else if (w.registry.bodies.data[*body].type != BodyType::fixed && !w.registry.hasMesh(*body)) {
    checkMass(check, w.registry.massOfShapes(*body, materials));
  }
  if (check.failed()) return check.error();
  w.upkeep().setMass(*body, properties);
  return {};
}

Status World::setLocks(BodyId id, const AxisLocks& locks) {
  Result<BodyIndex> body = impl_->openForChange(id, {});
  if (!body) return body.error();
  if (impl_->registry.bodies.data[*body].locks != lockBits(locks)) impl_->upkeep().setLocks(*body, lockBits(locks));
  return {};
}

Status World::setEnabled(BodyId id, bool enabled) {
  Result<BodyIndex> body = impl_->openForChange(id, {});
  if (!body) return body.error();
  if (impl_->registry.bodies.data[*body].enabled != enabled) impl_->upkeep().setEnabled(*body, enabled);
  return {};
}

Status World::setPreSolve(PreSolve callback) {
  Impl& w = *impl_;
  if (Status open = w.openForChange("setPreSolve"); !open) return open;
  if (w.preSolve) w.upkeep().wakeAll();  // what it changed lasts no longer
  for (Contact& contact : w.ties.contacts.contacts)
    if (contact.bodyA != kNoIndex) takeConstants(contact, w.registry.shapes, w.registry.bodies);
  w.preSolve = std::move(callback);
  return {};
}

Status World::setContactFilter(ContactFilter filter) {
  Impl& w = *impl_;
  if (Status open = w.openForChange("setContactFilter"); !open) return open;
  w.contactFilter = std::move(filter);
  w.askContactFilter();
  return {};
}

// Whatever asks, the world is closed for changes meanwhile.
void World::Impl::askContactFilter() {
  registry.shapes.asked = {};
  if (!contactFilter) return;
  registry.shapes.asked = [this](ShapeIndex a, ShapeIndex b) {
    Visit here(visiting);
    return contactFilter(registry.idOfShape(a), registry.idOfShape(b));
  };
}

Status World::setGravity(Vec3 gravity) {
  Checks check;
  check.vector("gravity", gravity, limits::kLargestGravity);
  if (Status open = impl_->openForChange("setGravity"); !open) return open;
  if (check.failed()) return check.error();
  impl_->def.gravity = gravity;
  impl_->loadsChanged();
  return {};
}

Vec3 World::gravity() const { return impl_->def.gravity; }

Status World::wake(BodyId id) {
  return impl_->changeBody(id, {}, [](BodyData&) {});
}

Status World::sleep(BodyId id) {
  Impl& w = *impl_;
  Result<BodyIndex> body = w.openForChange(id, {});
  if (!body) return body.error();
  if (w.registry.bodies.data[*body].type != BodyType::dynamic)
    return Error{ErrorCode::wrongState, "sleep: the body is not BodyType::dynamic"};
  if (!w.registry.bodies.data[*body].enabled) return switchedOff("sleep");
  for (IslandPointer& island : w.activity.islands.awake)
    if (std::binary_search(island->bodies.begin(), island->bodies.end(), *body)) island->restTime = w.def.sleepDelay;
  return {};
}

// Something that the balance of bodies depends on has changed: no body counts as resting by an earlier check.
void World::Impl::loadsChanged() {
  upkeep().wakeAll();
  for (BodyIndex body : activity.awake) registry.bodies.still[body] = 0;
}

const WorldDef& World::definition() const { return impl_->def; }

Status World::setDefinition(const WorldDef& def) {
  Impl& w = *impl_;
  if (Status open = w.openForChange("setDefinition"); !open) return open;
  if (Status fine = checkWorld(def); !fine) return fine;
  Checks check;
  checkKept(check, w.def, def);
  if (check.failed()) return check.error();
  const bool loads = def.gravity != w.def.gravity || def.airDensity != w.def.airDensity ||
                     def.integrator != w.def.integrator || !sameSolver(def.solver, w.def.solver);
  const bool sleepEnds = w.def.enableSleep && !def.enableSleep;
  if (def.threads != w.def.threads) w.solve.workers = std::make_unique<WorkerPool>(def.threads, def.tasks);
  w.def = def;
  if (loads || sleepEnds) w.loadsChanged();
  return {};
}

Status World::setMaterial(ShapeId id, const Material& material) {
  Impl& w = *impl_;
  if (Status open = w.openForChange("setMaterial"); !open) return open;
  Result<ShapeIndex> found = w.registry.find(id);
  if (!found) return found.error();
  const ShapeData& shape = w.registry.shapes.data[*found];
  Checks check;
  checkMaterial(check, "material", material);
  Result<BodyIndex> body = w.openForChange(w.registry.idOf(shape.body), check.error());
  if (!body) return body.error();
  std::vector<Material> materials;
  for (ShapeIndex part : w.registry.bodies.shapes[*body])
    materials.push_back(part == *found ? material : w.registry.shapes.data[part].def.material);
  checkMassWith(check, w.registry, *body, materials);
  if (check.failed()) return check.error();
  w.upkeep().setMaterial(*found, material);
  return {};
}

Status World::checkMaterials(BodyId id, std::span<const Material> materials) const {
  const Impl& w = *impl_;
  Checks check;
  for (std::size_t i = 0; i < materials.size() && !check.failed(); i++)
    checkMaterial(check, "materials[" + std::to_string(i) + "]", materials[i]);
  Result<BodyIndex> body = w.openForChange(id, check.error());
  if (!body) return body.error();
  const std::size_t shapes = w.registry.bodies.shapes[*body].size();
  check.condition(materials.size() == shapes, "materials: found " + std::to_string(materials.size()) + ", expected " +
                                                  std::to_string(shapes) + ", one for each shape");
  if (!check.failed()) checkMassWith(check, w.registry, *body, materials);
  return check.error();
}

// Force and torque about the centre of mass for the next step, or impulses at once.
Status World::Impl::push(BodyId id, Vec3 linear, Vec3 angular, Vec3* pointWorld, bool impulse) {
  Checks check = forceCheck(linear, pointWorld ? *pointWorld : Vec3{});
  check.vector("torque", angular, limits::kLargestPush);
  Result<BodyIndex> found = openForChange(id, check.error());
  if (!found) return found.error();
  BodyIndex body = *found;
  if (registry.bodies.data[body].type != BodyType::dynamic)
    return Error{ErrorCode::wrongState, "force: the body is not BodyType::dynamic"};
  if (!registry.bodies.data[body].enabled) return switchedOff("force");
  upkeep().disturb(body);
  BodyMotion& m = registry.bodies.motion[body];
  BodyData& data = registry.bodies.data[body];
  if (pointWorld) angular += cross(*pointWorld - m.position, linear);
  if (impulse) {
    Vec3 kick = registry.bodies.freeWay(body, linear * registry.bodies.mass[body].invMass),
         spin = registry.bodies.worldInvInertia(body) * angular;
    m.linearVelocity += kick;
    m.angularVelocity += spin;
    data.lastLinearVelocity += kick;
    data.lastAngularVelocity += spin;
  } else {
    activity.push(body);
    data.force += linear;
    data.torque += angular;
  }
  return {};
}

Status World::applyForce(BodyId body, Vec3 force) { return impl_->push(body, force, {}, nullptr, false); }
Status World::applyForceAtPoint(BodyId body, Vec3 force, Vec3 pointWorld) {
  return impl_->push(body, force, {}, &pointWorld, false);
}
Status World::applyTorque(BodyId body, Vec3 torque) { return impl_->push(body, {}, torque, nullptr, false); }
Status World::applyImpulse(BodyId body, Vec3 impulse) { return impl_->push(body, impulse, {}, nullptr, true); }
Status World::applyImpulseAtPoint(BodyId body, Vec3 impulse, Vec3 pointWorld) {
  return impl_->push(body, impulse, {}, &pointWorld, true);
}
Status World::applyAngularImpulse(BodyId body, Vec3 impulse) { return impl_->push(body, {}, impulse, nullptr, true); }

double World::time() const { return impl_->clock.time; }
std::uint64_t World::stepCount() const { return impl_->clock.stepCount; }
const Events& World::events() const { return impl_->diary.events; }

}  // namespace brickfall
