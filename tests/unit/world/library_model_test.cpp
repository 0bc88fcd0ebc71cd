// Calls of a program at random, in sequence, against a model of the world that is told of the same calls: bodies of every shape with
// masses of their own, locks, switches, filters, joints, sensors, pushes, questions, saves, calls that are refused, and the program's
// own threads, memory, log and handler of failures.
#include <algorithm>
#include <map>
#include <optional>
#include <set>
#include <stdexcept>
#include <thread>

#include "convex_model.h"
#include "counting_memory.h"
#include "math/random.h"
#include "support/world_helpers.h"

namespace brickfall {
namespace {

using namespace test;

struct Known {
  BodyId id;
  ShapeDef shape;
  bool sensor = false;
  double mass = 0, ownMass = 0;  // kg, now and of its shape; 0: does not move
  Vec3 centre;                   // m, of mass, in the body
  bool off = false;
  AxisLocks locks;
  Vec3 place;  // m, of the centre of mass, since it was switched off or locked
};

struct KnownJoint {
  JointId id;
  BodyId a, b;
};

// Pieces in any order, some on other threads.
class ShuffledTasks final : public TaskSystem {
 public:
  int loops = 0;
  int threads() const override { return 3; }
  void forRange(int count, int grain, const std::function<void(int, int)>& body) override {
    loops++;
    std::vector<int> begins;
    for (int begin = 0; begin < count; begin += grain) begins.push_back(begin);
    for (std::size_t k = begins.size(); k > 0; k--) {
      std::swap(begins[k - 1], begins[random_.below(std::uint32_t(k))]);
      const int begin = begins[k - 1], end = std::min(count, begin + grain);
      if (random_.unit() < 0.1)
        std::thread(body, begin, end).join();
      else
        body(begin, end);
    }
  }

 private:
  Random random_{7};
};

// What the process was told through its hooks.
struct Told {
  int ties = 0, notes = 0, failures = 0;
} told;

void takeNote(const Note& note) {
  EXPECT_EQ(note.kind, NoteKind::tiesEnded);
  told.notes++;
  told.ties += note.count;
}

void takeFailure(const Failure& failure) {
  told.failures++;
  throw std::runtime_error(failure.text);
}

bool mayMeet(ShapeId a, ShapeId b) { return (a.index + b.index) % 5 != 0; }

class Program {
 public:
  Program(std::uint64_t seed, const WorldDef& def, bool asks)
      : random_(seed), questions_(seed + 1000), filters_(seed % 2 == 0), asks_(asks), world_(makeWorld(def)) {
    if (filters_) {
      EXPECT_TRUE(world_.setContactFilter(mayMeet).ok());
    }
    ground_ = addGround(world_);
  }

  void turn() {
    if (known_.size() < 4 || (known_.size() < 25 && chance(0.5))) make();
    if (chance(0.1)) look();
    if (chance(0.2)) switchOne();
    if (chance(0.2)) lock();
    if (chance(0.2)) weigh();
    if (chance(0.15)) tie();
    if (chance(0.2)) push();
    if (chance(0.1)) place();
    if (chance(0.15)) destroy();
    if (chance(0.1)) refused();
    if (chance(0.05)) {
      EXPECT_TRUE(world_.restore(world_.snapshot()).ok());
    }
    asked_.clear();
    const StepReport report = stepSound(world_);
    preSolveAgrees(report);
    eventsAgree();
    for (const Known& body : known_) bodyAgrees(body);
    if (asks_) {
      whole();
      ray();
      cast();
      nearest();
    }
    for (const Known& body : known_)
      if (!body.sensor && !body.off && chance(0.1)) {
        EXPECT_TRUE((chance(0.5) ? world_.sleep(body.id) : world_.wake(body.id)).ok());
      }
  }

  std::uint64_t hash() const { return world_.stateHash(); }
  int decided = 0, open = 0, hits = 0, presolved = 0;

