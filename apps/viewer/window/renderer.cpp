#include "viewer_window/renderer.h"

#include <OgreCamera.h>
#include <OgreException.h>
#include <OgreLight.h>
#include <OgreLogManager.h>
#include <OgreOverlaySystem.h>
#include <OgreRenderQueue.h>
#include <OgreRenderQueueSortingGrouping.h>
#include <OgreRenderWindow.h>
#include <OgreResourceGroupManager.h>
#include <OgreRoot.h>
#include <OgreSceneManager.h>
#include <OgreSceneNode.h>
#include <OgreViewport.h>

#include <algorithm>
#include <cmath>

#include "viewer_window/programs.h"

namespace brickfall::viewer {
namespace {

constexpr const char* kRenderSystem = "OpenGL 3+ Rendering Subsystem";

}  // namespace

// In the order in which they are made; gone in the other.
struct Renderer::Parts {
  Ogre::LogManager log;
  std::unique_ptr<Ogre::Root> root;
  std::unique_ptr<Ogre::OverlaySystem> overlays;
  Ogre::RenderWindow* window = nullptr;
  bool hidden = false;
};

Renderer::Renderer() : parts_(std::make_unique<Parts>()) {}

Result<std::unique_ptr<Renderer>> Renderer::create(const NativeWindow& window, const RendererOptions& options) {
  std::unique_ptr<Renderer> renderer(new Renderer);
  try {
    renderer->start(window, options);
  } catch (const Ogre::Exception& error) {
    return Error{ErrorCode::wrongState, "the picture cannot be drawn: " + error.getDescription() +
                                            "; expected OpenGL 3.3 or newer (--log FILE has more)"};
  } catch (const std::exception& error) {
    return Error{ErrorCode::wrongState, std::string("the picture cannot be drawn: ") + error.what()};
  }
  return renderer;
}

void Renderer::start(const NativeWindow& window, const RendererOptions& options) {
  fine_ = options.fine;
  parts_->log.createLog(options.log.empty() ? "none" : options.log, true, false, options.log.empty());
  parts_->root = std::make_unique<Ogre::Root>("", "", "");
  Ogre::Root& root = *parts_->root;
  root.loadPlugin(BRICKFALL_OGRE_PLUGINS "/RenderSystem_GL3Plus");
  root.loadPlugin(BRICKFALL_OGRE_PLUGINS "/Codec_STBI");
  Ogre::RenderSystem* system = root.getRenderSystemByName(kRenderSystem);
  if (!system) throw std::runtime_error(std::string(kRenderSystem) + " is not there");
  root.setRenderSystem(system);
  root.initialise(false);

  const WindowSize size = window.size();
  Ogre::NameValuePairList details;
  details["parentWindowHandle"] = std::to_string(window.handle());
  details["FSAA"] = std::to_string(options.samples);
  details["vsync"] = options.vsync ? "Yes" : "No";
  parts_->window = root.createRenderWindow("brickfall", unsigned(size.width), unsigned(size.height), false, &details);
  findMedia();

  scene_ = root.createSceneManager();
  parts_->overlays = std::make_unique<Ogre::OverlaySystem>();
  scene_->addRenderQueueListener(parts_->overlays.get());
  camera_ = scene_->createCamera("eye");
  camera_->setFarClipDistance(0);  // infinite: stencil shadows ask for it
  camera_->setAutoAspectRatio(true);
  eye_ = scene_->getRootSceneNode()->createChildSceneNode();
  eye_->attachObject(camera_);
  port_ = parts_->window->addViewport(camera_);
  port_->setBackgroundColour(Ogre::ColourValue(0.12f, 0.13f, 0.15f));
  setSun({0, 1, 0});
  keepShadowsToTheScene();
}

// Modulative shadows are drawn once for each group of the render queue that lets them: sky, lines and panel must not, or the
// scene behind them is darkened again.
void Renderer::keepShadowsToTheScene() {
  for (const int group :
       {int(Ogre::RENDER_QUEUE_SKIES_EARLY), int(Ogre::RENDER_QUEUE_8), int(Ogre::RENDER_QUEUE_OVERLAY)}) {
    scene_->getRenderQueue()->getQueueGroup(Ogre::uint8(group))->setShadowsEnabled(false);
  }
}

void Renderer::findMedia() {
  auto& groups = Ogre::ResourceGroupManager::getSingleton();
  groups.addResourceLocation(BRICKFALL_OGRE_MEDIA "/ShadowVolume", "FileSystem", Ogre::RGN_INTERNAL);
  groups.initialiseAllResourceGroups();
}

void Renderer::setSun(Vec3 towardsSun) {
  if (!sun_) {
    // Our programs know the sun themselves; this light is what Ogre casts shadows by.
    Ogre::Light* light = scene_->createLight("sun");
    light->setType(Ogre::Light::LT_DIRECTIONAL);
    sun_ = scene_->getRootSceneNode()->createChildSceneNode();
    sun_->attachObject(light);
    const appearance::Rgb shade = stencilShade().pixel;
    scene_->setShadowColour(Ogre::ColourValue(shade.x, shade.y, shade.z));
  }
  sun_->setDirection(Ogre::Real(-towardsSun.x), Ogre::Real(-towardsSun.y), Ogre::Real(-towardsSun.z),
                     Ogre::Node::TS_WORLD);
}

Renderer::~Renderer() {
  if (!parts_->root) return;
  if (scene_) {
    if (parts_->overlays) scene_->removeRenderQueueListener(parts_->overlays.get());
    parts_->root->destroySceneManager(scene_);
  }
  parts_->overlays.reset();
}

void Renderer::setView(const View& view, double near, PixelPlace shift) {
  camera_->setNearClipDistance(Ogre::Real(near));
  eye_->setPosition(Ogre::Real(view.position.x), Ogre::Real(view.position.y), Ogre::Real(view.position.z));
  eye_->setOrientation(Ogre::Real(view.rotation.w), Ogre::Real(view.rotation.x), Ogre::Real(view.rotation.y),
                       Ogre::Real(view.rotation.z));
  camera_->setFOVy(Ogre::Degree(Ogre::Real(view.fieldOfViewDegrees)));
  // At one metre from the eye, where Ogre takes the offset.
  const double pixel =
      2 * std::tan(view.fieldOfViewDegrees * 3.14159265358979 / 360) / std::max(port_->getActualHeight(), 1);
  camera_->setFrustumOffset(Ogre::Real(-shift.x * pixel), Ogre::Real(shift.y * pixel));
}

void Renderer::setWireframe(bool on) { camera_->setPolygonMode(on ? Ogre::PM_WIREFRAME : Ogre::PM_SOLID); }

void Renderer::setShadows(ShadowMode mode) {
  shadows_ = mode;
  switch (mode) {
    case ShadowMode::none:
      scene_->setShadowTechnique(Ogre::SHADOWTYPE_NONE);
      break;
    case ShadowMode::stencil:
      scene_->setShadowTechnique(Ogre::SHADOWTYPE_STENCIL_MODULATIVE);
      break;
    case ShadowMode::depth:
      scene_->setShadowTechnique(Ogre::SHADOWTYPE_TEXTURE_MODULATIVE_INTEGRATED);
      break;
  }
}

void Renderer::resize(WindowSize size) {
  if (size.width > 0 && size.height > 0) parts_->window->resize(unsigned(size.width), unsigned(size.height));
}

void Renderer::setHidden(bool hidden) { parts_->hidden = hidden; }

void Renderer::render() {
  if (!parts_->hidden) parts_->root->renderOneFrame();
}

Picture Renderer::picture() const {
  Picture picture{int(parts_->window->getWidth()), int(parts_->window->getHeight()), {}};
  picture.pixels.resize(std::size_t(picture.width) * std::size_t(picture.height) * 3);
  const Ogre::Box all(0, 0, unsigned(picture.width), unsigned(picture.height));
  parts_->window->copyContentsToMemory(all, Ogre::PixelBox(all, Ogre::PF_BYTE_RGB, picture.pixels.data()),
                                       Ogre::RenderTarget::FB_AUTO);
  return picture;
}

std::string Renderer::card() const { return parts_->root->getRenderSystem()->getCapabilities()->getDeviceName(); }

}  // namespace brickfall::viewer
