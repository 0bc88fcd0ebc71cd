// Bodies and what can be read from them: mass of compounds, frames, teleports, changes of type.
#include "support/world_helpers.h"

namespace brickfall {
namespace {

using namespace test;

TEST(Bodies, EveryShapeFallsAndComesToRestOnTheGround) {
  const std::pair<ShapeDef, double> shapes[] = {
      {boxOf({0.1, 0.2, 0.15}), 0.2}, {sphereOf(0.2), 0.2}, {capsuleOf(0.1, 0.2), 0.3}, {hullOf(0.3), 0.3}};
  for (const auto& [shape, height] : shapes) {
    World world = makeWorld();
    addGround(world);
    BodyId body = add(world, bodyOf(shape, {0.3, height + 0.05, -0.2}));
    run(world, 1.5);
    BodyState s = *world.state(body);
    EXPECT_LT(length(s.linearVelocity), 0.2) << "shape " << int(shape.type);
    EXPECT_GT(s.position.y, 0.05);
    EXPECT_LE(s.position.y, height + 1e-3);
  }
}

TEST(Bodies, MassOfACompoundIsThatOfItsParts) {
  World world = emptySpace();
  BodyDef d;  // a dumb-bell: two boxes of 8 and 4 kg, 1 m apart
  ShapeDef left = boxOf({0.1, 0.1, 0.1}, 1000), right = boxOf({0.1, 0.1, 0.1}, 500);
  left.local.position = {-0.5, 0, 0};
  right.local.position = {0.5, 0, 0};
  d.shapes = {left, right};
  d.position = {1, 2, 3};
  BodyId body = add(world, d);
  MassProperties m = *world.massProperties(body);
  EXPECT_NEAR(m.mass, 12, 1e-12);
  expectNear(m.centre, {(-4.0 + 2.0) / 12, 0, 0}, 1e-12);
  double own = (8 + 4) * (0.04 + 0.04) / 12;
  double steiner = 8 * std::pow(-0.5 + 1.0 / 6, 2) + 4 * std::pow(0.5 + 1.0 / 6, 2);
  EXPECT_NEAR(m.inertia.row[0].x, own, 1e-12);
  EXPECT_NEAR(m.inertia.row[1].y, own + steiner, 1e-12);
  EXPECT_NEAR(m.inertia.row[2].z, own + steiner, 1e-12);
  BodyState s = *world.state(body);
  expectNear(s.position, {1, 2, 3}, 1e-15);
  expectNear(s.centreOfMass, {1 - 1.0 / 6, 2, 3}, 1e-15);
  EXPECT_EQ(s.mass, m.mass);
}

TEST(Bodies, ATransformThatWasReadIsPutBackBitForBit) {
  World world = emptySpace();
  BodyDef def = bodyOf(boxOf({0.1, 0.2, 0.3}), {1, 2, 3});
  def.angularVelocity = {1, 2, 3};
  BodyId body = add(world, def);
  for (int i = 0; i < 100; i++) {
    ASSERT_TRUE(world.step(kDt).ok());
    BodyState s = *world.state(body);
    std::uint64_t hash = world.stateHash();
    ASSERT_TRUE(world.setTransform(body, s.position, s.rotation).ok());
    ASSERT_EQ(world.stateHash(), hash) << i;
  }
}

TEST(Bodies, CompoundSpinsAboutItsCentreOfMassNotItsOrigin) {
  World world = emptySpace();
  BodyDef d;
  ShapeDef far = boxOf({0.1, 0.1, 0.1});
  far.local.position = {2, 0, 0};
  d.shapes = {far};
  d.angularVelocity = {0, 3, 0};
  BodyId body = add(world, d);
  run(world, 1);
  BodyState s = *world.state(body);
  expectNear(s.centreOfMass, {2, 0, 0}, 1e-12, "centre");
  expectNear(s.position, Vec3{2, 0, 0} - rotate(s.rotation, Vec3{2, 0, 0}), 1e-12, "origin");
  EXPECT_GT(length(s.position), 1);
}

TEST(Bodies, ListsBodiesAndShapesInOrderOfCreation) {
  World world = emptySpace();
  std::vector<BodyId> made;
  for (int i = 0; i < 5; i++) made.push_back(addBox(world, {0.1, 0.1, 0.1}, {double(i), 0, 0}));
  ASSERT_TRUE(world.destroyBody(made[1]).ok());
  made.erase(made.begin() + 1);
  made.push_back(addBox(world, {0.1, 0.1, 0.1}, {9, 0, 0}));  // takes the free slot, comes last
  EXPECT_EQ(world.bodies(), made);
  BodyDef two;
  two.shapes = {boxOf({0.1, 0.2, 0.3}), sphereOf(0.4)};
  two.shapes[1].userData = 77;
  two.position = {0, 9, 0};
  two.userData = 5;
  BodyId body = add(world, two);
  std::vector<ShapeId> shapes = world.shapes(body);
  ASSERT_EQ(shapes.size(), 2u);
  EXPECT_EQ(world.shape(shapes[0])->halfExtents, (Vec3{0.1, 0.2, 0.3}));
  EXPECT_EQ(world.shape(shapes[1])->radius, 0.4);
  EXPECT_EQ(world.shape(shapes[1])->userData, 77u);
  EXPECT_EQ(world.state(body)->userData, 5u);
}

TEST(Bodies, RotationIsNormalised) {
  World world = emptySpace();
  BodyDef d = bodyOf(boxOf({0.1, 0.1, 0.1}), {});
  d.rotation = {0, 0, 3, 4};
  Quat q = world.state(add(world, d))->rotation;
  EXPECT_NEAR(q.z, 0.6, 1e-15);
  EXPECT_NEAR(q.w, 0.8, 1e-15);
}

TEST(Bodies, TeleportLeavesContactsBehindAndMakesNewOnes) {
  World world = makeWorld();
  addGround(world);
  BodyId lower = addBox(world, {0.5, 0.5, 0.5}, {0, 0.5, 0}), upper = addBox(world, {0.5, 0.5, 0.5}, {0, 1.5, 0});
  run(world, 1.5);
  EXPECT_FALSE(world.state(upper)->awake);
  ASSERT_TRUE(world.setTransform(lower, {5, 0.5, 0}, {}).ok());
  expectSound(world);
  EXPECT_TRUE(world.state(upper)->awake);
  run(world, 1.5);
  EXPECT_NEAR(world.state(upper)->position.y, 0.5, 2e-3) << "did not fall onto the ground";
  expectNear(world.state(lower)->position, {5, 0.5, 0}, 2e-3);
  // and back on top of the other
  ASSERT_TRUE(world.setTransform(lower, {0, 1.5, 0}, {}).ok());
  run(world, 1.5);
  expectNear(world.state(lower)->position, {0, 1.5, 0}, 5e-3);
}

TEST(Bodies, TeleportedGroundTakesItsContactsAlong) {
  World world = makeWorld();
  BodyId ground = addGround(world);
  BodyId box = addBox(world, {0.2, 0.2, 0.2}, {0, 0.2, 0});
  run(world, 1);
  ASSERT_TRUE(world.setTransform(ground, {0, -1, 0}, {}).ok());
  run(world, 2);
  EXPECT_NEAR(world.state(box)->position.y, -0.8, 1e-2);
}

TEST(Bodies, FixedBecomesDynamicAndBack) {
  World world = makeWorld();
  addGround(world);
  BodyId box = add(world, bodyOf(boxOf({0.2, 0.2, 0.2}), {0, 3, 0}, BodyType::fixed));
  BodyId on = addBox(world, {0.1, 0.1, 0.1}, {0, 3.3, 0});
  run(world, 1);
  EXPECT_EQ(world.state(box)->position.y, 3);
  EXPECT_EQ(world.state(box)->mass, 0);
  EXPECT_NEAR(world.state(on)->position.y, 3.3, 2e-3);
  ASSERT_TRUE(world.setType(box, BodyType::dynamic).ok());
  expectSound(world);
  EXPECT_NEAR(world.state(box)->mass, 64, 1e-9);
  run(world, 0.25);
  EXPECT_NEAR(world.state(box)->position.y, 3 - 0.5 * kG * 0.0625, 2e-2);
  EXPECT_LT(world.state(on)->position.y, 3.15) << "what stood on it stayed in the air";
  ASSERT_TRUE(world.setType(box, BodyType::fixed).ok());
  double height = world.state(box)->position.y;
  run(world, 2);
  EXPECT_EQ(world.state(box)->position.y, height);
  EXPECT_NEAR(world.state(on)->position.y, height + 0.3, 1e-2);
}

TEST(Bodies, ChangeOfTypeKeepsVelocitiesUnlessFixed) {
  World world = emptySpace();
  BodyDef d = bodyOf(boxOf({0.2, 0.2, 0.2}), {});
  d.linearVelocity = {1, 2, 3};
  d.angularVelocity = {0.5, 0, 0};
  BodyId body = add(world, d);
  ASSERT_TRUE(world.setType(body, BodyType::kinematic).ok());
  EXPECT_EQ(world.state(body)->linearVelocity, (Vec3{1, 2, 3}));
  run(world, 1);
  expectNear(world.state(body)->position, {1, 2, 3}, 1e-9);
  ASSERT_TRUE(world.setType(body, BodyType::dynamic).ok());
  EXPECT_EQ(world.state(body)->linearVelocity, (Vec3{1, 2, 3}));
  run(world, 1);
  expectNear(world.state(body)->position, {2, 4, 6}, 1e-9);
  ASSERT_TRUE(world.setType(body, BodyType::fixed).ok());
  EXPECT_EQ(world.state(body)->linearVelocity, (Vec3{}));
  EXPECT_EQ(world.state(body)->angularVelocity, (Vec3{}));
  stepSound(world);
}

TEST(Bodies, AccelerationIsTheMeanOverTheStep) {
  World world = makeWorld();
  BodyId free = addBox(world, {0.1, 0.1, 0.1}, {0, 9, 0});
  BodyDef d = bodyOf(boxOf({0.1, 0.1, 0.1}), {5, 9, 0});
  BodyId pushed = add(world, d);
  ASSERT_TRUE(world.applyForce(pushed, {16, 0, 0}).ok());  // 8 kg
  ASSERT_TRUE(world.applyTorque(pushed, {0, 0.1, 0}).ok());
  stepSound(world, kDt, 4);
  expectNear(world.state(free)->linearAcceleration, {0, -kG, 0}, 1e-9);
  expectNear(world.state(pushed)->linearAcceleration, {2, -kG, 0}, 1e-9);
  double inertia = 8 * 2 * 0.04 / 12;
  expectNear(world.state(pushed)->angularAcceleration, {0, 0.1 / inertia, 0}, 1e-9);
  stepSound(world);
  expectNear(world.state(pushed)->linearAcceleration, {0, -kG, 0}, 1e-9, "the force is forgotten");
  ASSERT_TRUE(world.setLinearVelocity(free, {100, 0, 0}).ok());
  ASSERT_TRUE(world.applyImpulse(pushed, {800, 0, 0}).ok());
  stepSound(world);
  expectNear(world.state(free)->linearAcceleration, {0, -kG, 0}, 1e-9, "a velocity that was set is no acceleration");
  expectNear(world.state(pushed)->linearAcceleration, {0, -kG, 0}, 1e-9, "nor is an impulse");
}

TEST(Bodies, EnergyAndMomentumAreSumsOverDynamicBodies) {
  World world = makeWorld();
  addGround(world);
  BodyDef d = bodyOf(boxOf({0.1, 0.1, 0.1}), {1, 5, 2});  // 8 kg
  d.linearVelocity = {3, 0, -1};
  d.angularVelocity = {0, 2, 0};
  add(world, d);
  BodyDef k = bodyOf(boxOf({0.1, 0.1, 0.1}), {9, 5, 2}, BodyType::kinematic);
  k.linearVelocity = {100, 0, 0};
  add(world, k);
  double inertia = 8 * 2 * 0.04 / 12;
  EXPECT_NEAR(world.energy().kinetic, 0.5 * 8 * 10 + 0.5 * inertia * 4, 1e-12);
  EXPECT_NEAR(world.energy().potential, 8 * kG * 5, 1e-9);
  expectNear(world.linearMomentum(), {24, 0, -8}, 1e-12);
  expectNear(world.angularMomentum(), cross(Vec3{1, 5, 2}, Vec3{24, 0, -8}) + Vec3{0, 2 * inertia, 0}, 1e-12);
}

}  // namespace
}  // namespace brickfall
