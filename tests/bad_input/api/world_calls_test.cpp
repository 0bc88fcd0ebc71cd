// Every call of World with every kind of wrong argument.
#include <array>

#include "refusal.h"

namespace brickfall {
namespace {

using namespace test;

using BodyCall = std::function<Error(World&, BodyId)>;

template <class Answer> Error errorOf(const Answer& answer) { return answer.ok() ? Error{} : answer.error(); }

// All calls that take one body.
std::vector<std::pair<const char*, BodyCall>> bodyCalls() {
  Vec3 v{1, 2, 3};
  return {
      {"state", [](World& w, BodyId b) { return errorOf(w.state(b)); }},
      {"massProperties", [](World& w, BodyId b) { return errorOf(w.massProperties(b)); }},
      {"destroyBody", [](World& w, BodyId b) { return errorOf(w.destroyBody(b)); }},
      {"setType", [](World& w, BodyId b) { return errorOf(w.setType(b, BodyType::kinematic)); }},
      {"setTransform", [=](World& w, BodyId b) { return errorOf(w.setTransform(b, v, {})); }},
      {"setLinearVelocity", [=](World& w, BodyId b) { return errorOf(w.setLinearVelocity(b, v)); }},
      {"setAngularVelocity", [=](World& w, BodyId b) { return errorOf(w.setAngularVelocity(b, v)); }},
      {"setGravityScale", [](World& w, BodyId b) { return errorOf(w.setGravityScale(b, 2)); }},
      {"setDamping", [](World& w, BodyId b) { return errorOf(w.setDamping(b, 1, 1)); }},
      {"setDragArea", [](World& w, BodyId b) { return errorOf(w.setDragArea(b, 1)); }},
      {"checkMaterials", [](World& w, BodyId b) { return errorOf(w.checkMaterials(b, std::vector(1, Material{}))); }},
      {"wake", [](World& w, BodyId b) { return errorOf(w.wake(b)); }},
      {"applyForce", [=](World& w, BodyId b) { return errorOf(w.applyForce(b, v)); }},
      {"applyForceAtPoint", [=](World& w, BodyId b) { return errorOf(w.applyForceAtPoint(b, v, v)); }},
      {"applyTorque", [=](World& w, BodyId b) { return errorOf(w.applyTorque(b, v)); }},
      {"applyImpulse", [=](World& w, BodyId b) { return errorOf(w.applyImpulse(b, v)); }},
      {"applyImpulseAtPoint", [=](World& w, BodyId b) { return errorOf(w.applyImpulseAtPoint(b, v, v)); }},
      {"applyAngularImpulse", [=](World& w, BodyId b) { return errorOf(w.applyAngularImpulse(b, v)); }},
      {"replaceBody", [](World& w, BodyId b) { return errorOf(w.replaceBody(b, {})); }},
      {"setSurfaceVelocity", [=](World& w, BodyId b) { return errorOf(w.setSurfaceVelocity(b, v)); }},
      {"setMassProperties", [](World& w, BodyId b) { return errorOf(w.setMassProperties(b, std::nullopt)); }},
      {"setLocks", [](World& w, BodyId b) { return errorOf(w.setLocks(b, {})); }},
      {"setEnabled", [](World& w, BodyId b) { return errorOf(w.setEnabled(b, false)); }},
      {"sleep", [](World& w, BodyId b) { return errorOf(w.sleep(b)); }},
      {"whyFell", [](World& w, BodyId b) { return errorOf(w.whyFell(b)); }},
  };
}

TEST(WorldCalls, EveryKindOfBadBodyIdIsRefusedByEveryCall) {
  LivedIn s, other;
  BodyId destroyed = addBox(s.world, {0.1, 0.1, 0.1}, {9, 5, 9});
  ShapeId destroyedShape = s.world.shapes(destroyed)[0];
  ASSERT_TRUE(s.world.destroyBody(destroyed).ok());
  BodyId inItsPlace = addBox(s.world, {0.1, 0.1, 0.1}, {9, 5, 9});
  ASSERT_EQ(inItsPlace.index, destroyed.index) << "the slot is used again";
  BodyId next = s.box;
  next.generation++;
  BodyId far = s.box;
  far.index = 0xffffffffu;
  const std::pair<const char*, BodyId> bad[] = {{"null", {}},     {"foreign", other.box}, {"reused slot", destroyed},
                                                {"future", next}, {"far index", far},     {"garbage", {77, 77, 77}}};
  Unchanged unchanged(s.world);
  for (const auto& [kind, id] : bad) {
    SCOPED_TRACE(kind);
    EXPECT_FALSE(s.world.isValid(id));
    EXPECT_TRUE(s.world.shapes(id).empty());
    for (const auto& [name, call] : bodyCalls()) {
      SCOPED_TRACE(name);
      unchanged.refuses(Status(call(s.world, id)), ErrorCode::staleId, "body");
    }
    unchanged.refuses(s.world.sharedFace(s.box, id), ErrorCode::staleId, "body");
    unchanged.refuses(s.world.sharedFace(id, s.box), ErrorCode::staleId, "body");
  }
  ShapeId good = s.world.shapes(s.box)[0], foreign = other.world.shapes(other.box)[0], later = good;
  later.generation++;
  for (ShapeId id : {ShapeId{}, foreign, destroyedShape, later, ShapeId{0xffffffffu, 1, good.world}}) {
    unchanged.refuses(s.world.shape(id), ErrorCode::staleId, "shape");
    unchanged.refuses(s.world.setMaterial(id, {}), ErrorCode::staleId, "shape");
    unchanged.refuses(s.world.penetration(id, good), ErrorCode::staleId, "shape");
    unchanged.refuses(s.world.penetration(good, id), ErrorCode::staleId, "shape");
  }
  EXPECT_EQ(unchanged.calls(), int(6 * (bodyCalls().size() + 2)) + 20);
  stepSound(s.world);
}

TEST(WorldCalls, AnIdStaysStaleHoweverOftenItsSlotIsUsedAgain) {
  World world = makeWorld();
  BodyDef def = bodyOf(boxOf({0.1, 0.1, 0.1}), {});
  BodyId first = add(world, def);
  ShapeId shape = world.shapes(first)[0];
  ASSERT_TRUE(world.destroyBody(first).ok());
  int reused = 0;
  for (int i = 0; i < 70000; i++) {  // generations are 16 bits wide
    Result<BodyId> body = world.createBody(def);
    ASSERT_TRUE(body.ok());
    ASSERT_NE(*body, first) << "after " << i;
    ASSERT_NE(world.shapes(*body)[0], shape) << "after " << i;
    reused += body->index == first.index;
    ASSERT_TRUE(world.destroyBody(*body).ok());
  }
  EXPECT_GT(reused, 65000);
  EXPECT_FALSE(world.isValid(first));
  expectSound(world);
}

TEST(WorldCalls, EveryNumberOfASetterIsChecked) {
  LivedIn s;
  Unchanged unchanged(s.world);
  World& w = s.world;
  for (double bad : {kNan, kInf, -kInf, 1e300, -1e300})
    for (int axis = 0; axis < 3; axis++) {
      SCOPED_TRACE(bad);
      Vec3 v;
      v[axis] = bad;
      std::string name = std::string(".") + "xyz"[axis];
      unchanged.refusesValue(w.setTransform(s.box, v, {}), "position" + name);
      unchanged.refusesValue(w.setLinearVelocity(s.box, v), "velocity" + name);
      unchanged.refusesValue(w.setAngularVelocity(s.paddle, v), "velocity" + name);
      unchanged.refusesValue(w.setSurfaceVelocity(s.paddle, v), "surfaceVelocity" + name);
      unchanged.refusesValue(w.setGravity(v), "gravity" + name);
      unchanged.refusesValue(w.applyForce(s.box, v), "force" + name);
      unchanged.refusesValue(w.applyForceAtPoint(s.box, v, {}), "force" + name);
      unchanged.refusesValue(w.applyForceAtPoint(s.box, {}, v), "pointWorld" + name);
      unchanged.refusesValue(w.applyTorque(s.sleeper, v), "torque" + name);
      unchanged.refusesValue(w.applyImpulse(s.sleeper, v), "force" + name);
      unchanged.refusesValue(w.applyImpulseAtPoint(s.box, v, {}), "force" + name);
      unchanged.refusesValue(w.applyImpulseAtPoint(s.box, {}, v), "pointWorld" + name);
      unchanged.refusesValue(w.applyAngularImpulse(s.box, v), "torque" + name);
      unchanged.refusesValue(w.castRay(v, {1, 0, 0}, 1), "origin" + name);
      unchanged.refusesValue(w.overlapBox({v, {1e6, 1e6, 1e6}}), "box.lower" + name);
      unchanged.refusesValue(w.overlapSphere(v, 1), "centre" + name);
      unchanged.refusesValue(w.closest(v, 1), "point" + name);
      if (!(std::fabs(bad) < 1e308)) unchanged.refusesValue(w.castRay({}, v, 1), "direction");
    }
  for (double bad : {kNan, kInf, -kInf, -1.0, 1e300}) {
    SCOPED_TRACE(bad);
    if (bad != -1) unchanged.refusesValue(w.setGravityScale(s.box, bad), "scale");
    unchanged.refusesValue(w.setDamping(s.box, bad, 0), "linear");
    unchanged.refusesValue(w.setDamping(s.box, 0, bad), "angular");
    unchanged.refusesValue(w.setDragArea(s.box, bad), "dragArea");
    unchanged.refusesValue(w.castRay({}, {1, 0, 0}, bad), "maxDistance");
    unchanged.refusesValue(w.overlapSphere({}, bad), "radius");
    unchanged.refusesValue(w.closest({}, bad), "maxDistance");
  }
  for (Quat bad : {Quat{0, 0, 0, 0}, Quat{kNan, 0, 0, 1}, Quat{0, kInf, 0, 1}, Quat{0, 0, 1e200, 1}})
    unchanged.refusesValue(w.setTransform(s.box, {}, bad), "rotation");
  unchanged.refusesValue(w.castRay({}, {}, 1), "direction");
  unchanged.refusesValue(w.overlapBox({{1, 0, 0}, {0, 1, 1}}), "box.lower.x");
  unchanged.refusesValue(w.overlapBox({{0, 1, 0}, {1, 0, 1}}), "box.lower.y");
  unchanged.refusesValue(w.overlapBox({{0, 0, 1}, {1, 1, 0}}), "box.lower.z");
  for (int bad : {3, 4, 255}) unchanged.refusesValue(w.setType(s.box, BodyType(bad)), "type");
  stepSound(s.world);
}

TEST(WorldCalls, BodiesThatCanNotBePushedOrChangedSaySo) {
  LivedIn s;
  Unchanged unchanged(s.world);
  World& w = s.world;
  for (BodyId body : {s.ground, s.wall}) {
    unchanged.refuses(w.setLinearVelocity(body, {1, 0, 0}), ErrorCode::wrongState, "velocity");
    unchanged.refuses(w.setAngularVelocity(body, {1, 0, 0}), ErrorCode::wrongState, "velocity");
  }
  for (BodyId body : {s.ground, s.wall, s.paddle}) {
    unchanged.refuses(w.applyForce(body, {1, 0, 0}), ErrorCode::wrongState, "force");
    unchanged.refuses(w.applyTorque(body, {1, 0, 0}), ErrorCode::wrongState, "force");
    unchanged.refuses(w.applyImpulse(body, {1, 0, 0}), ErrorCode::wrongState, "force");
    unchanged.refuses(w.applyAngularImpulse(body, {1, 0, 0}), ErrorCode::wrongState, "force");
  }
  unchanged.refuses(w.setType(s.ground, BodyType::dynamic), ErrorCode::invalidArgument, "plane");
  for (BodyId body : {s.box, s.sleeper})
    unchanged.refuses(w.setSurfaceVelocity(body, {1, 0, 0}), ErrorCode::wrongState, "surfaceVelocity");
}

TEST(WorldCalls, StepRefusesEveryBadTime) {
  LivedIn s;
  Unchanged unchanged(s.world);
  for (double dt : {0.0, -0.0, -1.0, -kDt, 1e-300, 1e-6, 0.1000001, 1.0, 1e9, 1e300, kNan, kInf, -kInf})
    unchanged.refusesValue(s.world.step(dt), "dt");
  for (int substeps : {0, -1, 65, 1 << 30, -(1 << 30)}) unchanged.refusesValue(s.world.step(kDt, substeps), "substeps");
  EXPECT_EQ(unchanged.calls(), 18);
  EXPECT_TRUE(s.world.step(0.1, 64).ok());
  EXPECT_TRUE(s.world.step(1e-5, 64).ok());
  EXPECT_TRUE(s.world.step(0.1, 1).ok());
  expectSound(s.world);
}

TEST(WorldCalls, EveryFieldOfABodyIsChecked) {
  LivedIn s;
  Unchanged unchanged(s.world);
  int wrong = 0;
  auto refuses = [&](const std::string& field, const std::function<void(BodyDef&)>& spoil) {
    BodyDef d = bodyOf(boxOf({0.1, 0.1, 0.1}), {0, 5, 0});
    d.shapes.push_back(sphereOf(0.1));
    d.shapes.push_back(capsuleOf(0.1, 0.1));
    d.shapes.push_back(hullOf(0.1));
    spoil(d);
    unchanged.refusesValue(s.world.createBody(d), field);
    wrong++;
  };
  for (double bad : {kNan, kInf, -kInf, 1e300, -1e300})
    for (int axis = 0; axis < 3; axis++) {
      refuses("position", [=](BodyDef& d) { d.position[axis] = bad; });
      refuses("linearVelocity", [=](BodyDef& d) { d.linearVelocity[axis] = bad; });
      refuses("angularVelocity", [=](BodyDef& d) { d.angularVelocity[axis] = bad; });
      refuses("shapes[1].local.position", [=](BodyDef& d) { d.shapes[1].local.position[axis] = bad; });
      refuses("shapes[3].vertices[4]", [=](BodyDef& d) { d.shapes[3].vertices[4][axis] = bad; });
    }
  for (double bad : {kNan, kInf, -kInf, 1e300, -1.0, 0.0, 1e-300}) {
    for (int axis = 0; axis < 3; axis++)
      refuses("shapes[0].halfExtents", [=](BodyDef& d) { d.shapes[0].halfExtents[axis] = bad; });
    refuses("shapes[1].radius", [=](BodyDef& d) { d.shapes[1].radius = bad; });
    refuses("shapes[2].radius", [=](BodyDef& d) { d.shapes[2].radius = bad; });
    refuses("shapes[2].halfHeight", [=](BodyDef& d) { d.shapes[2].halfHeight = bad; });
    if (bad != 1e-300) refuses("shapes[1].material.density", [=](BodyDef& d) { d.shapes[1].material.density = bad; });
  }
  for (double bad : {kNan, kInf, -kInf, -1.0, 1e300}) {
    refuses("linearDamping", [=](BodyDef& d) { d.linearDamping = bad; });
    refuses("angularDamping", [=](BodyDef& d) { d.angularDamping = bad; });
    refuses("dragArea", [=](BodyDef& d) { d.dragArea = bad; });
    refuses("gravityScale", [=](BodyDef& d) { d.gravityScale = 1e4 * bad; });
    refuses("shapes[3].material.friction", [=](BodyDef& d) { d.shapes[3].material.friction = bad; });
    refuses("shapes[3].material.rollingResistance", [=](BodyDef& d) { d.shapes[3].material.rollingResistance = bad; });
    refuses("shapes[3].material.restitution", [=](BodyDef& d) { d.shapes[3].material.restitution = bad; });
  }
  for (Quat bad : {Quat{0, 0, 0, 0}, Quat{kNan, 0, 0, 1}, Quat{0, kInf, 0, 1}, Quat{0, 0, 1e-9, 0}}) {
    refuses("rotation", [=](BodyDef& d) { d.rotation = bad; });
    refuses("shapes[2].local.rotation", [=](BodyDef& d) { d.shapes[2].local.rotation = bad; });
  }
  refuses("type", [](BodyDef& d) { d.type = BodyType(9); });
  refuses("shapes[1].type", [](BodyDef& d) { d.shapes[1].type = ShapeType(99); });
  refuses("shapes[1].type", [](BodyDef& d) { d.shapes[1].type = ShapeType::plane; });
  refuses("frictionRule", [](BodyDef& d) { d.shapes[0].material.frictionRule = CombineRule(9); });
  refuses("restitutionRule", [](BodyDef& d) { d.shapes[0].material.restitutionRule = CombineRule(9); });
  refuses("shapes", [](BodyDef& d) { d.shapes.clear(); });
  refuses("shapes", [](BodyDef& d) { d.shapes.resize(4097, d.shapes[0]); });
  refuses("mass", [](BodyDef& d) {  // each field legal, the whole too light
    d.shapes.resize(1);
    d.shapes[0].material.density = 1e-300;
  });
  refuses("mass", [](BodyDef& d) {  // and too heavy
    d.shapes.resize(1);
    d.shapes[0].halfExtents = {1e4, 1e4, 1e4};
    d.shapes[0].material.density = 1e7;
  });
  EXPECT_EQ(wrong, 175);
  auto refusesHull = [&](const std::function<void(std::vector<Vec3>&)>& spoil) {
    BodyDef d = bodyOf(hullOf(0.1), {0, 5, 0});
    spoil(d.shapes[0].vertices);
    Result<BodyId> made = s.world.createBody(d);
    ASSERT_FALSE(made.ok());
    unchanged.refuses(made, made.error().code, "shapes[0].vertices");
  };
  refusesHull([](std::vector<Vec3>& v) { v.clear(); });
  refusesHull([](std::vector<Vec3>& v) { v.resize(3); });
  refusesHull([](std::vector<Vec3>& v) { v.assign(100000, Vec3{1, 2, 3}); });
  refusesHull([](std::vector<Vec3>& v) {
    for (Vec3& p : v) p.y = 0;
  });
  refusesHull([](std::vector<Vec3>& v) {
    for (Vec3& p : v) p = {p.x + p.y + p.z, 0, 0};
  });
  stepSound(s.world);
}

TEST(WorldCalls, EveryFieldOfAWorldIsChecked) {
  int wrong = 0;
  auto refuses = [&](const std::string& field, const std::function<void(WorldDef&)>& spoil) {
    WorldDef d;
    spoil(d);
    Result<World> made = World::create(d);
    ASSERT_FALSE(made.ok()) << field;
    EXPECT_EQ(made.error().code, ErrorCode::invalidArgument);
    for (const std::string& word : {field, std::string("found"), std::string("expected")})
      EXPECT_NE(made.error().message.find(word), std::string::npos) << made.error().message << " lacks " << word;
    wrong++;
  };
  struct Field {
    const char* name;
    double& (*of)(WorldDef&);
  };
  const Field fields[] = {
      {"gravity.x", [](WorldDef& d) -> double& { return d.gravity.x; }},
      {"gravity.y", [](WorldDef& d) -> double& { return d.gravity.y; }},
      {"gravity.z", [](WorldDef& d) -> double& { return d.gravity.z; }},
      {"airDensity", [](WorldDef& d) -> double& { return d.airDensity; }},
      {"sleepDelay", [](WorldDef& d) -> double& { return d.sleepDelay; }},
      {"hitEventSpeed", [](WorldDef& d) -> double& { return d.hitEventSpeed; }},
      {"hitEventImpulse", [](WorldDef& d) -> double& { return d.hitEventImpulse; }},
      {"solver.restingStiffness", [](WorldDef& d) -> double& { return d.solver.restingStiffness; }},
      {"solver.impactStiffness", [](WorldDef& d) -> double& { return d.solver.impactStiffness; }},
      {"solver.restingApproachSpeed", [](WorldDef& d) -> double& { return d.solver.restingApproachSpeed; }},
      {"solver.contactMargin", [](WorldDef& d) -> double& { return d.solver.contactMargin; }},
      {"solver.restSpeed", [](WorldDef& d) -> double& { return d.solver.restSpeed; }},
      {"solver.restTolerance", [](WorldDef& d) -> double& { return d.solver.restTolerance; }},
      {"solver.cycleTolerance", [](WorldDef& d) -> double& { return d.solver.cycleTolerance; }}};
  for (const Field& f : fields)
    for (double bad : {kNan, kInf, -kInf, 1e300, -1e5}) refuses(f.name, [&](WorldDef& d) { f.of(d) = bad; });
  for (int bad : {0, -1, 65, 1 << 30}) refuses("threads", [=](WorldDef& d) { d.threads = bad; });
  for (int bad : {0, -1, 16'000'001, 1 << 30}) refuses("maxBodies", [=](WorldDef& d) { d.maxBodies = bad; });
  for (int bad : {0, -1, 65}) refuses("solver.minCycles", [=](WorldDef& d) { d.solver.minCycles = bad; });
  for (int bad : {0, -1, 257}) refuses("solver.maxCycles", [=](WorldDef& d) { d.solver.maxCycles = bad; });
  for (int bad : {0, -1, 257}) refuses("solver.maxCyclesSmall", [=](WorldDef& d) { d.solver.maxCyclesSmall = bad; });
  for (int bad : {0, -1, 65}) refuses("solver.maxHitParts", [=](WorldDef& d) { d.solver.maxHitParts = bad; });
  refuses("solver.maxCycles", [](WorldDef& d) { d.solver.minCycles = 11; });
  refuses("solver.impactStiffness", [](WorldDef& d) { d.solver.impactStiffness = 1001; });
  EXPECT_EQ(wrong, 14 * 5 + 22);
}

TEST(WorldCalls, ABodyTooManyIsRefused) {
  WorldDef def;
  def.maxBodies = 2;
  World world = makeWorld(def);
  addGround(world);
  addBox(world, {0.1, 0.1, 0.1}, {0, 1, 0});
  Unchanged unchanged(world);
  unchanged.refuses(world.createBody(bodyOf(boxOf({0.1, 0.1, 0.1}), {})), ErrorCode::limitExceeded, "maxBodies");
}

TEST(WorldCalls, SnapshotsOfNothingAreRefused) {
  LivedIn s;
  std::vector<std::byte> good = s.world.snapshot(), torn(good.begin(), good.begin() + long(good.size() / 2)),
                         odd = good;
  odd[odd.size() / 2] ^= std::byte{1};
  Unchanged unchanged(s.world);
  unchanged.refuses(s.world.restore({}), ErrorCode::badFormat, "snapshot");
  unchanged.refuses(s.world.restore(torn), ErrorCode::badFormat, "snapshot");
  unchanged.refuses(s.world.restore(odd), ErrorCode::badFormat, "snapshot");
  EXPECT_TRUE(s.world.restore(good).ok());
  unchanged.expectSame("restored");
}

}  // namespace
}  // namespace brickfall
