// Mass, centre and inertia of bricks as they are: hollow, of uneven density, with their share of mortar. Sums of moments of boxes,
// cylinders and frusta of pyramids.
#include <algorithm>
#include <array>
#include <cmath>

#include "brickfall/masonry.h"
#include "masonry/layout.h"
#include "math/random.h"

namespace brickfall {

namespace {

// Mass and its first and second moments about one point.
struct Moments {
  double mass = 0;
  Vec3 first;
  double second[3][3] = {};  // int x_i x_k dm

  // A body of this mass with its centre at `at` and these second moments about it, along the axes.
  void add(double m, Vec3 at, Vec3 own) {
    mass += m;
    first += at * m;
    for (int i = 0; i < 3; i++)
      for (int k = 0; k < 3; k++) second[i][k] += m * at[i] * at[k] + (i == k ? own[i] : 0);
  }
  void addBox(double density, Vec3 at, Vec3 size) {
    const double m = density * size.x * size.y * size.z;
    add(m, at, scaled(size, size) * (m / 12));
  }

  MassProperties properties() const {
    MassProperties out;
    out.mass = mass;
    out.centre = first * (1 / mass);
    double c[3][3], trace = 0;
    for (int i = 0; i < 3; i++)
      for (int k = 0; k < 3; k++) c[i][k] = second[i][k] - mass * out.centre[i] * out.centre[k];
    for (int i = 0; i < 3; i++) trace += c[i][i];
    for (int i = 0; i < 3; i++)
      for (int k = 0; k < 3; k++) out.inertia.row[i][k] = (i == k ? trace : 0) - c[i][k];
    return out;
  }
};

Moments momentsOf(const MassProperties& p, Vec3 shift) {
  Moments out;
  out.mass = p.mass;
  const Vec3 at = p.centre + shift;
  out.first = at * p.mass;
  const double half = 0.5 * (p.inertia.row[0].x + p.inertia.row[1].y + p.inertia.row[2].z);
  for (int i = 0; i < 3; i++)
    for (int k = 0; k < 3; k++) out.second[i][k] = p.mass * at[i] * at[k] + (i == k ? half : 0) - p.inertia.row[i][k];
  return out;
}

// The volume of a hollow with its moments; its shape has its middle on the axes it is symmetric about.
struct Hollow {
  double volume = 0;
  Vec3 centre, own;  // second moments about the centre, m5
};

// In the brick's own axes: length, height, width. Three Gauss points are exact for the fourth powers that come up.
Hollow frogOf(const Frog& frog, double height) {
  constexpr double kPlace[3] = {0.1127016653792583115, 0.5, 0.8872983346207416885};
  constexpr double kWeight[3] = {5.0 / 18, 8.0 / 18, 5.0 / 18};
  double volume = 0, down = 0, downTwice = 0, along = 0, across = 0;
  for (int i = 0; i < 3; i++) {
    const double s = kPlace[i], a = frog.length + (frog.floorLength - frog.length) * s,
                 b = frog.width + (frog.floorWidth - frog.width) * s, part = kWeight[i] * frog.depth * a * b;
    volume += part;
    down += part * s * frog.depth;
    downTwice += part * s * s * frog.depth * frog.depth;
    along += part * a * a / 12;
    across += part * b * b / 12;
  }
  const double mean = volume > 0 ? down / volume : 0;
  return {volume, {0, 0.5 * height - mean, 0}, {along, downTwice - volume * mean * mean, across}};
}

// The hollows of a whole brick.
std::vector<Hollow> hollowsOf(const BrickFormat& format) {
  constexpr double kPi = 3.14159265358979323846;
  std::vector<Hollow> out;
  if (format.frog.depth > 0) out.push_back(frogOf(format.frog, format.size.y));
  const Perforation& holes = format.holes;
  const double volume = kPi * holes.radius * holes.radius * format.size.y,
               round = volume * holes.radius * holes.radius / 4;
  for (int i = 0; i < holes.along; i++)
    for (int k = 0; k < holes.across; k++)
      out.push_back(
          {volume,
           {format.size.x * ((i + 0.5) / holes.along - 0.5), 0, format.size.z * ((k + 0.5) / holes.across - 0.5)},
           {round, volume * format.size.y * format.size.y / 12, round}});
  return out;
}

// A header's length lies through the wall.
bool liesAcross(const WallDef& wall, const BrickPlacement& brick) {
  return masonry::isThick(wall.bond) && brick.size.z > wall.brick.size.z * (1 + 1e-9);
}

// As they lie in this brick: narrowed with it, turned as it is.
std::vector<Hollow> hollowsOf(const WallDef& wall, const BrickPlacement& brick) {
  if (brick.lintel) return {};
  std::vector<Hollow> out = hollowsOf(wall.brick);
  const bool across = liesAcross(wall, brick);
  const double along = (across ? brick.size.z : brick.size.x) / wall.brick.size.x,
               through = (across ? brick.size.x : brick.size.z) / wall.brick.size.z;
  for (Hollow& hollow : out) {
    const Vec3 narrowed{along, 1, through};
    hollow.volume *= along * through;
    hollow.centre = scaled(hollow.centre, narrowed);
    hollow.own = scaled(scaled(hollow.own, narrowed), narrowed) * (along * through);
    if (!across) continue;
    std::swap(hollow.centre.x, hollow.centre.z);
    std::swap(hollow.own.x, hollow.own.z);
  }
  return out;
}

}  // namespace

MassProperties brickMass(const WallDef& wall, const BrickPlacement& brick, const UnevenDensity& uneven,
                         std::uint64_t seed) {
  constexpr int kParts[3] = {4, 2, 2};
  Random random(seed);
  const Vec3 size = brick.size;
  Vec3 slope;  // of relative density, from the middle to a face
  for (int i = 0; i < 3; i++) slope[i] = uneven.gradient * random.between(-1, 1);
  Moments sum;
  sum.addBox(1, {}, size);
  // A linear field has no mass, adds to the centre, and by symmetry nothing to second moments about the middle.
  for (int i = 0; i < 3; i++) sum.first[i] += sum.mass * slope[i] * size[i] / 6;
  const Vec3 part{size.x / kParts[0], size.y / kParts[1], size.z / kParts[2]};
  for (int i = 0; uneven.noise > 0 && i < kParts[0]; i++)
    for (int j = 0; j < kParts[1]; j++)
      for (int k = 0; k < kParts[2]; k++)
        sum.addBox(
            uneven.noise * random.between(-1, 1),
            {part.x * (i + 0.5) - 0.5 * size.x, part.y * (j + 0.5) - 0.5 * size.y, part.z * (k + 0.5) - 0.5 * size.z},
            part);
  for (const Hollow& hollow : hollowsOf(wall, brick)) {
    double density = 1;
    for (int i = 0; i < 3; i++) density += slope[i] * 2 * hollow.centre[i] / size[i];
    sum.add(-density * hollow.volume, hollow.centre, hollow.own * -density);
  }
  return sum.properties();
}

MassProperties mortaredBrickMass(const WallDef& wall, const BrickPlacement& brick, const GrownBrick& grown,
                                 const MassProperties& atOne, double brickDensity, double mortarDensity) {
  const Vec3 shift = rotate(conjugate(brick.rotation), brick.centre - grown.centre);
  MassProperties inKilograms = atOne;
  inKilograms.mass *= brickDensity;
  inKilograms.inertia = inKilograms.inertia * brickDensity;
  Moments sum = momentsOf(inKilograms, shift);
  sum.addBox(mortarDensity, {}, grown.size);
  sum.addBox(-mortarDensity, shift, brick.size);
  // The mortar of the bed above fills a frog; holes stay empty.
  if (wall.brick.frog.depth > 0)
    for (const Hollow& hollow : hollowsOf(wall, brick))
      sum.add(mortarDensity * hollow.volume, hollow.centre + shift, hollow.own * mortarDensity);
  return sum.properties();
}

}  // namespace brickfall
