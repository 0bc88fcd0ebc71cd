// The straight lines that a wall is made of, and the cells of its bond on each: between any two places, so that walls go round
// corners, reach into each other and close to rings.
#pragma once
#include <vector>

#include "brickfall/masonry.h"
#include "masonry/layout.h"
#include "masonry/openings.h"

namespace brickfall::masonry {

struct Line {
  Vec3 origin;                              // m, in the wall's frame
  double yawDegrees = 0;                    // about +y
  double length = 0;                        // m, from corner to corner
  double from[2] = {0, 0}, to[2] = {0, 0};  // m, of even and odd courses
  double anchor = 0;                        // m: where a whole brick begins in even courses
  double before = 0;                        // m of the path before it
  bool plain = true;                        // a straight wall by its number of bricks, with closers at its ends
};

// One of a straight wall or a ring; of a path one from corner to corner.
std::vector<Line> linesOf(const WallDef& wall);
// Straight, by its number of bricks, with nothing that is not in the course's own cells.
bool isPlain(const WallDef& wall);
// More than it has.
std::int64_t mostBricks(const WallDef& wall);
// The line on which a place along the wall lies.
std::size_t lineOf(const std::vector<Line>& lines, double place);
OpeningSpan spanOf(const WallDef& wall, Opening opening, const Line& line);
// A ring that closes has no ends.
bool isRing(const WallDef& wall);
// m: that the bricks of a ring or an arc have at its inner face.
double ringLength(const WallDef& wall);
// Bricks (header bond: headers) of a ring that closes.
int ringBricks(const WallDef& wall);
// Radians of the circle for a metre along the inner face.
double ringTurn(const WallDef& wall);
// Courses of the gable on a line.
int gableCourses(const WallDef& wall, const Line& line, int index);
bool hasGable(const WallDef& wall, int index);
// Beyond what is straight and plain: what a gable takes away, walls that are let in, ends that reach.
std::vector<Run> cellsOf(const WallDef& wall, const Line& line, int index, int course);

// A pier's place: its middle along the wall and through it, and how many half bricks it has.
struct PierPlace {
  double at = 0, across = 0;        // m
  double width = 0, depth = 0;      // m
  int along = 0, through = 0;       // half bricks
  int wallFirst = 0, wallRows = 1;  // the rows that are the wall's own
  std::size_t line = 0;             // of the wall's lines: `at` is along it
  double taken = 0;  // m along the line, to both sides of `at`: where no brick of a course that it crosses may lie
  double inward = 0, outward = 0;  // m: further from the middle of a round wall, whose faces are no planes
  bool crosswise(int course) const { return course % 2 == 0; }
};
PierPlace placeOf(const WallDef& wall, const Pier& pier);
// m along the line: the places between which a pier of this half width finds room on the line.
struct PierRoom {
  double from = 0, to = 0;
};
PierRoom roomFor(const WallDef& wall, const PierPlace& place);

// A brick of a pier, in the wall's frame.
struct PierBrick {
  Vec3 centre;
  double length = 0;
  bool crosswise = false, cut = false;
};
std::vector<PierBrick> pierCourse(const WallDef& wall, const PierPlace& place, int course);

}  // namespace brickfall::masonry
