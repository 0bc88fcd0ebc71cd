#include "masonry/lines.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace brickfall::masonry {

namespace {

constexpr double kFar = 1e7;

// A corner in plan: the wall that goes through reaches `beyond` it, the one that ends there stops `short_` of it.
struct Corner {
  double beyond = 0, short_ = 0;
};

// Of a turn between two lines, both as thick: neither lies in the other.
Corner cornerOf(double turn, double thickness) {
  double sine, cosine;
  sinCos(0.5 * std::fabs(turn), sine, cosine);
  return {0.5 * thickness * sine / cosine, 0.5 * thickness * cosine / sine};
}

Corner cornerBetween(const Line& a, const Line& b, double thickness) {
  double turn = b.yawDegrees - a.yawDegrees;
  turn -= 360 * std::floor(turn / 360 + 0.5);
  return cornerOf(turn * (std::numbers::pi / 180), thickness);
}

// The angle of a direction in plan, in degrees; by bisection on sines, which are the same on every platform.
double yawOf(double x, double z) {
  const double length = std::sqrt(x * x + z * z), sine = -z / length, cosine = x / length;
  double low = -90, high = 90;
  for (int k = 0; k < 60; k++) {
    const double middle = 0.5 * (low + high);
    double s, c;
    sinCos(middle * (std::numbers::pi / 180), s, c);
    (s < sine ? low : high) = middle;
  }
  double angle = 0.5 * (low + high);
  if (cosine < 0) angle = 180 - angle;
  const double whole = std::floor(angle + 0.5);  // walls mostly run at whole degrees
  return std::fabs(angle - whole) < 1e-5 ? whole : angle;
}

std::vector<Line> pathLines(const WallDef& wall) {
  std::vector<Line> lines;
  const std::size_t count = wall.path.size() - (wall.closed ? 0 : 1);
  double before = 0;
  for (std::size_t k = 0; k < count; k++) {
    const Vec3 a = wall.path[k], b = wall.path[(k + 1) % wall.path.size()];
    Line line;
    line.origin = a;
    line.length = length(b - a);
    line.yawDegrees = line.length > 0 ? yawOf(b.x - a.x, b.z - a.z) : 0;
    line.before = before;
    line.plain = false;
    before += line.length;
    lines.push_back(line);
  }
  const Layout at = layoutOf(wall);
  for (std::size_t k = 0; k < lines.size(); k++) {
    Line& line = lines[k];
    line.to[0] = line.to[1] = line.length;
    if (wall.closed || k > 0) {
      const Corner corner = cornerBetween(lines[k > 0 ? k - 1 : lines.size() - 1], line, at.thickness);
      line.from[0] = line.anchor = -corner.beyond;
      line.from[1] = corner.short_ + at.joint;
    }
    if (wall.closed || k + 1 < lines.size()) {
      const Corner corner = cornerBetween(line, lines[(k + 1) % lines.size()], at.thickness);
      line.to[0] = line.length - corner.short_ - at.joint;
      line.to[1] = line.length + corner.beyond;
    }
  }
  return lines;
}

bool reaches(const WallDef& wall) {
  for (int p = 0; p < 2; p++)
    if (wall.startReach[p] != 0 || wall.endReach[p] != 0) return true;
  return false;
}

// Equal steps from below `from` to above `to`.
template <class Add> void steps(double first, double pitch, double from, double to, Add add) {
  const double low = std::floor((from - first) / pitch) - 1, high = std::ceil((to - first) / pitch) + 1;
  for (double k = low; k <= high; k++) add(first + k * pitch);
}

// The endless pattern of a bond, as far as it lies between two places.
std::vector<Cell> pattern(const WallDef& wall, int course, double from, double to) {
  const Layout at = layoutOf(wall);
  const bool second = course % 2 == 1;
  std::vector<Cell> cells;
  const auto add = [&](double place, double length, Laying laying) {
    if (place + length > from && place < to) cells.push_back({place, length, laying, false});
  };
  const double half = 0.5 * at.headerPitch, headerShift = 0.5 * (at.headerJoint - at.joint);
  switch (wall.bond) {
    case Bond::running:
    case Bond::stack: {
      const double shift = second && wall.bond == Bond::running ? wall.bondShift * at.pitch : 0;
      steps(shift, at.pitch, from, to, [&](double place) { add(place, at.length, Laying::single); });
      break;
    }
    case Bond::header:
      steps(second ? half : 0, at.headerPitch, from, to, [&](double place) { add(place, at.width, Laying::header); });
      break;
    case Bond::english:
      if (!second) steps(0, at.pitch, from, to, [&](double place) { add(place, at.length, Laying::leaves); });
      if (second)
        steps(half + headerShift, at.headerPitch, from, to,
              [&](double place) { add(place, at.width, Laying::header); });
      break;
    case Bond::flemish: {
      const double shift = second ? 3 * half : 0;
      steps(shift, 6 * half, from, to, [&](double place) {
        add(place, at.length, Laying::leaves);
        add(place + 4 * half + headerShift, at.width, Laying::header);
      });
      break;
    }
  }
  return cells;
}

std::vector<Cell> ringCells(const WallDef& wall, int course) {
  const double length = ringLength(wall);
  std::vector<Cell> cells;
  for (const Cell& cell : pattern(wall, course, 0, length))
    if (cell.from > -1e-9 && cell.from < length - 1e-9) cells.push_back(cell);
  return cells;
}

void keepBetween(std::vector<Run>& runs, double from, double to, const Layout& at) {
  takeOut(runs, -kFar, from, at);
  takeOut(runs, to, kFar, at);
}

double slopeOf(const WallDef& wall) {
  double sine, cosine;
  sinCos(wall.gableDegrees * (std::numbers::pi / 180), sine, cosine);
  return sine / cosine;
}

}  // namespace

