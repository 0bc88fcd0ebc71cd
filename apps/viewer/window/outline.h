// The edges of a shape, for lines over the picture: without those that only divide a flat face.
#pragma once
#include <utility>
#include <vector>

#include "brickfall/geometry/shape_mesh.h"

namespace brickfall::viewer {

// From end to end, m, in the frame of the mesh; each edge once.
std::vector<std::pair<Vec3, Vec3>> outlineOf(const ShapeMesh& mesh);

}  // namespace brickfall::viewer
