#include "viewer_window/depth_shadows.h"

#include <OgreCamera.h>
#include <OgreSceneManager.h>
#include <OgreShadowCameraSetup.h>

#include <algorithm>
#include <cmath>

namespace brickfall::viewer {

// A square straight along the sun's rays that holds a ball around all casters.
class DepthShadows::Setup : public Ogre::ShadowCameraSetup {
 public:
  void fit(const Aabb& casters, Vec3 towardsSun) {
    sun_ = towardsSun;
    const double reach = length(casters.upper - casters.lower) / 2 + 0.1;
    // Sizes by quarters of an octave, and the middle by whole texels.
    radius_ = std::pow(2.0, std::ceil(std::log2(reach) * 4) / 4);
    middle_ = (casters.lower + casters.upper) * 0.5;
  }

  void getShadowCamera(const Ogre::SceneManager*, const Ogre::Camera*, const Ogre::Viewport*, const Ogre::Light*,
                       Ogre::Camera* eye, std::size_t) const override {
    const Vec3 back = sun_, right = normalized(cross(Vec3{0, 1, 0}, back)), up = cross(back, right);
    const double texel = 2 * radius_ / kMapSize;
    const auto snapped = [texel](double at) { return std::floor(at / texel) * texel; };
    const double x = snapped(dot(right, middle_)), y = snapped(dot(up, middle_)), z = dot(back, middle_) + 2 * radius_;
    Ogre::Affine3 view = Ogre::Affine3::IDENTITY;
    const Vec3 rows[3] = {right, up, back};
    const double shift[3] = {-x, -y, -z};
    for (int i = 0; i < 3; i++) {
      for (int k = 0; k < 3; k++) view[i][k] = Ogre::Real(rows[i][k]);
      view[i][3] = Ogre::Real(shift[i]);
    }
    Ogre::Matrix4 projection = Ogre::Matrix4::IDENTITY;
    projection[0][0] = projection[1][1] = Ogre::Real(1 / radius_);
    projection[2][2] = Ogre::Real(-1 / (2 * radius_));  // from the sun's side to as far behind the casters
    projection[2][3] = Ogre::Real(-1);
    eye->setCustomViewMatrix(true, view);
    eye->setCustomProjectionMatrix(true, projection);
  }

 private:
  Vec3 middle_, sun_{0, 1, 0};
  double radius_ = 10;
};

DepthShadows::DepthShadows(Ogre::SceneManager& scene) : setup_(std::make_shared<Setup>()) {
  scene.setShadowTextureSettings(kMapSize, 1, Ogre::PF_DEPTH16);
  scene.setShadowCameraSetup(setup_);
  // The map is found by our own programs; Ogre's far distance only fades what it draws itself.
  scene.setShadowFarDistance(1e6f);
  scene.setShadowTextureSelfShadow(true);
}

void DepthShadows::fit(const Aabb& casters, Vec3 towardsSun) { setup_->fit(casters, towardsSun); }

}  // namespace brickfall::viewer
