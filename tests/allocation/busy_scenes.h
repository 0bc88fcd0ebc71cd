// Scenes in which contacts, islands and sleep change all the time, or not at all.
#pragma once
#include <cmath>

#include "brickfall/geometry/mesh_tree.h"
#include "support/lab_scenes.h"
#include "support/world_helpers.h"

namespace brickfall::test {

struct BusyScene {
  World world;
  std::function<void(World&, int step)> before = [](World&, int) {};  // called ahead of every step
};

inline void addRandomBodies(World& world, int count, double lowest, double spacing, double restitution = 0) {
  lab::LabRandom random(5);
  for (int i = 0; i < count; i++) {
    ShapeDef s = i % 4 == 0   ? sphereOf(0.1)
                 : i % 4 == 1 ? capsuleOf(0.08, 0.1)
                 : i % 4 == 2 ? hullOf(0.14)
                              : boxOf({0.1, 0.07, 0.12});
    s.material.restitution = restitution;
    BodyDef d = bodyOf(s, {random.unit() - 0.5, lowest + spacing * i, random.unit() - 0.5});
    d.rotation = {random.unit() - 0.5, random.unit() - 0.5, random.unit() - 0.5, 0.7};
    add(world, d);
  }
}

inline BusyScene standingWall(bool sleep, int threads = 1) {
  lab::Options o;
  o.gap = 0.1e-3;
  o.seed = 3;
  o.sleep = sleep;
  o.threads = threads;
  return {std::move(lab::make("w10", o).world)};
}

// Lies still after a second or two, and is kept awake.
inline BusyScene heapAtRest() {
  BusyScene s{awakeWorld()};
  addGround(s.world);
  addRandomBodies(s.world, 60, 0.15, 0.02);
  return s;
}

// All still in the air when the first second is over: contacts go from none to hundreds after it.
inline BusyScene fallingPile(bool sleep, int threads = 1) {
  WorldDef def;
  def.enableSleep = sleep;
  def.threads = threads;
  BusyScene s{makeWorld(def)};
  addGround(s.world);
  addRandomBodies(s.world, 100, 6, 0.25);
  return s;
}

// A trough in which a paddle goes round and round.
inline BusyScene stirredPile() {
  BusyScene s{makeWorld()};
  addGround(s.world);
  for (int i = 0; i < 4; i++) {
    BodyDef side = bodyOf(boxOf({1.2, 1, 0.1}), {}, BodyType::fixed);
    side.rotation = turn({0, 1, 0}, 90 * i);
    side.position = rotate(side.rotation, {0, 1, 1.1});
    add(s.world, side);
  }
  addRandomBodies(s.world, 80, 0.3, 0.05);
  BodyDef paddle = bodyOf(boxOf({0.7, 0.3, 0.05}), {0, 0.35, 0}, BodyType::kinematic);
  paddle.angularVelocity = {0, 2.1, 0};
  BodyId id = add(s.world, paddle);
  // It rests for a while now and then, so that what it stirred falls asleep and is woken again.
  s.before = [id](World& world, int step) {
    if (step % 300 != 100 && step % 300 != 299) return;
    EXPECT_TRUE(world.setAngularVelocity(id, {0, step % 300 == 100 ? 0.0 : 2.1, 0}).ok());
  };
  return s;
}

// A wall that a heavy ball meets in its second second.
inline BusyScene wallHitLate(int threads = 1) {
  lab::Options o;
  o.threads = threads;
  o.restitution = 0.2;
  BusyScene s{std::move(lab::make("w10", o).world)};
  BodyDef ball = bodyOf(sphereOf(0.2, 7800), {1, 0.3, 20});
  ball.linearVelocity = {0, 0, -15};
  ball.gravityScale = 0;
  add(s.world, ball);
  return s;
}

// Small and fast among thin walls, without gravity: islands of two and three that come and go in every step.
inline BusyScene swarm() {
  BusyScene s{emptySpace()};
  for (int i = 0; i < 6; i++) {
    BodyDef side = bodyOf(boxOf({1.5, 1.5, 0.01}), {}, BodyType::fixed);
    side.shapes[0].material.restitution = 1;
    side.rotation = i < 4 ? turn({0, 1, 0}, 90 * i) : turn({1, 0, 0}, i == 4 ? 90 : -90);
    side.position = rotate(side.rotation, {0, 0, 1.5});
    add(s.world, side);
  }
  lab::LabRandom random(9);
  for (int i = 0; i < 60; i++) {
    ShapeDef shape = i % 2 == 0 ? sphereOf(0.05) : boxOf({0.05, 0.04, 0.03});
    shape.material.restitution = 1;
    BodyDef d = bodyOf(shape, {2 * random.unit() - 1, 2 * random.unit() - 1, 2 * random.unit() - 1});
    d.linearVelocity = {20 * random.unit() - 10, 20 * random.unit() - 10, 20 * random.unit() - 10};
    d.angularVelocity = {5 * random.unit(), 0, 0};
    d.allowSleep = false;
    add(s.world, d);
  }
  return s;
}

// The same on hilly ground made of triangles.
inline BusyScene fallingOnHills() {
  BusyScene s{makeWorld()};
  constexpr int kCells = 40;
  std::vector<Vec3> vertices;
  std::vector<std::uint32_t> indices;
  for (int i = 0; i <= kCells; i++)
    for (int k = 0; k <= kCells; k++)
      vertices.push_back({0.2 * (i - kCells / 2), 0.2 * std::sin(0.9 * i) * std::sin(0.7 * k), 0.2 * (k - kCells / 2)});
  for (int i = 0; i < kCells; i++)
    for (int k = 0; k < kCells; k++) {
      std::uint32_t a = std::uint32_t(i * (kCells + 1) + k), b = a + kCells + 1;
      indices.insert(indices.end(), {a, a + 1, b, b, a + 1, b + 1});
    }
  Result<TriangleMesh> mesh = TriangleMesh::create(vertices, indices);
  EXPECT_TRUE(mesh.ok());
  ShapeDef shape;
  shape.type = ShapeType::mesh;
  shape.mesh = std::make_shared<MeshTree>(MeshTree::build(std::move(mesh).value()));
  add(s.world, bodyOf(shape, {}, BodyType::fixed));
  addRandomBodies(s.world, 60, 6, 0.25);
  return s;
}

}  // namespace brickfall::test
