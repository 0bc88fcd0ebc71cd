#include "masonry/bend.h"

#include <algorithm>
#include <cmath>

namespace brickfall {

namespace masonry {

namespace {

// A piece from one angle to the other, about the middle of the circle.
struct Sector {
  double radius = 0, from = 0, to = 0;

  double half() const { return 0.5 * (to - from); }
  // At an angle and a distance from the middle line, in the brick's own axes.
  Vec3 at(double angle, double out, double y) const {
    double sine, cosine;
    sinCos(angle, sine, cosine);
    return {(radius + out) * sine, y, (radius + out) * cosine - radius};
  }
};

std::vector<Sector> sectorsOf(const BrickPlacement& brick) {
  std::vector<Sector> out;
  const double radius = brick.size.x / brick.bend;
  const int count = std::max(1, int(std::ceil(brick.size.x / straightTo(radius, brick.size.z) - 1e-9)));
  for (int k = 0; k < count; k++)
    out.push_back({radius, brick.bend * (double(k) / count - 0.5), brick.bend * (double(k + 1) / count - 0.5)});
  return out;
}

}  // namespace

double straightTo(double radius, double thickness) { return std::sqrt(0.8 * radius * thickness); }

std::vector<BrickPlacement> piecesOf(const BrickPlacement& brick) {
  if (!(brick.bend > 0)) return {brick};
  std::vector<BrickPlacement> out;
  for (const Sector& sector : sectorsOf(brick)) {
    double sine, cosine;
    sinCos(sector.half(), sine, cosine);
    const double middle = 0.5 * (sector.from + sector.to);
    BrickPlacement piece = brick;
    piece.bend = 0;
    piece.size.x = 2 * sector.radius * sine;
    piece.centre += rotate(brick.rotation, sector.at(middle, sector.radius * (cosine - 1), 0));
    piece.rotation = normalized(brick.rotation * quatFromAxisAngle({0, 1, 0}, middle));
    out.push_back(piece);
  }
  return out;
}

}  // namespace masonry

std::vector<ShapeDef> shapesOf(const BrickPlacement& brick) {
  std::vector<ShapeDef> out;
  if (!(brick.bend > 0)) {
    out.emplace_back().halfExtents = brick.size * 0.5;
    return out;
  }
  for (const masonry::Sector& sector : masonry::sectorsOf(brick)) {
    ShapeDef& wedge = out.emplace_back();
    wedge.type = ShapeType::hull;
    for (double angle : {sector.from, sector.to})
      for (double through : {-0.5, 0.5})
        for (double up : {-0.5, 0.5})
          wedge.vertices.push_back(sector.at(angle, through * brick.size.z, up * brick.size.y));
  }
  return out;
}

}  // namespace brickfall
