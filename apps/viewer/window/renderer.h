// Ogre: its start and end, the scene, the camera, and one picture after the other.
#pragma once
#include <OgrePrerequisites.h>

#include <memory>
#include <string>
#include <vector>

#include "brickfall/result.h"
#include "viewer_core/camera_rig.h"
#include "viewer_window/native_window.h"

namespace brickfall::viewer {

enum class ShadowMode : std::uint8_t { none, stencil, depth };

struct RendererOptions {
  std::string log;   // Ogre's own log goes to this file; empty: nowhere
  int samples = 0;   // of antialiasing, 0, 2, 4 or 8
  bool fine = true;  // textures are filtered as a graphics card does without noticing
  bool vsync = true;
};

// A picture as pixels, from the upper left corner, three bytes each.
struct Picture {
  int width = 0, height = 0;
  std::vector<unsigned char> pixels;
};

class Renderer {
 public:
  // Ogre says what is wrong by exceptions: they end here.
  static Result<std::unique_ptr<Renderer>> create(const NativeWindow& window, const RendererOptions& options);
  ~Renderer();
  Renderer(const Renderer&) = delete;
  Renderer& operator=(const Renderer&) = delete;

  Ogre::SceneManager& scene() const { return *scene_; }
  Ogre::Viewport& port() const { return *port_; }
  // shift: pixels by which the middle of the view lies right of and below that of the window, for a panel that covers a part.
  // near: m, what is closer to the eye is not drawn.
  void setView(const View& view, double near, PixelPlace shift = {});
  void setSun(Vec3 towardsSun);
  void setWireframe(bool on);
  // What bodies are drawn with follows: BodyDrawer::setShadows.
  void setShadows(ShadowMode mode);
  ShadowMode shadows() const { return shadows_; }
  void resize(WindowSize size);
  // The window is not to be seen: nothing is drawn.
  void setHidden(bool hidden);
  void render();
  Picture picture() const;
  std::string card() const;  // who draws: "llvmpipe ..."
  bool fine() const { return fine_; }

 private:
  Renderer();
  void start(const NativeWindow& window, const RendererOptions& options);
  void findMedia();
  void keepShadowsToTheScene();

  struct Parts;
  std::unique_ptr<Parts> parts_;
  Ogre::SceneManager* scene_ = nullptr;
  Ogre::Viewport* port_ = nullptr;
  Ogre::Camera* camera_ = nullptr;
  Ogre::SceneNode *eye_ = nullptr, *sun_ = nullptr;
  ShadowMode shadows_ = ShadowMode::none;
  bool fine_ = true;
};

}  // namespace brickfall::viewer
