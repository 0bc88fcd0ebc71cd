// How a material looks at one point of a body: colour, roughness and the small relief, from patterns in the body's own space, so
// that they move with it and go on through it. Faces of a brick differ: long sides are drawn, ends burnt darker, beds bear lime.
#pragma once
#include "appearance/look.h"

namespace brickfall::appearance {

struct SurfacePoint {
  Vec3f position;       // m, in the shape's frame
  Vec3f normal;         // unit, in the shape's frame
  Vec3f halfExtents;    // m, of a box; 0 for other shapes
  float footprint = 0;  // m, width of a pixel there: what is finer is left out; 0 = show all
};

struct Surface {
  Rgb colour;
  float roughness = 1, metalness = 0;
  Vec3f normal;  // unit, tilted by the relief
};

Surface surfaceAt(const Look& look, const SurfacePoint& point);
// m, outwards; its slope is what tilts the normal.
float heightAt(const Look& look, const SurfacePoint& point);
// The colour alone, without the relief: what is baked, and the cheap half of surfaceAt.
Surface paintAt(const Look& look, const SurfacePoint& point);

}  // namespace brickfall::appearance
