// Mortar between bricks: who lies opposite whom, on which outline, and how far each brick grows into its joints. Knows nothing
// of bonds: it looks at where the bricks are, so that cut bricks, lintels and corners of walls need no rules of their own.
#include <algorithm>
#include <array>
#include <cmath>
#include <tuple>
#include <utility>

#include "brickfall/geometry/polygon2d.h"
#include "brickfall/masonry.h"
#include "masonry/bend.h"
#include "masonry/layout.h"
#include "masonry/lines.h"

namespace brickfall {

namespace {

// A face that is turned by less than this from another's opposite is parallel to it: 1 - cosine.
constexpr double kParallel = 1e-7;
constexpr double kSlack =
    1e-3;  // of a brick's smallest extent: bricks that far into each other still lie on each other
constexpr double kLeastShare = 1e-3;  // of the smaller face: less is no joint
constexpr double kWidest = 1.5;       // joint widths: a mason fills what is left beside a lintel
constexpr double kSame = 1e-9;        // of a face: corners closer than this are one

struct Block {
  Vec3 centre, half;
  Mat3 axes;  // columns
  Aabb bounds;
  JointWidths widths;
  double least = 0;  // m, smallest extent
  std::size_t brick = 0;
  bool bent = false;  // one of several that are one brick

  Vec3 axis(int i) const { return {axes.row[0][i], axes.row[1][i], axes.row[2][i]}; }
  Vec3 normal(int face) const { return axis(face / 2) * (face % 2 ? 1.0 : -1.0); }
  Vec3 middle(int face) const { return centre + normal(face) * half[face / 2]; }
  double area(int face) const { return 4 * half[(face / 2 + 1) % 3] * half[(face / 2 + 2) % 3]; }
};

Block blockOf(const BrickPlacement& brick, JointWidths widths) {
  Block block;
  block.centre = brick.centre;
  block.half = brick.size * 0.5;
  block.axes = toMatrix(brick.rotation);
  block.widths = widths;
  block.least = std::min({brick.size.x, brick.size.y, brick.size.z});
  Vec3 reach;
  for (int i = 0; i < 3; i++)
    for (int k = 0; k < 3; k++) reach[i] += std::fabs(block.axes.row[i][k]) * block.half[k];
  block.bounds = {block.centre - reach, block.centre + reach};
  return block;
}

// Pairs of blocks whose bounds meet once each is grown by `by`, from a grid of cells as large as a block is on average. A pair
// is found in the one cell that has the lower corner of what the two share.
class CloseBlocks {
 public:
  CloseBlocks(const std::vector<Block>& blocks, double by) : blocks_(blocks), by_(by) {
    Vec3 sum, most;
    for (const Block& block : blocks) {
      const Vec3 extent = block.bounds.upper - block.bounds.lower + Vec3{2 * by, 2 * by, 2 * by};
      sum += extent;
      most = max(most, extent);
    }
    // No block in more than some dozens of cells along each axis.
    for (int i = 0; i < 3; i++) cell_[i] = std::max(sum[i] / double(blocks.size()), most[i] / 32);
    for (std::uint32_t k = 0; k < blocks.size(); k++) enter(k);
    std::sort(entries_.begin(), entries_.end());
  }

  template <class Visit> void forEach(Visit visit) const {
    for (std::size_t from = 0, to = 0; from < entries_.size(); from = to) {
      while (to < entries_.size() && entries_[to].cell == entries_[from].cell) to++;
      for (std::size_t i = from; i < to; i++)
        for (std::size_t k = i + 1; k < to; k++)
          if (meetIn(entries_[i].block, entries_[k].block, entries_[from].cell))
            visit(entries_[i].block, entries_[k].block);
    }
  }

 private:
  using Cell = std::array<std::int64_t, 3>;
  struct Entry {
    Cell cell;
    std::uint32_t block;
    auto operator<=>(const Entry&) const = default;
  };

