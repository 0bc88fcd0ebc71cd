// Draws the dust of dust_cloud.h. Only to be looked at.
#pragma once
#include <OgrePrerequisites.h>

#include <memory>

#include "viewer_core/camera_rig.h"
#include "viewer_window/dust_cloud.h"

namespace brickfall::viewer {

class Dust {
 public:
  explicit Dust(Ogre::SceneManager& scene);
  ~Dust();
  void setSun(Vec3 towardsSun);
  // Looks for new hits in the frame and draws the cloud as it is at the frame's time; rewinding takes puffs away again.
  void update(const Frame& frame, const View& view, bool shown);

 private:
  class Drawn;
  DustCloud cloud_;
  std::unique_ptr<Drawn> drawn_;
};

}  // namespace brickfall::viewer
