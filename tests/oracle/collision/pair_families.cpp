#include "pair_families.h"

#include <algorithm>
#include <cmath>

namespace brickfall::oracle {

using namespace test;

namespace {

constexpr double kHalfTurn = 3.14159265358979323846;

Vec3 across(Random& random, Vec3 axis) {
  for (;;) {
    Vec3 v = randomDirection(random);
    v -= axis * dot(v, axis);
    if (length(v) > 0.1) return normalized(v);
  }
}

Quat between(Vec3 from, Vec3 to) {
  Vec3 axis = cross(from, to);
  double sine = length(axis), cosine = dot(from, to);
  if (sine < 1e-12) {
    axis = std::fabs(from.x) < 0.7 ? cross(from, Vec3{1, 0, 0}) : cross(from, Vec3{0, 1, 0});
    return cosine > 0 ? Quat{} : quatFromAxisAngle(normalized(axis), kHalfTurn);
  }
  return quatFromAxisAngle(axis * (1 / sine), std::atan2(sine, cosine));
}

double extentOf(const Shape& shape) { return shape.type == ShapeType::plane ? 0 : outerRadius(shape, {}); }

std::vector<Vec3> cloudOf(Random& random, int kind) {
  std::vector<Vec3> out;
  Vec3 size{random.between(0.02, 0.3), random.between(0.02, 0.3), random.between(0.02, 0.3)};
  if (kind == 0) size.y *= 0.1;
  if (kind <= 4) {  // rounded, and flat shards
    int count = kind == 4 && random.below(4) == 0 ? 24 : 4 + int(random.below(10));
    for (int i = 0; i < count; i++) out.push_back(scaled(randomDirection(random), size));
  } else if (kind == 5) {  // a box
    for (int k = 0; k < 8; k++) out.push_back(scaled(size, {k & 1 ? 1. : -1., k & 2 ? 1. : -1., k & 4 ? 1. : -1.}));
  } else if (kind == 6) {  // a prism
    int sides = 3 + int(random.below(6));
    for (int i = 0; i < 2 * sides; i++) {
      double sine, cosine;
      sinCos(2 * kHalfTurn * (i / 2) / sides, sine, cosine);
      out.push_back({size.x * cosine, i % 2 ? size.y : -size.y, size.x * sine});
    }
  } else {  // a brick with some corners broken off
    for (int k = 0; k < 8; k++) {
      Vec3 sign{k & 1 ? 1. : -1., k & 2 ? 1. : -1., k & 4 ? 1. : -1.};
      if (random.below(4) != 0) {
        out.push_back(scaled(size, sign));
        continue;
      }
      for (int axis = 0; axis < 3; axis++) {
        Vec3 p = sign;
        p[axis] *= random.between(-0.2, 0.8);
        out.push_back(scaled(size, p));
      }
    }
  }
  return out;
}

}  // namespace

const char* nameOf(Family family) {
  constexpr const char* kNames[kFamilies] = {"generic",  "near-parallel", "flush", "edge-edge",  "corner-face",
                                             "touching", "deep",          "apart", "size ratio", "speculative"};
  return kNames[int(family)];
}

PairSource::PairSource(ShapeType first, ShapeType second, std::uint64_t seed)
    : first_(first), second_(second), random_(seed) {
  if (first != ShapeType::hull && second != ShapeType::hull) return;
  struct Class {
    std::vector<const Hull*>* list;
    double low, high;
  };
  for (auto [list, low, high] : {Class{&small_, -2, -1}, Class{&middle_, -0.3, 0.3}, Class{&large_, 1, 2}})
    while (list->size() < 150) {
      std::vector<Vec3> cloud = cloudOf(random_, int(random_.below(8)));
      double scale = std::pow(10.0, random_.between(low, high));
      for (Vec3& p : cloud) p *= scale;
      Result<Hull> hull = buildHull(cloud);
      if (!hull.ok()) continue;
      hulls_.push_back(*hull);
      list->push_back(&hulls_.back());
    }
}

bool PairSource::has(Family family) const {
  auto is = [&](ShapeType t) { return first_ == t || second_ == t; };
  auto round = [](ShapeType t) { return t == ShapeType::sphere || t == ShapeType::capsule; };
  switch (family) {
    case Family::nearParallel:
    case Family::flush:
      return !is(ShapeType::sphere);
    case Family::edgeEdge:
      return !is(ShapeType::sphere) && !is(ShapeType::plane);
    case Family::cornerFace:
      return !round(first_) || !round(second_);
    case Family::sizeRatio:
      return !is(ShapeType::plane);
    default:
      return true;
  }
}

const Hull* PairSource::hullOf(double scale) {
  const std::vector<const Hull*>& list = scale < 0.3 ? small_ : scale > 3 ? large_ : middle_;
  return list[random_.below(std::uint32_t(list.size()))];
}

Shape PairSource::shapeOf(ShapeType type, double scale) {
  Shape shape;
  shape.type = type;
  auto length = [&](double low, double high) { return random_.between(low, high) * scale; };
  if (type == ShapeType::box) {
    shape.halfExtents = {length(0.02, 0.3), length(0.02, 0.3), length(0.02, 0.3)};
    int thin = int(random_.below(12));
    if (thin < 3) shape.halfExtents[thin] *= 0.1;                           // a plate
    if (thin == 3) shape.halfExtents.x *= 0.2, shape.halfExtents.y *= 0.2;  // a rod
  }
  if (type == ShapeType::sphere) shape.radius = length(0.02, 0.3);
  if (type == ShapeType::capsule) shape.radius = length(0.02, 0.15), shape.halfHeight = length(0.02, 0.4);
  if (type == ShapeType::hull) shape.hull = hullOf(scale);
  return shape;
}

PairSource::Feature PairSource::face(const Shape& shape) {
  if (shape.type == ShapeType::plane) return {{}, {0, 1, 0}, across(random_, {0, 1, 0})};
  if (shape.type == ShapeType::sphere || shape.type == ShapeType::capsule) return edge(shape);
  Solid solid = solidOf(shape, {});
  std::size_t f = random_.below(std::uint32_t(solid.faces.size()));
  const std::vector<int>& loop = solid.faces[f];
  Vector middle{};
  double sum = 0;
  for (int k : loop) {
    double weight = random_.between(0.05, 1);
    middle += solid.corners[std::size_t(k)] * Real(weight);
    sum += weight;
  }
  Vector side = solid.corners[std::size_t(loop[1])] - solid.corners[std::size_t(loop[0])];
  return {narrow(middle * (1 / Real(sum))), narrow(solid.normals[f]), narrow(normalized(side))};
}

PairSource::Feature PairSource::edge(const Shape& shape) {
  if (shape.type == ShapeType::sphere || shape.type == ShapeType::plane) return corner(shape);
  if (shape.type == ShapeType::capsule) {
    Vec3 out = across(random_, {0, 1, 0});
    return {out * shape.radius + Vec3{0, random_.between(-1, 1) * shape.halfHeight, 0}, out, {0, 1, 0}};
  }
  Solid solid = solidOf(shape, {});
  auto [from, to] = solid.edges[random_.below(std::uint32_t(solid.edges.size()))];
  Vector p = solid.corners[std::size_t(from)], q = solid.corners[std::size_t(to)], out{};
  for (std::size_t f = 0; f < solid.faces.size(); f++) {
    const std::vector<int>& loop = solid.faces[f];
    bool both = std::count(loop.begin(), loop.end(), from) && std::count(loop.begin(), loop.end(), to);
    if (both) out += solid.normals[f] * Real(random_.between(0.2, 1));
  }
  return {narrow(p + (q - p) * Real(random_.between(0.1, 0.9))), narrow(normalized(out)), narrow(normalized(q - p))};
}

PairSource::Feature PairSource::corner(const Shape& shape) {
  if (shape.type == ShapeType::plane) return face(shape);
  Vec3 out = randomDirection(random_);
  if (shape.type == ShapeType::sphere) return {out * shape.radius, out, across(random_, out)};
  if (shape.type == ShapeType::capsule) {
    double end = out.y < 0 ? -1 : 1;
    return {out * shape.radius + Vec3{0, end * shape.halfHeight, 0}, out, across(random_, out)};
  }
  Solid solid = solidOf(shape, {});
  int k = int(random_.below(std::uint32_t(solid.corners.size())));
  Vector sum{};
  for (std::size_t f = 0; f < solid.faces.size(); f++)
    if (std::count(solid.faces[f].begin(), solid.faces[f].end(), k))
      sum += solid.normals[f] * Real(random_.between(0.2, 1));
  out = narrow(normalized(sum));
  return {narrow(solid.corners[std::size_t(k)]), out, across(random_, out)};
}

Vec3 PairSource::inside(const Shape& shape) {
  if (shape.type == ShapeType::plane) return {0, -0.1, 0};
  if (shape.type == ShapeType::hull) return shape.hull->centroid;
  return {};
}

// Puts the features on each other, face to face, turned by `angle` about the common normal.
void PairSource::join(Pair& pair, const Feature& ofA, const Feature& ofB, double angle) {
  Quat turn = between(ofB.outward, -ofA.outward);
  Vec3 along = rotate(turn, ofB.along);
  Vec3 side = cross(ofA.outward, ofA.along);
  double now = std::atan2(dot(along, side), dot(along, ofA.along));
  turn = normalized(quatFromAxisAngle(ofA.outward, angle - now) * turn);
  pair.bInA = {ofA.point - rotate(turn, ofB.point), turn};
}

void PairSource::scales(Family family, double& first, double& second) {
  double all = std::pow(10.0, random_.between(-0.3, 0.3));
  first = second = all;
  if (family != Family::sizeRatio) return;
  first = std::pow(10.0, random_.between(-2, -1)), second = std::pow(10.0, random_.between(1, 2));
  if (random_.below(2)) std::swap(first, second);
}

Pair PairSource::next(Family family) {
  double scaleA, scaleB;
  scales(family, scaleA, scaleB);
  bool swapped = random_.below(2) == 1;
  Pair pair;
  pair.a = shapeOf(swapped ? second_ : first_, scaleA);
  pair.b = shapeOf(swapped ? first_ : second_, scaleB);
  pair.size = std::max(extentOf(pair.a), extentOf(pair.b));
  pair.smallest = std::min(innerRadius(pair.a), innerRadius(pair.b));
  pair.margin = std::min(0.01, 0.3 * pair.smallest);
  Quat any = randomRotation(random_);
  auto someFeature = [&](const Shape& s) {
    int which = int(random_.below(3));
    return which == 0 ? face(s) : which == 1 ? edge(s) : corner(s);
  };
  double close = random_.between(-0.1, 0.05) * pair.smallest;
  switch (family) {
    case Family::generic:
    case Family::sizeRatio:
    case Family::touching:
    case Family::apart:
    case Family::speculative: {
      join(pair, someFeature(pair.a), someFeature(pair.b), random_.between(-3, 3));
      if (random_.below(2)) {  // any turn about the point of contact
        Vec3 pivot = pair.bInA.position;
        pair.bInA.rotation = any;
        pair.bInA.position = pivot;
      }
      double target = close;
      if (family == Family::touching) target = random_.between(-1e-9, 1e-9) * pair.size;
      if (family == Family::apart) target = pair.margin + random_.between(1e-3, 1) * pair.smallest;
      if (family == Family::speculative) {
        pair.margin = pair.size;
        target = random_.between(0, 1.2) * pair.margin;
      }
      setSeparation(pair, target);
      break;
    }
    case Family::nearParallel:
    case Family::flush: {
      bool edges = random_.below(4) == 0;
      join(pair, edges ? edge(pair.a) : face(pair.a), face(pair.b),
           random_.below(2) ? 0.5 * kHalfTurn * random_.below(4) : random_.between(-3, 3));
      if (family == Family::nearParallel) {
        Quat tilt = quatFromRotationVector(randomDirection(random_) * std::pow(10.0, random_.between(-9, -2)));
        Vec3 contact = edges ? Vec3{} : pair.bInA.position;
        pair.bInA.rotation = normalized(tilt * pair.bInA.rotation);
        pair.bInA.position = contact + rotate(tilt, pair.bInA.position - contact);
      }
      setSeparation(pair, random_.below(3) ? 0.05 * close : close);
      break;
    }
    case Family::edgeEdge:
      join(pair, edge(pair.a), edge(pair.b), random_.between(0.1, 3));
      setSeparation(pair, 0.3 * close);
      break;
    case Family::cornerFace: {
      auto flat = [](const Shape& s) { return s.type != ShapeType::sphere && s.type != ShapeType::capsule; };
      bool cornerOfA = pair.b.type == ShapeType::plane || !flat(pair.a) ||
                       (pair.a.type != ShapeType::plane && flat(pair.b) && random_.below(2));
      join(pair, cornerOfA ? corner(pair.a) : face(pair.a), cornerOfA ? face(pair.b) : corner(pair.b),
           random_.between(-3, 3));
      setSeparation(pair, close);
      break;
    }
    case Family::deep: {
      pair.bInA.rotation = random_.below(4) ? any : Quat{};
      Vec3 shift = randomDirection(random_) * (random_.between(0, 0.8) * pair.smallest);
      if (random_.below(20) == 0) shift = {};
      pair.bInA.position = inside(pair.a) + shift - rotate(pair.bInA.rotation, inside(pair.b));
      break;
    }
  }
  return pair;
}

void setSeparation(Pair& pair, double target) {
  for (int round = 0; round < 3; round++) {
    Separation now = separationOf(solidOf(pair.a, {}), solidOf(pair.b, pair.bInA));
    double off = target - double(now.value);
    if (std::fabs(off) < 1e-15 * pair.size) return;
    pair.bInA.position += narrow(now.axis) * off;
  }
}

}  // namespace brickfall::oracle