  Cell cellOf(Vec3 p) const {
    return {std::int64_t(std::floor(p.x / cell_.x)), std::int64_t(std::floor(p.y / cell_.y)),
            std::int64_t(std::floor(p.z / cell_.z))};
  }
  Aabb reach(std::uint32_t block) const { return brickfall::grown(blocks_[block].bounds, by_); }
  void enter(std::uint32_t block) {
    const Cell low = cellOf(reach(block).lower), high = cellOf(reach(block).upper);
    for (std::int64_t x = low[0]; x <= high[0]; x++)
      for (std::int64_t y = low[1]; y <= high[1]; y++)
        for (std::int64_t z = low[2]; z <= high[2]; z++) entries_.push_back({{x, y, z}, block});
  }
  bool meetIn(std::uint32_t a, std::uint32_t b, const Cell& cell) const {
    const Aabb first = reach(a), second = reach(b);
    return overlaps(first, second) && cellOf(max(first.lower, second.lower)) == cell;
  }

  const std::vector<Block>& blocks_;
  double by_;
  Vec3 cell_;
  std::vector<Entry> entries_;
};

using Corners = std::vector<Vec2>;

// What is left of a convex polygon at sign * (coordinate) <= most.
Corners cutCorners(const Corners& in, int axis, double sign, double most) {
  Corners out;
  const auto beyond = [&](Vec2 p) { return sign * (axis == 0 ? p.x : p.y) - most; };
  for (std::size_t i = 0; i < in.size(); i++) {
    const Vec2 p = in[i], q = in[(i + 1) % in.size()];
    const double dp = beyond(p), dq = beyond(q);
    if (dp <= 0) out.push_back(p);
    if ((dp < 0 && dq > 0) || (dp > 0 && dq < 0)) out.push_back(p + (q - p) * (dp / (dp - dq)));
  }
  return out;
}

void dropEqualCorners(Corners& corners, double same) {
  Corners kept;
  for (Vec2 p : corners)
    if (kept.empty() || length(p - kept.back()) > same) kept.push_back(p);
  while (kept.size() > 1 && length(kept.front() - kept.back()) <= same) kept.pop_back();
  corners = std::move(kept);
}

double areaOf(const Corners& corners) {
  double twice = 0;
  for (std::size_t i = 2; i < corners.size(); i++) twice += cross(corners[i - 1] - corners[0], corners[i] - corners[0]);
  return 0.5 * twice;
}

// Anticlockwise; corners within an edge are dropped.
Corners convexHull(Corners points) {
  std::sort(points.begin(), points.end(), [](Vec2 p, Vec2 q) { return p.x != q.x ? p.x < q.x : p.y < q.y; });
  Corners hull;
  for (int side = 0; side < 2; side++) {
    const std::size_t first = hull.size();
    for (Vec2 p : points) {
      while (hull.size() >= first + 2 && !(cross(hull.back() - hull[hull.size() - 2], p - hull.back()) > 0))
        hull.pop_back();
      hull.push_back(p);
    }
    hull.pop_back();  // it begins the other side
    std::reverse(points.begin(), points.end());
  }
  return hull;
}

// The part of two opposite faces that lies on each other, seen along A's normal.
Corners sharedCorners(const Block& a, int faceA, const Block& b, int faceB) {
  const int iu = (faceA / 2 + 1) % 3, iv = (faceA / 2 + 2) % 3;
  // u x v is the normal.
  const Vec3 u = a.axis(iu) * (faceA % 2 ? 1.0 : -1.0), v = a.axis(iv);
  const Vec3 from = a.middle(faceA), middle = b.middle(faceB);
  const Vec3 p = b.axis((faceB / 2 + 1) % 3) * b.half[(faceB / 2 + 1) % 3];
  const Vec3 q = b.axis((faceB / 2 + 2) % 3) * b.half[(faceB / 2 + 2) % 3];
  Corners corners;
  for (Vec3 corner : {middle - p - q, middle + p - q, middle + p + q, middle - p + q})
    corners.push_back({dot(corner - from, u), dot(corner - from, v)});
  if (areaOf(corners) < 0) std::reverse(corners.begin(), corners.end());
  for (double sign : {-1.0, 1.0}) {
    corners = cutCorners(corners, 0, sign, a.half[iu]);
    corners = cutCorners(corners, 1, sign, a.half[iv]);
  }
  dropEqualCorners(corners, kSame * (a.half[iu] + a.half[iv]));
  return corners;
}

double cosineOf(double angle) {
  double sine, cosine;
  sinCos(angle, sine, cosine);
  return cosine;
}

class Mason {
 public:
  explicit Mason(std::span<const MortaredBricks> walls) {
    double widest = 0;
    for (const MortaredBricks& wall : walls) {
      widest = std::max({widest, wall.widths.head, wall.widths.bed});
      for (const BrickPlacement& brick : wall.bricks) lay(brick, wall.widths);
    }
    if (blocks_.empty()) return;
    double slack = 0;
    for (const Block& block : blocks_) slack = std::max(slack, kSlack * block.least);
    CloseBlocks(blocks_, 0.5 * kWidest * widest + slack).forEach([&](std::size_t a, std::size_t b) { join(a, b); });
    std::sort(joints_.begin(), joints_.end(), [](const Faced& x, const Faced& y) {
      return std::tie(x.joint.a, x.joint.b, x.faceA, x.faceB) < std::tie(y.joint.a, y.joint.b, y.faceA, y.faceB);
    });
    mergeBends();
  }

