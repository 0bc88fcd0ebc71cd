#include "render/moving_shade.h"

namespace brickfall::render {

namespace {

constexpr std::size_t kMostCasters = 256;  // more would cost more to ask than the samples that are saved
constexpr float kSeenShift = 0.5f;         // of a pixel's width: an edge that moves by less is as if it stood

}  // namespace

MovingShade::MovingShade(const Stage& stage, const Sky& sky, bool cameraMoves)
    : sun_(sky.sun), sunRadius_(sky.sunRadius), anyMotion_(cameraMoves), everywhere_(cameraMoves) {
  for (const Part& part : stage.parts()) {
    if (!part.moves) continue;
    anyMotion_ = true;
    if (casters_.size() == kMostCasters) everywhere_ = true;
    if (everywhere_) return;
    casters_.push_back({part.origin, part.radius, part.sweep});
  }
}

bool MovingShade::reaches(Vec3f position, float width) const {
  if (everywhere_) return true;
  for (const Caster& caster : casters_) {
    if (caster.sweep < kSeenShift * width) continue;
    const Vec3f way = caster.centre - position;
    const float towards = dot(way, sun_),
                reach = caster.radius + caster.sweep + sunRadius_ * std::fabs(towards) + width;
    if (towards > -reach && dot(way, way) - towards * towards < reach * reach) return true;
  }
  return false;
}

}  // namespace brickfall::render
