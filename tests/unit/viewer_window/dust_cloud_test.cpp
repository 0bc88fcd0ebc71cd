#include "viewer_window/dust_cloud.h"

#include <gtest/gtest.h>

namespace brickfall::viewer {
namespace {

// A brick that moves at 1 m/s, at one moment.
struct Dusty {
  Frame frame;
  explicit Dusty(double time, std::uint64_t number, double sinceHit, double hitSpeed,
                 const std::shared_ptr<const RunInfo>& run) {
    ListedBody brick;
    brick.serial = 7;
    brick.role = BodyRole::brick;
    brick.radius = 0.2;
    auto list = std::make_shared<BodyList>();
    list->bodies = {brick};
    frame.list = std::move(list);
    frame.info = run;
    frame.number = number;
    frame.status.time = time;
    FrameBody body;
    body.linearVelocity = {1, 0, 0};
    body.sinceHit = float(sinceHit);
    body.hitSpeed = float(hitSpeed);
    frame.bodies = {body};
  }
};

class Dust : public testing::Test {
 protected:
  std::size_t after(double time, double sinceHit, double hitSpeed) {
    cloud.update(Dusty(time, ++number, sinceHit, hitSpeed, run).frame);
    return cloud.puffs().size();
  }
  std::shared_ptr<const RunInfo> run = std::make_shared<RunInfo>();
  std::uint64_t number = 0;
  DustCloud cloud;
};

TEST_F(Dust, risesWhereAHitWasFastEnough) {
  EXPECT_EQ(after(1, 1e9, 0), 0u);
  EXPECT_EQ(after(1.02, 0, 0.7), 0u);
  EXPECT_EQ(after(1.04, 0, 3), 2u);
  EXPECT_EQ(cloud.puffs()[0].born, 1.04);
  EXPECT_FLOAT_EQ(cloud.puffs()[0].strength, 0.5f);
  EXPECT_EQ(after(1.06, 0.02, 3), 2u) << "the same hit again";
}

// Few pictures, or fast forward: what was hit long before the frame raised its dust then, and where the body was.
TEST_F(Dust, knowsHitsOfLongAgo) {
  after(1, 1e9, 0);
  EXPECT_EQ(after(2, 0.75, 6), 2u);
  EXPECT_NEAR(cloud.puffs()[0].born, 1.25, 1e-6);
  EXPECT_NEAR(cloud.puffs()[0].place.x, -0.75, 0.15);
  EXPECT_EQ(after(5, 2.5, 6), 0u) << "what has settled again";
}

TEST_F(Dust, isNotRaisedByEveryStepOfASlidingBrick) {
  after(1, 1e9, 0);
  for (int i = 1; i <= 60; i++) after(1 + i / 60.0, 0, 2);
  EXPECT_LE(cloud.puffs().size(), 14u);
  EXPECT_GE(cloud.puffs().size(), 10u);
}

TEST_F(Dust, goesWhenTimeGoesBackAndWithTheRun) {
  after(1, 1e9, 0);
  after(1.1, 0, 3);
  EXPECT_EQ(after(1.05, 1e9, 0), 0u);
  EXPECT_EQ(after(1.1, 0, 3), 2u) << "it is hit again";
  run = std::make_shared<RunInfo>();
  EXPECT_EQ(after(1.2, 1e9, 0), 0u);
  run = std::make_shared<RunInfo>();
  EXPECT_EQ(after(1.2, 0.1, 3), 2u) << "before the first frame that is seen of a run";
}

TEST_F(Dust, hasAnEnd) {
  Dusty many(1, ++number, 1e9, 0, run);
  auto list = std::make_shared<BodyList>();
  list->bodies.assign(500, many.frame.list->bodies[0]);
  for (std::size_t i = 0; i < list->bodies.size(); i++) list->bodies[i].serial = Serial(i + 1);
  many.frame.list = list;
  many.frame.bodies.assign(500, many.frame.bodies[0]);
  cloud.update(many.frame);
  for (FrameBody& body : many.frame.bodies) body.sinceHit = 0, body.hitSpeed = 5;
  many.frame.number = ++number;
  many.frame.status.time = 1.1;
  cloud.update(many.frame);
  EXPECT_EQ(cloud.puffs().size(), DustCloud::kMostPuffs);
  EXPECT_EQ(after(10, 1e9, 0), 0u);
}

}  // namespace
}  // namespace brickfall::viewer
