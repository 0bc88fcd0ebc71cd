// From courses of cells to bricks in the world: leaves, lintels, disorder, order of creation, place and yaw.
#include <algorithm>
#include <numbers>
#include <utility>

#include "brickfall/limits.h"
#include "brickfall/masonry.h"
#include "masonry/bend.h"
#include "masonry/layout.h"
#include "masonry/lines.h"
#include "masonry/named_seed.h"
#include "masonry/openings.h"
#include "math/random.h"

namespace brickfall {

namespace {

using masonry::Cell;
using masonry::Laying;
using masonry::Layout;
using masonry::OpeningSpan;

// Bricks in the wall's own frame: x along, y up from the foot, z through from the middle.
class Bricklayer {
 public:
  explicit Bricklayer(const WallDef& wall) : wall_(wall), at_(masonry::layoutOf(wall)), lines_(masonry::linesOf(wall)) {
    for (const Opening& opening : wall.openings) {
      spanLines_.push_back(masonry::lineOf(lines_, opening.from));
      spans_.push_back(masonry::spanOf(wall, opening, lines_[spanLines_.back()]));
    }
    if (wall.radius > 0) turn_ = masonry::ringTurn(wall);
  }

  std::vector<BrickPlacement> lay() {
    int courses = wall_.courses;
    for (std::size_t k = 0; k < lines_.size(); k++)
      courses = std::max(courses, wall_.courses + masonry::gableCourses(wall_, lines_[k], int(k)));
    for (const Pier& pier : wall_.piers) courses = std::max(courses, wall_.courses + pier.higher);
    for (int course = 0; course < courses; course++) {
      int position = 0;
      for (std::size_t k = 0; k < lines_.size(); k++) {
        line_ = &lines_[k];
        const bool here = !wall_.pierAlone && course < wall_.courses + masonry::gableCourses(wall_, *line_, int(k));
        if (here) layLine(k, course, position);
      }
      layPiers(course, position);
    }
    return std::move(bricks_);
  }

 private:
  void layLine(std::size_t k, int course, int& position) {
    std::vector<masonry::Run> runs = masonry::cellsOf(wall_, *line_, int(k), course);
    for (std::size_t i = 0; i < spans_.size(); i++) {
      if (spanLines_[i] != k) continue;
      masonry::takeOutOpenings(runs, wall_, course, spans_[i]);
      if (!masonry::isRing(wall_)) continue;
      for (double shift : {-line_->length, line_->length}) {  // bricks and openings may lie across the seam
        OpeningSpan again = spans_[i];
        for (double* place : {&again.from, &again.to, &again.lintelFrom, &again.lintelTo}) *place += shift;
        masonry::takeOutOpenings(runs, wall_, course, again);
      }
    }
    for (const masonry::Run& run : runs)
      for (const Cell& cell : run) layCell(cell, course, position);
    for (std::size_t i = 0; i < spans_.size(); i++)
      if (spanLines_[i] == k && spans_[i].hasLintel() && spans_[i].endCourse == course) layLintel(spans_[i], position);
  }

  void layPiers(int course, int& position) {
    for (const Pier& pier : wall_.piers) {
      if (course >= wall_.courses + pier.higher) continue;
      const masonry::PierPlace place = masonry::placeOf(wall_, pier);
      line_ = &lines_[place.line];
      for (const masonry::PierBrick& brick : masonry::pierCourse(wall_, place, course)) {
        const Vec3 centre{brick.centre.x, course * at_.coursePitch + 0.5 * wall_.brick.size.y, brick.centre.z};
        add(centre, {brick.length, wall_.brick.size.y, at_.width}, course, position, brick.cut);
        BrickPlacement& laid = bricks_.back();
        if (wall_.radius > 0) layAt(place.at, centre, laid);
        if (brick.crosswise) laid.rotation = laid.rotation * quatFromAxisAngle({0, 1, 0}, 0.5 * std::numbers::pi);
      }
    }
  }

  // A brick of a straight block in a round wall.
  void layAt(double place, Vec3 centre, BrickPlacement& brick) const {
    const double angle = place * turn_;
    brick.rotation = quatFromAxisAngle({0, 1, 0}, angle);
    double sine, cosine;
    sinCos(angle, sine, cosine);
    const double out = wall_.radius + centre.z, along = centre.x - place;
    brick.centre = {out * sine + along * cosine, centre.y, out * cosine - along * sine};
  }

  void add(Vec3 centre, Vec3 size, int course, int& position, bool cut) {
    BrickPlacement brick;
    brick.name = wall_.name + "/" + std::to_string(course) + "/" + std::to_string(position++);
    brick.centre = centre;
    brick.size = size;
    brick.course = course;
    brick.cut = cut;
    if (wall_.radius > 0) {
      const double angle = centre.x * turn_, out = wall_.radius + centre.z;
      double sine, cosine;
      sinCos(angle, sine, cosine);
      brick.centre = {out * sine, centre.y, out * cosine};
      brick.rotation = quatFromAxisAngle({0, 1, 0}, angle);
    } else if (line_->yawDegrees != 0 || !(line_->origin == Vec3{})) {
      const Transform place{line_->origin, quatFromAxisAngle({0, 1, 0}, line_->yawDegrees * (std::numbers::pi / 180))};
      brick.centre = transformPoint(place, centre);
      brick.rotation = place.rotation;
    }
    bricks_.push_back(std::move(brick));
  }