bool isPlain(const WallDef& wall) {
  return wall.path.empty() && wall.radius == 0 && wall.piers.empty() && !wall.pierAlone && wall.letIn.empty() &&
         !(wall.gableDegrees > 0) && !reaches(wall);
}

std::int64_t mostBricks(const WallDef& wall) {
  const Layout at = layoutOf(wall);
  double most = 0;
  const std::vector<Line> lines = linesOf(wall);
  for (std::size_t k = 0; k < lines.size(); k++) {
    const double length = std::max(lines[k].to[0], lines[k].to[1]) - std::min(lines[k].from[0], lines[k].from[1]);
    const double courses =
        double(wall.courses) + (hasGable(wall, int(k)) ? length * slopeOf(wall) / at.coursePitch : 0);
    most += (2 * length / std::min(at.length, 2 * at.width) + 4) * courses;
  }
  for (const Pier& pier : wall.piers) most += (4 * pier.width * pier.depth + 4) * (wall.courses + pier.higher);
  return std::int64_t(std::min(most, 1e15));
}

std::size_t lineOf(const std::vector<Line>& lines, double place) {
  std::size_t found = 0;
  for (std::size_t k = 1; k < lines.size(); k++)
    if (place >= lines[k].before) found = k;
  return found;
}

OpeningSpan spanOf(const WallDef& wall, Opening opening, const Line& line) {
  opening.from -= line.before;
  return spanOf(wall, opening);
}

bool isRing(const WallDef& wall) { return wall.radius > 0 && wall.arcDegrees >= 360; }

int ringBricks(const WallDef& wall) {
  const Layout at = layoutOf(wall);
  const double unit = wall.bond == Bond::header ? at.headerPitch : at.pitch;
  const double most = 2 * std::numbers::pi * (wall.radius - 0.5 * at.thickness) / unit;
  const int bricks = int(std::floor(std::min(most, 1e6) + 1e-9));
  return wall.bond == Bond::flemish ? bricks / 3 * 3 : bricks;
}

double ringLength(const WallDef& wall) {
  const Layout at = layoutOf(wall);
  if (!isRing(wall)) return wall.arcDegrees * (std::numbers::pi / 180) * (wall.radius - 0.5 * at.thickness);
  return ringBricks(wall) * (wall.bond == Bond::header ? at.headerPitch : at.pitch);
}

double ringTurn(const WallDef& wall) {
  if (isRing(wall)) return 2 * std::numbers::pi / ringLength(wall);
  return 1 / (wall.radius - 0.5 * layoutOf(wall).thickness);
}

