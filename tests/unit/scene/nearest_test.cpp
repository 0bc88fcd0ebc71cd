// The nearest known key to a misspelt one.
#include "scene/nearest.h"

#include <gtest/gtest.h>

#include "scene/keys.h"

namespace brickfall::scene {
namespace {

TEST(Nearest, FindsWhatWasMeant) {
  const char* cases[][3] = {
      {"wall", "cours", "courses"},
      {"wall", "coruses", "courses"},
      {"wall", "half-bats", "half_bats"},
      {"wall", "halfBats", "half_bats"},
      {"wall", "Bond", "bond"},
      {"wall", "yaw", "yaw_degrees"},
      {"wall", "openings", "opening"},
      {"world", "timestep", "time_step"},
      {"world", "gravty", "gravity"},
      {"world", "fps", ""},
      {"ball", "velocty", "velocity"},
      {"ball", "launchtime", "launch_time"},
      {"material", "color", "colour"},
      {"material", "freiction", "friction"},
      {"", "walls", "wall"},
      {"", "cameras", "camera"},
      {"body", "zzz", ""},
      {"ball", "x", ""},
  };
  for (auto& [table, word, wanted] : cases) EXPECT_EQ(nearest(word, keysOf(table)), wanted) << table << " " << word;
}

TEST(Nearest, EveryKeyIsNearestToItself) {
  for (const KeySpec& spec : keySpecs()) EXPECT_EQ(nearest(spec.key, keysOf(spec.table)), spec.key);
}

TEST(Nearest, EverySwapOfNeighboursIsFound) {
  for (const KeySpec& spec : keySpecs()) {
    std::string word = spec.key;
    if (word.size() < 5) continue;
    std::swap(word[1], word[2]);
    EXPECT_EQ(nearest(word, keysOf(spec.table)), spec.key) << word;
  }
}

TEST(Nearest, LongNonsenseIsNothing) {
  EXPECT_EQ(nearest(std::string(1000000, 'q'), keysOf("wall")), "");
  EXPECT_EQ(didYouMean("qqqqq", keysOf("wall")), "");
  EXPECT_EQ(didYouMean("cours", keysOf("wall")), " (did you mean \"courses\"?)");
}

}  // namespace
}  // namespace brickfall::scene
