// Arithmetic in a scene file: "$courses * 0.065 / 2". Numbers, $parameters, + - * /, brackets, and
// round floor ceil sqrt abs (one argument), min max (two).
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
Evaluated evaluate(std::string_view text, const ParameterLookup& lookup);
// True for texts that are meant as an expression: those with a $ or a bracket, and those that begin as a number does.
bool looksLikeExpression(std::string_view text);

}  // namespace brickfall::scene
