// Bodies that are hollow or of uneven density: what is taken for their mass, what is refused, and that it is kept.
#include <cmath>

#include "support/world_helpers.h"

namespace brickfall {
namespace {

using namespace test;

// Half of a box: all below its middle.
MassProperties lowerHalf(Vec3 half) {
  const double volume = 4 * half.x * half.y * half.z;
  const double x = half.x * half.x / 3, y = half.y * half.y / 12, z = half.z * half.z / 3;
  MassProperties mass;
  mass.mass = volume;
  mass.centre = {0, -half.y / 2, 0};
  mass.inertia = diagonal(Vec3{y + z, z + x, x + y} * volume);
  return mass;
}

BodyDef hollowBody(const MassProperties& mass, Vec3 at = {0, 2, 0}) {
  BodyDef def = bodyOf(boxOf({0.2, 0.1, 0.15}), at);
  def.shapes[0].distribution = std::make_shared<const MassProperties>(mass);
  return def;
}

std::string refusalOf(const std::function<void(MassProperties&)>& change) {
  World world = makeWorld();
  MassProperties mass = lowerHalf({0.2, 0.1, 0.15});
  change(mass);
  const Result<BodyId> made = world.createBody(hollowBody(mass));
  return made ? std::string() : made.error().message;
}

TEST(Distribution, IsTheBodysMass) {
  World world = makeWorld();
  const MassProperties half = lowerHalf({0.2, 0.1, 0.15});
  BodyDef def = hollowBody(half);
  def.shapes[0].local = {{1, 0, 0}, quatFromAxisAngle({0, 0, 1}, 1.5707963267948966)};
  const BodyId body = add(world, def);
  const MassProperties mass = *world.massProperties(body);
  const double density = def.shapes[0].material.density;
  EXPECT_NEAR(mass.mass, half.mass * density, 1e-9);
  EXPECT_NEAR(length(mass.centre - Vec3{1.05, 0, 0}), 0, 1e-12);
  EXPECT_NEAR(mass.inertia.row[0].x, half.inertia.row[1].y * density, 1e-9);
  EXPECT_NEAR(length(world.state(body)->centreOfMass - Vec3{1.05, 2, 0}), 0, 1e-12);
  Material lighter = def.shapes[0].material;
  lighter.density *= 0.5;
  ASSERT_TRUE(world.setMaterial(world.shapes(body)[0], lighter).ok());
  EXPECT_NEAR(world.state(body)->mass, 0.5 * half.mass * density, 1e-9);
}

TEST(Distribution, MustBePossible) {
  EXPECT_EQ(refusalOf([](MassProperties&) {}), "");
  const auto has = [](const std::string& text, const char* part) { return text.find(part) != std::string::npos; };
  EXPECT_TRUE(has(refusalOf([](MassProperties& m) { m.mass = 0; }), "shapes[0].distribution.mass"));
  EXPECT_TRUE(has(refusalOf([](MassProperties& m) { m.mass = std::nan(""); }), "distribution.mass"));
  EXPECT_TRUE(has(refusalOf([](MassProperties& m) { m.centre.y = -0.1; }), "distribution.centre"));
  EXPECT_TRUE(has(refusalOf([](MassProperties& m) { m.centre.x = std::nan(""); }), "not finite"));
  EXPECT_TRUE(has(refusalOf([](MassProperties& m) { m.inertia.row[2].z *= 8; }), "distribution.inertia"));
  EXPECT_TRUE(has(refusalOf([](MassProperties& m) { m.inertia = m.inertia * 4.0; }), "than fits into the shape"));
  EXPECT_TRUE(has(refusalOf([](MassProperties& m) { m.inertia = m.inertia * 0.0; }), "distribution.inertia"));
  EXPECT_TRUE(has(refusalOf([](MassProperties& m) { m.inertia.row[0].y = 1e-6; }), "not symmetric"));
  World world = makeWorld();
  BodyDef ball = bodyOf(sphereOf(0.5), {0, 1, 0});
  ball.shapes[0].distribution = std::make_shared<const MassProperties>(lowerHalf({0.2, 0.1, 0.15}));
  EXPECT_TRUE(has(world.createBody(ball).error().message, "expected a box or a hull"));
}

// Heavy at one end: it lies on a table as long as its centre of mass does, wherever its middle is.
TEST(Distribution, DecidesOverWhichEdgeItTips) {
  for (const double over : {0.09, 0.11}) {
    World world = makeWorld();
    BodyDef table = bodyOf(boxOf({1, 0.5, 1}), {-1, 0.5, 0});
    table.type = BodyType::fixed;
    add(world, table);
    // All of its mass beyond the middle: the centre is a quarter of its length from it.
    MassProperties mass = lowerHalf({0.1, 0.2, 0.15});
    MassProperties along;
    along.mass = mass.mass;
    along.centre = {-0.1, 0, 0};
    along.inertia = diagonal(Vec3{mass.inertia.row[1].y, mass.inertia.row[0].x, mass.inertia.row[2].z});
    const BodyId body = add(world, hollowBody(along, {over, 1.1, 0}));
    for (int k = 0; k < 120; k++) stepSound(world);
    EXPECT_EQ(world.state(body)->position.y > 1.05, over < 0.1) << over;
  }
}

TEST(Distribution, IsKeptByASnapshot) {
  World world = makeWorld(), other = makeWorld();
  addGround(world);
  const BodyId body = add(world, hollowBody(lowerHalf({0.2, 0.1, 0.15})));
  for (int k = 0; k < 10; k++) stepSound(world);
  ASSERT_TRUE(other.restore(world.snapshot()).ok());
  const BodyId same = other.bodies().back();
  EXPECT_EQ(other.massProperties(same)->centre, world.massProperties(body)->centre);
  for (int k = 0; k < 60; k++) stepSound(world), stepSound(other);
  EXPECT_EQ(world.stateHash(), other.stateHash());
  ASSERT_NE(other.shape(other.shapes(same)[0])->distribution, nullptr);
}

}  // namespace
}  // namespace brickfall
