// Dust where bodies hit each other: a few puffs each, that rise, spread and fade. Only to be looked at.
#pragma once
#include <OgrePrerequisites.h>

#include <memory>
#include <vector>

#include "viewer_core/camera_rig.h"
#include "viewer_core/frame.h"

namespace brickfall::viewer {

class Dust {
 public:
  explicit Dust(Ogre::SceneManager& scene);
  ~Dust();
  void setSun(Vec3 towardsSun);
  // Looks for new hits in the frame and draws the cloud as it is at the frame's time; rewinding takes puffs away again.
  void update(const Frame& frame, const View& view, bool shown);
  std::size_t count() const { return puffs_.size(); }

 private:
  struct Puff {
    double born = 0;  // s, simulated
    Vec3 place, drift;
    float radius = 0.05f, strength = 1;
  };
  class Drawn;
  void findHits(const Frame& frame);
  void puff(const Frame& frame, std::size_t body, std::uint32_t salt);

  std::vector<Puff> puffs_;
  std::shared_ptr<const RunInfo> run_;
  std::uint64_t lastFrame_ = 0;
  double lastTime_ = 0;
  std::unique_ptr<Drawn> drawn_;
};

}  // namespace brickfall::viewer
