// The bonds, course by course.
#include "masonry/layout.h"

#include <cmath>

namespace brickfall::masonry {

namespace {

// Stretchers shifted by a share of the pitch; cut bricks close the ends, or they are left toothed.
std::vector<Cell> runningCourse(const WallDef& wall, const Layout& at, bool shifted) {
  std::vector<Cell> cells;
  double shift = shifted ? wall.bondShift * at.pitch : 0;
  bool closed = shifted && wall.halfBats && shift > 0;
  int whole = closed ? wall.bricksPerCourse - 1 : wall.bricksPerCourse;
  if (closed) cells.push_back({0, shift - at.joint, Laying::single, true});
  for (int i = 0; i < whole; i++) cells.push_back({i * at.pitch + shift, at.length, Laying::single, false});
  if (closed) {
    double from = whole * at.pitch + shift;
    cells.push_back({from, at.wallLength - from, Laying::single, true});
  }
  return cells;
}

// Headers only, every second course shifted by half a header.
std::vector<Cell> headerCourse(const WallDef& wall, const Layout& at, bool shifted) {
  std::vector<Cell> cells;
  double shift = shifted ? 0.5 * at.headerPitch : 0;
  bool closed = shifted && wall.halfBats;
  int whole = closed ? wall.bricksPerCourse - 1 : wall.bricksPerCourse;
  double closer = 0.5 * at.headerPitch - at.headerJoint;
  if (closed) cells.push_back({0, closer, Laying::header, true});
  for (int i = 0; i < whole; i++) cells.push_back({i * at.headerPitch + shift, at.width, Laying::header, false});
  if (closed) cells.push_back({whole * at.headerPitch + shift, closer, Laying::header, true});
  return cells;
}

// Where header position k (in half header pitches) lies, centred so that both ends of the wall are alike.
double halfPitchPlace(const Layout& at, int k) { return 0.5 * k * at.headerPitch + 0.5 * (at.headerJoint - at.joint); }

std::vector<Cell> englishCourse(const WallDef& wall, const Layout& at, bool headers) {
  std::vector<Cell> cells;
  int n = wall.bricksPerCourse;
  if (!headers) {
    for (int i = 0; i < n; i++) cells.push_back({i * at.pitch, at.length, Laying::leaves, false});
    return cells;
  }
  if (!wall.halfBats) {
    for (int i = 0; i < 2 * n - 1; i++)
      cells.push_back({halfPitchPlace(at, 2 * i + 1), at.width, Laying::header, false});
    return cells;
  }
  // header, queen closer, headers off the joints below by a quarter brick, queen closer, header
  double closer = 0.5 * at.headerPitch - at.headerJoint;
  cells.push_back({halfPitchPlace(at, 0), at.width, Laying::header, false});
  cells.push_back({halfPitchPlace(at, 2), closer, Laying::header, true});
  for (int i = 0; i < 2 * n - 3; i++) cells.push_back({halfPitchPlace(at, 3 + 2 * i), at.width, Laying::header, false});
  cells.push_back({halfPitchPlace(at, 4 * n - 3), closer, Laying::header, true});
  cells.push_back({halfPitchPlace(at, 4 * n - 2), at.width, Laying::header, false});
  return cells;
}

// Stretchers and headers in turn from both ends, half pitch k and half pitch `end`, to the middle. A stretcher and a
// header take six half pitches: what is left in the middle is filled with headers, so that both ends bond at any length.
void flemishRun(std::vector<Cell>& cells, const Layout& at, int k, int end, bool stretcherFirst) {
  const auto lay = [&](int place, bool stretcher) {
    if (stretcher) return Cell{0.5 * place * at.headerPitch, at.length, Laying::leaves, false};
    return Cell{halfPitchPlace(at, place), at.width, Laying::header, false};
  };
  std::vector<Cell> right;
  for (bool stretcher = stretcherFirst; k + 2 <= end; stretcher = !stretcher) {
    const int size = stretcher ? 4 : 2;
    if (end - k >= 2 * size) {
      cells.push_back(lay(k, stretcher));
      right.push_back(lay(end -= size, stretcher));
    } else if (end - k != size) {
      for (; k + 2 <= end; k += 2) cells.push_back(lay(k, false));
    } else {
      cells.push_back(lay(k, stretcher));
    }
    k += size;
  }
  cells.insert(cells.end(), right.rbegin(), right.rend());
}

std::vector<Cell> flemishCourse(const WallDef& wall, const Layout& at, bool shifted) {
  std::vector<Cell> cells;
  int end = 4 * wall.bricksPerCourse;
  if (!shifted) {
    flemishRun(cells, at, 0, end, true);
  } else if (!wall.halfBats) {
    flemishRun(cells, at, 1, end - 1, false);  // toothed: the first header is centred on the stretcher below
  } else {
    double closer = 0.5 * at.headerPitch - at.headerJoint;
    cells.push_back({halfPitchPlace(at, 0), at.width, Laying::header, false});
    cells.push_back({halfPitchPlace(at, 2), closer, Laying::header, true});
    flemishRun(cells, at, 3, end - 3, true);
    cells.push_back({halfPitchPlace(at, end - 3), closer, Laying::header, true});
    cells.push_back({halfPitchPlace(at, end - 2), at.width, Laying::header, false});
  }
  return cells;
}

}  // namespace

bool isThick(Bond bond) { return bond == Bond::header || bond == Bond::english || bond == Bond::flemish; }

Layout layoutOf(const WallDef& wall) {
  Layout at;
  at.length = wall.brick.size.x;
  at.width = wall.brick.size.z;
  at.joint = wall.headJoint;
  at.pitch = at.length + at.joint;
  // In header bond nothing has to agree with stretchers.
  at.headerPitch = wall.bond == Bond::header ? at.width + at.joint : 0.5 * at.pitch;
  at.headerJoint = wall.bond == Bond::header ? at.joint : at.headerPitch - at.width;
  at.coursePitch = wall.brick.size.y + wall.bedJoint;
  at.thickness = isThick(wall.bond) ? at.length : at.width;
  double unit = wall.bond == Bond::header ? at.headerPitch : at.pitch;
  at.wallLength = wall.bricksPerCourse * unit - at.joint;
  return at;
}

std::vector<Cell> courseCells(const WallDef& wall, int course) {
  Layout at = layoutOf(wall);
  bool second = course % 2 == 1;
  switch (wall.bond) {
    case Bond::running:
      return runningCourse(wall, at, second);
    case Bond::header:
      return headerCourse(wall, at, second);
    case Bond::english:
      return englishCourse(wall, at, second);
    case Bond::flemish:
      return flemishCourse(wall, at, second);
    case Bond::stack:
      break;
  }
  return runningCourse(wall, at, false);
}

}  // namespace brickfall::masonry

namespace brickfall {

double wallThickness(const WallDef& wall) { return masonry::layoutOf(wall).thickness; }

}  // namespace brickfall
