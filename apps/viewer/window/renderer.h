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
  std::string log;  // Ogre's own log goes to this file; empty: nowhere
  int samples = 0;  // of antialiasing, 0, 2, 4 or 8
  bool vsync = true;
};

// 4 where there is a graphics card, 0 where the processor has to draw.
int usualSamples();

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
  void setView(const View& view);
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

 private:
  Renderer();
  void start(const NativeWindow& window, const RendererOptions& options);
  void findMedia();

  struct Parts;
  std::unique_ptr<Parts> parts_;
  Ogre::SceneManager* scene_ = nullptr;
  Ogre::Viewport* port_ = nullptr;
  Ogre::Camera* camera_ = nullptr;
  Ogre::SceneNode *eye_ = nullptr, *sun_ = nullptr;
  ShadowMode shadows_ = ShadowMode::none;
};

}  // namespace brickfall::viewer
