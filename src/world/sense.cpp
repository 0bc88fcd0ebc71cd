#include "world/sense.h"

#include "geometry/queries.h"
#include "world/diary.h"
#include "world/proximity.h"
#include "world/registry.h"

namespace brickfall {

namespace {

// Conditions on another shape to be sensed, wherever it is.
bool isSensed(const Registry& registry, const ShapeData& sensor, const ShapeData& other) {
  if (other.body == sensor.body || other.def.sensor) return false;
  if (registry.bodies.data[other.body].type == BodyType::fixed) return false;
  return filtersAllow(sensor.def.filter, other.def.filter);
}

}  // namespace

void sense(const Registry& registry, const Proximity& proximity, Diary& diary) {
  if (registry.sensors.empty() && diary.sensed.empty()) return;
  diary.sensedNow.clear();
  for (ShapeIndex sensor : registry.sensors) {
    const ShapeData& s = registry.shapes.data[sensor];
    if (!registry.bodies.takesPart(s.body)) continue;
    const Transform pose = registry.shapes.worldPose(sensor, registry.bodies), back = inverse(pose);
    proximity.broadPhase->query(bounds(s.geometry, pose), [&](std::uint32_t shape) {
      const ShapeData& o = registry.shapes.data[shape];
      if (!isSensed(registry, s, o)) return true;
      const Transform placed = back * registry.shapes.worldPose(shape, registry.bodies);
      if (penetrationDepth(s.geometry, o.geometry, placed) > 0)
        diary.sensedNow.push_back(
            {registry.idOfShape(sensor), registry.idOfShape(shape), registry.idOf(s.body), registry.idOf(o.body)});
      return true;
    });
  }
  diary.tellSensed();
}

}  // namespace brickfall
