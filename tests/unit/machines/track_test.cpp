// Numbers and poses over time, and where to point a shot.
#include "brickfall/machines.h"
#include "support/world_helpers.h"

namespace brickfall {
namespace {

using namespace test;

TEST(Track, PassesItsKeysAndNeverGoesBeyondThem) {
  for (Interpolation way : {Interpolation::smooth, Interpolation::linear}) {
    const Track track{{{1, 0}, {2, 3}, {2.5, 3}, {4, 3.1}, {5, -2}}, way};
    for (const auto& [time, value] : track.keys) EXPECT_NEAR(track.at(time), value, 1e-12);
    EXPECT_EQ(track.at(-10), 0);
    EXPECT_EQ(track.at(10), -2);
    EXPECT_EQ(track.at(2.2), 3) << "between equal keys it stands";
    for (std::size_t k = 0; k + 1 < track.keys.size(); k++) {
      const auto [low, high] = std::minmax(track.keys[k].second, track.keys[k + 1].second);
      for (double s = 0; s <= 1; s += 0.05) {
        const double value = track.at(track.keys[k].first + s * (track.keys[k + 1].first - track.keys[k].first));
        EXPECT_GE(value, low - 1e-12);
        EXPECT_LE(value, high + 1e-12);
      }
    }
  }
  EXPECT_EQ(Track{}.at(1), 0);
}

TEST(Track, SmoothOnesStartSoftlyAndHaveNoJerks) {
  const Track track{{{0, 0}, {1, 1}, {3, 2}, {4, 5}}};
  const auto speed = [&](double t) { return (track.at(t + 1e-6) - track.at(t - 1e-6)) / 2e-6; };
  EXPECT_NEAR(speed(0), 0, 1e-4);
  EXPECT_NEAR(speed(4), 0, 1e-4);
  for (double t : {1.0, 3.0}) {
    EXPECT_NEAR(speed(t - 1e-5), speed(t + 1e-5), 1e-3);
    EXPECT_GT(speed(t), 0.3);
  }
}

TEST(MotionPath, TurnsTheShortWayAndEvenly) {
  MotionPath path{{{0, {0, 0, 0}, {}}, {2, {4, 0, 0}, quatFromAxisAngle({0, 0, 1}, 2)}}, Interpolation::linear};
  const Transform half = path.at(1);
  EXPECT_NEAR(half.position.x, 2, 1e-12);
  EXPECT_NEAR(rotationVector(half.rotation).z, 1, 1e-12);
  path.interpolation = Interpolation::smooth;
  EXPECT_NEAR(rotationVector(path.at(1).rotation).z, 1, 1e-12);
  EXPECT_NEAR(rotationVector(path.at(0.01).rotation).z, 0, 2e-4);
}

// Flies there: the engine is asked, not the formula.
TEST(Aim, ShotsHitWhatTheyAreAimedAt) {
  for (bool flat : {true, false}) {
    const Vec3 from{-3, 0.5, 2}, target{4, 2, -1};
    const Result<Vec3> velocity = aim(from, target, 12, {0, -kG, 0}, flat);
    ASSERT_TRUE(velocity.ok()) << velocity.error().message;
    EXPECT_NEAR(length(*velocity), 12, 1e-9);
    World world = makeWorld();
    BodyDef shot = bodyOf(sphereOf(0.05), from);
    shot.linearVelocity = *velocity;
    const BodyId ball = add(world, shot);
    double nearest = 1e9;
    for (int k = 0; k < 1200; k++) {
      ASSERT_TRUE(world.step(1.0 / 480).ok());
      nearest = std::min(nearest, length(world.state(ball)->position - target));
    }
    EXPECT_LT(nearest, 0.02);
  }
  EXPECT_NEAR(aim({}, {3, 4, 0}, 10, {})->x, 6, 1e-12);
}

TEST(Aim, TellsTheSpeedThatWouldDo) {
  const Result<Vec3> far = aim({}, {10, 0, 0}, 5, {0, -kG, 0});
  ASSERT_FALSE(far.ok());
  EXPECT_NE(far.error().message.find("speed: found 5.000000 m/s, expected at least 9.90"), std::string::npos)
      << far.error().message;
  EXPECT_FALSE(aim({}, {}, 5, {0, -kG, 0}).ok());
  EXPECT_FALSE(aim({}, {1, 0, 0}, NAN, {0, -kG, 0}).ok());
  EXPECT_FALSE(aim({}, {NAN, 0, 0}, 5, {0, -kG, 0}).ok());
  EXPECT_TRUE(aim({}, {10, 0, 0}, 9.91, {0, -kG, 0}).ok());
}

}  // namespace
}  // namespace brickfall
