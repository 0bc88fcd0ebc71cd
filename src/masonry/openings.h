// Doors and windows: which courses an opening takes, where its lintel lies, and how the bricks beside it are cut.
#pragma once
#include <vector>

#include "masonry/layout.h"

namespace brickfall::masonry {

// An opening in whole courses. Sill and head are moved to the nearest bed joint: bricks are not cut in height.
struct OpeningSpan {
  double from = 0, to = 0;  // m along the wall
  int firstCourse = 0, endCourse = 0;
  double lintelFrom = 0, lintelTo = 0;
  int lintelEnd = 0;  // the lintel takes courses endCourse .. lintelEnd; none if equal
  bool hasLintel() const { return lintelEnd > endCourse; }
};

// From 0 of the line that it is in.
OpeningSpan spanOf(const WallDef& wall, const Opening& opening);

// The course with everything between `from` and `to` taken out, as the runs of neighbouring cells that are left.
using Run = std::vector<Cell>;
std::vector<Run> runsOf(const WallDef& wall, int course, const std::vector<OpeningSpan>& spans);
void takeOutOpenings(std::vector<Run>& runs, const WallDef& wall, int course, const OpeningSpan& span);
// All between two places: what is left of a cell is cut, and small remnants join their neighbours.
void takeOut(std::vector<Run>& runs, double from, double to, const Layout& at);

}  // namespace brickfall::masonry
