// Arithmetic in a scene file: "$courses * 0.065 / 2". Numbers, pi, $parameters, + - * /, brackets, and
// round floor ceil sqrt abs sin cos tan (one argument), min max random (two).
#pragma once
#include <functional>
#include <optional>
#include <string>
#include <string_view>

namespace brickfall::scene {

struct Evaluated {
  double value = 0;
  std::string error;  // empty = sound
  int column = 0;     // of the error, from 1, in the expression
};

// Value of a parameter, or nothing (with a reason in `error`).
using ParameterLookup = std::function<std::optional<double>(const std::string& name, std::string& error)>;
// A random number of 0 .. 1, the next at each call; or nothing (with a reason in `error`).
using RandomSource = std::function<std::optional<double>(std::string& error)>;
Evaluated evaluate(std::string_view text, const ParameterLookup& lookup, const RandomSource& random = {});
// True for texts that are meant as an expression: those with a $ or a bracket, "pi", and those that begin as a number does.
bool looksLikeExpression(std::string_view text);

}  // namespace brickfall::scene