  void layCell(const Cell& cell, int course, int& position) {
    Vec3 centre{cell.from + 0.5 * cell.length, course * at_.coursePitch + 0.5 * wall_.brick.size.y, 0};
    Vec3 size{cell.length, wall_.brick.size.y, cell.laying == Laying::header ? at_.length : at_.width};
    if (cell.laying != Laying::leaves) {
      add(centre, size, course, position, cell.cut);
      return;
    }
    Vec3 out{0, 0, 0.5 * (at_.thickness - at_.width)};
    add(centre + out, size, course, position, cell.cut);
    add(centre - out, size, course, position, cell.cut);
  }

  void layLintel(const OpeningSpan& span, int& position) {
    int high = span.lintelEnd - span.endCourse;
    double height = high * at_.coursePitch - wall_.bedJoint;
    Vec3 centre{0.5 * (span.lintelFrom + span.lintelTo), span.endCourse * at_.coursePitch + 0.5 * height, 0};
    add(centre, {span.lintelTo - span.lintelFrom, height, at_.thickness}, span.endCourse, position, false);
    BrickPlacement& lintel = bricks_.back();
    lintel.lintel = true;
    const double turn = (span.lintelTo - span.lintelFrom) * turn_;
    if (!(wall_.radius * turn > masonry::straightTo(wall_.radius, at_.thickness))) return;
    lintel.bend = turn;
    lintel.size.x = wall_.radius * turn;
  }

  const WallDef& wall_;
  Layout at_;
  std::vector<masonry::Line> lines_;
  const masonry::Line* line_ = nullptr;
  double turn_ = 0;  // rad/m, of a ring
  std::vector<OpeningSpan> spans_;
  std::vector<std::size_t> spanLines_;
  std::vector<BrickPlacement> bricks_;
};

// Out of true by gaps of 0 .. disorder below each brick, like shifts, and turns about the vertical to match.
void disturb(BrickPlacement& brick, double disorder, Random& random) {
  double down = random.unit(), along = random.unit(), through = random.unit(), turn = random.unit();
  brick.centre +=
      Vec3{disorder * (along - 0.5), (brick.course + 1) * disorder - disorder * down, disorder * (through - 0.5)};
  const Quat tilt = normalized(Quat{0, (turn - 0.5) * disorder * 5, 0, 1});
  brick.rotation = brick.rotation == Quat{} ? tilt : normalized(brick.rotation * tilt);
}

}  // namespace

std::int64_t brickCount(const WallDef& wall) {
  if (wall.courses < 1 || wall.bricksPerCourse < 1) return 0;
  if (!masonry::isPlain(wall)) {
    const std::int64_t most = masonry::mostBricks(wall);
    if (most > scene_limits::kMostBodies) return most;
    WallDef closed = wall;
    closed.openings.clear();
    return std::int64_t(Bricklayer(closed).lay().size());
  }
  auto bricksIn = [&](int course) {
    std::int64_t count = 0;
    for (const Cell& cell : masonry::courseCells(wall, course)) count += cell.laying == Laying::leaves ? 2 : 1;
    return count;
  };
  std::int64_t odd = wall.courses / 2, even = wall.courses - odd;
  return even * bricksIn(0) + (odd > 0 ? odd * bricksIn(1) : 0);
}

Result<std::vector<BrickPlacement>> layBricks(const WallDef& wall, std::uint64_t seed) {
  std::vector<WallProblem> problems = checkWall(wall);
  if (!problems.empty())
    return Error{ErrorCode::invalidArgument,
                 "wall " + wall.name + ": " + problems[0].field + ": " + problems[0].message};
  std::vector<BrickPlacement> bricks = Bricklayer(wall).lay();
  Random random(masonry::namedSeed(seed, wall.name));
  if (wall.disorder > 0)
    for (BrickPlacement& brick : bricks) disturb(brick, wall.disorder, random);
  Transform place{wall.position, quatFromAxisAngle({0, 1, 0}, wall.yawDegrees * (std::numbers::pi / 180))};
  for (BrickPlacement& brick : bricks) {
    brick.centre = transformPoint(place, brick.centre);
    brick.rotation = normalized(place.rotation * brick.rotation);
  }
  if (wall.shuffle)
    for (std::size_t i = bricks.size(); i > 1; i--) std::swap(bricks[i - 1], bricks[random.below(std::uint32_t(i))]);
  return bricks;
}

}  // namespace brickfall
