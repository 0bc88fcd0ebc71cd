// What is under the mouse. Looks at a frame, never at the running world: what is seen is what is hit, a take as well, and the
// simulation thread is not asked. The frame's bodies stand, all fixed, in a world of their own, whose castRay does the work.
#pragma once
#include <memory>
#include <optional>

#include "viewer_core/commands.h"
#include "viewer_core/frame.h"

namespace brickfall::viewer {

struct PickHit {
  Serial serial = 0;
  int place = 0;        // in the frame's list
  Vec3 point;           // m, world
  Vec3 local;           // m, the same in the body's frame
  Vec3 normal;          // unit, out of the body
  double distance = 0;  // m, along the ray
};

// Used by one thread. Keeps its world between calls: only what has moved since is put in its new place.
class Picker {
 public:
  Picker();
  ~Picker();
  // `blend` as the frame is drawn (blendAt). None: nothing within 1000 km, or no bodies.
  std::optional<PickHit> pick(const Frame& frame, const Ray& ray, double blend = 1);

 private:
  class Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace brickfall::viewer
