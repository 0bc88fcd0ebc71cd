// The core of a shape is a ball a fourth as thick as the shape. On its way through a step it must pass through nothing.
#pragma once
#include "dynamics/body_set.h"
#include "dynamics/shape_set.h"

namespace brickfall {

//! inner radii | too small: cores slip through shapes thinner than the cores
//! | too large: bodies in contact stop each other in their ordinary overlap
constexpr double kCoreShare = 0.25;  // of a shape's inner radius; and so much of its outer one is that of a thick body

//! rad | too small: cost of tumbling bodies
//! | too large: tops precess too slowly, then fall; ends of spinning bodies, and arcs, pass over thin corners
constexpr double kMostTurn = 0.2;  // visible: beyond it points, normals and arms do not stand for the motion

//! - | too small: quick series of impacts end first order, the fastest tops fall, chords of fast spins get long
//! | too large: cost
constexpr int kMostParts = 24;  // of the step of an island, and of an arc

//! - | too small: turning bodies stop earlier than they need to; glancing hits keep the normal of the start
//! | too large: cost
constexpr int kMostLooks = 12;  // along a way, where a place on it is looked for

struct Sweep {
  Transform start;     // of a body's centre frame
  Vec3 way, turn;      // m, rad
  bool turns = false;  // so far that the body's surface moves by more than the body is thick

  Transform at(double share) const {
    Quat turned = turns ? normalized(quatFromRotationVector(turn * share) * start.rotation) : start.rotation;
    return {start.position + way * share, turned};
  }

  // What is left of it after a share.
  Sweep from(double share) const { return {at(share), way * (1 - share), turn * (1 - share), turns}; }
  // Displacement (m) in the rest of the step of a point that is at `place` after `share` of it and from then on moves
  // with this body.
  Vec3 carry(Vec3 place, double share) const {
    Sweep exact = *this;
    exact.turns = true;
    return transformPoint(exact.at(1), transformPoint(inverse(exact.at(share)), place)) - place;
  }
};

// Whether the body turns so far that its surface moves by more than the body is thick, as far as its radii show it.
bool turnsFar(const BodySet& bodies, BodyIndex body, Vec3 turn);

// The way of a body from where it is now.
Sweep sweepOf(const BodySet& bodies, BodyIndex body, Vec3 way, Vec3 turn);

// The box around a shape all along the way of its body.
Aabb sweptBounds(const ShapeData& shape, const Sweep& own);

// Share of its way that the core of `moving` gets past `still`. A turning shape is seen from its own frame: the way
// then leads to the core's last place in that frame.
double coreWay(const ShapeData& moving, const Sweep& way, const ShapeData& still, const Sweep& of);

}  // namespace brickfall
