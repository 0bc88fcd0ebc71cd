// From places on the picture to rays into the scene, for a camera that may move while the shutter is open.
#pragma once
#include "brickfall/scenery.h"
#include "render/stage.h"

namespace brickfall::render {

struct View {
  Vec3f position, right, up, forward;  // right and up reach half the picture's height at distance 1
};
View viewOf(const Camera& camera);
bool samePose(const Camera& a, const Camera& b);

class CameraRays {
 public:
  CameraRays(const Camera& open, const Camera& close, int width, int height);
  // x from the left, y from the top, in pixels.
  Ray through(float x, float y, float time) const;
  // How long a pixel is on a plane that a ray through its middle meets, along each axis of a frame: m.
  Vec3f footprint(const Ray& ray, float distance, Vec3f normal, const Mat3f& toFrame) const;
  bool moves() const { return moves_; }
  // The angle that a pixel in the middle covers, rad.
  float pixelAngle() const { return pixelAngle_; }

 private:
  View open_, close_;
  bool moves_;
  float width_, height_, pixelAngle_;
};

}  // namespace brickfall::render