  MortarLayout layout() const {
    MortarLayout out;
    std::vector<Growth> growth(bricks_.size(), {kNone, kNone, kNone, kNone, kNone, kNone});
    for (const Faced& faced : joints_) {
      out.joints.push_back(faced.joint);
      for (auto [brick, face] : {std::pair(faced.joint.a, faced.faceA), std::pair(faced.joint.b, faced.faceB)})
        if (!bricks_[brick].bent || faced.joint.bed)  // what is bent keeps its ends
          growth[brick][face] = std::min(growth[brick][face], 0.5 * faced.joint.thickness);
    }
    for (Growth& one : growth)
      for (double& by : one) by = by < kNone ? by : 0;
    for (std::size_t k = 0; k < bricks_.size(); k++) {
      GrownBrick brick{bricks_[k].centre, bricks_[k].half * 2.0};
      for (std::size_t face = 0; face < 6; face++) {
        brick.size[int(face / 2)] += growth[k][face];
        brick.centre += bricks_[k].normal(int(face)) * (0.5 * growth[k][face]);
      }
      out.grown.push_back(brick);
    }
    out.slabs = slabs(growth);
    return out;
  }

 private:
  static constexpr double kNone = 1e30;
  using Growth = std::array<double, 6>;  // m, by face
  struct Faced {
    MortarJoint joint;
    std::size_t faceA, faceB;
  };

  // Bounds, in a brick's axes from its middle, of the outlines on one of its faces.
  struct Covered {
    Vec3 lower{kNone, kNone, kNone}, upper{-kNone, -kNone, -kNone};
    double thickness = 0;
  };

  void lay(const BrickPlacement& brick, JointWidths widths) {
    bricks_.push_back(blockOf(brick, widths));
    bricks_.back().bent = brick.bend > 0;
    for (const BrickPlacement& piece : masonry::piecesOf(brick)) {
      blocks_.push_back(blockOf(piece, widths));
      blocks_.back().brick = bricks_.size() - 1;
    }
  }

  // Two beds that pieces of one brick have on another are one.
  void mergeBends() {
    std::vector<Faced> merged;
    for (Faced& faced : joints_) {
      const bool bent = bricks_[faced.joint.a].bent || bricks_[faced.joint.b].bent;
      Faced* last = merged.empty() ? nullptr : &merged.back();
      const bool same = last && bent && faced.joint.bed && last->joint.a == faced.joint.a &&
                        last->joint.b == faced.joint.b && last->faceA == faced.faceA && last->faceB == faced.faceB;
      if (!same) {
        merged.push_back(std::move(faced));
        continue;
      }
      last->joint.outline = around(last->joint.outline, faced.joint.outline);
    }
    joints_ = std::move(merged);
  }