std::vector<Line> linesOf(const WallDef& wall) {
  if (!wall.path.empty()) {
    std::vector<Line> lines = pathLines(wall);
    for (int p = 0; p < 2 && !wall.closed; p++) {
      lines.front().from[p] -= wall.startReach[p];
      lines.back().to[p] += wall.endReach[p];
    }
    return lines;
  }
  Line line;
  line.length = wall.radius > 0 ? ringLength(wall) : layoutOf(wall).wallLength;
  line.plain = wall.radius == 0 && !reaches(wall);
  for (int p = 0; p < 2; p++) {
    line.from[p] = -wall.startReach[p];
    line.to[p] = line.length + wall.endReach[p];
  }
  return {line};
}

bool hasGable(const WallDef& wall, int index) {
  if (!(wall.gableDegrees > 0)) return false;
  return wall.gableSides.empty() ||
         std::find(wall.gableSides.begin(), wall.gableSides.end(), index) != wall.gableSides.end();
}

int gableCourses(const WallDef& wall, const Line& line, int index) {
  if (!hasGable(wall, index)) return 0;
  const Layout at = layoutOf(wall);
  const double from = std::min(line.from[0], line.from[1]), to = std::max(line.to[0], line.to[1]);
  const double left = to - from - 0.5 * at.length;  // half a brick stays at the ridge
  return std::max(0, int(std::floor(0.5 * left * slopeOf(wall) / at.coursePitch + 1e-9)));
}

std::vector<Run> cellsOf(const WallDef& wall, const Line& line, int index, int course) {
  const Layout at = layoutOf(wall);
  const int odd = course % 2;
  std::vector<Run> runs;
  double from = line.from[odd], to = line.to[odd];
  if (line.plain) {
    runs.push_back(courseCells(wall, course));
  } else if (isRing(wall)) {
    runs.push_back(ringCells(wall, course));
  } else {
    runs.push_back(pattern(wall, course, from - line.anchor - at.pitch, to - line.anchor + at.pitch));
    for (Cell& cell : runs[0]) cell.from += line.anchor;
    keepBetween(runs, from, to, at);
  }
  if (course >= wall.courses) {
    const double rise = (course + 1 - wall.courses) * at.coursePitch / slopeOf(wall);
    const double low = std::min(line.from[0], line.from[1]), high = std::max(line.to[0], line.to[1]);
    keepBetween(runs, low + rise, high - rise, at);
  }
  for (const LetIn& other : wall.letIn)
    if (other.side == index && course >= other.firstCourse && course < other.endCourse && odd == other.parity)
      takeOut(runs, other.from, other.to, at);
  for (const Pier& pier : wall.piers) {
    const PierPlace place = placeOf(wall, pier);
    if (int(place.line) != index || !place.crosswise(course)) continue;
    takeOut(runs, place.at - place.taken, place.at + place.taken, at);
    if (!isRing(wall)) continue;
    for (const double round : {-line.length, line.length})  // a brick may lie across the seam
      takeOut(runs, place.at + round - place.taken, place.at + round + place.taken, at);
  }
  return runs;
}

namespace {

// m along the inner face of a round wall: how far from the middle of a block of this half width its bricks begin, so that no
// corner of them lies in the block, however short the first is.
double clearOf(double half, double radius, double longest) {
  double low = half, high = std::min(2 * half + longest, 1.5 * radius);
  for (int k = 0; k < 50; k++) {
    const double middle = 0.5 * (low + high);
    double least = kFar;
    for (const double length : {0.0, longest}) {
      double sine, cosine;
      sinCos((middle + 0.5 * length) / radius, sine, cosine);
      least = std::min(least, radius * sine - 0.5 * length * cosine);
    }
    (least < half ? low : high) = middle;
  }
  return high;
}

// What a round wall makes of a pier: a straight block at one place of it.
void goRound(const WallDef& wall, const Layout& at, PierPlace& place) {
  const double inner = wall.radius - 0.5 * at.thickness, outer = wall.radius + 0.5 * at.thickness;
  const double half = std::min(0.5 * place.width, inner);
  place.taken = clearOf(half + at.joint, inner, at.length);
  place.inward = inner - std::sqrt(inner * inner - half * half);
  place.outward = std::sqrt(outer * outer + 0.25 * at.length * at.length) - outer;
}

}  // namespace

