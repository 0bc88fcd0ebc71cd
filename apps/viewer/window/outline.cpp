#include "viewer_window/outline.h"

#include <algorithm>
#include <map>

namespace brickfall::viewer {
namespace {

constexpr double kFlat = 0.9999;  // cosine between the normals of two faces that are one

using Corner = std::array<float, 3>;
struct Sides {
  Vec3 normal;  // unit, of the first triangle at the edge
  int triangles = 0;
  bool flat = true;
};

Vec3 vecOf(const Corner& place) { return {place[0], place[1], place[2]}; }

}  // namespace

std::vector<std::pair<Vec3, Vec3>> outlineOf(const ShapeMesh& mesh) {
  std::map<std::pair<Corner, Corner>, Sides> edges;
  for (std::size_t i = 0; i + 2 < mesh.indices.size(); i += 3) {
    Corner corners[3];
    for (std::size_t k = 0; k < 3; k++) corners[k] = mesh.positions[mesh.indices[i + k]];
    const Vec3 across = cross(vecOf(corners[1]) - vecOf(corners[0]), vecOf(corners[2]) - vecOf(corners[0]));
    if (!(length(across) > 0)) continue;
    const Vec3 normal = across * (1 / length(across));
    for (int k = 0; k < 3; k++) {
      const Corner &a = corners[k], &b = corners[(k + 1) % 3];
      Sides& sides = edges[{std::min(a, b), std::max(a, b)}];
      if (sides.triangles++ == 0) sides.normal = normal;
      sides.flat = sides.flat && dot(sides.normal, normal) > kFlat;
    }
  }
  std::vector<std::pair<Vec3, Vec3>> out;
  for (const auto& [ends, sides] : edges)
    if (sides.triangles == 1 || !sides.flat) out.push_back({vecOf(ends.first), vecOf(ends.second)});
  return out;
}

}  // namespace brickfall::viewer
