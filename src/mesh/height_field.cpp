#include "brickfall/geometry/height_field.h"

#include <cmath>
#include <string>

namespace brickfall {

namespace {

Error badGrid(const std::string& what) { return {ErrorCode::invalidArgument, "heightField: " + what}; }

}  // namespace

Result<TriangleMesh> heightField(std::span<const double> heights, std::size_t columns, double spacingX,
                                 double spacingZ) {
  if (columns < 2 || heights.size() / columns < 2 || heights.size() % columns != 0)
    return badGrid("found " + std::to_string(heights.size()) + " heights in rows of " + std::to_string(columns) +
                   ", expected two whole rows of two at least");
  if (!(spacingX > 0 && spacingZ > 0 && std::isfinite(spacingX) && std::isfinite(spacingZ)))
    return badGrid("found a spacing of " + std::to_string(spacingX) + " and " + std::to_string(spacingZ) +
                   ", expected finite lengths above 0");
  if (heights.size() > TriangleMesh::kMaxTriangles / 2)
    return badGrid("found " + std::to_string(heights.size()) + " heights, expected at most " +
                   std::to_string(TriangleMesh::kMaxTriangles / 2));
  const std::size_t rows = heights.size() / columns;
  std::vector<Vec3> corners;
  corners.reserve(heights.size());
  for (std::size_t row = 0; row < rows; row++)
    for (std::size_t column = 0; column < columns; column++)
      corners.push_back({(double(column) - 0.5 * double(columns - 1)) * spacingX, heights[row * columns + column],
                         (double(row) - 0.5 * double(rows - 1)) * spacingZ});
  std::vector<std::uint32_t> indices;
  indices.reserve(6 * (rows - 1) * (columns - 1));
  for (std::size_t row = 0; row + 1 < rows; row++)
    for (std::size_t column = 0; column + 1 < columns; column++) {
      const auto a = std::uint32_t(row * columns + column), b = a + 1, c = a + std::uint32_t(columns), d = c + 1;
      indices.insert(indices.end(), {a, c, b, b, c, d});
    }
  return TriangleMesh::create(corners, indices);
}

}  // namespace brickfall
