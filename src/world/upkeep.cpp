#include "world/upkeep.h"

#include <algorithm>
#include <limits>

#include "solver/rigid_sum.h"
#include "world/mortar_succession.h"
#include "world/succession.h"

namespace brickfall {

BodyIndex Upkeep::create(BodyPlan&& plan) {
  BodyIndex body = registry_.add(std::move(plan));
  proximity_.enter(registry_, body);
  activity_.enlist(registry_.bodies, body);
  return body;
}

void Upkeep::destroy(BodyIndex body) {
  wakeIslandOf(body);
  endTiesOf(body);
  proximity_.leave(registry_, body);
  activity_.delist(registry_.bodies, body);
  activity_.forgetIslandsOf(body);
  registry_.remove(body);
}

std::vector<BodyIndex> Upkeep::replace(BodyIndex body, std::vector<BodyPlan>&& pieces) {
  wakeIslandOf(body);
  wakeTied(body);  // now all contacts of the body are among the pairs that are awake
  Succession succession(registry_, ties_.contacts, body);
  MortarSuccession mortar(registry_, body, ties_.mortar);
  const Vec3 centre = registry_.bodies.motion[body].position;
  const Vec3 force = registry_.bodies.data[body].force, torque = registry_.bodies.data[body].torque;
  destroy(body);
  std::vector<BodyIndex> made;
  for (BodyPlan& piece : pieces) made.push_back(create(std::move(piece)));
  mortar.pass(registry_, made, ties_.mortar, diary_);
  succession.pass(registry_, made, proximity_, ties_);
  if (force != Vec3{} || torque != Vec3{}) push(made, centre, force, torque);
  return made;
}

void Upkeep::push(const std::vector<BodyIndex>& pieces, Vec3 at, Vec3 force, Vec3 torque) {
  BodySet& bodies = registry_.bodies;
  RigidSum sum(at);
  for (BodyIndex piece : pieces)
    if (bodies.data[piece].type == BodyType::dynamic)
      sum.add(bodies.mass[piece].mass, bodies.motion[piece].position, bodies.worldInertia(piece), {}, {});
  if (!(sum.mass() > 0)) return;
  const Vec3 centre = sum.centre(), acceleration = force * (1 / sum.mass());
  const Vec3 turning = inverse(sum.inertia()) * (torque - cross(centre - at, force));
  for (BodyIndex piece : pieces) {
    BodyData& data = bodies.data[piece];
    if (data.type != BodyType::dynamic) continue;
    Vec3 arm = bodies.motion[piece].position - centre;
    data.force = (acceleration + cross(turning, arm)) * bodies.mass[piece].mass;
    data.torque = bodies.worldInertia(piece) * turning;
    activity_.push(piece);
  }
}

void Upkeep::setType(BodyIndex body, BodyType type) {
  wakeIslandOf(body);
  displace(body);
  // A joint of two bodies that nothing moved may sleep though none of its bodies does.
  ties_.wakeWhere([&](BodyIndex a, BodyIndex b) { return a == body || b == body; });
  activity_.delist(registry_.bodies, body);
  registry_.setType(body, type);
  ties_.renewConstants(body, registry_.shapes, registry_.bodies);
  renewProxies(body);
  activity_.enlist(registry_.bodies, body);
  activity_.forgetIslandsOf(body);
}

void Upkeep::setLocks(BodyIndex body, std::uint8_t locks) {
  disturb(body);
  registry_.setLocks(body, locks);
  ties_.renewConstants(body, registry_.shapes, registry_.bodies);
}

// Its joints and mortar stay, idle while it is out.
void Upkeep::setEnabled(BodyIndex body, bool enabled) {
  wakeIslandOf(body);
  wakeTied(body);
  ties_.contacts.dropOf(body);
  tiesEnded(body);
  proximity_.leave(registry_, body);
  activity_.delist(registry_.bodies, body);
  activity_.forgetIslandsOf(body);
  registry_.bodies.data[body].enabled = enabled;
  registry_.bodies.data[body].steady = {};
  ties_.renewConstants(body, registry_.shapes, registry_.bodies);
  proximity_.enter(registry_, body);
  activity_.enlist(registry_.bodies, body);
  if (!enabled) return;
  wakeTied(body);
  ties_.wakeWhere([&](BodyIndex a, BodyIndex b) { return a == body || b == body; });
}

void Upkeep::setPose(BodyIndex body, Vec3 position, Quat rotation) {
  disturb(body);
  displace(body);
  registry_.setPose(body, position, rotation);
  renewProxies(body);
}

void Upkeep::setMaterial(ShapeIndex shape, const Material& material) {
  const BodyIndex body = registry_.shapes.data[shape].body;
  const bool densityChanged = registry_.shapes.data[shape].def.material.density != material.density;
  remake(body, densityChanged, [&] { return registry_.setMaterial(shape, material); });
}

void Upkeep::setMass(BodyIndex body, const std::optional<MassProperties>& given) {
  remake(body, true, [&] { return registry_.setMass(body, given); });
}

// `change`: true if the centre of mass is elsewhere in the body, from where anchors of contacts are measured.
template <class Change> void Upkeep::remake(BodyIndex body, bool massChanges, Change change) {
  disturb(body);
  wakeTied(body);  // of a fixed body, too
  if (change()) {
    displace(body);
    renewProxies(body);
  }
  ties_.renewConstants(body, registry_.shapes, registry_.bodies);
  if (massChanges) activity_.forgetIslandsOf(body);
  activity_.unsettlePartnersOf(body);
}

JointIndex Upkeep::join(const Joint& joint) {
  const JointIndex made = ties_.joints.create(joint);
  ties_.renewConstants(joint.bodyA, registry_.shapes, registry_.bodies);
  disturbEnds(joint);
  if (!joint.collide) ties_.contacts.dropBetween(joint.bodyA, joint.bodyB);
  return made;
}

template <class Tie> void Upkeep::disturbEnds(const Tie& tie) {
  for (BodyIndex body : {tie.bodyA, tie.bodyB})
    if (registry_.bodies.data[body].type == BodyType::dynamic) disturb(body);
}

void Upkeep::disturbJoint(JointIndex joint) { disturbEnds(ties_.joints.slots[joint]); }

void Upkeep::unjoin(JointIndex joint) {
  disturbJoint(joint);
  const Joint was = ties_.joints.slots[joint];
  ties_.joints.destroy(joint);
  if (!was.collide) meetAnew(was.bodyA, was.bodyB);
}

// A pair that was refused is reported again only if its shapes enter anew, also where they lie at rest.
void Upkeep::meetAnew(BodyIndex a, BodyIndex b) {
  for (BodyIndex body : {a, b}) renewProxies(body);
}

MortarIndex Upkeep::glue(const Mortar& mortar, const SharedStrength& shared, std::uint64_t userData) {
  const MortarIndex made = ties_.mortar.create(mortar, shared, userData);
  disturbEnds(mortar);
  ties_.contacts.dropBetween(mortar.bodyA, mortar.bodyB);
  return made;
}

void Upkeep::unglue(MortarIndex mortar) {
  const Mortar was = ties_.mortar.slots[mortar];
  disturbEnds(was);
  ties_.mortar.destroy(mortar);
  if (!was.broken) meetAnew(was.bodyA, was.bodyB);
}

void Upkeep::crumble(MortarIndex mortar) {
  ties_.mortar.breakUp(mortar);
  const Mortar& m = ties_.mortar.slots[mortar];
  meetAnew(m.bodyA, m.bodyB);
}

// A kinematic body joins or leaves the moving bodies as its velocity says.
void Upkeep::relist(BodyIndex body) {
  if (registry_.bodies.data[body].type != BodyType::kinematic) return;
  activity_.delist(registry_.bodies, body);
  activity_.enlist(registry_.bodies, body);
}

void Upkeep::isolate(BodyIndex body) {
  endTiesOf(body);
  proximity_.leave(registry_, body);
  activity_.delist(registry_.bodies, body);
}

// The body's pairs are found anew.
void Upkeep::renewProxies(BodyIndex body) {
  proximity_.leave(registry_, body);
  proximity_.enter(registry_, body);
}

void Upkeep::endTiesOf(BodyIndex body) {
  wakeTied(body);
  ties_.dropOf(body);
  tiesEnded(body);
}

void Upkeep::displace(BodyIndex body) {
  wakeTied(body);
  ties_.displace(body);
  tiesEnded(body);
}

void Upkeep::tiesEnded(BodyIndex body) {
  diary_.endTouchingOf(body, registry_);
  activity_.membershipChanged = true;
}

void Upkeep::disturb(BodyIndex body) {
  BodySet& bodies = registry_.bodies;
  bodies.still[body] = 0;
  if (bodies.data[body].type != BodyType::dynamic) {
    activity_.countAsMoved(bodies, body);
    wakeTied(body);
    // The body may begin to move: its pairs are looked at, whichever bodies sleep.
    ties_.wakeWhere([&](BodyIndex a, BodyIndex b) { return a == body || b == body; });
    activity_.unsettlePartnersOf(body);
    return;
  }
  bodies.data[body].turnEnergy = -std::numeric_limits<double>::infinity();
  wakeIslandOf(body);
  activity_.unsettleIslandOf(body);
}

void Upkeep::wakeIslandOf(BodyIndex body) {
  if (registry_.bodies.data[body].activity != BodyActivity::asleep) return;
  const auto& asleep = activity_.islands.asleep;
  for (std::size_t i = 0; i < asleep.size(); i++)
    if (std::binary_search(asleep[i]->bodies.begin(), asleep[i]->bodies.end(), body)) {
      wakeIsland(i);
      return;
    }
}

void Upkeep::wakeIsland(std::size_t asleepIndex) {
  IslandSet& islands = activity_.islands;
  BodySet& bodies = registry_.bodies;
  IslandPointer island = std::move(islands.asleep[asleepIndex]);
  islands.asleep.erase(islands.asleep.begin() + std::ptrdiff_t(asleepIndex));
  for (BodyIndex body : island->bodies) {
    bodies.data[body].activity = BodyActivity::awake;
    bodies.still[body] = 0;
    activity_.awake.push_back(body);
    diary_.heard().woke.push_back(registry_.idOf(body));
  }
  std::sort(activity_.awake.begin(), activity_.awake.end());
  auto isAwake = [&](BodyIndex body) { return bodies.data[body].activity == BodyActivity::awake; };
  ties_.wakeWhere([&](BodyIndex a, BodyIndex b) { return isAwake(a) || isAwake(b); });
  diary_.addTouching(*island, ties_);
  island->restTime = 0;
  island->ending = IslandEnding::unsolved;
  auto place = std::lower_bound(islands.awake.begin(), islands.awake.end(), island,
                                [](const auto& a, const auto& b) { return a->key() < b->key(); });
  islands.awake.insert(place, std::move(island));
  activity_.membershipChanged = true;
}

void Upkeep::wakeAll() {
  while (!activity_.islands.asleep.empty()) wakeIsland(activity_.islands.asleep.size() - 1);
  activity_.unsettleAll();
  for (auto& island : activity_.islands.awake) island->restTime = 0;
}

void Upkeep::wakeTied(BodyIndex body) {
  std::vector<BodyIndex> wake;
  ties_.eachAsleep([&](const Link& link) {
    if (link.names(body)) wake.push_back(link.bodyA == body ? link.bodyB : link.bodyA);
  });
  for (BodyIndex other : wake) wakeIslandOf(other);
}

}  // namespace brickfall
