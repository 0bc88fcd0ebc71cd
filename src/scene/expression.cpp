// Recursive descent:  sum = product {(+|-) product};  product = unary {(*|/) unary};  unary = [-] primary;
// primary = number | pi | $name | function ( sum {, sum} ) | ( sum ).
#include "scene/expression.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstdint>
#include <numbers>
#include <string>
#include <vector>

#include "brickfall/math.h"

namespace brickfall::scene {

namespace {

constexpr std::string_view kOfOne[] = {"round", "floor", "ceil", "sqrt", "abs", "sin", "cos", "tan"};
constexpr std::string_view kOfTwo[] = {"min", "max", "random"};
constexpr const char* kFunctions = "round, floor, ceil, sqrt, abs, sin, cos, tan, min, max, random and pick";

bool isLetter(char c) { return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || c == '_'; }
bool isDigit(char c) { return c >= '0' && c <= '9'; }

double valueOfOne(const std::string& function, double a) {
  if (function == "round") return std::floor(a + 0.5);
  if (function == "floor") return std::floor(a);
  if (function == "ceil") return std::ceil(a);
  if (function == "sqrt") return std::sqrt(a);
  if (function == "abs") return std::fabs(a);
  if (!std::isfinite(a)) return a;
  double sine, cosine;
  sinCos(a, sine, cosine);
  return function == "sin" ? sine : function == "cos" ? cosine : sine / cosine;
}

std::string wholeText(double value) {
  return std::fabs(value) < 1e15 ? std::to_string(std::int64_t(value)) : std::string("that large");
}

class Parser {
 public:
  Parser(std::string_view text, const ParameterLookup& lookup, const RandomSource& random)
      : text_(text), lookup_(lookup), random_(random) {}

  Evaluated run() {
    Evaluated out;
    out.value = sum(0);
    skipSpace();
    if (error_.empty() && at_ < text_.size()) fail("unexpected \"" + std::string(1, text_[at_]) + "\"");
    if (error_.empty() && !std::isfinite(out.value)) {
      at_ = 0;
      fail("the result is not a finite number");
    }
    out.error = error_;
    out.column = errorColumn_;
    return out;
  }

 private:
  static constexpr int kMaxDepth = 64;

  double sum(int depth) {
    double value = product(depth);
    while (true) {
      if (take('+'))
        value += product(depth);
      else if (take('-'))
        value -= product(depth);
      else
        return value;
    }
  }
  double product(int depth) {
    double value = unary(depth);
    while (true) {
      if (take('*'))
        value *= unary(depth);
      else if (take('/'))
        value /= unary(depth);
      else
        return value;
    }
  }
  double unary(int depth) {
    if (depth >= kMaxDepth) return fail("brackets nested too deeply");
    if (take('-')) return -unary(depth + 1);
    if (take('(')) return closed(sum(depth + 1));
    skipSpace();
    if (at_ >= text_.size()) return fail("a number is missing at the end");
    char c = text_[at_];
    if (c == '$') return parameter();
    if (isDigit(c) || c == '.') return number();
    if (isLetter(c)) return function(depth);
    return fail("expected a number, found \"" + std::string(1, c) + "\"");
  }
  double number() {
    double value = 0;
    auto result = std::from_chars(text_.data() + at_, text_.data() + text_.size(), value);
    if (result.ec != std::errc()) return fail("not a number");
    at_ = std::size_t(result.ptr - text_.data());
    return value;
  }
  std::string name() {
    std::size_t from = at_;
    while (at_ < text_.size() && (isLetter(text_[at_]) || isDigit(text_[at_]))) at_++;
    return std::string(text_.substr(from, at_ - from));
  }
  double parameter() {
    std::size_t from = at_++;
    std::string key = name(), reason;
    if (key.empty()) return fail("a name is missing after \"$\"");
    std::optional<double> value = lookup_(key, reason);
    if (value) return *value;
    at_ = from;
    return fail(reason);
  }
  double function(int depth) {
    std::size_t from = at_;
    std::string key = name();
    if (key == "pi") return std::numbers::pi;
    const bool two = std::find(std::begin(kOfTwo), std::end(kOfTwo), key) != std::end(kOfTwo);
    const bool one = std::find(std::begin(kOfOne), std::end(kOfOne), key) != std::end(kOfOne);
    if (!one && !two && key != "pick") {
      bool call = take('(');
      at_ = from;
      if (call) return fail("unknown name \"" + key + "\"; functions are " + kFunctions);
      return fail("unknown name \"" + key + "\"; a parameter begins with $");
    }
    if (!take('(')) return fail("expected ( after \"" + key + "\"");
    if (key == "pick") return picked(depth);
    double a = sum(depth + 1), b = 0;
    if (two && !take(',')) return fail("expected two arguments of \"" + key + "\"");
    if (two) b = sum(depth + 1);
    if (key == "random") return closed(randomBetween(a, b));
    double value = key == "min" ? std::min(a, b) : key == "max" ? std::max(a, b) : valueOfOne(key, a);
    return closed(value);
  }
  // pick(k, a, b, ...): the k-th of what follows, from 0.
  double picked(int depth) {
    const std::size_t from = at_;
    const double which = sum(depth + 1);
    std::vector<double> values;
    while (take(',')) values.push_back(sum(depth + 1));
    const double value = closed(0);
    const double index = std::floor(which + 0.5);
    if (!error_.empty() || (index >= 0 && index < double(values.size())))
      return error_.empty() ? values[std::size_t(index)] : value;
    at_ = from;
    return fail("there is no number " + wholeText(index) + " of \"pick\", which counts from 0 and has " +
                std::to_string(values.size()));
  }
  double randomBetween(double a, double b) {
    std::string reason = "there is no \"random\" here";
    const std::optional<double> share = error_.empty() && random_ ? random_(reason) : std::nullopt;
    return share ? a + (b - a) * *share : fail(reason);
  }
  double closed(double value) {
    if (take(')')) return value;
    return fail("a closing bracket is missing");
  }
  void skipSpace() {
    while (at_ < text_.size() && (text_[at_] == ' ' || text_[at_] == '\t')) at_++;
  }
  bool take(char c) {
    skipSpace();
    if (!error_.empty() || at_ >= text_.size() || text_[at_] != c) return false;
    at_++;
    return true;
  }
  // The first failure counts; everything after it is noise.
  double fail(std::string why) {
    if (error_.empty()) {
      error_ = std::move(why);
      errorColumn_ = int(at_) + 1;
    }
    return 0;
  }

  std::string_view text_;
  const ParameterLookup& lookup_;
  const RandomSource& random_;
  std::size_t at_ = 0;
  std::string error_;
  int errorColumn_ = 0;
};

}  // namespace

Evaluated evaluate(std::string_view text, const ParameterLookup& lookup, const RandomSource& random) {
  return Parser(text, lookup, random).run();
}

bool looksLikeExpression(std::string_view text) {
  if (text == "pi" || text.starts_with("pi ")) return true;
  if (text.find_first_of("$(") != std::string_view::npos) return true;
  return !text.empty() && (isDigit(text[0]) || text[0] == '(' || text[0] == '-' || text[0] == '.');
}

}  // namespace brickfall::scene