  // The convex outline around two that lie in one level, the way round of the first.
  static std::vector<Vec3> around(const std::vector<Vec3>& a, const std::vector<Vec3>& b) {
    std::vector<Vec2> points;
    for (const std::vector<Vec3>* outline : {&a, &b})
      for (Vec3 p : *outline) points.push_back({p.x, p.z});
    std::vector<Vec2> hull = convexHull(std::move(points));
    double twice = 0;
    for (std::size_t i = 2; i < a.size(); i++)
      twice += cross(Vec2{a[i - 1].x - a[0].x, a[i - 1].z - a[0].z}, Vec2{a[i].x - a[0].x, a[i].z - a[0].z});
    if (twice < 0) std::reverse(hull.begin(), hull.end());
    std::vector<Vec3> out;
    for (Vec2 p : hull) out.push_back({p.x, a[0].y, p.y});
    return out;
  }

  std::vector<std::vector<MortarSlab>> slabs(const std::vector<Growth>& growth) const {
    std::vector<std::array<Covered, 6>> covered(bricks_.size());
    for (const Faced& faced : joints_) {
      const Block &a = bricks_[faced.joint.a], &b = bricks_[faced.joint.b];
      const bool first = !faced.joint.bed || a.normal(int(faced.faceA)).y > 0;
      const bool onA = a.bent != b.bent ? b.bent : first;  // a slab is straight
      const std::size_t owner = onA ? faced.joint.a : faced.joint.b;
      Covered& face = covered[owner][onA ? faced.faceA : faced.faceB];
      face.thickness = std::max(face.thickness, faced.joint.thickness);
      for (Vec3 corner : faced.joint.outline) {
        const Vec3 p = transposeTimes(bricks_[owner].axes, corner - bricks_[owner].centre);
        face.lower = min(face.lower, p);
        face.upper = max(face.upper, p);
      }
    }
    std::vector<std::vector<MortarSlab>> out(bricks_.size());
    for (std::size_t k = 0; k < bricks_.size(); k++)
      for (std::size_t face = 0; face < 6; face++)
        if (covered[k][face].thickness > 0) out[k].push_back(slabOf(bricks_[k], growth[k], face, covered[k][face]));
    return out;
  }

  // A bed that reaches the end of its brick goes on to the middle of the upright joint there.
  static MortarSlab slabOf(const Block& block, const Growth& growth, std::size_t face, Covered covered) {
    const int across = int(face / 2);
    const bool bed = std::fabs(block.axis(across).y) > 0.7;
    Vec3 shift;  // of the grown brick's middle
    for (int i = 0; i < 3; i++) {
      const double below = growth[std::size_t(2 * i)], above = growth[std::size_t(2 * i + 1)];
      shift[i] = 0.5 * (above - below);
      if (bed && covered.lower[i] < -block.half[i] * (1 - kSlack)) covered.lower[i] = -block.half[i] - below;
      if (bed && covered.upper[i] > block.half[i] * (1 - kSlack)) covered.upper[i] = block.half[i] + above;
    }
    const double near = block.half[across], far = near + covered.thickness;
    covered.lower[across] = face % 2 ? near : -far;
    covered.upper[across] = face % 2 ? far : -near;
    return {(covered.lower + covered.upper) * 0.5 - shift, covered.upper - covered.lower};
  }

  void join(std::size_t i, std::size_t k) {
    const std::size_t first = std::min(i, k), second = std::max(i, k);
    const Block &a = blocks_[first], &b = blocks_[second];
    if (a.brick == b.brick) return;
    if (a.widths.wedge > 0 && b.widths.wedge > 0) joinWedge(first, second);
    for (int faceA = 0; faceA < 6; faceA++)
      for (int faceB = 0; faceB < 6; faceB++) {
        if (!(dot(a.normal(faceA), b.normal(faceB)) < kParallel - 1)) continue;
        const bool bed = std::fabs(a.normal(faceA).y) > 0.7;
        const double width = bed ? std::max(a.widths.bed, b.widths.bed) : std::max(a.widths.head, b.widths.head);
        const double slack = kSlack * std::min(a.least, b.least);
        const double gap = dot(b.middle(faceB) - a.middle(faceA), a.normal(faceA));
        if (!(gap >= -slack && gap <= kWidest * width + slack)) continue;
        add(first, faceA, second, faceB, bed, gap);
      }
  }

