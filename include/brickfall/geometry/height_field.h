// Ground from heights over a grid, as a mesh of triangles: two a cell. Nothing catches at the edges between cells, as with
// every mesh.
#pragma once
#include <span>

#include "brickfall/geometry/triangle_mesh.h"

namespace brickfall {

// `heights` (m), row after row of `columns`; columns go along x, rows along z, the middle of the grid is at x = z = 0. Errors:
// fewer than two rows or columns, heights that do not fill the last row or are not finite, spacings (m) not above 0, more
// cells than a mesh holds.
Result<TriangleMesh> heightField(std::span<const double> heights, std::size_t columns, double spacingX,
                                 double spacingZ);

}  // namespace brickfall
