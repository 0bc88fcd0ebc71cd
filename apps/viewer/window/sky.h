// The sky behind everything: a gradient, bright around the sun, by the same formula that lights the bodies.
#pragma once
#include <OgrePrerequisites.h>

#include <memory>

#include "brickfall/math.h"

namespace brickfall::viewer {

class Sky {
 public:
  explicit Sky(Ogre::SceneManager& scene);
  ~Sky();
  void setVisible(bool visible);
  void setSun(Vec3 towardsSun);

 private:
  class Screen;
  std::unique_ptr<Screen> screen_;
};

}  // namespace brickfall::viewer
