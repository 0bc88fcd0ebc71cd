// From triangles to faces: nearly coplanar triangles become one polygon, and corners that then lie within a face or
// within an edge go.
#pragma once
#include <span>
#include <vector>

#include "geometry/hull_triangles.h"

namespace brickfall {

// Corners of each face in order; empty if at this tolerance (grid steps) the faces do not close up to a solid. At 0 only
// what is exactly in one plane is merged: then they always do, and all faces are convex.
std::vector<std::vector<int>> mergedFaces(std::span<const GridPoint> points, std::span<const HullTriangle> triangles,
                                          double tolerance);

}  // namespace brickfall
