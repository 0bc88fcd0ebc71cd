#include "world/core_sweep.h"

#include <algorithm>

#include "geometry/queries.h"
#include "solver/free_motion.h"

namespace brickfall {

namespace {

//! - | too small: a turning body stops earlier than it need | too large: cost
constexpr int kHalvings = 6;  // of a way that turned out to end inside
//! rad | too small: cost | too large: an arc passes over a thin corner between two chords
constexpr double kChord = 0.1;  // rad: arcs are looked at as straight in parts of this
//! - | too small: chords of fast spins get long | too large: cost of fast spins
constexpr int kMostChords = 32;

}  // namespace

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

double coreWay(const ShapeData& moving, const Sweep& way, const ShapeData& still, const Sweep& of) {
  Transform pose = of.start * still.inCentreFrame, back = inverse(pose);
  Vec3 from = transformPoint(way.start, moving.middle);
  bool turns = way.turns || of.turns;
  auto placeAt = [&](double share) {
    return transformPoint(inverse(of.at(share) * still.inCentreFrame), transformPoint(way.at(share), moving.middle));
  };
  Transform coreInOther{transformPoint(back, from), {}};
  Shape core;
  core.type = ShapeType::sphere;
  core.radius = kCoreShare * moving.innerRadius;
  // However often it is stopped there, it never gets all the way.
  double apart = shapeDistance(still.geometry, core, coreInOther).distance, target = core.radius;
  if (!(apart > 0)) {  // pressed in: at least its centre must stay outside
    core.radius = 0;
    apart = shapeDistance(still.geometry, core, coreInOther).distance;
    if (!(apart > 0)) return 1;  // inside: the contacts push it out
  }
  target = std::min(target, 0.5 * apart);
  if (!turns) {
    Vec3 motion = rotate(back.rotation, way.way - of.way);
    return timeOfImpact(still.geometry, core, coreInOther, motion, target).value_or(1);
  }
  double angle = std::max(length(way.turn), length(of.turn));
  int parts = angle < kChord * kMostChords ? 1 + int(angle / kChord) : kMostChords;
  for (int part = 0; part < parts; part++) {
    double begin = double(part) / parts, step = 1.0 / parts;
    coreInOther.position = placeAt(begin);
    Vec3 motion = placeAt(begin + step) - coreInOther.position;
    std::optional<double> met = timeOfImpact(still.geometry, core, coreInOther, motion, target);
    // The part was taken as straight: where it really gets to on the arc must be outside, too.
    double share = begin + step * met.value_or(1);
    bool outside = false;
    for (int halving = 0; halving < kHalvings && !outside; halving++) {
      outside = shapeDistance(still.geometry, core, {placeAt(share), {}}).distance > 0.5 * target;
      if (outside && (met || halving > 0)) return share;
      share = begin + 0.5 * (share - begin);
    }
    if (!outside) return begin;
  }
  return 1;
}

}  // namespace brickfall
