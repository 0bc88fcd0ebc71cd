// A look as images, for programs that draw with textures: a rectangle of a body's surface, colour and relief.
#pragma once
#include <cstdint>
#include <vector>

#include "appearance/surface.h"

namespace brickfall::appearance {

// A flat rectangle in the shape's frame. `u` and `v` are its whole sides: image columns go along u, rows along v.
struct BakeArea {
  Vec3f corner, u, v;  // m
  Vec3f normal;
  Vec3f halfExtents;  // m, of the box it belongs to; 0 for none
};
// The face of a box whose normal is +-`axis` (0 x, 1 y, 2 z), with the texture coordinates of boxMesh and chamferedBoxMesh: u / width
// and v / height of the face's sides in metres give 0 .. 1 of the image.
BakeArea boxFace(Vec3f halfExtents, int axis, bool negative = false);
// A piece of ground, side by side metres about the origin, seen from above.
BakeArea groundPatch(float side);

struct BakedImages {
  int width = 0, height = 0;
  std::vector<std::uint8_t> colour;  // 4 bytes a texel, rows from the top: red, green, blue in sRGB, roughness
  std::vector<std::uint8_t>
      normal;  // 4 bytes a texel: x along u, y against v, z outwards (0 .. 255 for -1 .. 1), height
};
BakedImages bake(const Look& look, const BakeArea& area, int width, int height);

}  // namespace brickfall::appearance
