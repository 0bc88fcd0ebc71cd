#include "appearance/bake.h"

#include <algorithm>

namespace brickfall::appearance {

BakeArea boxFace(Vec3f half, int axis, bool negative) {
  const int u = (axis + 1) % 3, v = (axis + 2) % 3;
  const float side = negative ? -1.0f : 1.0f;
  BakeArea area;
  area.halfExtents = half;
  area.normal[axis] = side;
  area.u[u] = 2 * side * half[u];
  area.v[v] = -2 * half[v];  // texture coordinates grow downwards
  area.corner = area.normal * half[axis] - (area.u + area.v) * 0.5f;
  return area;
}

BakeArea groundPatch(float side) {
  BakeArea area;
  area.normal = {0, 1, 0};
  area.u = {side, 0, 0};
  area.v = {0, 0, side};
  area.corner = {-0.5f * side, 0, -0.5f * side};
  return area;
}

BakedImages bake(const Look& look, const BakeArea& area, int width, int height) {
  BakedImages out;
  out.width = std::max(width, 1);
  out.height = std::max(height, 1);
  const std::size_t texels = std::size_t(out.width) * std::size_t(out.height);
  out.colour.reserve(4 * texels);
  out.normal.reserve(4 * texels);
  const Vec3f alongU = normalized(area.u), alongV = normalized(area.v);
  SurfacePoint point;
  point.normal = area.normal;
  point.halfExtents = area.halfExtents;
  point.footprint = std::max(length(area.u) / float(out.width), length(area.v) / float(out.height));
  for (int y = 0; y < out.height; y++)
    for (int x = 0; x < out.width; x++) {
      point.position = area.corner + area.u * ((float(x) + 0.5f) / float(out.width)) +
                       area.v * ((float(y) + 0.5f) / float(out.height));
      const Surface surface = surfaceAt(look, point);
      for (float part : {surface.colour.x, surface.colour.y, surface.colour.z})
        out.colour.push_back(toByte(srgbFromLinear(clampUnit(part))));
      out.colour.push_back(toByte(surface.roughness));
      for (float part : {dot(surface.normal, alongU), -dot(surface.normal, alongV), dot(surface.normal, area.normal)})
        out.normal.push_back(toByte(0.5f + 0.5f * part));
      const float raised = look.relief > 0 ? heightAt(look, point) / (6 * look.relief) : 0;
      out.normal.push_back(toByte(0.5f + raised));
    }
  return out;
}

}  // namespace brickfall::appearance
