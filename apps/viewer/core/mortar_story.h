// Of a body: how its mortar is, and why it fell, as lines of text. Runs and takes tell it alike.
#pragma once
#include <string>
#include <vector>

#include "brickfall/mortar.h"

namespace brickfall::viewer {

// As MortarPast, with names in the place of ids.
struct ToldBreak {
  double time = 0;  // s
  MortarMode mode = MortarMode::none;
  double tensionShare = 0, shearShare = 0;
  double force = 0;  // N, before it opened
  std::string bodyA, bodyB;
  struct Taker {
    bool contact = false;
    std::string bodyA, bodyB;
    double before = 0, after = 0;  // N
  };
  std::vector<Taker> takers;
};

struct MortarCount {
  int all = 0, hold = 0;
  double utilisation = 0;  // the largest
};

// `first`: why it fell; null: it did not, or not by mortar.
std::vector<std::string> mortarLines(const MortarCount& count, const ToldBreak* first);

// m: what moved less stands.
constexpr double kFellWay = 0.02;

}  // namespace brickfall::viewer