 private:
  bool chance(double p) { return random_.unit() < p; }
  Known& pick() { return known_[random_.below(std::uint32_t(known_.size()))]; }
  Vec3 somewhere(Random& random) { return {random.between(-1, 1), random.between(0.2, 1.5), random.between(-1, 1)}; }
  Quat anyTurn(Random& random) {
    return test::turn({random.between(-1, 1), 1, random.between(-1, 1)}, random.between(0, 360));
  }
  ShapeDef anyShape(Random& random) {
    const ShapeDef shapes[] = {boxOf({.1, .1, .1}), sphereOf(.1),         capsuleOf(.06, .08),
                               cylinderOf(.1, .08), coneOf(.1, .03, .09), hullOf(.13)};
    return shapes[random.below(6)];
  }
  const Known* find(BodyId id) const {
    for (const Known& body : known_)
      if (body.id == id) return &body;
    return nullptr;
  }
  Vec3 centreNow(const Known& body) { return world_.state(body.id)->centreOfMass; }

  // --- Calls

  void make() {
    Known body;
    body.sensor = chance(0.3);
    body.shape = body.sensor ? boxOf({.3, .3, .3}) : anyShape(random_);
    body.shape.sensor = body.sensor;
    BodyDef def = bodyOf(body.shape, somewhere(random_), body.sensor ? BodyType::fixed : BodyType::dynamic);
    if (!body.sensor && chance(0.5)) def.rotation = anyTurn(random_);
    if (!body.sensor && chance(0.1)) def.enabled = false;
    body.off = !def.enabled;
    body.id = add(world_, def);
    body.mass = body.ownMass = world_.state(body.id)->mass;
    body.centre = world_.massProperties(body.id)->centre;
    body.place = centreNow(body);
    if (body.shape.type == ShapeType::box && !body.sensor) {
      EXPECT_NEAR(body.mass, 8, 1e-9);
    }
    if (body.sensor) {
      EXPECT_EQ(body.mass, 0);
    }
    known_.push_back(body);
  }
  // A callback that makes a body slick, or lets others through it.
  void look() {
    slick_ = pick().id;
    through_ = chance(0.3);
    EXPECT_TRUE(world_
                    .setPreSolve([this](PreSolveContact& contact) {
                      asked_.emplace_back(contact.shapeA, contact.shapeB);
                      EXPECT_NEAR(contact.friction, 0.6, 1e-6);
                      EXPECT_EQ(contact.restitution, 0);
                      EXPECT_EQ(world_.setGravity({}).error().code, ErrorCode::wrongState);
                      if (contact.bodyA != slick_ && contact.bodyB != slick_) return;
                      contact.friction = 0;
                      contact.enabled = !through_;
                    })
                    .ok());
  }
  void switchOne() {
    Known& body = pick();
    body.off = !body.off;
    ASSERT_TRUE(world_.setEnabled(body.id, !body.off).ok());
    body.place = centreNow(body);
  }
  void lock() {
    Known& body = pick();
    body.locks = chance(0.3) ? AxisLocks::plane() : AxisLocks{};
    for (bool* one : {&body.locks.wayX, &body.locks.wayY, &body.locks.turnX, &body.locks.turnY, &body.locks.turnZ})
      *one = *one || chance(0.15);
    ASSERT_TRUE(world_.setLocks(body.id, body.locks).ok());
    body.place = centreNow(body);
  }
  void weigh() {
    Known& body = pick();
    if (body.sensor) return;
    std::optional<MassProperties> given;
    if (chance(0.6))
      given = MassProperties{random_.between(1, 20),
                             {random_.between(-.02, .02), random_.between(-.02, .02), random_.between(-.02, .02)},
                             diagonal(Vec3{1, 1, 1} * 0.003)};
    ASSERT_TRUE(world_.setMassProperties(body.id, given).ok());
    body.mass = given ? given->mass : body.ownMass;
    body.centre = given ? given->centre : world_.massProperties(body.id)->centre;
    body.place = centreNow(body);
  }
  void tie() {
    if (!joints_.empty() && chance(0.3)) {
      const std::size_t at = random_.below(std::uint32_t(joints_.size()));
      EXPECT_TRUE(world_.destroyJoint(joints_[at].id).ok());
      EXPECT_FALSE(world_.isValid(joints_[at].id));
      joints_.erase(joints_.begin() + std::ptrdiff_t(at));
      return;
    }
    const Known &a = pick(), &b = pick();
    if (a.sensor || b.sensor || a.id == b.id) return;
    const Vec3 one = world_.state(a.id)->position, other = world_.state(b.id)->position;
    JointDef def;
    def.bodyA = a.id;
    def.bodyB = b.id;
    const JointType types[] = {JointType::rope, JointType::spring, JointType::spherical};
    def.type = types[random_.below(3)];
    def.anchor = def.type == JointType::spherical ? (one + other) * 0.5 : one;
    if (def.type != JointType::spherical) def.anchorB = other;
    def.stiffness = 50;
    const Result<JointId> made = world_.createJoint(def);
    ASSERT_TRUE(made.ok()) << made.error().message;
    joints_.push_back({*made, a.id, b.id});
  }
  // What a blow gives, and who refuses it.
  void push() {
    const Known& body = pick();
    const Vec3 blow{random_.between(-2, 2), random_.between(0, 3), random_.between(-2, 2)};
    const Vec3 before = world_.state(body.id)->linearVelocity;
    const Status done = world_.applyImpulse(body.id, blow);
    EXPECT_EQ(done.ok(), !body.sensor && !body.off);
    if (!done) {
      EXPECT_EQ(done.error().code, ErrorCode::wrongState);
    }
    const BodyState after = *world_.state(body.id);
    const bool locked[] = {body.locks.wayX, body.locks.wayY, body.locks.wayZ};
    for (int k = 0; k < 3; k++)
      EXPECT_NEAR(after.linearVelocity[k], before[k] + (done && !locked[k] ? blow[k] / body.mass : 0), 1e-9);
  }
  void place() {
    Known& body = pick();
    const Vec3 to = somewhere(random_);
    EXPECT_TRUE(world_.setTransform(body.id, to, {}).ok());
    body.place = centreNow(body);
    expectNear(body.place, to + body.centre, 1e-12);
  }
  // All that is tied to it goes along, and the log is told how many those are.
  void destroy() {
    const std::size_t at = random_.below(std::uint32_t(known_.size()));
    const BodyId id = known_[at].id;
    const auto isTied = [id](const KnownJoint& joint) { return joint.a == id || joint.b == id; };
    const auto ties = std::count_if(joints_.begin(), joints_.end(), isTied);
    const Told before = told;
    ASSERT_TRUE(world_.destroyBody(id).ok());
    EXPECT_EQ(told.ties - before.ties, ties);
    EXPECT_EQ(told.notes - before.notes, ties > 0 ? 1 : 0);
    for (const KnownJoint& joint : joints_)
      if (isTied(joint)) {
        EXPECT_FALSE(world_.isValid(joint.id));
      }
    joints_.erase(std::remove_if(joints_.begin(), joints_.end(), isTied), joints_.end());
    known_.erase(known_.begin() + std::ptrdiff_t(at));
    gone_ = id;
  }
  // What is refused changes nothing. value() of an error comes to the program's handler, with the field in its text.
  void refused() {
    const std::uint64_t before = world_.stateHash();
    if (gone_) {
      for (const Status& status :
           {world_.setTransform(gone_, {}, {}), world_.setEnabled(gone_, false), world_.setLocks(gone_, {}),
            world_.setMassProperties(gone_, {}), world_.applyImpulse(gone_, {1, 0, 0}), world_.sleep(gone_),
            world_.wake(gone_), world_.destroyBody(gone_)})
        EXPECT_EQ(status.error().code, ErrorCode::staleId) << status.error().message;
      EXPECT_FALSE(world_.state(gone_).ok());
      EXPECT_TRUE(world_.shapes(gone_).empty());
    }
    EXPECT_FALSE(world_.overlapShape(planeOf(), {}).ok());
    EXPECT_FALSE(world_.castShape(boxOf({.1, .1, .1}), {}, {std::nan(""), 0, 0}).ok());
    const int failures = told.failures;
    try {
      world_.createBody(ballBody(-1)).value();
      ADD_FAILURE() << "a ball of radius -1";
    } catch (const std::runtime_error& failure) {
      EXPECT_NE(std::string(failure.what()).find("radius"), std::string::npos) << failure.what();
    }
    EXPECT_EQ(told.failures, failures + 1);
    EXPECT_EQ(world_.stateHash(), before);
  }

