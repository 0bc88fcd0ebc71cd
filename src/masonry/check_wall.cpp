// What a wall must satisfy before a brick is laid. Every check is in the positive form, so that NaN fails.
#include <charconv>
#include <cmath>
#include <string>

#include "brickfall/limits.h"
#include "brickfall/masonry.h"
#include "masonry/layout.h"
#include "masonry/openings.h"

namespace brickfall {

namespace {

using masonry::Layout;
using masonry::OpeningSpan;

std::string textOf(double value) {
  char buffer[40];
  auto end = std::to_chars(buffer, buffer + sizeof buffer, value, std::chars_format::general, 6).ptr;
  return std::string(buffer, end);
}

struct Problems {
  std::vector<WallProblem> list;
  void add(std::string field, std::string message) { list.push_back({std::move(field), std::move(message)}); }
  // false (and a problem) unless low <= value <= high
  bool range(const std::string& field, double value, double low, double high, const char* unit) {
    if (value >= low && value <= high) return true;
    std::string suffix = *unit ? std::string(" ") + unit : std::string();
    add(field, "found " + textOf(value) + ", expected " + textOf(low) + " .. " + textOf(high) + suffix);
    return false;
  }
};

bool checkNumbers(const WallDef& wall, Problems& problems) {
  std::size_t before = problems.list.size();
  if (!(wall.bond <= Bond::stack))
    problems.add("bond", "found " + std::to_string(int(wall.bond)) + ", expected a Bond");
  problems.range("courses", wall.courses, 1, 10000, "");
  problems.range("bricksPerCourse", wall.bricksPerCourse, 1, 10000, "");
  problems.range("brick.size.x", wall.brick.size.x, 0.001, 100, "m");
  problems.range("brick.size.y", wall.brick.size.y, 0.001, 100, "m");
  problems.range("brick.size.z", wall.brick.size.z, 0.001, 100, "m");
  problems.range("headJoint", wall.headJoint, 0, 1, "m");
  problems.range("bedJoint", wall.bedJoint, 0, 1, "m");
  problems.range("bondShift", wall.bondShift, 0, 1, "");
  problems.range("position.x", wall.position.x, -1e5, 1e5, "m");
  problems.range("position.y", wall.position.y, -1e5, 1e5, "m");
  problems.range("position.z", wall.position.z, -1e5, 1e5, "m");
  problems.range("yawDegrees", wall.yawDegrees, -3600, 3600, "degrees");
  problems.range("disorder", wall.disorder, 0, 0.01, "m");
  return problems.list.size() == before;
}

// Hollows lie within the brick, and not in each other.
void checkHollows(const BrickFormat& brick, Problems& problems) {
  const Frog& frog = brick.frog;
  const Perforation& holes = brick.holes;
  const double length = brick.size.x, height = brick.size.y, width = brick.size.z;
  if (frog.depth != 0) {
    problems.range("brick.frog.depth", frog.depth, 0, 0.9 * height, "m");
    problems.range("brick.frog.length", frog.length, 0.001 * length, 0.95 * length, "m");
    problems.range("brick.frog.width", frog.width, 0.001 * width, 0.95 * width, "m");
    problems.range("brick.frog.floorLength", frog.floorLength, 0, frog.length, "m");
    problems.range("brick.frog.floorWidth", frog.floorWidth, 0, frog.width, "m");
  }
  if (holes.along == 0 && holes.across == 0) return;
  problems.range("brick.holes.along", holes.along, 1, 100, "");
  problems.range("brick.holes.across", holes.across, 1, 100, "");
  const double most = 0.475 * std::min(length / std::max(holes.along, 1), width / std::max(holes.across, 1));
  problems.range("brick.holes.radius", holes.radius, 1e-4 * most, most, "m");
  if (frog.depth != 0) problems.add("brick.holes", "found holes and a frog, expected one of them");
}

void checkBond(const WallDef& wall, Problems& problems) {
  Layout at = masonry::layoutOf(wall);
  if (wall.bond == Bond::running && wall.halfBats && wall.bondShift > 0) {
    double left = wall.bondShift * at.pitch - at.joint, right = (1 - wall.bondShift) * at.pitch - at.joint;
    if (!(left >= masonry::kMinPiece && right >= masonry::kMinPiece))
      problems.add("bondShift", "found " + textOf(wall.bondShift) + ", which leaves cut bricks of " + textOf(left) +
                                    " and " + textOf(right) + " m at the ends; expected pieces of at least 0.005 m");
  }
  if (!masonry::isThick(wall.bond)) return;
  if (!(wall.brick.size.x >= 2 * wall.brick.size.z))
    problems.add("brick.size", "found a brick " + textOf(wall.brick.size.x) + " m long and " +
                                   textOf(wall.brick.size.z) +
                                   " m wide; header, English and Flemish bond need length >= 2 widths");
  if (wall.bond != Bond::header && !(wall.bricksPerCourse >= 2))
    problems.add("bricksPerCourse",
                 "found " + std::to_string(wall.bricksPerCourse) + ", expected at least 2 in English and Flemish bond");
  double closer = 0.5 * at.headerPitch - at.headerJoint;
  if (wall.halfBats && !(closer >= masonry::kMinPiece))
    problems.add("headJoint", "found " + textOf(wall.headJoint) + " m, which leaves closers of " + textOf(closer) +
                                  " m; expected at least 0.005 m");
}

// Two rectangles of a wall, in metres along it and whole courses.
bool meet(double fromA, double toA, int firstA, int endA, double fromB, double toB, int firstB, int endB) {
  return fromA < toB - 1e-9 && fromB < toA - 1e-9 && firstA < endB && firstB < endA;
}

// An opening with its lintel, and the course below the lintel that carries it.
bool inTheWay(const OpeningSpan& a, const OpeningSpan& b) {
  bool lintel = b.hasLintel();
  return meet(a.from, a.to, a.firstCourse, a.endCourse, b.from, b.to, b.firstCourse, b.endCourse) ||
         (lintel &&
          meet(a.from, a.to, a.firstCourse, a.endCourse, b.lintelFrom, b.lintelTo, b.endCourse - 1, b.lintelEnd)) ||
         (lintel && a.hasLintel() &&
          meet(a.lintelFrom, a.lintelTo, a.endCourse, a.lintelEnd, b.lintelFrom, b.lintelTo, b.endCourse, b.lintelEnd));
}

bool checkOpening(const WallDef& wall, std::size_t index, Problems& problems) {
  const Opening& opening = wall.openings[index];
  std::string field = "openings[" + std::to_string(index) + "].";
  std::size_t before = problems.list.size();
  problems.range(field + "from", opening.from, 0, 1e5, "m");
  problems.range(field + "sill", opening.sill, 0, 1e5, "m");
  problems.range(field + "width", opening.width, 0.01, 1e3, "m");
  problems.range(field + "height", opening.height, 0.01, 1e3, "m");
  problems.range(field + "lintelBearing", opening.lintelBearing, 0.01, 100, "m");
  problems.range(field + "lintelHeight", opening.lintelHeight, 0, 100, "m");
  if (problems.list.size() != before) return false;
  double length = wallLength(wall);
  OpeningSpan span = masonry::spanOf(wall, opening);
  if (!(span.to <= length + 1e-9)) {
    problems.add(field + "width", "the opening ends at " + textOf(span.to) +
                                      " m, expected inside the wall's length of " + textOf(length) + " m");
  } else if (!(span.endCourse > span.firstCourse)) {
    bool above = span.firstCourse >= wall.courses;
    problems.add(field + (above ? "sill" : "height"),
                 above ? "the opening lies above the wall, expected sill below its height of " +
                             textOf(wall.courses * masonry::layoutOf(wall).coursePitch) + " m"
                       : "the opening takes no whole course, expected a height of at least one course");
  } else if (span.hasLintel() && !(span.lintelFrom >= -1e-9 && span.lintelTo <= length + 1e-9)) {
    problems.add(field + "lintelBearing", "the lintel reaches from " + textOf(span.lintelFrom) + " to " +
                                              textOf(span.lintelTo) + " m, expected inside the wall: 0 .. " +
                                              textOf(length) + " m");
  }
  return problems.list.size() == before;
}

void checkOpenings(const WallDef& wall, Problems& problems) {
  std::vector<std::size_t> sound;
  for (std::size_t i = 0; i < wall.openings.size(); i++)
    if (checkOpening(wall, i, problems)) sound.push_back(i);
  for (std::size_t b = 0; b < sound.size(); b++)
    for (std::size_t a = 0; a < b; a++) {
      OpeningSpan spanA = masonry::spanOf(wall, wall.openings[sound[a]]);
      OpeningSpan spanB = masonry::spanOf(wall, wall.openings[sound[b]]);
      if (!inTheWay(spanA, spanB) && !inTheWay(spanB, spanA)) continue;
      problems.add("openings[" + std::to_string(sound[b]) + "].from",
                   "the opening or its lintel meets opening " + std::to_string(sound[a]) +
                       ", expected openings and lintels apart from each other");
    }
}

}  // namespace

std::int64_t brickCount(const WallDef& wall) {
  if (wall.courses < 1 || wall.bricksPerCourse < 1) return 0;
  auto bricksIn = [&](int course) {
    std::int64_t count = 0;
    for (const masonry::Cell& cell : masonry::courseCells(wall, course))
      count += cell.laying == masonry::Laying::leaves ? 2 : 1;
    return count;
  };
  std::int64_t odd = wall.courses / 2, even = wall.courses - odd;
  return even * bricksIn(0) + (odd > 0 ? odd * bricksIn(1) : 0);
}

std::vector<WallProblem> checkWall(const WallDef& wall) {
  Problems problems;
  if (!checkNumbers(wall, problems)) return problems.list;
  checkBond(wall, problems);
  checkHollows(wall.brick, problems);
  if (!problems.list.empty()) return problems.list;
  if (std::int64_t bricks = brickCount(wall); !(bricks <= scene_limits::kMostBodies))
    problems.add("courses", "the wall has " + std::to_string(bricks) + " bricks, expected at most " +
                                std::to_string(scene_limits::kMostBodies));
  else
    checkOpenings(wall, problems);
  return problems.list;
}

}  // namespace brickfall
