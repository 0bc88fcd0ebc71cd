// Which broad phase a world has changes no bit of what happens in it, and no answer to a question.
#include <gtest/gtest.h>

#include <algorithm>

#include "support/lab_scenes.h"
#include "support/world_helpers.h"

namespace brickfall {
namespace {

constexpr BroadPhaseMethod kAll[] = {BroadPhaseMethod::tree, BroadPhaseMethod::sweepAndPrune,
                                     BroadPhaseMethod::boundingSpheres, BroadPhaseMethod::allPairs};

struct Course {
  std::vector<std::uint64_t> hashes;  // each step
  std::vector<double> answers;        // rays, boxes, nearest points
  int touching = 0, begins = 0, slept = 0;
};

void ask(const World& world, Course& course) {
  for (int i = 0; i < 8; i++) {
    auto hit = world.castRay({0.3 * i, 0.1 * i, 3}, {0.1 * (i - 4), -0.02 * i, -1}, 10).value();
    course.answers.push_back(hit ? hit->distance : -1);
    Vec3 at{0.3 * i, 0.08 * i, 0};
    std::vector<BodyId> inside = world.overlapBox({at, at + Vec3{0.3, 0.2, 0.2}}).value();
    for (BodyId body : inside) course.answers.push_back(body.index);
    auto near = world.closest({0.3 * i, 1, 0.5}, 2).value();
    course.answers.push_back(near ? near->distance : -1);
  }
}

Course run(const std::string& name, BroadPhaseMethod method, int steps, const lab::Options& given) {
  lab::Options options = given;
  options.broadPhase = method;
  lab::Scene scene = lab::make(name, options);
  Course course;
  for (int i = 0; i < steps; i++) {
    // Half way bodies go, and others take their slots.
    if (i == steps / 2)
      for (std::size_t k = 0; k < scene.boxes.size(); k += 7) {
        EXPECT_TRUE(scene.world.destroyBody(scene.boxes[k]).ok());
        test::add(scene.world, test::bodyOf(test::boxOf({0.05, 0.05, 0.05}), {0.1 * double(k), 2, 0.05}));
      }
    StepReport report = scene.world.step(test::kDt).value();
    course.touching += report.touchingPoints;
    course.begins += int(scene.world.events().begin.size());
    course.slept += int(scene.world.events().fellAsleep.size());
    course.hashes.push_back(scene.world.stateHash());
    if (i % 20 == 0) ask(scene.world, course);
  }
  EXPECT_TRUE(scene.world.validate().empty());
  return course;
}

TEST(BroadPhaseChoice, ChangesNoBitOfWhatHappens) {
  struct Case {
    const char* name;
    int steps;
    lab::Options options;
  };
  lab::Options loose, sleepy;
  loose.gap = 2e-3;
  loose.yawDegrees = 30;
  sleepy.sleep = true;
  int touching = 0, begins = 0, slept = 0;
  for (const Case& c : {Case{"drop", 120, loose},
                        {"drop", 120, {}},
                        {"hit0", 60, {}},
                        {"hole8", 40, {}},
                        {"col", 60, {}},
                        {"w10", 90, sleepy},
                        {"tumble", 240, sleepy}}) {
    Course expected = run(c.name, BroadPhaseMethod::tree, c.steps, c.options);
    for (BroadPhaseMethod method : kAll) {
      if (method == BroadPhaseMethod::tree) continue;
      Course course = run(c.name, method, c.steps, c.options);
      EXPECT_EQ(course.hashes, expected.hashes) << c.name << ", " << broadPhaseName(method);
      EXPECT_EQ(course.answers, expected.answers) << c.name << ", " << broadPhaseName(method);
    }
    touching += expected.touching;
    begins += expected.begins;
    slept += expected.slept;
  }
  EXPECT_GT(touching, 100'000);
  EXPECT_GT(begins, 1000);
  EXPECT_GT(slept, 0);
}

TEST(BroadPhaseChoice, IsKeptInSnapshotsAndChecked) {
  WorldDef def;
  for (BroadPhaseMethod method : kAll) {
    def.broadPhase = method;
    def.integrator = Integrator::velocityVerlet;
    World world = test::makeWorld(def), other = test::makeWorld();
    test::addGround(world, 0.6);
    BodyId first = test::add(world, test::bodyOf(test::boxOf({0.1, 0.1, 0.1}), {0, 1, 0}));
    ASSERT_TRUE(world.setAngularVelocity(first, {1, 2, 3}).ok());
    for (int i = 0; i < 10; i++) ASSERT_TRUE(world.step(test::kDt).ok());
    ASSERT_TRUE(other.restore(world.snapshot()).ok());
    for (int i = 0; i < 60; i++) {
      ASSERT_TRUE(world.step(test::kDt).ok());
      ASSERT_TRUE(other.step(test::kDt).ok());
      ASSERT_EQ(world.stateHash(), other.stateHash()) << i;
    }
  }
  def.broadPhase = BroadPhaseMethod(7);
  Result<World> world = World::create(def);
  ASSERT_FALSE(world.ok());
  EXPECT_NE(world.error().message.find("broadPhase"), std::string::npos) << world.error().message;
}

}  // namespace
}  // namespace brickfall
