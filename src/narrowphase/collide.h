// Contact of two shapes at a relative pose.
#pragma once
#include "geometry/shape.h"
#include "narrowphase/manifold.h"

namespace brickfall {

// Points where the shapes are nearer than `margin` (m, >= 0) along the contact normal. Double precision, in the frame
// of a: exact however far from the origin the two are. Every pair of types, except meshes
// (mesh_collide.h); two planes never touch. Depends on nothing but its arguments. One file per pair of types.
// `loaded`: of the contact that the two have already; these points stay as long as they exist.
void collide(const Shape& a, const Shape& b, const Transform& bInA, double margin, Manifold& out,
             const LoadedPoints& loaded = {});

}  // namespace brickfall