  // --- What a step left

  bool isTied(BodyId a, BodyId b) const {
    return std::any_of(joints_.begin(), joints_.end(), [&](const KnownJoint& joint) {
      return (joint.a == a && joint.b == b) || (joint.a == b && joint.b == a);
    });
  }
  void preSolveAgrees(const StepReport& report) {
    int parts = asked_.empty() ? 0 : 1;
    for (std::size_t i = 1; i < asked_.size(); i++) parts += asked_[i] <= asked_[i - 1];
    EXPECT_LE(parts, report.parts);
    presolved += int(asked_.size());
    std::map<ShapeId, const Known*> owners;
    for (const Known& body : known_) owners[world_.shapes(body.id)[0]] = &body;
    const ShapeId ground = world_.shapes(ground_)[0];
    for (const auto& [a, b] : asked_) {
      EXPECT_TRUE(!filters_ || mayMeet(a, b));
      for (const ShapeId shape : {a, b})
        EXPECT_TRUE(shape == ground || (owners.count(shape) && !owners[shape]->off && !owners[shape]->sensor));
      if (a != ground && b != ground) {
        EXPECT_FALSE(isTied(owners[a]->id, owners[b]->id));
      }
    }
  }
  void eventsAgree() {
    const Events& events = world_.events();
    for (const SensorEvent& event : events.sensorBegin)
      EXPECT_TRUE(inside_.insert({event.sensorBody, event.body}).second);
    for (const SensorEvent& event : events.sensorEnd) EXPECT_EQ(inside_.erase({event.sensorBody, event.body}), 1u);
    const auto mayTouch = [&](BodyId a, BodyId b, ShapeId shapeA, ShapeId shapeB) {
      EXPECT_EQ(world_.shapes(a)[0], shapeA);
      EXPECT_EQ(world_.shapes(b)[0], shapeB);
      EXPECT_TRUE(!filters_ || mayMeet(shapeA, shapeB));
      EXPECT_FALSE(through_ && (a == slick_ || b == slick_));
      for (const BodyId id : {a, b}) EXPECT_TRUE(id == ground_ || (find(id) && !find(id)->off && !find(id)->sensor));
    };
    for (const ContactEvent& event : events.begin) mayTouch(event.bodyA, event.bodyB, event.shapeA, event.shapeB);
    for (const HitEvent& hit : events.hits) mayTouch(hit.bodyA, hit.bodyB, hit.shapeA, hit.shapeB);
    hits += int(events.hits.size());
    EXPECT_TRUE(events.breaks.empty());
    EXPECT_EQ(world_.joints().size(), joints_.size());
    for (const KnownJoint& joint : joints_) EXPECT_TRUE(world_.isValid(joint.id));
  }
  void bodyAgrees(const Known& body) {
    const BodyState now = *world_.state(body.id);
    EXPECT_NEAR(now.mass, body.mass, 1e-9);
    EXPECT_EQ(now.enabled, !body.off);
    EXPECT_TRUE(now.locks == body.locks);
    expectNear(now.centreOfMass, now.position + rotate(now.rotation, body.centre), 1e-9);
    if (body.off) {
      EXPECT_EQ(now.centreOfMass, body.place);
    }
    if (body.sensor) return;
    const bool ways[] = {body.locks.wayX, body.locks.wayY, body.locks.wayZ};
    const bool turns[] = {body.locks.turnX, body.locks.turnY, body.locks.turnZ};
    for (int k = 0; k < 3; k++) {
      if (ways[k]) {
        EXPECT_EQ(now.centreOfMass[k], body.place[k]);
      }
      if (turns[k]) {
        EXPECT_EQ(now.angularVelocity[k], 0);
      }
    }
  }

