// Where the scene is looked at from. Knows no window: what was pressed and moved comes in as numbers, a place and a rotation come
// out. Changes are smooth and do not depend on the frame rate.
#pragma once
#include <optional>
#include <vector>

#include "brickfall/scenery.h"
#include "viewer_core/commands.h"
#include "viewer_core/frame.h"

namespace brickfall::viewer {

enum class CameraMode : std::uint8_t {
  orbit,   // about a point
  fly,     // goes where it looks
  follow,  // orbit about a body that moves, at a distance by the body's size
  watch,   // stays where it stands and turns after a body, until the user moves it
};

// What a renderer needs. The camera looks along -z of its frame, y is up in the picture, as in Ogre and glTF.
struct View {
  Vec3 position;  // m
  Quat rotation;
  double fieldOfViewDegrees = 45;  // vertical
  Vec3 forward() const;
  Vec3 right() const;
  Vec3 up() const;
};

// A picture of `width` x `height` pixels; x to the right, y down, from the upper left corner.
struct Viewport {
  int width = 1280, height = 720;
};
Ray rayThrough(const View& view, const Viewport& port, double x, double y);
// Where a point is in the picture; none if it lies behind the camera.
struct PixelPlace {
  double x = 0, y = 0;
};
std::optional<PixelPlace> pixelOf(const View& view, const Viewport& port, Vec3 point);

class CameraRig {
 public:
  // --- What a scene brings.
  void setGround(double height);  // the camera never goes under it (RunInfo::ground)
  // Goes there; `atOnce` without the way. `list`: to find the body that it is to turn after; null: it looks at its target.
  void goTo(const Camera& saved, bool atOnce = false, const BodyList* list = nullptr);
  // All of the box in the picture, from where it looks now.
  void frame(const Aabb& box, const Viewport& port, bool atOnce = false);

  // --- How it moves.
  CameraMode mode() const { return mode_; }
  void setMode(CameraMode mode);  // keeps place and direction; follow only through follow(), watch through goTo()
  // `radius`: the body's, m. Its distance is at least kNearestRadii radii then and stays what the user makes of it.
  void follow(Serial body, double radius);
  Serial followed() const { return followed_; }

  // --- What the user does. Turns in rad: to the right and up. `pixels` of a picture `height` pixels high.
  void turn(double right, double up);
  void drag(double pixelsRight, double pixelsDown, const Viewport& port);  // moves the point looked at with the mouse
  void zoom(double notches);                                               // > 0: nearer (orbit, follow); forward (fly)
  // Keys held: each -1 .. 1, along right, up and forward. Metres by itself: by the distance, or flySpeed.
  void move(Vec3 keys, double seconds);
  double flySpeed() const { return flySpeed_; }
  void setFlySpeed(double speed);  // m/s, .05 .. 200

  // --- Time of the window, s. `target`: where the followed or watched body is drawn now; none: it is gone, and so is that mode.
  void update(double seconds, const std::optional<Vec3>& target = {});
  View view() const;
  Vec3 target() const;      // m: what it looks at
  double distance() const;  // m, to it
  // As a scene file would have it: for "copy this view".
  Camera asCamera() const;

  static constexpr double kNearestRadii = 3, kFirstRadii = 12;  // of a followed body

 private:
  struct Pose {
    Vec3 target;
    double yaw = 0, pitch = 0;  // rad: yaw 0 looks along -z, grows to the left; pitch > 0 looks up
    double distance = 5;        // m
    double fieldOfViewDegrees = 45;
  };
  static Vec3 forwardOf(const Pose& pose);
  Vec3 eyeOf(const Pose& pose) const;
  void keepAboveGround(Pose& pose) const;
  void turnTo(Vec3 target);
  void endWatch();
  double leastDistance() const;

  CameraMode mode_ = CameraMode::orbit;
  Pose wanted_, shown_;
  Serial followed_ = 0;
  double followedRadius_ = 0;
  double ground_ = -1e30;
  double flySpeed_ = 4;
};

}  // namespace brickfall::viewer
