// The spring by which a body is dragged: critically damped at the point where it is held, never harder than its limit. Forces
// only, through the world's calls: what is dragged pushes and is held back like anything else.
#pragma once
#include "brickfall/world.h"
#include "viewer_core/frame.h"

namespace brickfall::viewer {

struct DragSpring {
  BodyId body;
  Serial serial = 0;
  Vec3 local;            // m, in the body's frame: where it is held
  Vec3 target;           // m, world
  double strength = 20;  // largest pull, in weights of the body
  double force = 0;      // N, in the last step
};

// An error if the body can't be dragged: it is gone, or no force moves it.
Status checkDraggable(const World& world, BodyId body);
// For the coming step of dt seconds.
Status pull(World& world, DragSpring& spring, double dt);
// Where it is held now, m, world.
Vec3 heldPoint(const World& world, const DragSpring& spring);

}  // namespace brickfall::viewer