  // --- Questions, against convex_model.h

  Convex convexOf(const Known& body) {
    const BodyState now = *world_.state(body.id);
    return {&body.shape, {now.position, now.rotation}, {}};
  }
  double lowest(const Convex& convex) { return farthest(convex, {0, -1, 0}).y; }
  // Bodies that a shape meets for sure, and those that it may.
  void meets(const Convex& asked, std::set<BodyId>& surely, std::set<BodyId>& perhaps) {
    for (const Known& body : known_) {
      if (body.sensor || body.off) continue;
      const Between found = between(asked, convexOf(body));
      (found.overlap() || found.apart() ? decided : open)++;
      if (found.overlap()) surely.insert(body.id);
      if (!found.apart()) perhaps.insert(body.id);
    }
    if (lowest(asked) < -1e-6) surely.insert(ground_);
    if (lowest(asked) < 1e-6) perhaps.insert(ground_);
  }
  void whole() {
    const ShapeDef shape = anyShape(questions_);
    const Transform at{somewhere(questions_) - Vec3{0, 0.15, 0}, anyTurn(questions_)};
    overlaps(shape, at);
    std::set<std::pair<BodyId, BodyId>> wanted;
    for (const Known& body : known_) {
      if (!body.sensor || body.off) continue;
      for (const BodyId other : overlaps(body.shape, convexOf(body).at))
        if (other != ground_) wanted.insert({body.id, other});
    }
    EXPECT_EQ(inside_, wanted);
  }
  std::set<BodyId> overlaps(ShapeDef shape, const Transform& at) {
    shape.sensor = false;
    const std::vector<ShapeId> found = world_.overlapShape(shape, at).value();
    EXPECT_TRUE(std::is_sorted(found.begin(), found.end()));
    std::set<BodyId> surely, perhaps, said;
    meets({&shape, at, {}}, surely, perhaps);
    for (const Known& body : known_)
      if (std::find(found.begin(), found.end(), world_.shapes(body.id)[0]) != found.end()) said.insert(body.id);
    if (std::find(found.begin(), found.end(), world_.shapes(ground_)[0]) != found.end()) said.insert(ground_);
    EXPECT_EQ(said.size(), found.size());
    EXPECT_TRUE(std::includes(said.begin(), said.end(), surely.begin(), surely.end()));
    EXPECT_TRUE(std::includes(perhaps.begin(), perhaps.end(), said.begin(), said.end()));
    return said;
  }
  void ray() {
    const Vec3 from{questions_.between(-1, 1), 3, questions_.between(-1, 1)};
    const Vec3 way = normalized(Vec3{questions_.between(-1, 1), 0, questions_.between(-1, 1)} - from);
    const std::vector<RayHit> met = world_.castRayAll(from, way, 5).value();
    ShapeDef point = sphereOf(1e-9);
    std::set<BodyId> surely, perhaps, said;
    meets({&point, {from, {}}, way * 5.0}, surely, perhaps);
    double last = 0;
    for (const RayHit& hit : met) {
      EXPECT_GE(hit.distance, last);
      last = hit.distance;
      EXPECT_EQ(world_.shapes(hit.body)[0], hit.shape);
      EXPECT_TRUE(said.insert(hit.body).second);
      if (const Known* body = find(hit.body)) {
        EXPECT_FALSE(between({&point, {hit.pointWorld, {}}, {}}, convexOf(*body)).apart());
        EXPECT_FALSE(between({&point, {from, {}}, way * (hit.distance - 1e-5)}, convexOf(*body)).overlap());
      }
    }
    EXPECT_TRUE(std::includes(said.begin(), said.end(), surely.begin(), surely.end()));
    EXPECT_TRUE(std::includes(perhaps.begin(), perhaps.end(), said.begin(), said.end()));
    const std::optional<RayHit> first = world_.castRay(from, way, 5).value();
    ASSERT_EQ(first.has_value(), !met.empty());
    if (first) {
      EXPECT_EQ(first->shape, met[0].shape);
      EXPECT_EQ(first->distance, met[0].distance);
    }
  }
  void cast() {
    const ShapeDef shape = anyShape(questions_);
    const Transform from{{-1.6, questions_.between(0.2, 1.2), questions_.between(-1, 1)}, anyTurn(questions_)};
    const Vec3 motion{questions_.between(1, 3), questions_.between(-0.6, 0.3), questions_.between(-0.5, 0.5)};
    const std::optional<ShapeCastHit> hit = world_.castShape(shape, from, motion).value();
    std::set<BodyId> surely, perhaps;
    meets({&shape, from, motion}, surely, perhaps);
    if (!hit) {
      EXPECT_TRUE(surely.empty());
      return;
    }
    EXPECT_TRUE(perhaps.count(hit->body));
    EXPECT_EQ(world_.shapes(hit->body)[0], hit->shape);
    const Transform there{from.position + motion * hit->share, from.rotation};
    if (const Known* body = find(hit->body)) {
      EXPECT_FALSE(between({&shape, there, {}}, convexOf(*body), true).apart(1e-5));
    } else {
      EXPECT_NEAR(hit->share > 0 ? lowest({&shape, there, {}}) : 0, 0, 1e-5);
    }
    if (hit->share == 0) return;
    EXPECT_NEAR(length(hit->normalWorld), 1, 1e-9);
    surely.clear();
    meets({&shape, from, motion * std::max(0.0, hit->share - 1e-5)}, surely, perhaps);
    EXPECT_TRUE(surely.empty()) << "it goes past " << surely.size() << " that it meets before";
  }
  void nearest() {
    const Vec3 point = somewhere(questions_) + Vec3{0, 0.3, 0};
    const double reach = 0.6;
    const std::optional<ClosestResult> found = world_.closest(point, reach).value();
    const double said = found ? found->distance : reach;
    ShapeDef dot = sphereOf(1e-9);
    for (const Known& body : known_) {
      if (body.sensor || body.off) continue;
      const Between bounds = between({&dot, {point, {}}, {}}, convexOf(body), true);
      EXPECT_GE(bounds.most, said - 1e-6);
      if (found && found->body == body.id) {
        EXPECT_LE(bounds.least, said + 1e-6);
      }
    }
    EXPECT_GE(point.y, said - 1e-9);
    if (found && found->body == ground_) {
      EXPECT_NEAR(point.y, said, 1e-9);
    }
  }

