// From courses of cells to bricks in the world: leaves, lintels, disorder, order of creation, place and yaw.
#include <numbers>
#include <utility>

#include "brickfall/masonry.h"
#include "masonry/layout.h"
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
  explicit Bricklayer(const WallDef& wall) : wall_(wall), at_(masonry::layoutOf(wall)) {
    for (const Opening& opening : wall.openings) spans_.push_back(masonry::spanOf(wall, opening));
  }

  std::vector<BrickPlacement> lay() {
    for (int course = 0; course < wall_.courses; course++) {
      int position = 0;
      for (const masonry::Run& run : masonry::runsOf(wall_, course, spans_))
        for (const Cell& cell : run) layCell(cell, course, position);
      for (const OpeningSpan& span : spans_)
        if (span.hasLintel() && span.endCourse == course) layLintel(span, position);
    }
    return std::move(bricks_);
  }

 private:
  void add(Vec3 centre, Vec3 size, int course, int& position, bool cut) {
    BrickPlacement brick;
    brick.name = wall_.name + "/" + std::to_string(course) + "/" + std::to_string(position++);
    brick.centre = centre;
    brick.size = size;
    brick.course = course;
    brick.cut = cut;
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
    bricks_.back().lintel = true;
  }

  const WallDef& wall_;
  Layout at_;
  std::vector<OpeningSpan> spans_;
  std::vector<BrickPlacement> bricks_;
};

// Out of true by gaps of 0 .. disorder below each brick, like shifts, and turns about the vertical to match.
void disturb(BrickPlacement& brick, double disorder, Random& random) {
  double down = random.unit(), along = random.unit(), through = random.unit(), turn = random.unit();
  brick.centre +=
      Vec3{disorder * (along - 0.5), (brick.course + 1) * disorder - disorder * down, disorder * (through - 0.5)};
  brick.rotation = normalized(Quat{0, (turn - 0.5) * disorder * 5, 0, 1});
}

}  // namespace

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
