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
    // A place, unless it is the file as a whole that is wrong; what was found; what was expected.
    bool whole = diagnostic.message.starts_with("found an empty file") ||
                 diagnostic.message.starts_with("found nothing to simulate");
    EXPECT_EQ(diagnostic.line > 0 && diagnostic.column > 0, !whole) << format(diagnostic);
    EXPECT_TRUE(diagnostic.message.find("expected") != std::string::npos ||
                diagnostic.message.find(" need ") != std::string::npos)
        << format(diagnostic);
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
  EXPECT_GE(names().size(), 130u);
  for (const auto& entry : fs::directory_iterator(kScenes)) {
    fs::path scene = entry.path();
    EXPECT_TRUE(fs::exists(scene.replace_extension(".toml"))) << entry.path();
  }
}

// Every prefix of every file, malformed or shipped, ends in an answer: a scene, or at least one reason.
TEST(MalformedScenes, EveryPrefixIsAnswered) {
  std::vector<fs::path> files;
  for (const std::string& name : names()) files.push_back(kScenes / (name + ".toml"));
  for (const auto& entry : fs::directory_iterator(fs::path(BRICKFALL_SOURCE_DIR) / "scenes"))
    if (entry.path().extension() == ".toml") files.push_back(entry.path());
  int prefixes = 0, sound = 0;
  for (const fs::path& path : files) {
    std::string text = contentOf(path);
    if (text.size() > 4000) continue;  // the same line a thousand times
    for (std::size_t length = 0; length < text.size(); length++, prefixes++) {
      SceneLoad load = parseScene(std::string_view(text).substr(0, length), "prefix.toml");
      EXPECT_TRUE(load.scene.has_value() || !load.diagnostics.empty()) << path << " " << length;
      sound += load.scene.has_value();
    }
  }
  EXPECT_GT(prefixes, 10000);
  EXPECT_GT(sound, 100);
}

// Byte order mark, line ends of Windows: sound.
TEST(MalformedScenes, OtherEditorsFilesAreRead) {
  for (const char* text : {"\xef\xbb\xbf[[wall]]\ncourses = 3\n", "[[wall]]\r\ncourses = 3\r\n"}) {
    SceneLoad load = parseScene(text, "sound.toml");
    ASSERT_TRUE(load.scene.has_value()) << format(load.diagnostics[0]);
    EXPECT_EQ(load.scene->walls[0].wall.courses, 3);
  }
}

// Thousands of mistakes: the first, and how many more.
TEST(MalformedScenes, ManyMistakesAreABoundedList) {
  std::string balls, keys;
  for (int i = 0; i < 5000; i++) balls += "[[ball]]\nradius = -1\n", keys += "k" + std::to_string(i) + " = 1\n";
  SceneLoad load = parseScene(balls, "many.toml");
  ASSERT_EQ(load.diagnostics.size(), 101u);
  EXPECT_EQ(format(load.diagnostics[100]), "many.toml: error: found 9900 more mistakes, expected none");
  EXPECT_EQ(load.diagnostics[0].line, 1);
  load = parseScene(keys, "many.toml");
  EXPECT_EQ(load.diagnostics.size(), 101u);
  EXPECT_FALSE(load.scene.has_value());
}

TEST(MalformedScenes, HugeFilesAreRefused) {
  SceneLoad load = parseScene(std::string((16u << 20) + 1, '#'), "huge.toml");
  ASSERT_EQ(load.diagnostics.size(), 1u);
  EXPECT_EQ(format(load.diagnostics[0]), "huge.toml: error: found a file of over 16 MiB, expected a scene file");
}

// What --set may get wrong, with the answer.
TEST(MalformedScenes, BadOverridesSayWhatTheyMean) {
  const char* scene =
      "[parameters]\nspeed = 3\n[[wall]]\n[[ball]]\nposition = [0, 1, 3]\n[[ball]]\nposition = [0, 2, 3]\n";
  struct Case {
    const char *key, *value, *report;
  };
  for (const Case& c : {
           Case{"world.second", "3",
                "world.second: found an unknown key \"second\", expected a key of [world] (did you mean \"seconds\"?)"},
           Case{"world.seconds", "ten", "world.seconds: found the text \"ten\", expected a number 0.001 .. 86400 s"},
           Case{"world.seconds", "3 s", "found the text \"3 s\": a number is written without its unit"},
           Case{"world.seconds", "-1", "world.seconds: found -1, expected a number 0.001 .. 86400 s"},
           Case{"world.seconds", "nan", "found nan, expected a number"},
           Case{"world.seconds", "", "found no value, expected one such as \"world.seconds=1\""},
           Case{"wall.courses", "2.5", "wall[0].courses: found 2.5, expected a whole number 1 .. 10000"},
           Case{"wall[1].courses", "3", "found index [1] of \"wall\", expected [0] .. [0]"},
           Case{"ball.radius", "0.1", "the scene has 2 of \"ball\", expected an index: ball[0] .. ball[1]"},
           Case{"ball[0].position[3]", "0", "found index [3] of \"position\", expected [0] .. [2]"},
           Case{"camera.position", "[1, 2, 3]", "the scene has no \"camera\", expected a path to what it has"},
           Case{"wall.[0]", "3", "found a malformed path, expected one such as"},
           Case{"", "3", "found a malformed path"},
           Case{"speed", "fast", "parameters.speed: found the text \"fast\""},
           Case{"sped", "3",
                "found an unknown key \"sped\", expected a key of the top level (did you mean \"speed\"?)"},
           Case{"wall.material", "../brick", "found the text \"../brick\", expected the name of a material"},
           Case{"wall", "3", "wall: found 3, expected an array of tables: write [[wall]]"},
       }) {
    SceneLoad load = parseScene(scene, "s.toml", {{c.key, c.value}});
    EXPECT_FALSE(load.scene.has_value()) << c.key;
    ASSERT_FALSE(load.diagnostics.empty()) << c.key;
    std::string report = format(load.diagnostics[0]);
    EXPECT_NE(report.find(c.report), std::string::npos) << c.key << "=" << c.value << "\n" << report;
    EXPECT_TRUE(report.starts_with("--set: error: ")) << report;
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
