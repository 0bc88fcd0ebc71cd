// The core of a shape, a ball a fourth as thick as the shape, on its way through a step: what it may not pass through.
#pragma once
#include "dynamics/body_set.h"
#include "dynamics/shape_set.h"

namespace brickfall {

//! inner radii | too small: cores slip through what is thinner than they
//! | too large: bodies in contact stop each other in their ordinary overlap
constexpr double kCoreShare = 0.25;  // of a shape's inner radius

struct Sweep {
  Transform start;     // of a body's centre frame
  Vec3 way, turn;      // m, rad
  bool turns = false;  // so far that its surface moves by more than it is thick

  Transform at(double share) const {
    Quat turned = turns ? normalized(quatFromRotationVector(turn * share) * start.rotation) : start.rotation;
    return {start.position + way * share, turned};
  }

  // How much further what is at `place` after that share gets, if it stays where it then is on this body.
  Vec3 carry(Vec3 place, double share) const {
    Sweep exact = *this;
    exact.turns = true;
    return transformPoint(exact.at(1), transformPoint(inverse(exact.at(share)), place)) - place;
  }
};

// Whether it turns so far that its surface moves by more than it is thick, as far as that can be seen.
bool turnsFar(const BodySet& bodies, BodyIndex body, Vec3 turn);

// Of a body, from where it is now.
Sweep sweepOf(const BodySet& bodies, BodyIndex body, Vec3 way, Vec3 turn);

// The box around a shape all along the way of its body.
Aabb sweptBounds(const ShapeData& shape, const Sweep& own);

// How far the core of `moving` gets on its way past `still`, as a share. What turns is seen from its own frame: the way
// then is where the core ends up in it.
double coreWay(const ShapeData& moving, const Sweep& way, const ShapeData& still, const Sweep& of);

}  // namespace brickfall
