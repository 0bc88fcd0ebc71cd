#include "world/proximity.h"

#include <algorithm>

#include "base/keep_room.h"
#include "geometry/mesh_shape.h"
#include "solver/scale.h"

namespace brickfall {

namespace {

//! not of the method: room
constexpr std::size_t kMeshScratch = 4096;  // faces near one shape, points on them

// Planes and meshes have no size: the shapes that come near them have.
bool hasSize(const ShapeData& shape) { return shape.innerRadius < 1e29; }
double slackOf(const ShapeData& shape) { return hasSize(shape) ? kRoom * shape.innerRadius : 0; }

}  // namespace

void Proximity::open(BroadPhaseMethod method, double margin) {
  broadPhase = makeBroadPhase(method);
  contactMargin = margin;
}

double Proximity::marginOf(const ShapeData& shape) const {
  return std::min(kRoom, contactMargin / kReferenceSize) * shape.innerRadius;
}

// Swept bounds: the shape's motion at the present velocity, and the contact margin. Contacts are made only where these
// bounds overlap, so that which contacts exist does not depend on the history of the tree.
void Proximity::updateSwept(const Registry& registry, ShapeIndex shape, double dt) {
  const ShapeData& s = registry.shapes.data[shape];
  const BodyMotion& m = registry.bodies.motion[s.body];
  Aabb box = bounds(s.geometry, registry.shapes.worldPose(shape, registry.bodies));
  if (s.geometry.type != ShapeType::plane) {
    const Vec3 move = m.linearVelocity * dt;
    const bool falls = registry.bodies.mass[s.body].invMass > 0;
    const Vec3 fallen = move + (falls ? fall * (registry.bodies.data[s.body].gravityScale * dt) : Vec3{});
    double turn = std::min(1.0, length(m.angularVelocity) * dt) * registry.bodies.mass[s.body].outerRadius;
    double pad = (hasSize(s) ? marginOf(s) : 0) + turn;
    box = {box.lower + min(min(move, fallen), Vec3{}) - Vec3{pad, pad, pad},
           box.upper + max(max(move, fallen), Vec3{}) + Vec3{pad, pad, pad}};
  }
  around[shape].swept = box;
}

void Proximity::enter(const Registry& registry, BodyIndex body) {
  around.resize(registry.shapes.slots());
  if (!registry.bodies.takesPart(body)) return;
  for (ShapeIndex shape : registry.bodies.shapes[body]) {
    updateSwept(registry, shape, 0);
    enter(registry, shape, around[shape].swept);
  }
}

void Proximity::enter(const Registry& registry, ShapeIndex shape, const Aabb& swept) {
  around[shape].mesh = registry.shapes.data[shape].geometry.type == ShapeType::mesh;
  around[shape].proxy = broadPhase->add(swept, slackOf(registry.shapes.data[shape]), shape);
}

void Proximity::leave(const Registry& registry, BodyIndex body) {
  for (ShapeIndex shape : registry.bodies.shapes[body]) {
    ProxyIndex& proxy = around[shape].proxy;
    if (proxy != kNoProxy) broadPhase->remove(proxy);
    proxy = kNoProxy;
  }
}

void Proximity::follow(const Registry& registry, ShapeIndex shape) {
  const Surroundings& s = around[shape];
  following.push_back({s.proxy, s.swept, slackOf(registry.shapes.data[shape])});
}

// The tree must have a body where it is now: queries between steps rely on it. A collision may throw it out of the
// bounds that its velocity before the step foretold.
void Proximity::keepBounds(const Registry& registry, BodyIndex body) {
  for (ShapeIndex shape : registry.bodies.shapes[body]) {
    const ShapeData& s = registry.shapes.data[shape];
    const Surroundings& at = around[shape];
    Aabb now = bounds(s.geometry, registry.shapes.worldPose(shape, registry.bodies));
    if (!contains(broadPhase->kept(at.proxy), now)) broadPhase->update(at.proxy, merged(now, at.swept), slackOf(s));
  }
}

void Proximity::keepRoom(std::size_t shapes, std::size_t pairs, std::size_t touching) {
  foundPairs.reserve(pairs);
  newPairs.reserve(pairs);
  brickfall::keepRoom(newParts, touching);
  brickfall::keepRoom(passed, touching);
  keepRoomFor(courses, shapes);
  keepRoomFor(sinking, shapes);
  keepRoomFor(following, shapes);
  brickfall::keepRoom(meshScratch.faces, kMeshScratch);
  brickfall::keepRoom(meshScratch.points, kMeshScratch);
  keepMeshRoom();
}

void Proximity::checkStructure(Findings& f, const Registry& registry) const {
  f.expect(around.size() == registry.shapes.slots(), "bounds: not one for each shape");
}

void Proximity::checkBounds(Findings& f, const Registry& registry) const {
  for (const std::string& text : broadPhase->validate()) f.expect(false, "broad phase: " + text);
  for (BodyIndex i = 0; i < registry.bodies.slots(); i++) {
    if (!registry.bodies.alive(i)) continue;
    for (ShapeIndex s : registry.bodies.shapes[i]) {
      const Surroundings& at = around[s];
      if (at.proxy == kNoProxy) {
        f.expect(!registry.bodies.takesPart(i), "shape", s, "not in the broad phase");
        continue;
      }
      Aabb now = bounds(registry.shapes.data[s].geometry, registry.shapes.worldPose(s, registry.bodies));
      f.expect(contains(kept(s), at.swept), "shape", s, "its swept bounds are outside the kept ones");
      f.expect(contains(kept(s), now), "shape", s, "outside its kept bounds");
    }
  }
}

}  // namespace brickfall
