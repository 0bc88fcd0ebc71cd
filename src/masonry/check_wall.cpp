// What a wall must satisfy before a brick is laid. Every check is in the positive form, so that NaN fails.
#include <algorithm>
#include <charconv>
#include <cmath>
#include <numbers>
#include <string>

#include "brickfall/limits.h"
#include "brickfall/masonry.h"
#include "masonry/layout.h"
#include "masonry/lines.h"
#include "masonry/openings.h"

namespace brickfall {

namespace {

constexpr double kDegree = std::numbers::pi / 180;
constexpr double kMostBend = 120 * kDegree;  // of a lintel in a round wall

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

// A path that has corners which can be bonded.
void checkPath(const WallDef& wall, Problems& problems) {
  if (!wall.path.empty()) {
    if (wall.radius > 0) problems.add("radius", "found beside a path, expected one of the two");
    for (const Vec3& p : wall.path)
      if (!(std::fabs(p.x) <= 1e4 && std::fabs(p.z) <= 1e4 && p.y == 0))
        return problems.add("path", "found coordinates beyond 10000 m, expected a shorter path");
    if (!(wall.path.size() >= (wall.closed ? 3u : 2u)))
      return problems.add("path", "found " + std::to_string(wall.path.size()) + " points, expected at least " +
                                      (wall.closed ? "3 of a closed path" : "2"));
    const std::vector<masonry::Line> lines = masonry::linesOf(wall);
    for (std::size_t k = 0; k < lines.size(); k++) {
      const masonry::Line& line = lines[k];
      if (!(line.length > 0.001)) return problems.add("path", "found a point twice, expected corners apart");
      if (k == 0 && !wall.closed) continue;
      const masonry::Line& before = lines[k > 0 ? k - 1 : lines.size() - 1];
      double turn = line.yawDegrees - before.yawDegrees;
      turn = std::fabs(turn - 360 * std::floor(turn / 360 + 0.5));
      if (!(turn >= 29.9 && turn <= 120.1))
        return problems.add("path", "found a corner that turns by " + textOf(turn) +
                                        " degrees, expected 30 .. 120; a round wall has a radius");
    }
    for (const masonry::Line& line : lines)
      if (!(std::min(line.to[0], line.to[1]) - std::max(line.from[0], line.from[1]) >= wall.brick.size.x))
        return problems.add("path", "found a side of " + textOf(line.length) +
                                        " m, expected room for a whole brick between its corners");
  }
  if (wall.closed && wall.path.empty()) problems.add("closed", "found without a path, expected one");
  problems.range("radius", wall.radius, 0, 1e4, "m");
  problems.range("arcDegrees", wall.arcDegrees, 1, 360, "degrees");
  const Layout at = masonry::layoutOf(wall);
  if (wall.radius != 0 && !(wall.radius >= at.length + 0.5 * at.thickness))
    problems.add("radius", "found " + textOf(wall.radius) + " m, expected at least " +
                               textOf(at.length + 0.5 * at.thickness) + " m: a brick's length at its inner face");
  else if (wall.radius > 0 && !masonry::isRing(wall) && !(masonry::ringLength(wall) >= at.length))
    problems.add("arcDegrees",
                 "found an arc of " + textOf(masonry::ringLength(wall)) + " m, expected room for a brick");
}

void checkPierPlace(const WallDef& wall, std::size_t k, Problems& problems) {
  const Pier& pier = wall.piers[k];
  const std::string field = "piers[" + std::to_string(k) + "].";
  const double length = wallLength(wall), inner = wall.radius - 0.5 * masonry::layoutOf(wall).thickness;
  const masonry::PierPlace place = masonry::placeOf(wall, pier);
  if (wall.radius > 0 && !(place.width <= inner))
    return problems.add(field + "width", "found a pier of " + textOf(place.width) + " m, expected at most " +
                                             textOf(inner) + " m: the inner radius of the wall");
  const masonry::PierRoom room = masonry::roomFor(wall, place);
  const double before = masonry::linesOf(wall)[place.line].before;
  if (!(pier.at <= length + 0.5 * place.width && room.from <= room.to + 1e-9))
    problems.add(field + "at", "found " + textOf(pier.at) + " m, expected room for a pier of " + textOf(place.width) +
                                   " m in the wall's length of " + textOf(length) + " m" +
                                   (wall.path.empty() ? "" : ", between two corners"));
  for (std::size_t i = 0; i < k; i++) {
    const masonry::PierPlace other = masonry::placeOf(wall, wall.piers[i]);
    double apart = std::fabs(other.at - place.at);
    if (masonry::isRing(wall)) apart = std::min(apart, length - apart);
    if (other.line == place.line && apart < 0.5 * (other.width + place.width) + wall.brick.size.z)
      problems.add(field + "at", "found it beside pier " + std::to_string(i) + ", expected piers apart");
  }
  for (std::size_t i = 0; i < wall.openings.size(); i++) {
    const Opening& opening = wall.openings[i];
    double at = before + place.at;
    if (masonry::isRing(wall))  // the nearest way round
      at += length * std::round((opening.from + 0.5 * opening.width - at) / length);
    if (opening.from < at + 0.5 * place.width + 1e-9 && opening.from + opening.width > at - 0.5 * place.width - 1e-9)
      problems.add(field + "at", "found it in opening " + std::to_string(i) + ", expected it beside openings");
  }
}

void checkGableAndPiers(const WallDef& wall, Problems& problems) {
  problems.range("gableDegrees", wall.gableDegrees, 0, 80, "degrees");
  if (wall.gableDegrees > 0 && wall.radius > 0)
    problems.add("gableDegrees", "found on a round wall, expected a straight one or a path");
  const int lines = wall.path.empty() ? 1 : int(wall.path.size()) - (wall.closed ? 0 : 1);
  for (int side : wall.gableSides)
    if (!(side >= 0 && side < lines))
      problems.add("gableSides", "found side " + std::to_string(side) + ", expected 0 .. " + std::to_string(lines - 1));
  for (std::size_t k = 0; k < wall.piers.size(); k++) {
    const Pier& pier = wall.piers[k];
    const std::string field = "piers[" + std::to_string(k) + "].";
    const std::size_t before = problems.list.size();
    problems.range(field + "at", pier.at, 0, 1e5, "m");
    problems.range(field + "width", pier.width, 1, 100, "brick lengths");
    problems.range(field + "depth", pier.depth, masonry::isThick(wall.bond) ? 1.5 : 1, 100, "brick lengths");
    problems.range(field + "higher", pier.higher, 0, 10000, "");
    if (problems.list.size() != before) continue;
    if (!wall.pierAlone) checkPierPlace(wall, k, problems);
  }
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

// As far round as a ring goes, and once more: where one of them lies across the seam it meets what is on the other side.
bool inTheWayOnRing(const OpeningSpan& a, OpeningSpan b, double length) {
  for (double* place : {&b.from, &b.to, &b.lintelFrom, &b.lintelTo}) *place -= length;
  for (int round = 0; round < 3; round++) {
    if (inTheWay(a, b) || inTheWay(b, a)) return true;
    for (double* place : {&b.from, &b.to, &b.lintelFrom, &b.lintelTo}) *place += length;
  }
  return false;
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
  const std::vector<masonry::Line> lines = masonry::linesOf(wall);
  const masonry::Line& line = lines[masonry::lineOf(lines, opening.from)];
  double length = std::min(line.to[0], line.to[1]);
  const double begin = std::max({line.from[0], line.from[1], 0.0});
  OpeningSpan span = masonry::spanOf(wall, opening, line);
  const bool ring = masonry::isRing(wall);  // it has no ends to reach beyond
  const double turn = wall.radius > 0 ? (span.lintelTo - span.lintelFrom) * masonry::ringTurn(wall) : 0;
  if (wall.radius > 0 && !(turn <= kMostBend)) {
    problems.add(field + "width",
                 "the opening with its lintel goes round by " + textOf(std::round(turn / kDegree)) +
                     " degrees, expected at most 120: " +
                     textOf(std::max(0.0, kMostBend / masonry::ringTurn(wall) - 2 * opening.lintelBearing)) +
                     " m, a shorter lintel bearing or a larger radius");
  } else if (ring && !(span.from <= length + 1e-9)) {
    problems.add(field + "from", "found " + textOf(span.from) + " m, expected a place in the wall's length of " +
                                     textOf(length) + " m, once round");
  } else if (!ring && !(span.to <= length + 1e-9 && span.from >= begin - 1e-9)) {
    const bool path = lines.size() > 1;
    problems.add(
        field + (path && span.from < begin ? "from" : "width"),
        "the opening " + std::string(path ? "reaches from " + textOf(span.from + line.before) + " to " : "ends at ") +
            textOf(span.to + line.before) + " m, expected inside the wall's length of " +
            (path ? textOf(line.before + begin) + " .. " + textOf(line.before + length) + " m, between two corners"
                  : textOf(length) + " m"));
  } else if (!(span.endCourse > span.firstCourse)) {
    bool above = span.firstCourse >= wall.courses;
    problems.add(field + (above ? "sill" : "height"),
                 above ? "the opening lies above the wall, expected sill below its height of " +
                             textOf(wall.courses * masonry::layoutOf(wall).coursePitch) + " m"
                       : "the opening takes no whole course, expected a height of at least one course");
  } else if (!ring && span.hasLintel() && !(span.lintelFrom >= begin - 1e-9 && span.lintelTo <= length + 1e-9)) {
    problems.add(field + "lintelBearing", "the lintel reaches from " + textOf(span.lintelFrom + line.before) + " to " +
                                              textOf(span.lintelTo + line.before) +
                                              " m, expected inside the wall: " + textOf(line.before + begin) + " .. " +
                                              textOf(line.before + length) + " m");
  }
  return problems.list.size() == before;
}

void checkOpenings(const WallDef& wall, Problems& problems) {
  std::vector<std::size_t> sound;
  for (std::size_t i = 0; i < wall.openings.size(); i++)
    if (checkOpening(wall, i, problems)) sound.push_back(i);
  for (std::size_t b = 0; b < sound.size(); b++)
    for (std::size_t a = 0; a < b; a++) {
      const std::vector<masonry::Line> lines = masonry::linesOf(wall);
      const double fromA = wall.openings[sound[a]].from, fromB = wall.openings[sound[b]].from;
      if (masonry::lineOf(lines, fromA) != masonry::lineOf(lines, fromB)) continue;
      OpeningSpan spanA = masonry::spanOf(wall, wall.openings[sound[a]]);
      OpeningSpan spanB = masonry::spanOf(wall, wall.openings[sound[b]]);
      const bool apart = masonry::isRing(wall) ? !inTheWayOnRing(spanA, spanB, lines[0].length)
                                               : !inTheWay(spanA, spanB) && !inTheWay(spanB, spanA);
      if (apart) continue;
      problems.add("openings[" + std::to_string(sound[b]) + "].from",
                   "the opening or its lintel meets opening " + std::to_string(sound[a]) +
                       ", expected openings and lintels apart from each other");
    }
}

}  // namespace

std::vector<WallProblem> checkWall(const WallDef& wall) {
  Problems problems;
  if (!checkNumbers(wall, problems)) return problems.list;
  checkBond(wall, problems);
  checkHollows(wall.brick, problems);
  if (problems.list.empty()) checkPath(wall, problems);
  if (problems.list.empty()) checkGableAndPiers(wall, problems);
  if (!problems.list.empty()) return problems.list;
  if (std::int64_t bricks = brickCount(wall); !(bricks <= scene_limits::kMostBodies))
    problems.add("courses", "the wall has " + std::to_string(bricks) + " bricks, expected at most " +
                                std::to_string(scene_limits::kMostBodies));
  else
    checkOpenings(wall, problems);
  return problems.list;
}

}  // namespace brickfall
