// The surface of a body as flat pieces: what air and blasts press on.
#pragma once
#include <vector>

#include "brickfall/machines.h"

namespace brickfall::machines {

struct Face {
  Vec3 corners[3];  // m, in the world, counter-clockwise seen from outside
  Vec3 centre() const { return (corners[0] + corners[1] + corners[2]) * (1.0 / 3); }
  Vec3 area() const { return cross(corners[1] - corners[0], corners[2] - corners[0]) * 0.5; }  // m2, outwards
};

// Appends the triangles of a shape of a body at `pose`. Round ones are divided coarsely. A sensor has none.
void appendFaces(const ShapeDef& shape, const Transform& pose, std::vector<Face>& out);

// Whether a way along `direction` from `origin`, on a face of `own`, meets any other shape.
bool meets(const World& world, ShapeId own, Vec3 origin, Vec3 direction, double farthest);

}  // namespace brickfall::machines
