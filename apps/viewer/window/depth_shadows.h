// Depth shadows: one map from the sun, fitted to what can move, so that no texel is spent on empty ground.
#pragma once
#include <OgrePrerequisites.h>

#include <memory>

#include "brickfall/math.h"

namespace brickfall::viewer {

class DepthShadows {
 public:
  static constexpr int kMapSize = 2048;

  explicit DepthShadows(Ogre::SceneManager& scene);
  // All that casts lies in it, m. Moves in coarse steps, so that edges do not crawl while bodies fly.
  void fit(const Aabb& casters, Vec3 towardsSun);

 private:
  class Setup;
  std::shared_ptr<Setup> setup_;
};

}  // namespace brickfall::viewer