  Random random_, questions_;
  bool filters_, asks_;
  World world_;
  BodyId ground_, slick_, gone_;
  bool through_ = false;
  std::vector<Known> known_;
  std::vector<KnownJoint> joints_;
  std::set<std::pair<BodyId, BodyId>> inside_;  // sensor, body
  std::vector<std::pair<ShapeId, ShapeId>> asked_;
};

TEST(Library, RandomCallsAgreeWithAModel) {
  told = {};
  setNoteHandler(takeNote);
  setFailureHandler(takeFailure);
  ShuffledTasks tasks;
  CountingMemory memory;
  int decided = 0, open = 0, hits = 0, presolved = 0;
  for (std::uint64_t seed : {1, 2, 3, 4}) {
    Program alone(seed, {}, true);
    WorldDef def;
    def.tasks = &tasks;
    def.memory = &memory;
    Program hosted(seed, def, false);
    for (int i = 0; i < 120 && !testing::Test::HasFailure(); i++) {
      alone.turn();
      hosted.turn();
      EXPECT_EQ(alone.hash(), hosted.hash());
      if (testing::Test::HasFailure()) ADD_FAILURE() << "seed " << seed << " step " << i;
    }
    decided += alone.decided;
    open += alone.open;
    hits += alone.hits;
    presolved += alone.presolved;
  }
  setNoteHandler(nullptr);
  setFailureHandler(nullptr);
  EXPECT_EQ(memory.held, 0u);
  EXPECT_GT(memory.taken, 10000u);
  EXPECT_GT(tasks.loops, 5);
  EXPECT_GT(told.ties, 20);
  EXPECT_GT(told.failures, 20);
  EXPECT_GT(hits, 100);
  EXPECT_GT(presolved, 1000);
  EXPECT_LT(open, decided / 50);
}

}  // namespace
}  // namespace brickfall
