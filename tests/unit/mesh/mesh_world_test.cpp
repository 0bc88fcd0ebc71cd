// Meshes as ground and obstacles of a world, mostly beside the same scene on a plane.
#include <gtest/gtest.h>

#include <algorithm>

#include "brickfall/geometry/mesh_tree.h"
#include "support/mesh_samples.h"
#include "support/random_geometry.h"
#include "support/world_helpers.h"

namespace {

using namespace brickfall;
using namespace brickfall::test;

ShapeDef meshOf(const MeshData& data, double friction = 0.6) {
  ShapeDef shape = boxOf({}, 1000, friction);
  shape.type = ShapeType::mesh;
  shape.mesh = std::make_shared<MeshTree>(treeOf(data));
  return shape;
}
BodyId addMesh(World& world, const MeshData& data, Vec3 position = {}, BodyType type = BodyType::fixed,
               double friction = 0.6) {
  return add(world, bodyOf(meshOf(data, friction), position, type));
}
// Flat, but of triangles that share no line with anything: a grid turned and with its vertices moved about in the plane.
MeshData flatFloor(double half, double cell, std::uint64_t seed) {
  Random random(seed);
  int n = int(half / cell);
  MeshData mesh = gridMesh(2 * n, 2 * n, cell);
  Quat turned = turn({0, 1, 0}, 17);
  for (Vec3& v : mesh.vertices) {
    v += Vec3{random.between(-0.3, 0.3), 0, random.between(-0.3, 0.3)} * cell;
    v = rotate(turned, v);
  }
  return mesh;
}

// --- what is refused

TEST(MeshWorld, RefusesDynamicMeshesAndMissingOnes) {
  World world = makeWorld();
  Result<BodyId> body = world.createBody(bodyOf(meshOf(cubeMesh()), {}));
  ASSERT_FALSE(body);
  EXPECT_NE(body.error().message.find("shapes[0].type"), std::string::npos) << body.error().message;
  ShapeDef none;
  none.type = ShapeType::mesh;
  body = world.createBody(bodyOf(none, {}, BodyType::fixed));
  ASSERT_FALSE(body);
  EXPECT_NE(body.error().message.find("shapes[0].mesh"), std::string::npos) << body.error().message;
  MeshData wide = cubeMesh(2e4);
  EXPECT_FALSE(world.createBody(bodyOf(meshOf(wide), {}, BodyType::fixed)));

  BodyId ground = addMesh(world, cubeMesh());
  EXPECT_FALSE(world.setType(ground, BodyType::dynamic));
  EXPECT_TRUE(world.setType(ground, BodyType::kinematic));
  EXPECT_FALSE(world.setType(ground, BodyType::dynamic));
  EXPECT_TRUE(world.setType(ground, BodyType::fixed));
  expectSound(world);
}

// --- flat floors: nothing may be felt of the edges between triangles

struct Slide {
  Vec3 position, velocity, spin;
};
Slide slideOver(bool mesh, const ShapeDef& shape, Vec3 start, Vec3 velocity, Vec3 spin, double friction, double seconds,
                double cell = 0.23, double* highest = nullptr) {
  World world = awakeWorld();
  if (mesh)
    addMesh(world, flatFloor(6, cell, 3), {}, BodyType::fixed, friction);
  else
    addGround(world, friction);
  BodyDef def = bodyOf(shape, start);
  def.linearVelocity = velocity;
  def.angularVelocity = spin;
  BodyId body = add(world, def);
  double top = -1e30;
  for (int n = 0; n < int(seconds / kDt) && !testing::Test::HasFailure(); n++) {
    stepSound(world);
    top = std::max(top, world.state(body)->position.y);
  }
  if (highest) *highest = top;
  Result<BodyState> s = world.state(body);
  return {s->position, s->linearVelocity, s->angularVelocity};
}

TEST(MeshWorld, BallRollsOverTrianglesAsOverAPlane) {
  for (double cell : {0.05, 0.23, 1.1}) {
    ShapeDef ball = sphereOf(0.1);
    Vec3 velocity{2.3, 0, 0.7}, spin{0.7 / 0.1, 0, -2.3 / 0.1};
    double top = 0;
    Slide onPlane = slideOver(false, ball, {-3, 0.1, -1}, velocity, spin, 0.6, 2);
    Slide onMesh = slideOver(true, ball, {-3, 0.1, -1}, velocity, spin, 0.6, 2, cell, &top);
    expectNear(onMesh.position, onPlane.position, 1e-5, "position");
    expectNear(onMesh.velocity, onPlane.velocity, 1e-5, "velocity");
    expectNear(onMesh.spin, onPlane.spin, 1e-3, "spin");
    EXPECT_LT(top, 0.1 + 1e-5);
  }
}

TEST(MeshWorld, BoxSlidesOverTrianglesAsOverAPlane) {
  for (double cell : {0.05, 0.23, 1.1}) {
    ShapeDef box = boxOf({0.15, 0.1, 0.2}, 1000, 0.1);
    double top = 0;
    Slide onPlane = slideOver(false, box, {-3, 0.1, -1}, {3, 0, 1}, {}, 0.1, 1.5);
    Slide onMesh = slideOver(true, box, {-3, 0.1, -1}, {3, 0, 1}, {}, 0.1, 1.5, cell, &top);
    expectNear(onMesh.position, onPlane.position, 1e-4, "position");
    expectNear(onMesh.velocity, onPlane.velocity, 1e-4, "velocity");
    EXPECT_LT(top, 0.1 + 1e-5) << cell;
  }
}

TEST(MeshWorld, CapsuleRollsAndHullSlidesAsOnAPlane) {
  ShapeDef capsule = capsuleOf(0.1, 0.3);
  capsule.local.rotation = turn({1, 0, 0}, 90);  // along z
  Slide onPlane = slideOver(false, capsule, {-3, 0.1, 0}, {2, 0, 0}, {0, 0, -20}, 0.6, 2);
  Slide onMesh = slideOver(true, capsule, {-3, 0.1, 0}, {2, 0, 0}, {0, 0, -20}, 0.6, 2);
  expectNear(onMesh.position, onPlane.position, 1e-4, "capsule");
  expectNear(onMesh.velocity, onPlane.velocity, 1e-4, "capsule velocity");

  ShapeDef hull = boxOf({});
  hull.type = ShapeType::hull;
  hull.material.friction = 0.1;
  hull.vertices = {{-0.2, 0, -0.2}, {0.2, 0, -0.2}, {0.25, 0, 0.1}, {-0.1, 0, 0.25}, {0, 0.2, 0}, {0.1, 0.15, 0.05}};
  onPlane = slideOver(false, hull, {-3, 0, 0}, {2.5, 0, 0.4}, {}, 0.1, 1.5);
  onMesh = slideOver(true, hull, {-3, 0, 0}, {2.5, 0, 0.4}, {}, 0.1, 1.5);
  expectNear(onMesh.position, onPlane.position, 1e-4, "hull");
  expectNear(onMesh.velocity, onPlane.velocity, 1e-4, "hull velocity");
}

// Where triangles meet at an angle there is something to feel: a ball rolls down into a valley and up its other side.
TEST(MeshWorld, BallCrossesAValley) {
  MeshData valley{{{-4, 1, -2}, {0, 0, -2}, {4, 1, -2}, {-4, 1, 2}, {0, 0, 2}, {4, 1, 2}},
                  {0, 3, 1, 1, 3, 4, 1, 4, 2, 2, 4, 5}};
  World world = awakeWorld();
  addMesh(world, valley);
  double slope = std::atan2(1, 4), r = 0.1;
  Vec3 start = Vec3{-2, 0.5, 0.1} + Vec3{std::sin(slope), std::cos(slope), 0} * r;
  BodyId ball = add(world, bodyOf(sphereOf(r), start));
  double furthest = -10, before = world.energy().kinetic + world.energy().potential;
  for (int n = 0; n < 240; n++) {
    stepSound(world);
    furthest = std::max(furthest, world.state(ball)->position.x);
  }
  EXPECT_GT(furthest, 1.0);  // without the knock at the bottom it would reach +2
  EXPECT_LT(furthest, 2.0);
  EXPECT_LT(world.energy().kinetic + world.energy().potential, before + 1e-6);
}

// --- shapes come to rest

TEST(MeshWorld, EveryShapeRestsOnAMeshBox) {
  std::vector<ShapeDef> shapes = {boxOf({0.2, 0.1, 0.15}), sphereOf(0.2), capsuleOf(0.1, 0.2), hullOf(0.25)};
  for (const ShapeDef& shape : shapes) {
    World world = makeWorld();
    addMesh(world, cubeMesh(0.5), {0, -0.5, 0});
    BodyDef def = bodyOf(shape, {0.05, 0.5, -0.03});
    def.angularDamping = 2;
    def.rotation = turn({1, 0.3, 0.2}, shape.type == ShapeType::sphere ? 0 : 20);
    BodyId body = add(world, def);
    run(world, 6);
    BodyState s = *world.state(body);
    EXPECT_GT(s.position.y, 0.05) << int(shape.type);
    EXPECT_LT(s.position.y, 0.4) << int(shape.type);
    EXPECT_LT(length(s.linearVelocity), 0.02) << int(shape.type);
    ShapeId ground = world.shapes(world.bodies()[0])[0], own = world.shapes(body)[0];
    EXPECT_LT(*world.penetration(ground, own), 2e-4) << int(shape.type);
    if (shape.type == ShapeType::box || shape.type == ShapeType::sphere) {
      EXPECT_NEAR(s.position.y, shape.type == ShapeType::box ? 0.1 : 0.2, 2e-4);
    }
  }
}

// A box in a groove leans on both sides: two manifolds.
TEST(MeshWorld, BoxInAGrooveHasAContactForEachSide) {
  MeshData groove{{{-1, 1, -1}, {0, 0, -1}, {1, 1, -1}, {-1, 1, 1}, {0, 0, 1}, {1, 1, 1}},
                  {0, 3, 1, 1, 3, 4, 1, 4, 2, 2, 4, 5}};
  World world = makeWorld();
  addMesh(world, groove);
  BodyDef def = bodyOf(boxOf({0.2, 0.2, 0.2}), {0, 0.2 * std::sqrt(2.0), 0});
  def.rotation = turn({0, 0, 1}, 45);
  BodyId body = add(world, def);
  run(world, 2);
  EXPECT_FALSE(world.state(body)->awake);
  expectNear(world.state(body)->position, {0, 0.2 * std::sqrt(2.0), 0}, 5e-4);
  int left = 0, right = 0, points = 0;
  double up = 0;
  world.forEachContact([&](const ContactView& c) {
    (c.normalWorld.x > 0 ? left : right)++;
    points += c.pointCount;
    for (int i = 0; i < c.pointCount; i++)
      up += c.normalWorld.y * c.points[i].normalForce + c.points[i].frictionForce.y;
  });
  EXPECT_EQ(left, 1);
  EXPECT_EQ(right, 1);
  EXPECT_EQ(points, 8);
  double weight = 1000 * 0.4 * 0.4 * 0.4 * kG;
  EXPECT_NEAR(up, weight, 0.02 * weight);
}

// On a rim, over a corner: what rests half over the edge of a table stays if its middle is over it, and falls if not.
TEST(MeshWorld, OverhangStaysOrFallsByItsMiddle) {
  for (double offset : {-0.04, 0.04}) {
    World world = makeWorld();
    addMesh(world, cubeMesh(0.5), {0, -0.5, 0});
    BodyId box = add(world, bodyOf(boxOf({0.2, 0.05, 0.1}), {0.5 + offset, 0.05, 0.1}));
    run(world, 1.5);
    if (offset < 0) {
      expectNear(world.state(box)->position, {0.5 + offset, 0.05, 0.1}, 1e-3);
    } else {
      EXPECT_LT(world.state(box)->position.y, -0.05);
    }
  }
}

// A wall, three bricks wide and eight courses high, in running bond; half bricks at the ends.
std::vector<BodyId> addWall(World& world) {
  Vec3 half{0.1, 0.0325, 0.05};
  std::vector<BodyId> bricks;
  for (int course = 0; course < 8; course++)
    for (int i = 0; i < (course % 2 ? 4 : 3); i++) {
      bool bat = course % 2 && (i == 0 || i == 3);
      double x = course % 2 ? (i == 0 ? -0.25 : i == 3 ? 0.25 : 0.2 * i - 0.3) : 0.2 * i - 0.2;
      bricks.push_back(
          add(world, bodyOf(boxOf({bat ? 0.05 : 0.1, half.y, half.z}, 1900), {x, half.y * (2 * course + 1), 0.1})));
    }
  return bricks;
}

TEST(MeshWorld, WallStandsOnAMeshAsOnAPlane) {
  for (double cell : {0.04, 0.17, 1.0}) {
    World onPlane = awakeWorld(), onMesh = awakeWorld();
    addGround(onPlane);
    addMesh(onMesh, flatFloor(2, cell, 8));
    std::vector<BodyId> reference = addWall(onPlane), bricks = addWall(onMesh);
    std::vector<Vec3> start;
    for (BodyId brick : bricks) start.push_back(onMesh.state(brick)->position);
    for (int n = 0; n < 300 && !HasFailure(); n++) {
      ASSERT_TRUE(onPlane.step(kDt));
      ASSERT_TRUE(onMesh.step(kDt));
    }
    expectSound(onMesh);
    double moved = 0, apart = 0;
    for (std::size_t i = 0; i < bricks.size(); i++) {
      Vec3 there = onMesh.state(bricks[i])->position;
      moved = std::max(moved, length(there - start[i]));
      apart = std::max(apart, length(there - onPlane.state(reference[i])->position));
    }
    EXPECT_LT(moved, 1e-4) << cell;
    EXPECT_LT(apart, 2e-5) << cell;
  }
}

// --- fast bodies

TEST(MeshWorld, FastBallDoesNotPassAWallOfTriangles) {
  Random random(5);
  int stopped = 0;
  for (double speed : {20.0, 60.0, 200.0, 900.0})
    for (int i = 0; i < 6; i++) {
      World world = emptySpace();
      MeshData wall = gridMesh(10, 10, 0.4);
      for (Vec3& v : wall.vertices) v = {v.y, v.z, v.x};  // its front towards +x
      addMesh(world, wall);
      BodyDef def =
          bodyOf(i % 2 ? sphereOf(0.05) : boxOf({0.05, 0.04, 0.06}), {3, random.between(-1, 1), random.between(-1, 1)});
      def.linearVelocity = {-speed, 0.1 * speed * random.between(-1, 1), 0};
      def.angularVelocity = {0, 0, i > 3 ? 30.0 : 0.0};
      BodyId body = add(world, def);
      for (int n = 0; n < 60 && !HasFailure(); n++) {
        stepSound(world);
        ASSERT_GT(world.state(body)->position.x, 0) << speed << " m/s, " << i;
        if (std::fabs(world.state(body)->position.y) > 1.8) break;
      }
      stopped++;
    }
  EXPECT_EQ(stopped, 24);
}

// Through the back: a surface has no other side.
TEST(MeshWorld, WhatIsBehindASurfaceMovesFreely) {
  World world = emptySpace();
  MeshData wall = gridMesh(4, 4, 0.5);
  for (Vec3& v : wall.vertices) v = {v.y, v.z, v.x};
  addMesh(world, wall);
  BodyDef def = bodyOf(sphereOf(0.1), {-1, 0.1, 0.1});
  def.linearVelocity = {3, 0, 0};
  BodyId body = add(world, def);
  run(world, 1);
  EXPECT_NEAR(world.state(body)->position.x, 2, 1e-6);
}

// --- moved by hand

TEST(MeshWorld, KinematicMeshCarriesWhatLiesOnIt) {
  World world = makeWorld();
  BodyDef def = bodyOf(meshOf(cubeMesh(0.5)), {0, -0.5, 0}, BodyType::kinematic);
  def.linearVelocity = {0.5, 0.2, 0};
  add(world, def);
  BodyId box = add(world, bodyOf(boxOf({0.1, 0.1, 0.1}), {0, 0.1, 0}));
  run(world, 2);
  expectNear(world.state(box)->linearVelocity, {0.5, 0.2, 0}, 2e-3);
  EXPECT_NEAR(world.state(box)->position.y, 0.1 + 0.4, 2e-3);
}

// --- queries

TEST(MeshWorld, QueriesSeeTheSurface) {
  World world = makeWorld();
  BodyId ground = addMesh(world, cubeMesh(0.5), {10, 0.5, 0});
  auto hit = *world.castRay({10.1, 5, 0.2}, {0, -1, 0}, 100);
  ASSERT_TRUE(hit);
  EXPECT_EQ(hit->body, ground);
  EXPECT_NEAR(hit->distance, 4, 1e-12);
  expectNear(hit->normalWorld, {0, 1, 0}, 1e-12);
  hit = *world.castRay({10.1, 0.5, 0.2}, {0, -1, 0}, 100);  // from inside
  ASSERT_TRUE(hit);
  EXPECT_NEAR(hit->distance, 0.5, 1e-12);
  auto closest = *world.closest({10, 3, 0}, 10);
  ASSERT_TRUE(closest);
  EXPECT_NEAR(closest->distance, 2, 1e-12);
  EXPECT_EQ(world.overlapSphere({10, 1.3, 0}, 0.31)->size(), 1u);
  EXPECT_EQ(world.overlapSphere({10, 1.3, 0}, 0.29)->size(), 0u);
  EXPECT_EQ(world.overlapSphere({10, 0.5, 0}, 0.1)->size(), 0u);  // inside: touches nothing of the surface
  EXPECT_EQ(world.overlapBox({{9, 0.9, -0.1}, {11, 1.1, 0.1}})->size(), 1u);
  EXPECT_EQ(world.overlapBox({{9, 1.01, -0.1}, {11, 1.1, 0.1}})->size(), 0u);
  BodyId ball = add(world, bodyOf(sphereOf(0.2), {10, 1.15, 0}, BodyType::fixed));
  EXPECT_NEAR(*world.penetration(world.shapes(ground)[0], world.shapes(ball)[0]), 0.05, 1e-9);
  BodyId box = add(world, bodyOf(boxOf({0.2, 0.2, 0.2}), {10, 1.15, 0}, BodyType::fixed));
  EXPECT_NEAR(*world.penetration(world.shapes(box)[0], world.shapes(ground)[0]), 0.05, 1e-9);
  BodyId high = add(world, bodyOf(boxOf({0.2, 0.2, 0.2}), {10, 1.25, 0}, BodyType::fixed));
  EXPECT_EQ(*world.penetration(world.shapes(high)[0], world.shapes(ground)[0]), 0);
}

// --- the world as a whole

World debrisOnTerrain(int bodies) {
  World world = makeWorld();
  MeshData hills = terrainMesh(1200);
  for (Vec3& v : hills.vertices) v = Vec3{4 * v.x, 3 * v.y, 4 * v.z};
  addMesh(world, hills);
  Random random(9);
  for (int i = 0; i < bodies; i++) {
    ShapeDef shape = i % 4 == 0   ? boxOf({0.11, 0.05, 0.08})
                     : i % 4 == 1 ? sphereOf(0.1)
                     : i % 4 == 2 ? capsuleOf(0.06, 0.1)
                                  : hullOf(0.12);
    BodyDef def = bodyOf(shape, {random.between(-2, 2), random.between(1.2, 3), random.between(-2, 2)});
    def.rotation = randomRotation(random);
    def.angularDamping = 0.5;
    add(world, def);
  }
  return world;
}

TEST(MeshWorld, DebrisOnHillsSettlesInTheSameWayEveryTime) {
  World first = debrisOnTerrain(40), second = debrisOnTerrain(40);
  for (int n = 0; n < 300 && !HasFailure(); n++) {
    stepSound(first);
    ASSERT_TRUE(second.step(kDt));
  }
  EXPECT_EQ(first.stateHash(), second.stateHash());
  int through = 0, slow = 0;
  for (BodyId body : first.bodies()) {
    BodyState s = *first.state(body);
    if (s.type != BodyType::dynamic) continue;
    bool inside = std::fabs(s.position.x) < 3.9 && std::fabs(s.position.z) < 3.9;
    through += inside && s.position.y < -1;
    slow += length(s.linearVelocity) < 0.05;
  }
  EXPECT_EQ(through, 0);
  EXPECT_GT(slow, 25);
}

// Many shapes thrown on ground whose triangles are larger and smaller than they are: none gets under it, none stays in it. (A
// ridge under a box once gave one point at a time, and the box sank in while it rocked.)
TEST(MeshWorld, NothingSinksIntoHills) {
  double worst = 0, third = 0;  // m, sums over worlds
  constexpr int kWorlds = 4;
  for (int n = 0; n < kWorlds; n++) {
    const int triangles = n % 2 ? 3000 : 400;
    World world = makeWorld();
    MeshData hills = terrainMesh(triangles);
    for (Vec3& v : hills.vertices) v *= 4.0;
    BodyId ground = addMesh(world, hills);
    MeshTree tree = treeOf(hills);
    Random random{std::uint64_t(triangles + n / 2)};
    std::vector<BodyId> bodies;
    for (int i = 0; i < 80; i++) {
      ShapeDef shape = i % 4 == 0 ? boxOf({0.1, 0.05, 0.08}) : i % 4 == 1 ? sphereOf(0.08) : capsuleOf(0.05, 0.12);
      if (i % 4 == 3) {
        shape = hullOf(1);
        shape.vertices = randomPoints(random, 14, {0.12, 0.1, 0.12});
      }
      BodyDef def = bodyOf(shape, {random.between(-2.5, 2.5), random.between(2.2, 4.5), random.between(-2.5, 2.5)});
      def.rotation = randomRotation(random);
      def.linearVelocity = {random.between(-3, 3), random.between(-12, 0), random.between(-3, 3)};
      bodies.push_back(add(world, def));
    }
    std::vector<double> deepest(bodies.size());
    int measured = 0;
    for (int step = 0; step < 300 && !HasFailure(); step++) {
      stepSound(world);
      if (step % 20 != 19) continue;
      for (std::size_t i = 0; i < bodies.size(); i++) {
        Vec3 p = world.state(bodies[i])->centreOfMass;
        std::optional<MeshRayHit> top = tree.castRay({p.x, 50, p.z}, {0, -1, 0}, 200);
        if (!top) continue;  // over the rim
        ASSERT_GT(p.y, top->point.y) << triangles << " step " << step;
        measured++;
        double depth = *world.penetration(world.shapes(ground)[0], world.shapes(bodies[i])[0]);
        if (step > 120) deepest[i] = std::max(deepest[i], depth);
      }
    }
    EXPECT_GT(measured, 700);
    std::sort(deepest.begin(), deepest.end());
    EXPECT_LT(deepest.back(), 0.07) << triangles << " world " << n / 2;
    worst += deepest.back();
    third += deepest[deepest.size() - 3];
  }
  // Measured in 120 worlds: 15.7 mm in the mean, 65 mm at most, but 3.4 mm in the mean for the third deepest: one or two capsules 100 mm
  // thick spin in a hollow, their turn seen only in part.
  EXPECT_LT(worst / kWorlds, 0.025);
  EXPECT_LT(third / kWorlds, 0.007);
}

TEST(MeshWorld, SnapshotGoesOnBitForBit) {
  World world = debrisOnTerrain(20);
  for (int n = 0; n < 60; n++) stepSound(world);
  std::vector<std::byte> bytes = world.snapshot();
  World other = makeWorld();
  Status restored = other.restore(bytes);
  ASSERT_TRUE(restored) << restored.error().message;
  expectSound(other);
  EXPECT_EQ(other.snapshot(), bytes);
  for (int n = 0; n < 120; n++) {
    stepSound(world);
    stepSound(other);
    ASSERT_EQ(world.stateHash(), other.stateHash()) << n;
  }
}

TEST(MeshWorld, SleepersWakeAndPartsGoWithThem) {
  World world = makeWorld();
  addMesh(world, flatFloor(3, 0.3, 1));
  BodyId box = add(world, bodyOf(boxOf({0.2, 0.1, 0.2}), {0, 0.1, 0}));
  run(world, 2);
  ASSERT_FALSE(world.state(box)->awake);
  ASSERT_TRUE(world.applyImpulse(box, {40, 0, 0}));
  run(world, 2);
  EXPECT_FALSE(world.state(box)->awake);
  EXPECT_GT(world.state(box)->position.x, 0.05);
  BodyId ground = world.bodies()[0];
  ASSERT_TRUE(world.destroyBody(ground));
  expectSound(world);
  run(world, 0.5);
  EXPECT_LT(world.state(box)->position.y, -0.5);
}

TEST(MeshWorld, DebugDrawGetsTheMesh) {
  World world = makeWorld();
  ShapeDef mesh = meshOf(cubeMesh());
  add(world, bodyOf(mesh, {1, 2, 3}, BodyType::fixed));
  int seen = 0;
  DebugDraw draw;
  draw.shape = [&](BodyId, const ShapeDef& shape, const Transform& pose, std::uint32_t) {
    seen += shape.mesh == mesh.mesh && pose.position == Vec3{1, 2, 3};
  };
  world.draw(draw);
  EXPECT_EQ(seen, 1);
}

}  // namespace
