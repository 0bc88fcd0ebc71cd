// Arithmetic in scene files: values, precedence, functions, and every way to get it wrong.
#include "scene/expression.h"

#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <string>

namespace brickfall::scene {
namespace {

std::optional<double> lookup(const std::string& name, std::string& error) {
  static const std::map<std::string, double> known = {{"n", 1000}, {"courses", 20}, {"a_1", -2}};
  if (auto found = known.find(name); found != known.end()) return found->second;
  error = "unknown parameter \"$" + name + "\"";
  return std::nullopt;
}

TEST(Expression, Values) {
  const std::pair<const char*, double> cases[] = {
      {"1", 1},
      {" 2.5e-3 ", 2.5e-3},
      {"1 + 2 * 3", 7},
      {"(1 + 2) * 3", 9},
      {"10 - 4 - 3", 3},
      {"16 / 4 / 2", 2},
      {"-3 + 1", -2},
      {"--3", 3},
      {"-(2 + 3) * 2", -10},
      {"2 * -3", -6},
      {".5 + .25", 0.75},
      {"$n / 50", 20},
      {"$courses * 0.065 / 2", 20 * 0.065 / 2},
      {"$a_1*$a_1", 4},
      {"-$n", -1000},
      {"round(2.5)", 3},
      {"round(-2.5)", -2},
      {"floor(-0.5)", -1},
      {"ceil(0.2)", 1},
      {"sqrt(16)", 4},
      {"abs($a_1)", 2},
      {"min(3, 2)", 2},
      {"max(3, 2 * 2)", 4},
      {"max(min(1, 5), round($n / 300))", 3},
      {"pick(2, 5, 6, 7) + pick(0.2, 1)", 8},
      {"round(20 + ($n - 1000) / 300)", 20},
  };
  for (auto [text, value] : cases) {
    Evaluated result = evaluate(text, lookup);
    EXPECT_EQ(result.error, "") << text;
    EXPECT_DOUBLE_EQ(result.value, value) << text;
  }
}

struct Mistake {
  const char* text;
  const char* part;
  int column;
};

TEST(Expression, MistakesNameTheReasonAndThePlace) {
  const Mistake mistakes[] = {
      {"", "number is missing", 1},
      {"1 +", "number is missing", 4},
      {"1 2", "unexpected \"2\"", 3},
      {"(1 + 2", "closing bracket", 7},
      {"1 + 2)", "unexpected \")\"", 6},
      {"$speed", "unknown parameter", 1},
      {"2 * $", "name is missing after", 6},
      {"courses * 2", "begins with $", 1},
      {"round 2", "expected (", 7},
      {"max(1)", "two arguments", 6},
      {"sen(1)", "unknown name \"sen\"", 1},
      {"1 / 0", "not a finite", 1},
      {"sqrt(0 - 1)", "not a finite", 1},
      {"3 ** 2", "expected a number, found \"*\"", 4},
      {"pick(2, 5, 6)", "no number 2 of \"pick\", which counts from 0 and has 2", 6},
      {"1e999", "not a number", 1},
      {"#", "expected a number, found \"#\"", 1},
  };
  for (const Mistake& mistake : mistakes) {
    Evaluated result = evaluate(mistake.text, lookup);
    EXPECT_NE(result.error.find(mistake.part), std::string::npos) << mistake.text << ": " << result.error;
    EXPECT_EQ(result.column, mistake.column) << mistake.text << ": " << result.error;
  }
}

TEST(Expression, KnowsCirclesAndRandomNumbers) {
  EXPECT_EQ(evaluate("pi / 2", lookup).value, std::acos(0.0));
  EXPECT_NEAR(evaluate("sin(pi / 6)", lookup).value, 0.5, 1e-15);
  EXPECT_NEAR(evaluate("cos(pi / 3) + tan(pi / 4)", lookup).value, 1.5, 1e-15);
  EXPECT_NE(evaluate("random(0, 1)", lookup).error.find("random"), std::string::npos) << "none is given";
  int calls = 0;
  const RandomSource half = [&](std::string&) { return calls++, std::optional<double>(0.5); };
  EXPECT_EQ(evaluate("random(2, 4) + random(0, 1)", lookup, half).value, 3.5);
  EXPECT_EQ(calls, 2);
  EXPECT_TRUE(looksLikeExpression("pi"));
}

TEST(Expression, DeepNestingIsRefusedNotFollowed) {
  std::string open(100000, '('), minus(100000, '-');
  EXPECT_NE(evaluate(open + "1", lookup).error.find("nested"), std::string::npos);
  EXPECT_NE(evaluate(minus + "1", lookup).error.find("nested"), std::string::npos);
}

TEST(Expression, LongChainsAreFine) {
  std::string text = "0";
  for (int i = 0; i < 20000; i++) text += "+1";
  EXPECT_EQ(evaluate(text, lookup).value, 20000);
}

TEST(Expression, PlainWordsAreNotExpressions) {
  for (const char* text : {"ten", "", "uk", "north wall"}) EXPECT_FALSE(looksLikeExpression(text)) << text;
  for (const char* text : {"$n", "1 / 3", "(2)", "-$x", "max($a, 1)"}) EXPECT_TRUE(looksLikeExpression(text)) << text;
}

}  // namespace
}  // namespace brickfall::scene