  // Neighbours in a round wall: their joint is a wedge, open on the outside. It lies half way between their faces.
  void joinWedge(std::size_t first, std::size_t second) {
    const Block &a = blocks_[first], &b = blocks_[second];
    const double least = cosineOf(a.widths.wedge);
    for (int faceA : {0, 1})
      for (int faceB : {0, 1}) {
        const double facing = -dot(a.normal(faceA), b.normal(faceB));
        if (!(facing >= least && facing < 1 - kParallel)) continue;
        const Vec3 normal = normalized(a.normal(faceA) - b.normal(faceB));
        const double gap = dot(b.middle(faceB) - a.middle(faceA), normal);
        const double turn = std::sqrt(std::max(0.0, 1 - facing * facing));  // its sine
        const double opening = turn * std::min(a.half.z, b.half.z), slack = kSlack * std::min(a.least, b.least);
        const double width = std::max(a.widths.head, b.widths.head) + 2 * turn * std::max(a.half.x, b.half.x);
        if (!(gap >= opening - slack && gap <= kWidest * width + slack)) continue;
        Block half = a;
        const double side = faceA % 2 ? 1.0 : -1.0;
        const Vec3 along = normal * side, up = a.axis(1), across = cross(along, up);
        for (int row = 0; row < 3; row++) half.axes.row[row] = {along[row], up[row], across[row]};
        half.centre = a.middle(faceA) - normal * a.half.x;
        add(half, faceA, second, faceB, false, gap, std::max(0.0, gap - opening));
      }
  }

  void add(std::size_t first, int faceA, std::size_t second, int faceB, bool bed, double gap) {
    add(blocks_[first], faceA, second, faceB, bed, gap, gap > kSame * blocks_[first].least ? gap : 0);
  }

  void add(const Block& a, int faceA, std::size_t second, int faceB, bool bed, double gap, double thickness) {
    const Block& b = blocks_[second];
    const Corners corners = sharedCorners(a, faceA, b, faceB);
    if (corners.size() < 3 || !(areaOf(corners) > kLeastShare * std::min(a.area(faceA), b.area(faceB)))) return;
    Faced faced{{a.brick, b.brick, {}, bed, thickness}, std::size_t(faceA), std::size_t(faceB)};
    const Vec3 u = a.axis((faceA / 2 + 1) % 3) * (faceA % 2 ? 1.0 : -1.0), v = a.axis((faceA / 2 + 2) % 3);
    const Vec3 from = a.middle(faceA) + a.normal(faceA) * (0.5 * gap);
    for (Vec2 p : corners) faced.joint.outline.push_back(from + u * p.x + v * p.y);
    joints_.push_back(std::move(faced));
  }

  std::vector<Block> bricks_;  // as they are named
  std::vector<Block> blocks_;  // the straight pieces of them
  std::vector<Faced> joints_;
};

}  // namespace

JointWidths jointWidths(const WallDef& wall) {
  const masonry::Layout at = masonry::layoutOf(wall);
  JointWidths widths{wall.headJoint, wall.bedJoint};
  if (wall.radius > 0)
    widths.wedge = std::min(1.05 * masonry::ringTurn(wall) * std::max(at.pitch, 2 * at.headerPitch), 1.0);
  if (!masonry::isThick(wall.bond)) return widths;
  // Beyond a quarter of a brick's width it is a cavity.
  double leaves = at.length - 2 * at.width;
  for (double gap : {at.headerJoint, wall.bond == Bond::header ? 0 : leaves})
    if (gap <= 0.25 * at.width) widths.head = std::max(widths.head, gap);
  return widths;
}

MortarLayout layMortar(std::span<const MortaredBricks> walls) { return Mason(walls).layout(); }

}  // namespace brickfall
