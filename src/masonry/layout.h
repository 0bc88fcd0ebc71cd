// Where the bricks of a course lie along a wall without openings.
//
// A course is a row of cells. Their places come from whole numbers times a pitch, never from sums, so that neighbours
// without a joint touch to rounding however long the wall is. In the bonds one brick length thick (header, English,
// Flemish) headers sit on half the pitch of the stretchers; with bricks of length = 2 widths + joint, as real ones are,
// that is header width + joint.
#pragma once
#include <vector>

#include "brickfall/masonry.h"

namespace brickfall::masonry {

enum class Laying : std::uint8_t {
  single,  // one brick along the wall: the wall is as thick as a brick is wide
  leaves,  // two bricks along the wall, one at either face
  header,  // one brick through the wall
};

struct Cell {
  double from = 0;    // m along the wall
  double length = 0;  // m
  Laying laying = Laying::single;
  bool cut = false;
};

struct Layout {
  double length = 0;  // m, of a brick
  double width = 0;   // m, of a brick
  double joint = 0;   // m, between stretchers
  double pitch = 0;   // m, stretcher to stretcher
  double headerPitch = 0;
  double headerJoint = 0;
  double coursePitch = 0;  // m, height of a course with its joint
  double thickness = 0;    // m, of the wall
  double wallLength = 0;   // m, of a full course
};

constexpr double kMinPiece = 0.005;  // m: nothing is cut smaller

Layout layoutOf(const WallDef& wall);
bool isThick(Bond bond);
// The cells of a course, left to right. The wall has passed checkWall.
std::vector<Cell> courseCells(const WallDef& wall, int course);

}  // namespace brickfall::masonry
