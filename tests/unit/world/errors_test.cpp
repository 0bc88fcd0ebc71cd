// Bad input through the public API: an error that names the field, and a world that stays as it was.
#include "support/world_helpers.h"

namespace brickfall {
namespace {

using namespace test;

const double kNan = std::nan("");
const double kInf = HUGE_VAL;

struct World3 {
  World world = makeWorld();
  BodyId ground, box;
  World3() {
    ground = addGround(world);
    box = addBox(world, {0.2, 0.2, 0.2}, {0, 0.5, 0}, {1, 0, 0});
    stepSound(world);
  }
};

// The call fails with `code`, its message holds `word`, and nothing changed.
template <class Answer>
void expectRefused(const World& world, std::uint64_t before, const Answer& answer, ErrorCode code,
                   const std::string& word) {
  ASSERT_FALSE(answer.ok()) << word;
  EXPECT_EQ(answer.error().code, code) << answer.error().message;
  EXPECT_NE(answer.error().message.find(word), std::string::npos)
      << answer.error().message << " does not name " << word;
  EXPECT_EQ(world.stateHash(), before);
}

// `count` points on a sphere, all of them corners.
ShapeDef roundHull(int count) {
  ShapeDef s = hullOf(1);
  s.vertices.clear();
  for (int i = 0; i < count; i++) {
    double z = 1 - (2 * i + 1.0) / count, r = std::sqrt(1 - z * z), angle = 2.399963 * i;
    s.vertices.push_back({r * std::cos(angle), r * std::sin(angle), z});
  }
  return s;
}

// What makes a definition bad, and the field that the error must name.
struct SpoiledBody {
  const char* field;
  std::function<void(BodyDef&)> spoil;
};

std::vector<SpoiledBody> spoiledForms() {
  return {
      {"shapes", [](BodyDef& d) { d.shapes.clear(); }},
      {"shapes", [](BodyDef& d) { d.shapes.resize(5000, d.shapes[0]); }},
      {"type", [](BodyDef& d) { d.type = BodyType(17); }},
      {"rotation",
       [](BodyDef& d) {
         d.rotation = {0, 0, 0, 0};
       }},
      {"rotation",
       [](BodyDef& d) {
         d.rotation = {0, kNan, 0, 1};
       }},
      {"rotation",
       [](BodyDef& d) {
         d.rotation = {0, kInf, 0, 1};
       }},
      {"shapes[0].type", [](BodyDef& d) { d.shapes[0].type = ShapeType(9); }},
      {"shapes[0].type", [](BodyDef& d) { d.shapes[0].type = ShapeType::plane; }},
      {"shapes[0].local.rotation",
       [](BodyDef& d) {
         d.shapes[0].local.rotation = {0, 0, 0, 0};
       }},
      {"shapes[0].local.position", [](BodyDef& d) { d.shapes[0].local.position.x = kNan; }},
      {"shapes[1].radius", [](BodyDef& d) { d.shapes.push_back(sphereOf(0)); }},
      {"shapes[1].radius", [](BodyDef& d) { d.shapes.push_back(sphereOf(kNan)); }},
      {"shapes[1].radius", [](BodyDef& d) { d.shapes.push_back(sphereOf(-1)); }},
      {"shapes[1].radius", [](BodyDef& d) { d.shapes.push_back(capsuleOf(-1, 1)); }},
      {"shapes[1].halfHeight", [](BodyDef& d) { d.shapes.push_back(capsuleOf(1, 0)); }},
      {"shapes[1].vertices",
       [](BodyDef& d) {
         d.shapes.push_back(hullOf(1));
         d.shapes[1].vertices.resize(3);
       }},
      {"shapes[1].vertices",
       [](BodyDef& d) {
         d.shapes.push_back(hullOf(1));
         d.shapes[1].vertices.clear();
       }},
      {"shapes[1].vertices", [](BodyDef& d) { d.shapes.push_back(roundHull(65)); }},
      {"shapes[1].vertices",
       [](BodyDef& d) {
         d.shapes.push_back(hullOf(1));
         for (Vec3& v : d.shapes[1].vertices) v.y = 0;
       }},
      {"shapes[1].vertices[2]",
       [](BodyDef& d) {
         d.shapes.push_back(hullOf(1));
         d.shapes[1].vertices[2].z = kInf;
       }},
  };
}

std::vector<SpoiledBody> spoiledNumbers() {
  std::vector<SpoiledBody> cases;
  for (double bad : {kNan, kInf, -kInf, 1e300, -1e300})
    for (int axis = 0; axis < 3; axis++) {
      cases.push_back({"position", [=](BodyDef& d) { d.position[axis] = bad; }});
      cases.push_back({"linearVelocity", [=](BodyDef& d) { d.linearVelocity[axis] = bad; }});
      cases.push_back({"surfaceVelocity", [=](BodyDef& d) { d.surfaceVelocity[axis] = bad; }});
      cases.push_back({"angularVelocity", [=](BodyDef& d) { d.angularVelocity[axis] = bad; }});
    }
  for (double bad : {kNan, kInf, -kInf, -1.0, 1e300, 0.0})
    for (int axis = 0; axis < 3; axis++)
      cases.push_back({"shapes[0].halfExtents", [=](BodyDef& d) { d.shapes[0].halfExtents[axis] = bad; }});
  for (double bad : {kNan, kInf, -1.0, 1e300}) {
    cases.push_back({"linearDamping", [=](BodyDef& d) { d.linearDamping = bad; }});
    cases.push_back({"angularDamping", [=](BodyDef& d) { d.angularDamping = bad; }});
    cases.push_back({"dragArea", [=](BodyDef& d) { d.dragArea = bad; }});
    cases.push_back({"shapes[0].material.density", [=](BodyDef& d) { d.shapes[0].material.density = bad; }});
    cases.push_back({"shapes[0].material.friction", [=](BodyDef& d) { d.shapes[0].material.friction = bad; }});
    cases.push_back({"shapes[0].material.restitution", [=](BodyDef& d) { d.shapes[0].material.restitution = bad; }});
  }
  for (double bad : {kNan, kInf, 1e4, -1e4})
    cases.push_back({"gravityScale", [=](BodyDef& d) { d.gravityScale = bad; }});
  cases.push_back({"density", [](BodyDef& d) { d.shapes[0].material.density = 0; }});
  cases.push_back({"restitution", [](BodyDef& d) { d.shapes[0].material.restitution = 1.01; }});
  cases.push_back({"friction", [](BodyDef& d) { d.shapes[0].material.friction = 101; }});
  cases.push_back({"frictionRule", [](BodyDef& d) { d.shapes[0].material.frictionRule = CombineRule(9); }});
  cases.push_back({"rollingResistance", [](BodyDef& d) { d.shapes[0].material.rollingResistance = -0.1; }});
  cases.push_back({"surfaceVelocity: found one on a dynamic body", [](BodyDef& d) { d.surfaceVelocity = {0, 0, 1}; }});
  cases.push_back({"restitutionRule", [](BodyDef& d) { d.shapes[0].material.restitutionRule = CombineRule(200); }});
  return cases;
}

TEST(Errors, BodyDefinitionsNameTheirBadField) {
  World3 w;
  std::uint64_t before = w.world.stateHash();
  std::vector<SpoiledBody> cases = spoiledForms();
  for (SpoiledBody& c : spoiledNumbers()) cases.push_back(std::move(c));
  for (const SpoiledBody& c : cases) {
    BodyDef d = bodyOf(boxOf({0.1, 0.1, 0.1}), {0, 5, 0});
    c.spoil(d);
    Result<BodyId> made = w.world.createBody(d);
    ASSERT_FALSE(made.ok()) << c.field;
    EXPECT_NE(made.error().code, ErrorCode::none);
    EXPECT_NE(made.error().message.find(c.field), std::string::npos)
        << made.error().message << " does not name " << c.field;
  }
  EXPECT_EQ(w.world.stateHash(), before);
  EXPECT_EQ(w.world.bodies().size(), 2u);
  expectSound(w.world);
}

TEST(Errors, TheSmallestAndLightestLegalBodiesWork) {
  World world = makeWorld();
  addGround(world);
  BodyDef d = bodyOf(boxOf({1e-4, 1e-4, 1e-4}, 1e-6), {0, 0.5, 0});
  d.shapes[0].material.density = 1e-300;
  Result<BodyId> made = world.createBody(d);
  if (made) {
    for (int i = 0; i < 60; i++) {
      Result<StepReport> report = world.step(kDt);
      ASSERT_TRUE(report.ok());
      expectSound(world);
    }
  } else {
    EXPECT_NE(made.error().message.find("density"), std::string::npos) << made.error().message;
  }
  addBox(world, {1e-4, 1e-4, 1e-4}, {1, 0.01, 0});
  run(world, 0.5);
}

TEST(Errors, WorldDefinitionsNameTheirBadField) {
  struct Case {
    const char* field;
    std::function<void(WorldDef&)> spoil;
  };
  std::vector<Case> cases = {{"threads", [](WorldDef& d) { d.threads = 0; }},
                             {"threads", [](WorldDef& d) { d.threads = 65; }},
                             {"maxBodies", [](WorldDef& d) { d.maxBodies = 0; }},
                             {"sleepDelay", [](WorldDef& d) { d.sleepDelay = 0; }},
                             {"solver.minCycles", [](WorldDef& d) { d.solver.minCycles = 0; }},
                             {"solver.maxCycles", [](WorldDef& d) { d.solver.maxCycles = 3; }},
                             {"solver.maxCyclesSmall", [](WorldDef& d) { d.solver.maxCyclesSmall = 1000; }},
                             {"solver.maxHitParts", [](WorldDef& d) { d.solver.maxHitParts = 0; }},
                             {"solver.impactStiffness", [](WorldDef& d) { d.solver.impactStiffness = 2000; }}};
  for (double bad : {kNan, kInf, -1.0}) {
    cases.push_back({"airDensity", [=](WorldDef& d) { d.airDensity = bad; }});
    cases.push_back({"sleepDelay", [=](WorldDef& d) { d.sleepDelay = bad; }});
    cases.push_back({"hitEventSpeed", [=](WorldDef& d) { d.hitEventSpeed = bad; }});
    cases.push_back({"hitEventImpulse", [=](WorldDef& d) { d.hitEventImpulse = bad; }});
    cases.push_back({"solver.restingStiffness", [=](WorldDef& d) { d.solver.restingStiffness = bad; }});
    cases.push_back({"solver.restingApproachSpeed", [=](WorldDef& d) { d.solver.restingApproachSpeed = bad; }});
    cases.push_back({"solver.contactMargin", [=](WorldDef& d) { d.solver.contactMargin = bad; }});
    cases.push_back({"solver.restSpeed", [=](WorldDef& d) { d.solver.restSpeed = bad; }});
    cases.push_back({"solver.restTolerance", [=](WorldDef& d) { d.solver.restTolerance = bad; }});
    cases.push_back({"solver.cycleTolerance", [=](WorldDef& d) { d.solver.cycleTolerance = bad; }});
  }
  for (double bad : {kNan, kInf, 1e9})
    for (int axis = 0; axis < 3; axis++) cases.push_back({"gravity", [=](WorldDef& d) { d.gravity[axis] = bad; }});
  for (const Case& c : cases) {
    WorldDef d;
    c.spoil(d);
    Result<World> made = World::create(d);
    ASSERT_FALSE(made.ok()) << c.field;
    EXPECT_EQ(made.error().code, ErrorCode::invalidArgument);
    EXPECT_NE(made.error().message.find(c.field), std::string::npos) << made.error().message;
  }
}

// Every call that takes a body, once with each bad id.
void expectAllRefuse(World& world, BodyId bad) {
  std::uint64_t before = world.stateHash();
  auto refused = [&](const auto& answer) { expectRefused(world, before, answer, ErrorCode::staleId, "body"); };
  EXPECT_FALSE(world.isValid(bad));
  EXPECT_TRUE(world.shapes(bad).empty());
  refused(world.state(bad));
  refused(world.massProperties(bad));
  refused(world.destroyBody(bad));
  refused(world.setType(bad, BodyType::fixed));
  refused(world.setTransform(bad, {}, {}));
  refused(world.setLinearVelocity(bad, {}));
  refused(world.setAngularVelocity(bad, {}));
  refused(world.setGravityScale(bad, 1));
  refused(world.setDamping(bad, 0, 0));
  refused(world.setDragArea(bad, 0));
  refused(world.wake(bad));
  refused(world.applyForce(bad, {}));
  refused(world.applyForceAtPoint(bad, {}, {}));
  refused(world.applyTorque(bad, {}));
  refused(world.applyImpulse(bad, {}));
  refused(world.applyImpulseAtPoint(bad, {}, {}));
  refused(world.applyAngularImpulse(bad, {}));
}

TEST(Errors, NullStaleAndForeignIdsAreFoundOut) {
  World3 w, foreign;
  BodyId dead = addBox(w.world, {0.1, 0.1, 0.1}, {5, 5, 5});
  ShapeId deadShape = w.world.shapes(dead)[0];
  ASSERT_TRUE(w.world.destroyBody(dead).ok());
  expectAllRefuse(w.world, {});
  expectAllRefuse(w.world, dead);
  expectAllRefuse(w.world, foreign.box);
  expectAllRefuse(w.world, {0xffffffffu, 1, w.box.world});
  expectAllRefuse(w.world, {w.box.index, std::uint16_t(w.box.generation + 1), w.box.world});
  addBox(w.world, {0.1, 0.1, 0.1}, {5, 5, 5});  // takes the slot
  expectAllRefuse(w.world, dead);
  EXPECT_EQ(w.world.shape(deadShape).error().code, ErrorCode::staleId);
  EXPECT_EQ(w.world.shape({}).error().code, ErrorCode::staleId);
  EXPECT_EQ(w.world.shape(foreign.world.shapes(foreign.box)[0]).error().code, ErrorCode::staleId);
  stepSound(w.world);
}

TEST(Errors, SettersRefuseWhatIsNotFiniteOrTooLarge) {
  World3 w;
  std::uint64_t before = w.world.stateHash();
  auto refused = [&](const Status& s, const char* word) {
    expectRefused(w.world, before, s, ErrorCode::invalidArgument, word);
  };
  for (double bad : {kNan, kInf, -kInf, 1e300})
    for (int axis = 0; axis < 3; axis++) {
      Vec3 v;
      v[axis] = bad;
      refused(w.world.setTransform(w.box, v, {}), "position");
      refused(w.world.setLinearVelocity(w.box, v), "velocity");
      refused(w.world.setAngularVelocity(w.box, v), "velocity");
      refused(w.world.setGravity(v), "gravity");
      refused(w.world.applyForce(w.box, v), "force");
      refused(w.world.applyForceAtPoint(w.box, v, {}), "force");
      refused(w.world.applyForceAtPoint(w.box, {}, v), "point");
      refused(w.world.applyTorque(w.box, v), "torque");
      refused(w.world.applyImpulse(w.box, v), "force");
      refused(w.world.applyImpulseAtPoint(w.box, {}, v), "point");
      refused(w.world.applyAngularImpulse(w.box, v), "torque");
    }
  for (double bad : {kNan, kInf, 1e9}) refused(w.world.setGravityScale(w.box, bad), "scale");
  for (double bad : {kNan, kInf, -1.0}) {
    refused(w.world.setDamping(w.box, bad, 0), "linear");
    refused(w.world.setDamping(w.box, 0, bad), "angular");
    refused(w.world.setDragArea(w.box, bad), "dragArea");
  }
  refused(w.world.setTransform(w.box, {}, {0, 0, 0, 0}), "rotation");
  refused(w.world.setTransform(w.box, {}, {kNan, 0, 0, 1}), "rotation");
  refused(w.world.setType(w.box, BodyType(3)), "type");
  refused(w.world.setType(w.ground, BodyType::dynamic), "plane");
  stepSound(w.world);
}

TEST(Errors, ForcesAndVelocitiesNeedABodyThatCanMove) {
  World3 w;
  std::uint64_t before = w.world.stateHash();
  auto refused = [&](const Status& s) { expectRefused(w.world, before, s, ErrorCode::wrongState, "body"); };
  refused(w.world.setLinearVelocity(w.ground, {1, 0, 0}));
  refused(w.world.setAngularVelocity(w.ground, {1, 0, 0}));
  refused(w.world.applyForce(w.ground, {1, 0, 0}));
  refused(w.world.applyImpulse(w.ground, {1, 0, 0}));
}

TEST(Errors, StepRefusesBadTimes) {
  World3 w;
  std::uint64_t before = w.world.stateHash();
  for (double dt : {0.0, -1.0, -kDt, kNan, kInf, -kInf, 0.2, 1e9, 1e-6})
    expectRefused(w.world, before, w.world.step(dt), ErrorCode::invalidArgument, "dt");
  for (int substeps : {0, -1, 65, 1000000})
    expectRefused(w.world, before, w.world.step(kDt, substeps), ErrorCode::invalidArgument, "substeps");
  EXPECT_EQ(w.world.stepCount(), 1u);
  EXPECT_TRUE(w.world.step(0.1, 64).ok());
  EXPECT_TRUE(w.world.step(1e-5, 64).ok());
  expectSound(w.world);
}

TEST(Errors, MaxBodiesIsALimitNotACrash) {
  WorldDef def;
  def.maxBodies = 3;
  World world = makeWorld(def);
  std::vector<BodyId> made;
  for (int i = 0; i < 3; i++) made.push_back(addBox(world, {0.1, 0.1, 0.1}, {double(i), 0, 0}));
  std::uint64_t before = world.stateHash();
  expectRefused(world, before, world.createBody(bodyOf(boxOf({0.1, 0.1, 0.1}), {9, 0, 0})), ErrorCode::limitExceeded,
                "maxBodies");
  ASSERT_TRUE(world.destroyBody(made[1]).ok());
  addBox(world, {0.1, 0.1, 0.1}, {9, 0, 0});
  EXPECT_EQ(world.bodies().size(), 3u);
}

TEST(Errors, ManyBadCallsDoNotDisturbASimulation) {
  World3 a, b;
  for (int i = 0; i < 60; i++) {
    BodyDef bad = bodyOf(boxOf({-1, 1, 1}), {});
    EXPECT_FALSE(a.world.createBody(bad).ok());
    EXPECT_FALSE(a.world.applyForce(a.box, {kNan, 0, 0}).ok());
    EXPECT_FALSE(a.world.destroyBody({}).ok());
    EXPECT_FALSE(a.world.step(-1).ok());
    EXPECT_FALSE(a.world.restore({}).ok());
    stepSound(a.world);
    stepSound(b.world);
  }
  EXPECT_EQ(a.world.stateHash(), b.world.stateHash());
}

}  // namespace
}  // namespace brickfall
