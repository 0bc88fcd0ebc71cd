// All that is in the picture, ready for rays: shapes of a take's bodies as Embree has them. Equal shapes share their triangles (an
// instance each); what moves while the shutter is open is an instance with two poses. Planes have no end and no triangles.
#pragma once
#include <memory>
#include <vector>

#include "appearance/look.h"
#include "render/motion.h"

namespace brickfall::render {

using appearance::Vec3f;
using Mat3f = Mat3T<float>;

struct Ray {
  Vec3f origin, direction;  // unit
  float time = 0;           // 0 the shutter opens .. 1 it closes
  float far = 1e30f;        // m
};

constexpr float kNoEnd = 1e9f;  // m, radius of a plane

// A shape of a body.
struct Part {
  std::uint32_t body = 0;
  appearance::Look look;
  Vec3f halfExtents;  // of a box; else 0
  Mat3f open, close;  // the shape's frame to the world, when the shutter opens and closes
  Vec3f origin;       // m, of the shape's frame when the shutter opens
  float radius = 0;   // m, about its origin; of a plane without end
  float sweep = 0;    // m: how far its surface moves while the shutter is open, about
  bool moves = false;

  bool isFloor() const { return look.kind == appearance::Kind::ground && radius >= kNoEnd; }
  Vec3f toWorld(Vec3f local, float time) const {
    return moves ? normalized(open * local * (1 - time) + close * local * time) : open * local;
  }
};

struct Hit {
  int part = -1;  // none
  float distance = 1e30f;
  Vec3f local, localNormal;  // in the shape's frame; the normal is smooth over round shapes and rounded edges
  Vec3f normal;              // of the triangle, in the world, towards the ray
};

class Stage {
 public:
  // Refused only where a shape has no triangles (a take that no engine made).
  static Result<Stage> create(const TakeReader& take);
  Stage(Stage&&) noexcept;
  Stage& operator=(Stage&&) noexcept;
  ~Stage();

  // False: nothing is elsewhere than it was, so that a picture from the same place would be the same.
  bool place(const Motion::Shutter& shutter);
  // The nearest of what the ray meets. Any number of threads at once.
  Hit firstHit(const Ray& ray) const;
  bool isBlocked(const Ray& ray) const;
  const std::vector<Part>& parts() const;

 private:
  struct Impl;
  explicit Stage(std::unique_ptr<Impl> impl);
  std::unique_ptr<Impl> impl_;
};

}  // namespace brickfall::render
