#include "support/snapshot_worlds.h"

#include "brickfall/geometry/mesh_tree.h"

namespace brickfall::test {

namespace {

ShapeDef shapeOf(ShapeType type) {
  ShapeDef s;
  s.type = type;
  s.halfExtents = {0.1, 0.05, 0.06};
  s.radius = 0.08;
  s.halfHeight = 0.1;
  if (type == ShapeType::cone) s.topRadius = 0.03;
  if (type == ShapeType::hull) s.vertices = {{.1, 0, 0}, {-.1, 0, 0}, {0, .1, 0}, {0, -.1, 0}, {0, 0, .1}, {0, 0, -.1}};
  return s;
}

BodyId add(World& world, ShapeType shape, Vec3 position, Vec3 velocity = {}, BodyType type = BodyType::dynamic) {
  BodyDef d;
  d.type = type;
  d.shapes = {shapeOf(shape)};
  d.position = position;
  d.linearVelocity = velocity;
  return *world.createBody(d);
}

World ground(const WorldDef& def = {}) {
  World world = std::move(World::create(def)).value();
  add(world, ShapeType::plane, {}, {}, BodyType::fixed);
  return world;
}

void advance(World& world, int steps) {
  for (int i = 0; i < steps; i++) (void)world.step(1.0 / 60).ok();
}

World stack(int steps) {
  World world = ground();
  for (int i = 0; i < 3; i++) add(world, ShapeType::box, {0.05 * (i % 2), 0.05 + 0.1 * i, 0});
  advance(world, steps);
  return world;
}

// Hit, and not yet at rest: a sphere, a capsule, a hull and a compound among boxes, one of them never asleep.
World busy() {
  World world = ground();
  for (int i = 0; i < 3; i++) add(world, ShapeType::box, {0.2 * i, 0.05, 0});
  add(world, ShapeType::box, {0.1, 0.15, 0});
  BodyDef two;
  two.shapes = {shapeOf(ShapeType::box), shapeOf(ShapeType::capsule)};
  two.shapes[1].local = {{0.1, 0.1, 0}, {0, 0, 0.6, 0.8}};
  two.shapes[0].material.restitution = 0.5;
  two.position = {0.3, 0.25, 0};
  two.angularVelocity = {1, 2, 3};
  two.allowSleep = false;
  two.dragArea = 0.1;
  two.linearDamping = two.angularDamping = 0.1;
  (void)world.createBody(two).ok();
  add(world, ShapeType::hull, {0.1, 0.32, 0});
  add(world, ShapeType::sphere, {0.1, 0.2, 0.3}, {0, 0, -4});
  add(world, ShapeType::box, {1, 0.05, 0}, {0.1, 0.1, 0}, BodyType::kinematic);
  add(world, ShapeType::capsule, {1, 0.3, 0});
  add(world, ShapeType::cylinder, {1.3, 0.2, 0});
  add(world, ShapeType::cone, {1.3, 0.5, 0});
  advance(world, 8);
  return world;
}

// As `busy`, with changes that the next step has to take in.
World changed() {
  World world = busy();
  std::vector<BodyId> bodies = world.bodies();
  (void)world.destroyBody(bodies[1]).ok();
  (void)world.applyForce(bodies[2], {5, 0, 0}).ok();
  (void)world.setTransform(bodies[4], {0, 1, 0}, {}).ok();
  (void)world.setType(bodies[3], BodyType::fixed).ok();
  (void)world.setLinearVelocity(bodies[8], {}).ok();
  return world;
}

// On a trough of triangles, between its two sides.
World onTriangles() {
  World world = std::move(World::create({})).value();
  const Vec3 vertices[] = {{-1, 1, -1}, {-1, 1, 1}, {0, 0, 1}, {0, 0, -1}, {1, 1, 1}, {1, 1, -1}};
  const std::uint32_t indices[] = {0, 1, 2, 0, 2, 3, 3, 2, 4, 3, 4, 5};
  ShapeDef trough = shapeOf(ShapeType::mesh);
  trough.mesh = std::make_shared<MeshTree>(MeshTree::build(TriangleMesh::create(vertices, indices).value()));
  BodyDef d;
  d.type = BodyType::fixed;
  d.shapes = {trough};
  (void)world.createBody(d).ok();
  add(world, ShapeType::sphere, {0, 0.1, 0});
  add(world, ShapeType::box, {0.05, 0.3, 0.3});
  advance(world, 30);
  return world;
}

// A body lost to absurd forces, and a slot that has been used twice.
World quarantined() {
  World world = ground();
  BodyId lost = add(world, ShapeType::box, {5, 5, 0});
  for (int i = 0; i < 2000 && !world.state(lost)->quarantined; i++) {
    (void)world.applyForce(lost, {1e12, 0, 0}).ok();
    (void)world.step(0.1).ok();
  }
  (void)world.destroyBody(add(world, ShapeType::sphere, {0, 3, 0})).ok();
  add(world, ShapeType::hull, {0, 0.1, 0});
  (void)world.destroyBody(add(world, ShapeType::box, {0, 5, 0})).ok();
  advance(world, 2);
  return world;
}

// Joints of every type, asleep and awake, one of them destroyed, one made since the last step.
World jointed(int steps) {
  World world = ground();
  const BodyId base = add(world, ShapeType::box, {0, 5, 0}, {}, BodyType::fixed);
  std::vector<JointId> joints;
  for (int i = 0; i < kJointTypeCount; i++) {
    JointDef d;
    d.type = JointType(i);
    d.bodyA = base;
    d.bodyB = add(world, ShapeType::box, {0.5 * i, 4.5, 0});
    d.anchor = {0.5 * i, 5, 0};
    d.anchorB = Vec3{0.5 * i, 4.6, 0};
    d.limit = JointDef::Limit{-0.2, 0.3};
    d.cone = 1;
    d.motor = JointDef::Motor{1, 2};
    joints.push_back(*world.createJoint(d));
  }
  advance(world, steps);
  (void)world.destroyJoint(joints[2]).ok();
  JointDef last;
  last.bodyA = world.bodies()[2];
  last.bodyB = world.bodies()[4];
  last.anchor = {0.5, 5, 0};
  (void)world.createJoint(last).ok();
  return world;
}

// A box and a ball that resists rolling on a surface that runs; another ball that its resistance holds on a slope.
World carried() {
  WorldDef def;
  def.gravity = {0.3, -9.8, 0};
  World world = ground(def);
  BodyDef belt;
  belt.type = BodyType::fixed;
  belt.shapes = {shapeOf(ShapeType::box)};
  belt.shapes[0].halfExtents = {1, 0.1, 1};
  belt.position = {0, 0.2, 0};
  belt.surfaceVelocity = {0, 0, 0.5};
  (void)world.createBody(belt).ok();
  add(world, ShapeType::box, {0, 0.35, 0});
  BodyDef ball;
  ball.shapes = {shapeOf(ShapeType::sphere)};
  ball.shapes[0].material.rollingResistance = 0.05;
  for (Vec3 place : {Vec3{0.5, 0.38, 0}, Vec3{3, 0.08, 0}}) {
    ball.position = place;
    (void)world.createBody(ball).ok();
  }
  advance(world, 20);
  return world;
}

// On rails and hit, locked anew and let go since the last step; switched off; with a mass of its own; a sensor in between.
World constrained() {
  World world = ground();
  std::vector<BodyId> boxes;
  for (int i = 0; i < 4; i++) {
    BodyDef d;
    d.shapes = {shapeOf(ShapeType::box)};
    d.shapes[0].sensor = i == 3;
    d.position = {0.3 * i, 0.05, 0};
    d.locks = i % 2 == 0 ? AxisLocks::plane() : AxisLocks::noTurns();
    d.enabled = i != 1;
    d.type = i == 3 ? BodyType::fixed : BodyType::dynamic;
    if (i == 2) d.massProperties = MassProperties{20, {0, 0.01, 0}, {{{0.03, 0, 0}, {0, 0.06, 0}, {0, 0, 0.06}}}};
    boxes.push_back(*world.createBody(d));
  }
  add(world, ShapeType::sphere, {-0.4, 0.08, 0.02}, {4, 0, 0.5});
  advance(world, 12);
  AxisLocks one;
  one.wayX = true;
  (void)world.setLocks(boxes[0], one).ok();
  (void)world.setLocks(boxes[2], {}).ok();
  (void)world.setEnabled(boxes[1], true).ok();
  return world;
}

// Mortar that holds, cracks and has broken, a chunk that spins in the air, one joint taken away.
World mortared(int steps) {
  World world = ground();
  std::vector<MortarId> joints;
  auto glue = [&](BodyId a, BodyId b, Vec3 centre) {
    MortarDef d;
    d.bodyA = a;
    d.bodyB = b;
    d.outline = {centre + Vec3{-0.1, 0, 0.06}, centre + Vec3{0.1, 0, 0.06}, centre + Vec3{0.1, 0, -0.06},
                 centre + Vec3{-0.1, 0, -0.06}};
    d.strength.tension = 2000;
    d.strength.cohesion = 3000;
    joints.push_back(*world.createMortar(d));
  };
  BodyId below = add(world, ShapeType::box, {0, 0.05, 0});
  for (int i = 1; i < 4; i++) {
    const BodyId above = add(world, ShapeType::box, {0, 0.05 + 0.1 * i, 0});
    glue(below, above, {0, 0.1 * i, 0});
    below = above;
  }
  const BodyId one = add(world, ShapeType::box, {1, 1, 0}), two = add(world, ShapeType::box, {1, 1.1, 0});
  glue(one, two, {1, 1.05, 0});
  for (BodyId body : {one, two}) (void)world.setAngularVelocity(body, {1, 2, 0}).ok();
  advance(world, steps / 2);
  add(world, ShapeType::sphere, {0.05, 0.33, 0.3}, {0, 0, -6});
  advance(world, steps - steps / 2);
  if (steps > 0) (void)world.destroyMortar(joints[1]).ok();
  return world;
}

}  // namespace

World smallWorld() {
  World world = ground();
  add(world, ShapeType::box, {0, 1, 0});
  return world;
}

std::vector<World> worldsOfEachKind() {
  std::vector<World> out;
  out.push_back(smallWorld());
  out.push_back(stack(5));
  out.push_back(stack(40));
  out.push_back(stack(120));
  out.push_back(busy());
  out.push_back(changed());
  out.push_back(quarantined());
  out.push_back(onTriangles());
  out.push_back(jointed(0));
  out.push_back(jointed(20));
  out.push_back(carried());
  out.push_back(constrained());
  out.push_back(mortared(0));
  out.push_back(mortared(12));
  out.push_back(std::move(World::create({})).value());
  return out;
}

std::vector<std::vector<std::byte>> snapshotsOfEachKind() {
  std::vector<std::vector<std::byte>> out;
  for (const World& world : worldsOfEachKind()) out.push_back(world.snapshot());
  return out;
}

}  // namespace brickfall::test
