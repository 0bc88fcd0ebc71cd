#include "scene/body_bounds.h"

namespace brickfall::scene {

Aabb bodyBounds(const BodyDef& def) {
  Transform pose{def.position, normalized(def.rotation)};
  if (def.shapes.empty()) return {def.position, def.position};
  Aabb box = bounds(def.shapes[0], pose);
  for (const ShapeDef& shape : def.shapes) box = merged(box, bounds(shape, pose));
  return box;
}

}  // namespace brickfall::scene
