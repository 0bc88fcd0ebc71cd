// Where shadows may move while the shutter is open: down-sun of what moves. Their edges want as many samples as moving things do; those
// of what stands still do not, and a ball that rolls away in the distance should not make a whole picture dear.
#pragma once
#include "render/sky.h"
#include "render/stage.h"

namespace brickfall::render {

class MovingShade {
 public:
  MovingShade(const Stage& stage, const Sky& sky, bool cameraMoves);
  // `width`: m, of a pixel at that place: what moves by less than half of it does not count.
  bool reaches(Vec3f position, float width) const;
  bool anyMotion() const { return anyMotion_; }

 private:
  struct Caster {
    Vec3f centre;
    float radius, sweep;  // m
  };
  Vec3f sun_;
  float sunRadius_;
  bool anyMotion_, everywhere_;
  std::vector<Caster> casters_;
};

}  // namespace brickfall::render
