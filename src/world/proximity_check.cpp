// Invariants of the bounds that shapes are kept in.
#include "world/proximity.h"

namespace brickfall {

void Proximity::checkStructure(Findings& f, const Registry& registry) const {
  f.expect(around.size() == registry.shapes.slots(), "bounds: not one for each shape");
}

void Proximity::checkBounds(Findings& f, const Registry& registry) const {
  for (const std::string& text : broadPhase->validate()) f.expect(false, "broad phase: " + text);
  for (BodyIndex i = 0; i < registry.bodies.slots(); i++) {
    if (!registry.bodies.alive(i)) continue;
    for (ShapeIndex s : registry.bodies.shapes[i]) {
      const Surroundings& at = around[s];
      if (at.proxy == kNoProxy) {
        f.expect(!registry.bodies.takesPart(i), "shape", s, "not in the broad phase");
        continue;
      }
      Aabb now = bounds(registry.shapes.data[s].geometry, registry.shapes.worldPose(s, registry.bodies));
      f.expect(contains(kept(s), at.swept), "shape", s, "its swept bounds are outside the kept ones");
      f.expect(contains(kept(s), now), "shape", s, "outside its kept bounds");
    }
  }
}

}  // namespace brickfall
