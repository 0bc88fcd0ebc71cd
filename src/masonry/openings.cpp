// Cutting at a reveal follows the bricklayer: no piece shorter than a quarter brick is left beside an opening; it is
// made one piece with its neighbour, or the two are cut to equal halves.
#include "masonry/openings.h"

#include <algorithm>
#include <cmath>

namespace brickfall::masonry {

namespace {

constexpr double kTiny = 1e-9;  // m: closer than this is the same place

double endOf(const Cell& cell) { return cell.from + cell.length; }

// The two cells made one piece, or two equal ones if that would be longer than a brick.
void mergeInto(Run& out, const Cell& left, const Cell& right, const Layout& at) {
  double from = left.from, length = endOf(right) - left.from;
  Laying laying = left.laying == right.laying ? left.laying : Laying::leaves;
  if (laying == Laying::header && length > at.width + kTiny) laying = Laying::leaves;
  if (length <= at.length + kTiny) {
    out.push_back({from, length, laying, true});
    return;
  }
  double half = 0.5 * (length - at.joint);
  out.push_back({from, half, laying, true});
  out.push_back({from + length - half, half, laying, true});
}

// A run whose last (or first) cell was cut: small remnants join their neighbour.
Run tidied(const Run& run, const Layout& at, bool cutAtEnd) {
  const Cell& remnant = cutAtEnd ? run.back() : run.front();
  if (!remnant.cut || remnant.length >= 0.25 * at.length - kTiny) return run;
  if (run.size() == 1) return remnant.length >= kMinPiece ? run : Run{};
  Run out;
  if (cutAtEnd) {
    out.assign(run.begin(), run.end() - 2);
    mergeInto(out, run[run.size() - 2], remnant, at);
  } else {
    mergeInto(out, remnant, run[1], at);
    out.insert(out.end(), run.begin() + 2, run.end());
  }
  return out;
}

}  // namespace

void takeOut(std::vector<Run>& runs, double from, double to, const Layout& at) {
  std::vector<Run> out;
  for (const Run& run : runs) {
    Run left, right;
    bool leftCut = false, rightCut = false;
    for (Cell cell : run) {
      Cell rest = cell;
      if (endOf(cell) <= from + kTiny) {
        left.push_back(cell);
        continue;
      }
      if (cell.from >= to - kTiny) {
        right.push_back(cell);
        continue;
      }
      if (cell.from < from - kTiny) {
        cell.length = from - cell.from;
        cell.cut = leftCut = true;
        left.push_back(cell);
      }
      if (endOf(rest) > to + kTiny) {
        rest.length = endOf(rest) - to;
        rest.from = to;
        rest.cut = rightCut = true;
        right.push_back(rest);
      }
    }
    if (leftCut) left = tidied(left, at, true);
    if (rightCut) right = tidied(right, at, false);
    if (!left.empty()) out.push_back(left);
    if (!right.empty()) out.push_back(right);
  }
  runs = out;
}

OpeningSpan spanOf(const WallDef& wall, const Opening& opening) {
  Layout at = layoutOf(wall);
  OpeningSpan span;
  span.from = opening.from;
  span.to = opening.from + opening.width;
  // Course r is open if the middle of its height is: r * pitch + height / 2 between sill and head.
  auto courseAt = [&](double height) {
    double r = std::ceil((height - 0.5 * wall.brick.size.y) / at.coursePitch - 1e-9);
    return int(std::clamp(r, 0.0, double(wall.courses)));
  };
  span.firstCourse = courseAt(opening.sill);
  span.endCourse = courseAt(opening.sill + opening.height);
  span.lintelEnd = span.endCourse;
  span.lintelFrom = span.from - opening.lintelBearing;
  span.lintelTo = span.to + opening.lintelBearing;
  if (opening.lintelHeight > 0 && span.endCourse < wall.courses) {
    double high = std::floor((opening.lintelHeight + wall.bedJoint) / at.coursePitch + 0.5);
    span.lintelEnd = int(std::min(span.endCourse + std::max(high, 1.0), double(wall.courses)));
  }
  return span;
}

std::vector<Run> runsOf(const WallDef& wall, int course, const std::vector<OpeningSpan>& spans) {
  std::vector<Run> runs{courseCells(wall, course)};
  for (const OpeningSpan& span : spans) takeOutOpenings(runs, wall, course, span);
  return runs;
}

void takeOutOpenings(std::vector<Run>& runs, const WallDef& wall, int course, const OpeningSpan& span) {
  const Layout at = layoutOf(wall);
  if (course >= span.firstCourse && course < span.endCourse) takeOut(runs, span.from, span.to, at);
  if (course >= span.endCourse && course < span.lintelEnd)
    takeOut(runs, span.lintelFrom - at.joint, span.lintelTo + at.joint, at);
}

}  // namespace brickfall::masonry
