#include "world/registry.h"

#include <algorithm>
#include <cmath>

#include "brickfall/geometry/mesh_tree.h"
#include "dynamics/tie_ranges.h"
#include "geometry/frustum.h"
#include "geometry/mass_properties.h"
#include "math/free_turn.h"

namespace brickfall {

namespace {

template <class Set, class Id>
Result<std::uint32_t> findIn(const Set& set, Id id, std::uint16_t world, const std::string& kind) {
  return slotOf(id, world, kind,
                [&](std::uint32_t slot) { return set.alive(slot) && set.data[slot].generation == id.generation; });
}

// A quaternion of unit length to rounding stays as it is, so that a rotation that was read can be put back bit for bit.
Quat unitRotation(Quat q) {
  double square = q.x * q.x + q.y * q.y + q.z * q.z + q.w * q.w;
  return std::fabs(square - 1) < 1e-14 ? q : normalized(q);
}

void setGeometry(ShapeData& s, std::unique_ptr<Hull> hull) {
  s.hull = std::move(hull);
  s.geometry = geometryOf(s.def, s.hull.get());
  s.innerRadius = innerRadius(s.geometry);
}

void checkMotion(Findings& f, const BodyMotion& m, BodyIndex i) {
  f.expect(isFinite(m.position) && isFinite(m.rotation) && isFinite(m.linearVelocity) && isFinite(m.angularVelocity),
           "body", i, "not finite");
  f.expect(ties::hasUnitLength(m.rotation), "body", i, "its quaternion is not of unit length");
}

// A slot whose generations are used up is neither alive nor free.
template <class Data> bool isFree(const Data& d) { return !d.alive && d.generation != 0xffff; }

}  // namespace

Result<BodyIndex> Registry::find(BodyId id) const { return findIn(bodies, id, worldNumber, "body"); }
Result<ShapeIndex> Registry::find(ShapeId id) const { return findIn(shapes, id, worldNumber, "shape"); }

Result<std::unique_ptr<Hull>> hullOf(const ShapeDef& def) {
  if (def.type != ShapeType::hull) return std::unique_ptr<Hull>();
  Result<Hull> hull = buildHull(std::span<const Vec3>(def.vertices));
  if (!hull) return hull.error();
  return std::make_unique<Hull>(std::move(hull).value());
}

Shape geometryOf(const ShapeDef& def, const Hull* hull) {
  Shape g;
  g.type = def.type;
  g.halfExtents = def.halfExtents;
  g.radius = def.radius;
  g.topRadius = def.topRadius;
  g.halfHeight = def.halfHeight;
  g.hull = hull;
  g.mesh = def.mesh.get();
  return g;
}

BodyIndex Registry::add(BodyPlan&& plan) {
  const BodyDef& def = *plan.def;
  BodyIndex body = bodies.create();
  BodyData& data = bodies.data[body];
  data.type = def.type;
  data.gravityScale = def.gravityScale;
  data.linearDamping = def.linearDamping;
  data.angularDamping = def.angularDamping;
  data.dragArea = def.dragArea;
  data.surfaceVelocity = def.surfaceVelocity;
  data.allowSleep = def.allowSleep;
  data.enabled = def.enabled;
  data.locks = lockBits(def.locks);
  data.userData = def.userData;
  data.givenMass = def.massProperties;
  bodies.setRotation(body, normalized(def.rotation));
  if (def.type != BodyType::fixed) {
    bodies.motion[body].linearVelocity = data.lastLinearVelocity = def.linearVelocity;
    bodies.motion[body].angularVelocity = data.lastAngularVelocity = def.angularVelocity;
  }
  for (std::size_t i = 0; i < def.shapes.size(); i++) {
    ShapeIndex shape = shapes.create();
    ShapeData& s = shapes.data[shape];
    s.def = def.shapes[i];
    s.def.local.rotation = normalized(s.def.local.rotation);
    s.body = body;
    setGeometry(s, std::move(plan.hulls[i]));
    bodies.shapes[body].push_back(shape);
    if (s.def.sensor) insertAscending(sensors, shape);
  }
  updateMass(body, def.position);
  keepLocks(body);
  dynamicBodies += def.type == BodyType::dynamic;
  return body;
}

void Registry::remove(BodyIndex body) {
  for (ShapeIndex shape : bodies.shapes[body]) {
    if (shapes.data[shape].def.sensor) std::erase(sensors, shape);
    shapes.destroy(shape);
  }
  dynamicBodies -= bodies.data[body].type == BodyType::dynamic;
  bodies.destroy(body);
}

void Registry::setType(BodyIndex body, BodyType type) {
  Vec3 origin = bodies.origin(body);
  dynamicBodies += (type == BodyType::dynamic) - (bodies.data[body].type == BodyType::dynamic);
  bodies.data[body].type = type;
  if (type == BodyType::dynamic) bodies.data[body].surfaceVelocity = {};
  if (type == BodyType::fixed) bodies.motion[body].linearVelocity = bodies.motion[body].angularVelocity = {};
  if (type != BodyType::kinematic) {
    bodies.data[body].usualChange = 0;
    bodies.data[body].lastLinearVelocity = bodies.motion[body].linearVelocity;
    bodies.data[body].lastAngularVelocity = bodies.motion[body].angularVelocity;
  }
  updateMass(body, origin);
  keepLocks(body);
}

void Registry::setLocks(BodyIndex body, std::uint8_t locks) {
  bodies.data[body].locks = locks;
  if (bodies.data[body].type == BodyType::dynamic) bodies.mass[body].locks = locks;
  keepLocks(body);
}

void Registry::keepLocks(BodyIndex body) {
  BodyMotion& m = bodies.motion[body];
  BodyData& data = bodies.data[body];
  for (Vec3* v : {&m.linearVelocity, &data.lastLinearVelocity}) *v = bodies.freeWay(body, *v);
  for (Vec3* v : {&m.angularVelocity, &data.lastAngularVelocity}) *v = bodies.freeTurn(body, *v);
  if (bodies.mass[body].locks != 0) data.steady = {};
}

void Registry::setPose(BodyIndex body, Vec3 position, Quat rotation) {
  bodies.setRotation(body, unitRotation(rotation));
  bodies.motion[body].position = position + bodies.motion[body].orientation * bodies.data[body].localCentre;
}

bool Registry::setMaterial(ShapeIndex shape, const Material& material) {
  ShapeData& s = shapes.data[shape];
  const bool densityChanged = s.def.material.density != material.density;
  s.def.material = material;
  return densityChanged && renewMass(s.body);
}

bool Registry::renewMass(BodyIndex body) {
  const Vec3 centre = bodies.data[body].localCentre;
  const Vec3 place = bodies.motion[body].position;
  updateMass(body, bodies.origin(body));
  if (bodies.data[body].localCentre != centre) return true;
  bodies.motion[body].position = place;  // bit for bit
  return false;
}

bool Registry::setMass(BodyIndex body, const std::optional<MassProperties>& given) {
  bodies.data[body].givenMass = given;
  return renewMass(body);
}

double Registry::massWith(BodyIndex body, std::span<const Material> materials) const {
  const auto& given = bodies.data[body].givenMass;
  return given ? given->mass : massOfShapes(body, materials);
}

double Registry::massOfShapes(BodyIndex body, std::span<const Material> materials) const {
  double mass = 0;
  for (std::size_t i = 0; i < materials.size(); i++) {
    const ShapeData& s = shapes.data[bodies.shapes[body][i]];
    if (s.def.sensor) continue;
    mass += shapeMass(s.geometry, materials[i].density, s.def.distribution.get()).mass;
  }
  return mass;
}

bool Registry::hasMesh(BodyIndex body) const {
  return std::any_of(bodies.shapes[body].begin(), bodies.shapes[body].end(),
                     [&](ShapeIndex shape) { return shapes.data[shape].geometry.type == ShapeType::mesh; });
}

bool Registry::mayMeet(ShapeIndex a, ShapeIndex b) const {
  const ShapeData &first = shapes.data[a], &second = shapes.data[b];
  if (first.body == second.body) return false;
  if (bodies.data[first.body].type != BodyType::dynamic && bodies.data[second.body].type != BodyType::dynamic)
    return false;
  return shapes.mayTouch(a, b);
}

// Mass, centre and radii from the shapes; keeps the body's origin where it is.
void Registry::updateMass(BodyIndex body, Vec3 origin) {
  BodyData& data = bodies.data[body];
  BodyMass& mass = bodies.mass[body];
  BodyMotion& m = bodies.motion[body];
  std::vector<MassProperties> parts, solid;  // of all shapes; without sensors, which weigh nothing
  for (ShapeIndex shape : bodies.shapes[body]) {
    const ShapeData& s = shapes.data[shape];
    parts.push_back(transformed(shapeMass(s.geometry, s.def.material.density, s.def.distribution.get()), s.def.local));
    if (!s.def.sensor) solid.push_back(parts.back());
  }
  data.bodyFrameMass = data.givenMass ? *data.givenMass : combined(solid);
  data.localCentre = data.bodyFrameMass.mass > 0 ? data.bodyFrameMass.centre : Vec3{};
  m.position = origin + m.orientation * data.localCentre;
  mass = {};
  mass.innerRadius = 1e30;
  std::size_t part = 0;
  for (ShapeIndex shape : bodies.shapes[body]) {
    ShapeData& s = shapes.data[shape];
    s.inCentreFrame = {s.def.local.position - data.localCentre, s.def.local.rotation};
    // Of the solid shape, wherever the mass lies in it.
    const Vec3 middle =
        s.def.distribution ? transformPoint(s.def.local, shapeMass(s.geometry, 1).centre) : parts[part].centre;
    part++;
    s.middle = middle - data.localCentre;
    if (s.def.sensor && !solid.empty()) continue;
    mass.innerRadius = std::min(mass.innerRadius, s.innerRadius);
    Vec3 centreInShape = transformPoint(inverse(s.inCentreFrame), Vec3{});
    mass.outerRadius = std::max(mass.outerRadius, outerRadius(s.geometry, centreInShape));
  }
  if (bodies.shapes[body].size() == 1) {
    const ShapeData& only = shapes.data[bodies.shapes[body][0]];
    mass.round = only.geometry.type == ShapeType::sphere;
    const ShapeType type = only.geometry.type;
    const bool turned = type == ShapeType::capsule || isFrustum(type);
    mass.rims = isFrustum(type);
    if (turned) mass.symmetryAxis = rotate(only.def.local.rotation, Vec3{0, 1, 0});
  }
  if (data.type != BodyType::dynamic) return;
  mass.locks = data.locks;
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

Status Registry::rebuild() {
  for (ShapeIndex i = 0; i < shapes.slots(); i++)
    if (shapes.alive(i) && shapes.data[i].def.sensor) sensors.push_back(i);
  for (ShapeData& s : shapes.data) {
    if (!s.alive) continue;
    Result<std::unique_ptr<Hull>> hull = hullOf(s.def);
    if (!hull) return Error{ErrorCode::badFormat, "a hull can't be built: " + hull.error().message};
    setGeometry(s, std::move(hull).value());
  }
  for (BodyIndex i = 0; i < bodies.slots(); i++) {
    if (!bodies.alive(i)) continue;
    bodies.setRotation(i, bodies.motion[i].rotation);
    Vec3 centre = bodies.motion[i].position;
    updateMass(i, {});
    bodies.motion[i].position = centre;
  }
  return {};
}

void Registry::checkStructure(Findings& f) const {
  std::size_t n = bodies.data.size(), m = shapes.data.size();
  f.expect(
      bodies.motion.size() == n && bodies.mass.size() == n && bodies.shapes.size() == n && bodies.still.size() == n,
      "bodies: lists of different lengths");
  if (f.any()) return;
  int alive = 0, dynamic = 0;
  for (std::size_t i = 0; i < n; i++) {
    const BodyData& d = bodies.data[i];
    alive += d.alive;
    dynamic += d.alive && d.type == BodyType::dynamic;
    if (!d.alive) continue;
    f.expect(d.type <= BodyType::dynamic && d.activity <= BodyActivity::fixed, "body", i, "unknown type");
    f.expect(!bodies.shapes[i].empty(), "body", i, "no shapes");
    for (ShapeIndex s : bodies.shapes[i])
      f.expect(s < m && shapes.data[s].alive && shapes.data[s].body == i, "body", i, "a shape is not its own");
  }
  f.expect(alive == bodies.count(), "bodies: wrong count");
  f.expect(dynamic == dynamicBodies, "bodies: wrong count of dynamic ones");
  for (std::size_t i = 0; i < m; i++) {
    const ShapeData& s = shapes.data[i];
    if (!s.alive) continue;
    bool owned = s.body < n && bodies.data[s.body].alive && int(s.def.type) < kShapeTypeCount;
    bool mesh = s.def.type == ShapeType::mesh;
    f.expect(owned && (!mesh || (s.def.mesh && bodies.data[s.body].type != BodyType::dynamic)), "shape", i,
             "of no body");
  }
  for (BodyIndex b : bodies.unused()) f.expect(b < n && !bodies.data[b].alive, "bodies: a free slot that is not free");
  for (ShapeIndex s : shapes.unused()) f.expect(s < m && !shapes.data[s].alive, "shapes: a free slot that is not free");
}

void Registry::check(Findings& f) const {
  checkFreeSlots(f, bodies.unused(), bodies.slots(), [&](std::size_t i) { return isFree(bodies.data[i]); });
  checkFreeSlots(f, shapes.unused(), shapes.slots(), [&](std::size_t i) { return isFree(shapes.data[i]); });
  std::vector<std::uint64_t> orders;
  std::vector<bool> seen(shapes.slots(), false);
  std::size_t alive = 0, listed = 0;
  for (const ShapeData& shape : shapes.data) alive += shape.alive;
  for (BodyIndex i = 0; i < bodies.slots(); i++) {
    const BodyData& d = bodies.data[i];
    f.expect(bodies.still[i] <= 1, "bodies: still is neither 0 nor 1");
    f.expect(d.alive || bodies.shapes[i].empty(), "bodies: a free slot has shapes");
    if (!d.alive) continue;
    orders.push_back(d.order);
    f.expect(d.order > 0 && d.order < bodies.nextOrder(), "bodies: an order of creation that was not given yet");
    const BodyMotion& m = bodies.motion[i];
    checkMotion(f, m, i);
    bool rests = m.linearVelocity == Vec3{} && m.angularVelocity == Vec3{};
    f.expect(d.type != BodyType::fixed || rests, "bodies: a fixed one has a velocity");
    f.expect(d.type != BodyType::dynamic || d.surfaceVelocity == Vec3{}, "bodies: the surface of a dynamic one runs");
    f.expect(bodies.freeWay(i, m.linearVelocity) == m.linearVelocity &&
                 bodies.freeTurn(i, m.angularVelocity) == m.angularVelocity && d.locks <= kAllLocks,
             "bodies: one moves along an axis that is locked");
    for (ShapeIndex shape : bodies.shapes[i]) {
      f.expect(!seen[shape], "shapes: one is listed twice");
      seen[shape] = true;
      listed++;
      bool plane = shapes.data[shape].def.type == ShapeType::plane;
      f.expect(!plane || d.type == BodyType::fixed, "shapes: a plane on a body that can move");
    }
  }
  f.expect(alive == listed, "shapes: one is of no body");
  std::vector<ShapeIndex> sensing;
  for (ShapeIndex i = 0; i < shapes.slots(); i++)
    if (shapes.alive(i) && shapes.data[i].def.sensor) sensing.push_back(i);
  f.expect(sensing == sensors, "sensors: the list is not theirs");
  std::sort(orders.begin(), orders.end());
  f.expect(std::adjacent_find(orders.begin(), orders.end()) == orders.end(), "bodies: two were created at once");
}

}  // namespace brickfall
