// Malformed scene files, one mistake (or a few) each. Beside NAME.toml, NAME.expected holds what the diagnostics must
// say, a part a line: place, key, what was found, what was expected.
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

#include "brickfall/scene.h"

namespace brickfall {
namespace {

namespace fs = std::filesystem;

const fs::path kScenes = fs::path(BRICKFALL_SOURCE_DIR) / "tests/bad_input/scene/scenes";

std::vector<std::string> names() {
  std::vector<std::string> out;
  for (const auto& entry : fs::directory_iterator(kScenes))
    if (entry.path().extension() == ".toml") out.push_back(entry.path().stem().string());
  std::sort(out.begin(), out.end());
  return out;
}

std::string contentOf(const fs::path& path) {
  std::ifstream file(path, std::ios::binary);
  return std::string((std::istreambuf_iterator<char>(file)), std::istreambuf_iterator<char>());
}

class MalformedScene : public testing::TestWithParam<std::string> {};

TEST_P(MalformedScene, IsRefusedWithItsReason) {
  std::string path = (kScenes / (GetParam() + ".toml")).string();
  SceneLoad load = loadSceneFile(path);
  EXPECT_FALSE(load.scene.has_value());
  std::string report;
  for (const Diagnostic& diagnostic : load.diagnostics) {
    report += format(diagnostic) + "\n";
    EXPECT_EQ(diagnostic.file, path);
    EXPECT_EQ(diagnostic.severity, Severity::error);
  }
  std::ifstream expected(kScenes / (GetParam() + ".expected"));
  int parts = 0;
  for (std::string part; std::getline(expected, part); parts++)
    EXPECT_NE(report.find(part), std::string::npos) << "wanted: " << part << "\nreport:\n" << report;
  EXPECT_GT(parts, 0) << "no expectation beside " << path;
}

INSTANTIATE_TEST_SUITE_P(Files, MalformedScene, testing::ValuesIn(names()),
                         [](const auto& file) { return file.param; });

TEST(MalformedScenes, AreManyAndEachExpectationHasItsScene) {
  EXPECT_GE(names().size(), 40u);
  for (const auto& entry : fs::directory_iterator(kScenes)) {
    fs::path scene = entry.path();
    EXPECT_TRUE(fs::exists(scene.replace_extension(".toml"))) << entry.path();
  }
}

// Every prefix of every file ends in an answer: a scene, or at least one reason.
TEST(MalformedScenes, EveryPrefixIsAnswered) {
  for (const std::string& name : names()) {
    std::string text = contentOf(kScenes / (name + ".toml"));
    for (std::size_t length = 0; length < text.size(); length++) {
      SceneLoad load = parseScene(std::string_view(text).substr(0, length), name);
      EXPECT_TRUE(load.scene.has_value() || !load.diagnostics.empty()) << name << " " << length;
    }
  }
}

// One byte changed at a time, to each of a few that matter in TOML.
TEST(MalformedScenes, EveryChangedByteIsAnswered) {
  for (const std::string name : {"openings_meet", "bad_expression", "flat_hull"}) {
    const std::string text = contentOf(kScenes / (name + ".toml"));
    for (std::size_t at = 0; at < text.size(); at++)
      for (char c : {'[', ']', '"', '=', '\n', '\0', '\xff', '$', '.', '-'}) {
        std::string changed = text;
        changed[at] = c;
        SceneLoad load = parseScene(changed, name);
        EXPECT_TRUE(load.scene.has_value() || !load.diagnostics.empty()) << name << " " << at;
      }
  }
}

// Texts on which toml++ 3.3 asserts, or runs into what it declares unreachable.
TEST(MalformedScenes, WeakSpotsOfTheParserAreAnswered) {
  for (const char* text :
       {"[$", "[[[", "[=]", "a = [.]", "\xC2\xB7", "a\xC2\xB7 = 1", "[a\xC2\xB7]", "a = 1\xC3\xA9"}) {
    SceneLoad load = parseScene(std::string(text) + "\n", "weak.toml");
    EXPECT_FALSE(load.scene.has_value()) << text;
    EXPECT_FALSE(load.diagnostics.empty()) << text;
  }
  SceneLoad load = parseScene("title = \"\"\"\\\n  \xC3\xA9lan\"\"\"\n[[wall]]\n", "sound.toml");
  ASSERT_TRUE(load.scene.has_value());
  EXPECT_EQ(load.scene->title, "\xC3\xA9lan");
}

// Nesting that would exhaust the stack of a recursive reader.
TEST(MalformedScenes, DeepNestingIsAnswered) {
  const int depth = 200000;
  std::string dots = "a", quoted = "\"=\"", arrays(depth, '['), digits = "1", tables;
  for (int i = 0; i < depth; i++) dots += ".a", quoted += ".\"=\"", digits += ".1", tables += "a={";
  for (const std::string& text : {dots + " = 1\n", "[" + dots + "]\n", quoted + " = 1\n", digits + " = 1\n",
                                  "a = " + arrays + "\n", tables + "\n"}) {
    SceneLoad load = parseScene(text, "deep.toml");
    EXPECT_FALSE(load.scene.has_value());
    EXPECT_FALSE(load.diagnostics.empty());
  }
}

TEST(MalformedScenes, DotsInTextsNumbersAndCommentsAreNoNesting) {
  std::string text = "# " + std::string(1000, '.') + "\ndescription = \"" + std::string(1000, '.') +
                     "\"\n[[body]]\nshape = \"hull\"\nvertices = [";
  for (int i = 0; i < 60; i++) text += "[0." + std::to_string(i) + ", " + std::to_string(i % 7) + ".5, 1.5],";
  SceneLoad load = parseScene(text + "[9.5, 9.5, -9.5]]\n", "dots.toml");
  EXPECT_TRUE(load.scene.has_value()) << (load.diagnostics.empty() ? "" : format(load.diagnostics[0]));
}

}  // namespace
}  // namespace brickfall
