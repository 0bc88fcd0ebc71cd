#include "world/clock.h"

#include <gtest/gtest.h>

#include <algorithm>

namespace brickfall {
namespace {

constexpr double kDt = 1.0 / 60;

TEST(Clock, JointsHaveTheStiffnessOfTheFirstTimeStep) {
  Clock clock;
  EXPECT_TRUE(clock.beginSubstep(kDt));
  EXPECT_EQ(clock.stiffnessDt, kDt);
  for (int k = 0; k < 100; k++) EXPECT_FALSE(clock.beginSubstep(kDt)) << "nothing changes";
  EXPECT_EQ(clock.stiffnessDt, kDt);
}

TEST(Clock, JointsStayAsTheyAreWhileTimeStepsVary) {
  Clock clock;
  clock.beginSubstep(kDt);
  for (int k = 0; k < 1000; k++) {
    const double dt = kDt * (0.5 + 0.015 * (k * 37 % 100));
    EXPECT_TRUE(clock.beginSubstep(dt)) << "nothing is settled";
    EXPECT_EQ(clock.lastDt, dt);
    EXPECT_EQ(clock.stiffnessDt, kDt) << k;
  }
}

TEST(Clock, JointsFollowATimeStepOfAnotherOrder) {
  for (double factor : {1.0 / 8, 1.0 / 3, 3.0, 8.0}) {
    Clock clock;
    clock.beginSubstep(kDt);
    EXPECT_TRUE(clock.beginSubstep(kDt * factor));
    const double off = clock.stiffnessDt / (kDt * factor);
    EXPECT_NEAR(std::max(off, 1 / off), 2, 1e-12) << "as far as they must";
    // They find one for all steps that lie within a factor of 4.
    for (int k = 0; k < 10; k++) clock.beginSubstep(k % 2 == 0 ? kDt * factor : 1.5 * kDt * factor);
    const double found = clock.stiffnessDt;
    for (int k = 0; k < 100; k++) clock.beginSubstep(k % 2 == 0 ? kDt * factor : 1.5 * kDt * factor);
    EXPECT_EQ(clock.stiffnessDt, found);
  }
}

TEST(Clock, JointsFollowATimeStepThatStays) {
  for (double factor : {0.5, 0.9, 1.1, 2.0}) {
    Clock clock;
    clock.beginSubstep(kDt);
    int changes = 0, steps = 0;
    while (clock.stiffnessDt == kDt && steps < 100) changes += clock.beginSubstep(kDt * factor), steps++;
    EXPECT_EQ(clock.stiffnessDt, kDt * factor) << factor;
    EXPECT_GT(steps, 20) << "it might have been chance";
    EXPECT_EQ(changes, 2) << "the time step, and the joints";
    EXPECT_FALSE(clock.beginSubstep(kDt * factor));
  }
}

}  // namespace
}  // namespace brickfall
