// The sky behind everything: a gradient with the sun in it, by the same formula that lights the bodies.
#pragma once
#include <OgrePrerequisites.h>

#include <memory>

namespace brickfall::viewer {

class Sky {
 public:
  explicit Sky(Ogre::SceneManager& scene);
  ~Sky();
  void setVisible(bool visible);

 private:
  class Screen;
  std::unique_ptr<Screen> screen_;
};

}  // namespace brickfall::viewer
