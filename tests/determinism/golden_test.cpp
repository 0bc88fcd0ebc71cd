// The shipped scenes come to the hashes that are kept in the repository: a change of the engine's results, meant or not, is
// seen, and so is a platform or compiler that computes otherwise.
#include "support/golden_scenes.h"

#include <gtest/gtest.h>

#include <fstream>
#include <sstream>
#include <vector>

namespace brickfall {
namespace {

const char* kFile = BRICKFALL_SOURCE_DIR "/tests/determinism/golden_hashes.txt";

std::vector<std::string> goldenLines() {
  std::vector<std::string> lines;
  std::ifstream file(kFile);
  for (std::string line; std::getline(file, line);)
    if (!line.empty() && line[0] != '#') lines.push_back(line);
  return lines;
}

std::string firstWord(const std::string& line) { return line.substr(0, line.find(' ')); }

class GoldenScene : public testing::TestWithParam<std::string> {};

TEST_P(GoldenScene, comesToTheHashOfTheRepository) {
  const std::string scene = firstWord(GetParam());
  test::Golden golden = test::runGolden(scene);
  ASSERT_EQ(golden.problem, "");
  EXPECT_EQ(test::toLine(golden), GetParam())
      << "If results were meant to change: make golden, and say why in the commit.\n"
      << "If not: `brickfall trace " << scene
      << " -o new.trace` here and with the build that still agrees (-o old.trace), "
      << "then `brickfall trace --compare old.trace new.trace` names the first step and stage in which they part.";
}

INSTANTIATE_TEST_SUITE_P(Golden, GoldenScene, testing::ValuesIn(goldenLines()),
                         [](const auto& scene) { return test::testNameOf(firstWord(scene.param)); });

TEST(Golden, everyShippedSceneIsInTheTable) {
  std::vector<std::string> shipped, listed;
  for (const ShippedScene& scene : shippedScenes()) shipped.push_back(scene.name);
  for (const std::string& line : goldenLines()) listed.push_back(firstWord(line));
  EXPECT_EQ(listed, shipped) << "a scene came, went or was renamed: make golden";
  EXPECT_GE(listed.size(), 10u);
}

TEST(Golden, threadsDoNotMatter) {
  for (const char* scene : {"wall", "cube"}) {
    test::Golden one = test::runGolden(scene), four = test::runGolden(scene, 0, 4);
    EXPECT_EQ(test::toLine(one), test::toLine(four));
  }
}

}  // namespace
}  // namespace brickfall
