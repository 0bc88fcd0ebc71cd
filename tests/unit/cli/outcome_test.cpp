#include "cli/outcome.h"

#include <gtest/gtest.h>

namespace brickfall::cli {
namespace {

TEST(Outcome, overlapIsTheShareOfThoseInBoth) {
  EXPECT_EQ(overlapOf({}, {}), 1);
  EXPECT_EQ(overlapOf({"a"}, {}), 0);
  EXPECT_DOUBLE_EQ(overlapOf({"a", "b", "c"}, {"b", "c", "d"}), 0.5);
}

TEST(Outcome, endsAreComparedOfThoseThatMovedInEither) {
  Outcome a, b;
  a.moved = {"x"};
  b.moved = {"y"};
  a.ends = {{"x", {1, 0, 0}}, {"y", {0, 0, 0}}, {"z", {9, 0, 0}}};
  b.ends = {{"x", {0, 0, 0}}, {"y", {0, 3, 0}}, {"z", {0, 0, 0}}};
  EXPECT_DOUBLE_EQ(apartOf(a, b), 2);
  EXPECT_EQ(apartOf(Outcome{}, b), 0);
}

// Of a scene file's text, after 60 steps.
Outcome outcomeOf(const std::string& text) {
  const SceneLoad load = parseScene(text, "test.toml");
  if (!load.scene) ADD_FAILURE() << format(load.diagnostics.front());
  Result<SceneRun> run = SceneRun::create(load.scene.value());
  OutcomeWatch watch(run.value());
  for (int k = 0; k < 60; k++) {
    EXPECT_TRUE(run->step().ok());
    watch.afterStep(*run);
  }
  return watch.outcomeOf(*run);
}

// A brick that falls by its own height has moved; one that stands has not; a joint too weak for its load breaks.
TEST(Outcome, tellsWhatMovedAndWhatBroke) {
  const Outcome outcome = outcomeOf(
      "[[body]]\nname = \"standing\"\nsize = [1, 1, 1]\nposition = [5, 0.5, 0]\n"
      "[[body]]\nname = \"hung\"\nsize = [1, 1, 1]\nposition = [0, 2, 0]\n"
      "[[joint]]\nname = \"thread\"\nbody_b = \"hung\"\nanchor = [0, 3, 0]\nbreak_force = 10\n");
  EXPECT_EQ(outcome.moved, (std::set<std::string>{"hung"}));
  EXPECT_EQ(outcome.broken, (std::set<std::string>{"thread"}));
}

// A block glued to a post by mortar too weak for its weight.
TEST(Outcome, mortarThatBreaksCountsToo) {
  const Outcome outcome = outcomeOf(
      "[[body]]\nname = \"post\"\ntype = \"fixed\"\nsize = [1, 4, 1]\nposition = [0, 2, 0]\n"
      "[[body]]\nname = \"block\"\nsize = [1, 1, 1]\nposition = [1, 3, 0]\n"
      "[[mortar]]\nbody_a = \"post\"\nbody_b = \"block\"\nkind = \"thin\"\n"
      "[[mortar_kind]]\nname = \"thin\"\ntension = 100\ncohesion = 100\n"
      "tension_energy = 0.1\nshear_energy = 0.1\n");
  EXPECT_EQ(outcome.broken, (std::set<std::string>{"mortar 1"}));
}

}  // namespace
}  // namespace brickfall::cli
