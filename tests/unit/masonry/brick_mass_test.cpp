// Masses of bricks as they are, against closed forms and against sums over small cubes.
#include <functional>

#include "unit/masonry/wall_checks.h"

namespace brickfall {
namespace {

BrickPlacement placed(Vec3 size) {
  BrickPlacement brick;
  brick.name = "wall/0/0";
  brick.size = size;
  return brick;
}

// By cells whose middles have this density; about the middle of the box.
MassProperties summed(Vec3 size, const std::function<double(Vec3)>& density, int n = 64) {
  double mass = 0, second[3][3] = {};
  Vec3 first;
  const Vec3 cell = size * (1.0 / n);
  for (int i = 0; i < n; i++)
    for (int j = 0; j < n; j++)
      for (int k = 0; k < n; k++) {
        const Vec3 p{cell.x * (i + 0.5) - size.x / 2, cell.y * (j + 0.5) - size.y / 2, cell.z * (k + 0.5) - size.z / 2};
        const double m = density(p) * cell.x * cell.y * cell.z;
        mass += m;
        first += p * m;
        for (int a = 0; a < 3; a++)
          for (int b = 0; b < 3; b++) second[a][b] += m * p[a] * p[b];
      }
  MassProperties out;
  out.mass = mass;
  out.centre = first * (1 / mass);
  for (int a = 0; a < 3; a++)
    for (int b = 0; b < 3; b++) {
      second[a][b] -= mass * out.centre[a] * out.centre[b];
      out.inertia.row[a][b] = -second[a][b];
    }
  const double trace = second[0][0] + second[1][1] + second[2][2];
  for (int a = 0; a < 3; a++) out.inertia.row[a][a] += trace;
  return out;
}

void expectAlike(const MassProperties& a, const MassProperties& b, Vec3 size, double share) {
  EXPECT_NEAR(a.mass, b.mass, share * b.mass);
  const double most = length(size);
  EXPECT_NEAR(length(a.centre - b.centre), 0, share * most);
  for (int i = 0; i < 3; i++)
    for (int k = 0; k < 3; k++)
      EXPECT_NEAR(a.inertia.row[i][k], b.inertia.row[i][k], share * b.mass * most * most) << i << k;
}

constexpr Vec3 kUk{0.215, 0.065, 0.1025};

TEST(BrickMass, OfASolidOneIsThatOfABox) {
  const MassProperties mass = brickMass(WallDef{}, placed(kUk));
  const double m = kUk.x * kUk.y * kUk.z;
  EXPECT_NEAR(mass.mass, m, 1e-15);
  EXPECT_EQ(length(mass.centre), 0);
  EXPECT_NEAR(mass.inertia.row[0].x, m * (kUk.y * kUk.y + kUk.z * kUk.z) / 12, 1e-18);
  EXPECT_NEAR(mass.inertia.row[1].y, m * (kUk.x * kUk.x + kUk.z * kUk.z) / 12, 1e-18);
}

TEST(BrickMass, OfHolesIsThatOfCylindersTakenOut) {
  WallDef wall;
  wall.brick.holes = {3, 1, 0.02};
  const MassProperties mass = brickMass(wall, placed(kUk));
  const double box = kUk.x * kUk.y * kUk.z, hole = 3.14159265358979312 * 4e-4 * kUk.y;
  EXPECT_NEAR(mass.mass, box - 3 * hole, 1e-15);
  EXPECT_NEAR(length(mass.centre), 0, 1e-15);
  const double pitch = kUk.x / 3;
  EXPECT_NEAR(mass.inertia.row[1].y,
              box * (kUk.x * kUk.x + kUk.z * kUk.z) / 12 - 3 * hole * 4e-4 / 2 - 2 * hole * pitch * pitch, 1e-15);
  EXPECT_NEAR(mass.inertia.row[0].x,
              box * (kUk.y * kUk.y + kUk.z * kUk.z) / 12 - 3 * hole * (3 * 4e-4 + kUk.y * kUk.y) / 12, 1e-15);
}

// Prismatoid rule: V = d (A + 4 M + B) / 6; the centre is below the brick's middle.
TEST(BrickMass, OfAFrogIsThatOfAPyramidTakenOut) {
  WallDef wall;
  wall.brick.frog = {0.15, 0.06, 0.12, 0.035, 0.018};
  const MassProperties mass = brickMass(wall, placed(kUk));
  const double frog = 0.018 * (0.15 * 0.06 + 4 * 0.135 * 0.0475 + 0.12 * 0.035) / 6;
  EXPECT_NEAR(mass.mass, kUk.x * kUk.y * kUk.z - frog, 1e-15);
  EXPECT_NEAR(frog / (kUk.x * kUk.y * kUk.z), 0.08, 0.003);  // as the documentation says
  EXPECT_LT(mass.centre.y, -0.001);
  const auto there = [](Vec3 p) {
    const double s = (kUk.y / 2 - p.y) / 0.018;
    const bool in = s < 1 && std::fabs(p.x) < (0.15 - 0.03 * s) / 2 && std::fabs(p.z) < (0.06 - 0.025 * s) / 2;
    return in ? 0.0 : 1.0;
  };
  expectAlike(mass, summed(kUk, there), kUk, 4e-3);
  // A box when its sides are upright.
  wall.brick.frog = {0.15, 0.06, 0.15, 0.06, 0.0325};
  const MassProperties deep = brickMass(wall, placed(kUk));
  EXPECT_NEAR(deep.mass, kUk.x * kUk.y * kUk.z - 0.15 * 0.06 * 0.0325, 1e-15);
  EXPECT_NEAR(deep.centre.y * deep.mass, -0.15 * 0.06 * 0.0325 * 0.0325 / 2, 1e-15);
}

TEST(BrickMass, FollowsCutAndTurnedBricks) {
  WallDef wall;
  wall.bond = Bond::english;
  wall.brick.holes = {5, 2, 0.012};
  const MassProperties whole = brickMass(wall, placed(kUk)), header = brickMass(wall, placed({kUk.z, kUk.y, kUk.x}));
  EXPECT_NEAR(header.mass, whole.mass, 1e-15);
  EXPECT_NEAR(header.inertia.row[0].x, whole.inertia.row[2].z, 1e-15);
  EXPECT_NEAR(header.inertia.row[2].z, whole.inertia.row[0].x, 1e-15);
  wall.bond = Bond::running;
  EXPECT_NEAR(brickMass(wall, placed({kUk.x / 2, kUk.y, kUk.z})).mass, whole.mass / 2, 1e-15);
  BrickPlacement lintel = placed({1, 0.065, 0.1025});
  lintel.lintel = true;
  EXPECT_NEAR(brickMass(wall, lintel).mass, 0.065 * 0.1025, 1e-15);
}

TEST(BrickMass, OfALinearFieldMovesTheCentre) {
  double most = 0;
  for (std::uint64_t seed = 1; seed < 200; seed++) {
    const MassProperties mass = brickMass(WallDef{}, placed(kUk), {0.1, 0}, seed);
    EXPECT_NEAR(mass.mass, kUk.x * kUk.y * kUk.z, 1e-15);
    const Vec3 slope{mass.centre.x * 6 / kUk.x, mass.centre.y * 6 / kUk.y, mass.centre.z * 6 / kUk.z};
    for (int i = 0; i < 3; i++) EXPECT_LT(std::fabs(slope[i]), 0.1);
    most = std::max(most, std::fabs(slope.x));
    if (seed > 3) continue;
    const auto field = [&](Vec3 p) {
      return 1 + slope.x * 2 * p.x / kUk.x + slope.y * 2 * p.y / kUk.y + slope.z * 2 * p.z / kUk.z;
    };
    expectAlike(mass, summed(kUk, field), kUk, 2e-4);
  }
  EXPECT_GT(most, 0.09);
}

TEST(BrickMass, OfNoiseScattersAndStaysPossible) {
  WallDef wall;
  wall.brick.holes = {3, 1, 0.02};
  const double even = brickMass(wall, placed(kUk)).mass;
  double sum = 0, squares = 0;
  const int n = 2000;
  for (std::uint64_t seed = 1; seed <= n; seed++) {
    const MassProperties mass = brickMass(wall, placed(kUk), {0.05, 0.05}, seed);
    const double off = mass.mass / even - 1;
    sum += off, squares += off * off;
    EXPECT_EQ(mass.mass, brickMass(wall, placed(kUk), {0.05, 0.05}, seed).mass);
  }
  EXPECT_NEAR(sum / n, 0, 1e-3);
  // Sixteen parts, each uniform within 5 %, of a box of which 17 % is not there.
  EXPECT_NEAR(std::sqrt(squares / n), 0.05 / std::sqrt(3.0 * 16) * kUk.x * kUk.y * kUk.z / even, 5e-4);
}

// Brick and mortar apart are what they are together; the frog is full of mortar.
TEST(BrickMass, InMortarAddsItsShareAndFillsTheFrog) {
  WallDef wall;
  wall.brick.frog = {0.15, 0.06, 0.15, 0.06, 0.018};
  BrickPlacement brick = placed(kUk);
  brick.centre = {3, 1, 2};
  brick.rotation = quatFromAxisAngle({0, 1, 0}, 0.7);
  const GrownBrick grown{brick.centre + rotate(brick.rotation, Vec3{0.0025, 0.001, 0}),
                         kUk + Vec3{0.005, 0.002, 0.004}};
  const MassProperties mass = mortaredBrickMass(wall, brick, grown, brickMass(wall, brick), 2000, 1500);
  const auto density = [&](Vec3 p) {
    const Vec3 q = p + Vec3{0.0025, 0.001, 0};  // from the brick's middle
    const bool in = std::fabs(q.x) < kUk.x / 2 && std::fabs(q.y) < kUk.y / 2 && std::fabs(q.z) < kUk.z / 2;
    const bool frog = q.y > kUk.y / 2 - 0.018 && std::fabs(q.x) < 0.075 && std::fabs(q.z) < 0.03;
    return in && !frog ? 2000.0 : 1500.0;
  };
  expectAlike(mass, summed(grown.size, density), kUk, 4e-3);
  const double box = kUk.x * kUk.y * kUk.z, frog = 0.15 * 0.06 * 0.018,
               all = grown.size.x * grown.size.y * grown.size.z;
  EXPECT_NEAR(mass.mass, 2000 * (box - frog) + 1500 * (all - box + frog), 1e-12);
}

TEST(BrickMass, HollowsThatDoNotFitAreRefused) {
  const auto problemOf = [](Frog frog, Perforation holes) {
    WallDef wall;
    wall.brick.frog = frog;
    wall.brick.holes = holes;
    const std::vector<WallProblem> problems = checkWall(wall);
    return problems.empty() ? std::string() : problems[0].field;
  };
  EXPECT_EQ(problemOf({0.15, 0.06, 0.1, 0.05, 0.02}, {}), "");
  EXPECT_EQ(problemOf({0.25, 0.06, 0.1, 0.05, 0.02}, {}), "brick.frog.length");
  EXPECT_EQ(problemOf({0.15, 0.06, 0.16, 0.05, 0.02}, {}), "brick.frog.floorLength");
  EXPECT_EQ(problemOf({0.15, 0.06, 0.1, 0.05, 0.065}, {}), "brick.frog.depth");
  EXPECT_EQ(problemOf({0.15, 0.06, 0.1, 0.05, -1}, {}), "brick.frog.depth");
  EXPECT_EQ(problemOf({}, {3, 1, 0.04}), "brick.holes.radius");
  EXPECT_EQ(problemOf({}, {3, 0, 0.01}), "brick.holes.across");
  EXPECT_EQ(problemOf({0.15, 0.06, 0.1, 0.05, 0.02}, {3, 1, 0.01}), "brick.holes");
}

}  // namespace
}  // namespace brickfall
