#include "world/core_sweep.h"

#include <algorithm>

#include "geometry/queries.h"
#include "solver/free_motion.h"

namespace brickfall {

bool turnsFar(const BodySet& bodies, BodyIndex body, Vec3 turn) {
  const BodyMass& mass = bodies.mass[body];
  const Vec3 visible = visibleTurn(mass, bodies.motion[body].orientation, turn);
  return lengthSquared(visible * mass.outerRadius) > mass.innerRadius * mass.innerRadius;
}

Sweep sweepOf(const BodySet& bodies, BodyIndex body, Vec3 way, Vec3 turn) {
  return {bodies.pose(body), way, turn, turnsFar(bodies, body, turn)};
}

Aabb sweptBounds(const ShapeData& shape, const Sweep& own) {
  Aabb here = bounds(shape.geometry, own.start * shape.inCentreFrame);
  if (own.turns) here = merged(here, bounds(shape.geometry, own.at(1) * shape.inCentreFrame));
  return {here.lower + min(own.way, Vec3{}), here.upper + max(own.way, Vec3{})};
}

namespace {

//! not of the method: above what timeOfImpact calls met, so that the answer is the same
constexpr double kSurelyApart = 1e-5, kSurelyApartShare = 1e-8;  // m, of the other's extent

// How much nearer the core can get to the other shape on its way, at most: m. In the frame of a turning shape, the core
// goes round that shape.
double mostApproach(const ShapeData& moving, const Sweep& way, const Sweep& of, Vec3 from) {
  double most = length(way.way - of.way);
  if (way.turns) most += length(way.turn) * length(moving.middle);
  if (of.turns) most += length(of.turn) * length(from - of.start.position);
  return most;
}

// If either body turns: the core's way in the other's frame, in parts that are taken as straight.
double coreWayOnArc(const ShapeData& moving, const Sweep& way, const ShapeData& still, const Sweep& of,
                    const Shape& core, double target) {
  auto placeAt = [&](double share) {
    return transformPoint(inverse(of.at(share) * still.inCentreFrame), transformPoint(way.at(share), moving.middle));
  };
  double angle = std::max(length(way.turn), length(of.turn));
  int parts = angle < kMostTurn * kMostParts ? 1 + int(angle / kMostTurn) : kMostParts;
  for (int part = 0; part < parts; part++) {
    double begin = double(part) / parts, step = 1.0 / parts;
    Transform coreInOther{placeAt(begin), {}};
    Vec3 motion = placeAt(begin + step) - coreInOther.position;
    std::optional<double> met = timeOfImpact(still.geometry, core, coreInOther, motion, target);
    // The part was taken as straight. The place on the arc where it really ends must be outside, too.
    double share = begin + step * met.value_or(1);
    bool outside = false;
    for (int halving = 0; halving < kMostLooks && !outside; halving++) {
      outside = shapeDistance(still.geometry, core, {placeAt(share), {}}).distance > 0.5 * target;
      if (outside && (met || halving > 0)) return share;
      share = begin + 0.5 * (share - begin);
    }
    if (!outside) return begin;
  }
  return 1;
}

}  // namespace

double coreWay(const ShapeData& moving, const Sweep& way, const ShapeData& still, const Sweep& of) {
  Transform pose = of.start * still.inCentreFrame, back = inverse(pose);
  Vec3 from = transformPoint(way.start, moving.middle);
  // Among debris that flies along together, most shapes nearby are out of reach. First their extent shows it, then
  // their distance.
  const bool hasExtent = still.geometry.type != ShapeType::mesh && still.geometry.type != ShapeType::plane;
  const double extent = hasExtent ? outerRadius(still.geometry, {}) : 0, radius = kCoreShare * moving.innerRadius;
  const double safe = mostApproach(moving, way, of, from) + kSurelyApart + kSurelyApartShare * extent;
  if (hasExtent && length(from - pose.position) - extent > 2 * radius + safe) return 1;
  Transform coreInOther{transformPoint(back, from), {}};
  Shape core = sphereOfRadius(radius);
  // Half the distance: however often the body is stopped there, the core never reaches the other shape.
  double apart = shapeDistance(still.geometry, core, coreInOther).distance, target = core.radius;
  if (!(apart > 0)) {  // pressed in: at least its centre must stay outside
    core.radius = 0;
    apart = shapeDistance(still.geometry, core, coreInOther).distance;
    if (!(apart > 0)) return 1;  // the centre is inside: the contacts push it out
  }
  target = std::min(target, 0.5 * apart);
  if (hasExtent && apart - target > safe) return 1;
  if (way.turns || of.turns) return coreWayOnArc(moving, way, still, of, core, target);
  Vec3 motion = rotate(back.rotation, way.way - of.way);
  return timeOfImpact(still.geometry, core, coreInOther, motion, target).value_or(1);
}

}  // namespace brickfall
