// Triangles as the graphics card takes them.
#pragma once
#include <array>
#include <cstdint>
#include <vector>

namespace brickfall::viewer {

struct DrawMesh {
  std::vector<std::array<float, 3>> positions, normals;  // m; unit
  std::vector<std::array<float, 3>> uvs;                 // place in the texture, 1 = once over it, and which layer
  std::vector<std::uint32_t> indices;                    // counter-clockwise seen from outside
};

}  // namespace brickfall::viewer
