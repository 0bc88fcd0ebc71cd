// Short words for building worlds in tests, and a step after which every invariant is checked.
#pragma once
#include <gtest/gtest.h>

#include <cmath>
#include <string>

#include "brickfall/brickfall.h"

namespace brickfall::test {

constexpr double kPi = 3.14159265358979323846;
constexpr double kDt = 1.0 / 60;
constexpr double kG = 9.81;

inline World makeWorld(const WorldDef& def = {}) { return std::move(World::create(def)).value(); }
inline World emptySpace() {
  WorldDef def;
  def.gravity = {};
  return makeWorld(def);
}
inline World awakeWorld() {
  WorldDef def;
  def.enableSleep = false;
  return makeWorld(def);
}

inline ShapeDef boxOf(Vec3 half, double density = 1000, double friction = 0.6) {
  ShapeDef s;
  s.halfExtents = half;
  s.material.density = density;
  s.material.friction = friction;
  return s;
}
inline ShapeDef sphereOf(double radius, double density = 1000, double friction = 0.6) {
  ShapeDef s = boxOf({}, density, friction);
  s.type = ShapeType::sphere;
  s.radius = radius;
  return s;
}
inline ShapeDef capsuleOf(double radius, double halfHeight, double density = 1000) {
  ShapeDef s = sphereOf(radius, density);
  s.type = ShapeType::capsule;
  s.halfHeight = halfHeight;
  return s;
}
inline ShapeDef cylinderOf(double radius, double halfHeight, double density = 1000, double friction = 0.6) {
  ShapeDef s = sphereOf(radius, density, friction);
  s.type = ShapeType::cylinder;
  s.halfHeight = halfHeight;
  return s;
}
inline ShapeDef coneOf(double radius, double topRadius, double halfHeight, double density = 1000) {
  ShapeDef s = cylinderOf(radius, halfHeight, density);
  s.type = ShapeType::cone;
  s.topRadius = topRadius;
  return s;
}
inline ShapeDef planeOf(double friction = 0.6) {
  ShapeDef s = boxOf({}, 1000, friction);
  s.type = ShapeType::plane;
  return s;
}
// An octahedron: six corners on the axes.
inline ShapeDef hullOf(double size, double density = 1000) {
  ShapeDef s = boxOf({}, density);
  s.type = ShapeType::hull;
  s.vertices = {{size, 0, 0}, {-size, 0, 0}, {0, size, 0}, {0, -size, 0}, {0, 0, size}, {0, 0, -size}};
  return s;
}

inline BodyDef bodyOf(const ShapeDef& shape, Vec3 position, BodyType type = BodyType::dynamic) {
  BodyDef d;
  d.type = type;
  d.shapes = {shape};
  d.position = position;
  return d;
}
inline BodyId add(World& world, const BodyDef& def) {
  Result<BodyId> body = world.createBody(def);
  EXPECT_TRUE(body.ok()) << body.error().message;
  return body.ok() ? *body : BodyId{};
}
inline BodyId addBox(World& world, Vec3 half, Vec3 position, Vec3 velocity = {}) {
  BodyDef d = bodyOf(boxOf(half), position);
  d.linearVelocity = velocity;
  return add(world, d);
}
inline BodyId addGround(World& world, double friction = 0.6) {
  return add(world, bodyOf(planeOf(friction), {}, BodyType::fixed));
}

inline void expectSound(const World& world) {
  std::vector<std::string> wrong = world.validate();
  EXPECT_TRUE(wrong.empty()) << "step " << world.stepCount() << ": " << (wrong.empty() ? "" : wrong.front());
}
// A step that must succeed, leave every invariant whole and quarantine nobody.
inline StepReport stepSound(World& world, double dt = kDt, int substeps = 1) {
  Result<StepReport> report = world.step(dt, substeps);
  EXPECT_TRUE(report.ok()) << report.error().message;
  if (!report) return {};
  EXPECT_TRUE(report->quarantined.empty()) << "step " << world.stepCount();
  expectSound(world);
  return *report;
}
inline void run(World& world, double seconds, double dt = kDt) {
  for (int n = int(std::lround(seconds / dt)); n > 0 && !testing::Test::HasFailure(); n--) stepSound(world, dt);
}

inline void expectNear(Vec3 found, Vec3 wanted, double tolerance, const char* what = "") {
  EXPECT_NEAR(found.x, wanted.x, tolerance) << what << ".x";
  EXPECT_NEAR(found.y, wanted.y, tolerance) << what << ".y";
  EXPECT_NEAR(found.z, wanted.z, tolerance) << what << ".z";
}
inline Quat turn(Vec3 axis, double degrees) { return quatFromAxisAngle(normalized(axis), degrees * kPi / 180); }

}  // namespace brickfall::test
