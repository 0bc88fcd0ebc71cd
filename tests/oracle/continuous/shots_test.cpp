// Thousands of random shots, none through.
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <map>

#include "shot.h"
#include "support/validation_record.h"

namespace brickfall::oracle {
namespace {

#ifndef BRICKFALL_SHOTS
#define BRICKFALL_SHOTS 1000
#endif

constexpr int kShots = BRICKFALL_SHOTS;

struct Tally {
  std::map<std::string, int> fired, hits;
  int through = 0, within = 0, wedged = 0, deep = 0;

  void add(const Shot& shot, const Flight& flight) {
    char step[32];
    std::snprintf(step, sizeof step, "dt 1/%.0f", 1 / shot.dt);
    const char* speed = shot.speed < 5 ? "below 5 m/s" : shot.speed < 30 ? "5 to 30 m/s" : "over 30 m/s";
    const char* plate = shot.thickness < 0.02 ? "plates below 20 mm" : "plates from 20 mm";
    for (std::string regime :
         {nameOf(shot.target), nameOf(shot.missile), nameOf(shot.aim), shot.spin > 0 ? "spinning" : "not spinning",
          speed, plate, static_cast<const char*>(step)}) {
      fired[regime]++;
      hits[regime] += flight.hit;
    }
    through += flight.through;
    within += flight.within;
    wedged += flight.wedged;
    deep += flight.overlap > 0.5 * std::min(flight.missileSize, flight.obstacleSize);
  }
};

void keepRows(const Tally& tally) {
  std::printf(
      "through %d, centre inside and staying %d, wedged and pushed out %d, overlap over half the inner radius %d\n",
      tally.through, tally.within, tally.wedged, tally.deep);
  for (const auto& [regime, n] : tally.fired)
    std::printf("%-20s %6d shots, %6d hit\n", regime.c_str(), n, tally.hits.at(regime));
  test::ValidationRow row;
  row.section = "continuous collision";
  row.name = "shots that went through";
  row.found = tally.through + tally.within;
  row.atMost = true;
  row.pass = row.found == 0;
  row.cases = kShots;
  test::record(row);
}

// BRICKFALL_SHOT=<seed> flies that one alone; BRICKFALL_SHOTS_FROM=<seed> begins the sweep there.
std::uint64_t seedFrom(const char* variable) {
  const char* text = std::getenv(variable);
  return text ? std::strtoull(text, nullptr, 10) : 0;
}

TEST(Shots, OneAlone) {
  std::uint64_t seed = seedFrom("BRICKFALL_SHOT");
  Shot shot = randomShot(seed);
  Flight flight = fly(shot);
  if (seed > 0)
    std::printf("%s: fired %d, hit %d, overlap %.3g m, %d steps\n", describe(shot).c_str(), flight.fired, flight.hit,
                flight.overlap, flight.steps);
  EXPECT_FALSE(flight.through) << describe(shot);
  EXPECT_FALSE(flight.within) << describe(shot);
}

// Light balls and bricks that crept through a heavy plate that turned, and a hull whose end stuck in a brick that turned:
// stopped in every step, they were taken along by the straight way of what they met, not by its turn. And a capsule that
// hung with an end in a plate, since with its way its turn was stopped, too.
TEST(Shots, ThoseThatOnceCreptInside) {
  for (std::uint64_t seed : {6143, 9039, 11845, 7394, 17613}) {
    Shot shot = randomShot(seed);
    Flight flight = fly(shot);
    EXPECT_TRUE(flight.hit) << describe(shot);
    EXPECT_FALSE(flight.through) << describe(shot);
    EXPECT_FALSE(flight.within) << describe(shot);
  }
}

// Bodies that went on to an impact within the step past a corner, or through what a contact found from afar had not shown.
TEST(Shots, ThoseThatWentThroughOnTheWayToAnImpact) {
  for (std::uint64_t seed : {2815, 3525, 5460, 6761, 7058, 11172, 13711, 15254, 15466, 19287, 19923}) {
    Shot shot = randomShot(seed);
    Flight flight = fly(shot);
    ASSERT_TRUE(flight.fired) << describe(shot);
    EXPECT_FALSE(flight.through) << describe(shot);
    EXPECT_FALSE(flight.within) << describe(shot);
  }
}

// Steps became an eighth as long while a ball was pressed into a plate: what was as soft as the impact of the longer step let it through.
TEST(Shots, ThoseThatWentThroughWhenStepsBecameShorter) {
  for (std::uint64_t seed :
       {2429, 2837, 3400, 6777, 7356, 7652, 8177, 8537, 8586, 11011, 11488, 12542, 13536, 14575, 15569, 18267, 20377}) {
    Shot shot = randomShot(seed);
    Flight flight = fly(shot);
    ASSERT_TRUE(flight.fired) << describe(shot);
    EXPECT_TRUE(flight.hit) << describe(shot);
    EXPECT_FALSE(flight.through) << describe(shot);
    EXPECT_FALSE(flight.within) << describe(shot);
  }
}

// Each with one build only, on the way from version to version: such shots are rare, and which it is is chance.
// 10029: pressed into a brick that flew along, both spinning. What turns too far for a step went only a part of its way, each of
// the two another one, and at 16 m/s that was through the other.
// 5459: a plate that spins freely was stopped where its whole turn would have met the capsule; a part of that turn is on another arc.
TEST(Shots, ThoseThatWentThroughWhatSpins) {
  for (std::uint64_t seed : {5459, 10029}) {
    Shot shot = randomShot(seed);
    Flight flight = fly(shot);
    ASSERT_TRUE(flight.fired) << describe(shot);
    EXPECT_TRUE(flight.hit) << describe(shot);
    EXPECT_FALSE(flight.through) << describe(shot);
    EXPECT_FALSE(flight.within) << describe(shot);
  }
}

// Stopped at the corner of a plate that flew, too, it was parted from that along its way: on and through, since the face nearest to
// it was one of the rim. Two that fly part to the side from which they came.
TEST(Shots, OneThatWasPartedFromWhatItWentThrough) {
  const Shot shot = randomShot(9914);
  const Flight flight = fly(shot);
  ASSERT_TRUE(flight.fired) << describe(shot);
  EXPECT_TRUE(flight.hit) << describe(shot);
  EXPECT_FALSE(flight.through) << describe(shot);
  EXPECT_FALSE(flight.within) << describe(shot);
}

TEST(Shots, NothingGoesThrough) {
  Tally tally;
  std::uint64_t first = std::max<std::uint64_t>(seedFrom("BRICKFALL_SHOTS_FROM"), 1);
  for (std::uint64_t seed = first, fired = 0; fired < std::uint64_t(kShots); seed++) {
    Shot shot = randomShot(seed);
    Flight flight = fly(shot);
    if (!flight.fired) continue;
    fired++;
    tally.add(shot, flight);
    EXPECT_FALSE(flight.through) << describe(shot);
    EXPECT_FALSE(flight.within) << describe(shot);
  }
  EXPECT_GE(tally.fired.size(), std::size_t(kTargets + kMissiles + kAims + 2 + 3 + 2 + 4));
  for (const auto& [regime, n] : tally.fired) {
    EXPECT_GT(n, kShots / 12) << regime;
    EXPECT_GT(tally.hits[regime], n / 2) << regime;
  }
  EXPECT_LT(tally.deep, kShots / 20);
  EXPECT_LE(tally.wedged, kShots / 1000);  // spinning chips that hit a joint
  if (kShots >= 10000) keepRows(tally);
}

}  // namespace
}  // namespace brickfall::oracle
