// Puffs of dust where bodies hit, in the colour of what broke: as the page has them (apps/web/src/dust.ts), from the time alone.
#pragma once
#include <span>
#include <vector>

#include "brickfall/take.h"
#include "render/camera_rays.h"
#include "render/picture.h"

namespace brickfall::render {

struct Puff {
  Vec3f place;
  float size = 0, opacity = 0;  // m across; of its middle
  float seed = 0;               // tells it from others
  Rgb colour;
};

class Dust {
 public:
  explicit Dust(const TakeReader& take);
  std::vector<Puff> at(double time) const;  // s

 private:
  struct Source {
    double time = 0;
    Vec3f place;
    float force = 0;  // 0 .. 1
    Rgb colour;
  };
  std::vector<Source> sources_;  // by time
};

// Over a picture's light, as far as nothing stands before it.
void addDust(std::vector<Rgb>& light, const Picture& picture, const View& view, std::span<const Puff> puffs,
             int threads);

}  // namespace brickfall::render