PierRoom roomFor(const WallDef& wall, const PierPlace& place) {
  const std::vector<Line> lines = linesOf(wall);
  const Line& line = lines[place.line];
  if (isRing(wall)) return {0, line.length};
  const double half = wall.radius > 0 ? place.taken : 0.5 * place.width;
  PierRoom room{half, line.length - half};
  const double apart = place.taken + kMinPiece;
  if (place.line > 0 || wall.closed) room.from = std::max(line.from[0], line.from[1]) + apart;
  if (place.line + 1 < lines.size() || wall.closed) room.to = std::min(line.to[0], line.to[1]) - apart;
  return room;
}

PierPlace placeOf(const WallDef& wall, const Pier& pier) {
  const Layout at = layoutOf(wall);
  PierPlace place;
  place.along = std::max(2, int(std::floor(2 * pier.width + 0.5)));
  place.through = std::max(2, int(std::floor(2 * pier.depth + 0.5)));
  place.width = 0.5 * place.along * at.pitch - at.joint;
  place.depth = 0.5 * place.through * at.pitch - at.joint;
  place.wallRows = isThick(wall.bond) ? 2 : 1;
  place.wallFirst = (place.through - place.wallRows) / 2;
  // The wall is some of the pier's rows: a pier that cannot lie in its middle stands further out in front.
  const double middleOfWall = place.wallFirst + 0.5 * (place.wallRows - 1), middle = 0.5 * (place.through - 1);
  place.across = (middle - middleOfWall) * 0.5 * at.pitch;
  if (wall.pierAlone) {
    place.across = 0;
    place.wallRows = 0;
    return place;
  }
  place.taken = 0.5 * place.width + at.joint;
  if (wall.radius > 0) goRound(wall, at, place);
  const std::vector<Line> lines = linesOf(wall);
  place.line = lineOf(lines, pier.at);
  const PierRoom room = roomFor(wall, place);
  place.at = std::min(std::max(pier.at - lines[place.line].before, room.from), room.to);
  return place;
}

std::vector<PierBrick> pierCourse(const WallDef& wall, const PierPlace& place, int course) {
  const Layout at = layoutOf(wall);
  const bool crosswise = place.crosswise(course), besideWall = course < wall.courses && !wall.pierAlone;
  const int rows = crosswise ? place.along : place.through, halves = crosswise ? place.through : place.along;
  const double bat = 0.5 * at.pitch - at.joint;
  std::vector<PierBrick> bricks;
  for (int row = 0; row < rows; row++) {
    const bool walls = row >= place.wallFirst && row < place.wallFirst + place.wallRows;
    if (!crosswise && besideWall && walls) continue;
    // Rows with an odd number of halves have a half bat, at one end and at the other in turn.
    double from = -0.5 * (0.5 * halves * at.pitch - at.joint);
    double side = (row - 0.5 * (rows - 1)) * 0.5 * at.pitch;
    if (!crosswise && besideWall) side += row < place.wallFirst ? -place.inward : place.outward;
    for (int half = 0; half < halves;) {
      const bool cut = halves % 2 == 1 && half == (row % 2 == 0 ? 0 : halves - 1);
      const double length = cut ? bat : at.length, middle = from + 0.5 * length;
      PierBrick brick;
      brick.length = length;
      brick.cut = cut;
      brick.crosswise = crosswise;
      brick.centre =
          crosswise ? Vec3{place.at + side, 0, place.across + middle} : Vec3{place.at + middle, 0, place.across + side};
      bricks.push_back(brick);
      from += length + at.joint;
      half += cut ? 1 : 2;
    }
  }
  return bricks;
}

}  // namespace brickfall::masonry

namespace brickfall {

double wallLength(const WallDef& wall) {
  double length = 0;
  for (const masonry::Line& line : masonry::linesOf(wall)) length += line.length;
  return length;
}

}  // namespace brickfall
