// Rows 20d to 20f: what stands of dry stones, against limit analysis: domes by a thrust surface within their thickness,
// walls by the least load that turns a part of them over, towers by the acceleration at which they begin to rock.
#include <algorithm>

#include "brickfall/machines.h"
#include "law/law.h"
#include "law/motion.h"
#include "support/lab_scenes.h"

namespace brickfall::law {
namespace {

// --- 20d: half a sphere, closed by a keystone, as [[dome]] of a scene file lays it.
struct DomeStones {
  int rings = 8, stones = 16;
  double thickness = 0.1;  // of a radius of 1
  double step() const { return kPi / 2 / (rings + 0.5); }
  double angle(int joint) const {
    return kPi / 2 - step() * (rings - joint);
  }  // from the crown; joint 0: the keystone's
  double inner() const { return 1 - thickness / 2; }
  double outer() const { return 1 + thickness / 2; }
};

// A corner of a stone: from the axis at the edge of its lune, and above the centre.
Vec3 cornerAt(double radius, double angle, double half) {
  return {radius * std::sin(angle) * std::cos(half), radius * std::cos(angle),
          radius * std::sin(angle) * std::sin(half)};
}
ShapeDef stoneOf(const DomeStones& dome, int ring) {
  ShapeDef shape = boxOf({}, 2400, 2);
  shape.type = ShapeType::hull;
  for (double angle : {dome.angle(ring), dome.angle(ring + 1)})
    for (double radius : {dome.inner(), dome.outer()})
      for (double side : {-1.0, 1.0}) shape.vertices.push_back(cornerAt(radius, angle, side * kPi / dome.stones));
  return shape;
}
ShapeDef keystoneOf(const DomeStones& dome) {
  ShapeDef shape = boxOf({}, 2400, 2);
  shape.type = ShapeType::hull;
  for (int k = 0; k < dome.stones; k++)
    for (double radius : {dome.inner(), dome.outer()})
      shape.vertices.push_back(rotate(quatFromAxisAngle({0, 1, 0}, 2 * kPi * k / dome.stones),
                                      cornerAt(radius, dome.angle(0), kPi / dome.stones)));
  return shape;
}

// States (H, M) of a ring joint for which what is above it can be in balance, as a convex polygon: the outward thrust of
// one lune, and the moment of the force about the dome's centre.
struct Thrust {
  double h, m;
};
using Thrusts = std::vector<Thrust>;

double turnOf(Thrust a, Thrust b, Thrust c) { return (b.h - a.h) * (c.m - a.m) - (b.m - a.m) * (c.h - a.h); }
Thrusts hullAround(Thrusts points) {
  std::sort(points.begin(), points.end(), [](Thrust a, Thrust b) { return a.h != b.h ? a.h < b.h : a.m < b.m; });
  Thrusts out;
  for (int pass = 0; pass < 2; pass++) {
    const std::size_t from = out.size();
    for (const Thrust& p : points) {
      while (out.size() >= from + 2 && turnOf(out[out.size() - 2], out.back(), p) <= 0) out.pop_back();
      out.push_back(p);
    }
    out.pop_back();
    std::reverse(points.begin(), points.end());
  }
  return out;
}
// Where a h + b m <= c.
Thrusts cutTo(const Thrusts& from, double a, double b, double c) {
  Thrusts out;
  for (std::size_t i = 0; i < from.size(); i++) {
    const Thrust p = from[i], q = from[(i + 1) % from.size()];
    const double atP = a * p.h + b * p.m - c, atQ = a * q.h + b * q.m - c;
    if (atP <= 0) out.push_back(p);
    if ((atP < 0 && atQ > 0) || (atP > 0 && atQ < 0)) {
      const double t = atP / (atP - atQ);
      out.push_back({p.h + (q.h - p.h) * t, p.m + (q.m - p.m) * t});
    }
  }
  return out;
}

// Lower bound: stones press on each other, no joint is drawn apart, and nothing slips. Going down from the crown, the
// neighbours of a ring may push its stones outwards at any height of their sides.
bool domeMayStand(const DomeStones& dome) {
  const double half = kPi / dome.stones, most = 1e6;
  World scales = emptySpace();
  const auto massOf = [&](const ShapeDef& shape) { return *scales.massProperties(add(scales, bodyOf(shape, {}))); };
  double load = massOf(keystoneOf(dome)).mass * kG / dome.stones;
  Thrusts possible{{0, -most}, {most, -most}, {most, most}, {0, most}};
  const auto pass = [&](int joint) {  // the force passes between the joint's inner and outer edge
    const Vec3 in = cornerAt(dome.inner(), dome.angle(joint), half),
               out = cornerAt(dome.outer(), dome.angle(joint), half);
    possible = cutTo(possible, in.y, 1, -in.x * load);
    possible = cutTo(possible, -out.y, -1, out.x * load);
  };
  pass(0);
  for (int ring = 0; ring < dome.rings && !possible.empty(); ring++) {
    const MassProperties stone = massOf(stoneOf(dome, ring));
    const double lowest = dome.inner() * std::cos(dome.angle(ring + 1)),
                 highest = dome.outer() * std::cos(dome.angle(ring));
    Thrusts grown;
    for (const Thrust& p : possible)
      for (double push : {0.0, most})
        for (double y : {lowest, highest})
          grown.push_back({p.h + push, p.m - y * push - stone.centre.x * stone.mass * kG});
    possible = hullAround(grown);
    load += stone.mass * kG;
    pass(ring + 1);
  }
  return !possible.empty();
}

bool domeStands(const DomeStones& dome, double dt) {
  World world = makeWorld();
  addGround(world, 2);
  for (int ring = 0; ring < dome.rings; ring++)
    for (int k = 0; k < dome.stones; k++) {
      BodyDef stone = bodyOf(stoneOf(dome, ring), {});
      stone.rotation = quatFromAxisAngle({0, 1, 0}, 2 * kPi * k / dome.stones);
      add(world, stone);
    }
  const BodyId key = add(world, bodyOf(keystoneOf(dome), {}));
  const double height = world.state(key)->centreOfMass.y;
  while (world.time() < 2 - dt / 2) {
    EXPECT_TRUE(world.step(dt).ok());
    if (world.state(key)->centreOfMass.y < height - 0.02) return false;
  }
  return true;
}

TEST(Law, Row20dADomeStandsFromItsLeastThicknessOn) {
  DomeStones dome;
  double low = 0.01, high = 0.1;
  for (int i = 0; i < 20; i++) {
    dome.thickness = (low + high) / 2;
    (domeMayStand(dome) ? high : low) = dome.thickness;
  }
  const double limit = high;
  for (double dt : stepsOfLongCase({kDt})) {
    double falls = 0.7 * limit, stands = 1.3 * limit;
    for (int i = 0; i < 4; i++) {
      dome.thickness = (falls + stands) / 2;
      (domeStands(dome, dt) ? stands : falls) = dome.thickness;
    }
    reached({"8 rings of 16 stones, half a sphere: least thickness over radius", dt, (falls + stands) / 2, limit,
             0.04 * limit, ""});
  }
}

// --- 20e: a running bond of bricks, ends closed with half bats.
struct TiltedWall {
  int courses = 6, bricks = 4;
  bool inPlane = false;
  std::vector<lab::Brick> laid() const { return lab::wall(courses, bricks, 0, {}); }

  // Of the loads that turn a part of the wall over the end of a course, the least, as a share of gravity: what lies on
  // the last `j` bricks of a course, all that lies on this, and so on.
  double limit() const {
    if (!inPlane) return lab::kBrickWidth / (courses * lab::kBrickHeight);
    const double toe = bricks * lab::kBrickLength;
    double least = 1e9;
    for (int foot = 0; foot < courses; foot++)
      for (int j = 1; j <= bricks; j++) {
        double from = toe - j * lab::kBrickLength, restoring = 0, driving = 0;
        for (int course = foot; course < courses; course++) {
          double next = from;
          for (const lab::Brick& brick : laid()) {
            const bool here = std::lround(brick.centre.y / lab::kBrickHeight - 0.5) == course;
            const double left = brick.centre.x - brick.half.x, right = brick.centre.x + brick.half.x;
            if (!here || (course == foot ? left < from - 1e-6 : right < from + 1e-6)) continue;
            restoring += brick.half.x * (toe - brick.centre.x);
            driving += brick.half.x * (brick.centre.y - foot * lab::kBrickHeight);
            next = std::min(next, left);
          }
          from = next;
        }
        if (driving > 0) least = std::min(least, restoring / driving);
      }
    return least;
  }
  // Gravity is turned slowly to this share of itself, and stays.
  bool stands(double load, double dt) const {
    World world = makeWorld();
    addGround(world, inPlane ? 2 : 0.65);
    std::vector<BodyId> all;
    const std::vector<lab::Brick> placed = laid();
    for (const lab::Brick& brick : placed)
      all.push_back(add(world, bodyOf(boxOf(brick.half, 1900, inPlane ? 2 : 0.65), brick.centre)));
    Machines machines;
    const Tilt tilt{.axis = inPlane ? Vec3{0, 0, -1} : Vec3{1, 0, 0},
                    .angle = {{{0.1, 0}, {1.6, std::atan(load)}}, Interpolation::smooth}};
    EXPECT_TRUE(machines.tiltAll(world, tilt).ok());
    while (world.time() < 3.5) {
      EXPECT_TRUE(machines.act(world, world.time(), dt).ok());
      EXPECT_TRUE(world.step(dt).ok());
      for (std::size_t i = 0; i < all.size(); i++)
        if (length(world.state(all[i])->position - placed[i].centre) > 0.01) return false;
    }
    return true;
  }
};

TEST(Law, Row20eDryWallsOnATiltTable) {
  for (const TiltedWall& wall : {TiltedWall{12, 3, false}, TiltedWall{6, 4, true}, TiltedWall{10, 4, true}})
    for (double share : {wall.inPlane ? 0.98 : 0.99, wall.inPlane ? 1.03 : 1.01})
      for (double dt : stepsOfLongCase({kDt}))
        reached({std::string(wall.inPlane ? "along the wall, " : "across the wall, ") + std::to_string(wall.courses) +
                     " courses, " + text(share, 2) + " of " + text(wall.limit(), 4) + ": stands (1 = yes)",
                 dt, wall.stands(share * wall.limit(), dt) ? 1.0 : 0.0, share < 1 ? 1.0 : 0.0, 0, ""});
}

// --- 20f: a tower of blocks rocks about its foot where the table's acceleration passes width over height of gravity.
bool towerRocks(int blocks, double width, double share, double dt) {
  World world = makeWorld();
  const BodyId table = add(world, bodyOf(boxOf({20, 0.5, 20}, 1000, 2), {0, -0.5, 0}, BodyType::kinematic));
  std::vector<BodyId> tower;
  for (int i = 0; i < blocks; i++)
    tower.push_back(add(world, bodyOf(boxOf({width / 2, 0.05, 0.1}, 2000, 2), {0, 0.05 + 0.1 * i, 0})));
  Machines machines;
  const Shake sine{.start = 0.2,
                   .signal = ShakeSignal::sine,
                   .amplitude = share * kG * width / (0.1 * blocks),
                   .frequency = 0.5,
                   .seconds = 6,
                   .ramp = 2};
  EXPECT_TRUE(machines.shake(world, table, sine).ok());
  double tilt = 0;
  while (world.time() < 6.5) {
    EXPECT_TRUE(machines.act(world, world.time(), dt).ok());
    EXPECT_TRUE(world.step(dt).ok());
    for (BodyId block : tower) tilt = std::max(tilt, std::fabs(2 * world.state(block)->rotation.z));
  }
  return tilt > 1e-3;
}

TEST(Law, Row20fATowerRocksUnderASineFromItsSlendernessOn) {
  for (int blocks : {2, 6, 12})
    for (double share : {0.97, 1.03})
      for (double dt : stepsOfLongCase({kDt}))
        reached(
            {"tower of " + std::to_string(blocks) + " blocks, sine of " + text(share, 2) + " g B / H: rocks (1 = yes)",
             dt, towerRocks(blocks, 0.2, share, dt) ? 1.0 : 0.0, share > 1 ? 1.0 : 0.0, 0, ""});
}

}  // namespace
}  // namespace brickfall::law
